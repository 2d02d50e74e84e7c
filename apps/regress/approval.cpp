#include "apps/regress/approval.h"

#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "core/files.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMostApproval_bytes = 64U << 20U;
constexpr const char* kFile = "approval.json";

Json read_json(const fs::path& file) {
  try {
    return Json::parse(core::read_file(file, kMostApproval_bytes));
  } catch (const Json::exception& error) {
    core::throw_input_error(core::ErrorClass::parse, core::Place{file.string()}, "", error.what(),
                            "the JSON that this program writes");
  }
}

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Rows of a list are told by what they are about: a new one does not move the others.
std::string row_name(const Json& row, std::size_t index) {
  if (row.is_object())
    for (const char* key : {"effect", "material"})
      if (row.contains(key) && row[key].is_string()) return row[key].get<std::string>();
  return std::to_string(index);
}

void flatten(const std::string& key, const Json& value, Settings& settings) {
  if (value.is_object()) {
    for (const auto& [name, member] : value.items())
      flatten(key.empty() ? name : key + "." + name, member, settings);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      flatten(key + "[" + row_name(value[i], i) + "]", value[i], settings);
  } else {
    settings[key] = dump(value);
  }
}

Settings settings_of(Json run) {
  Json frames = Json::array();
  for (const Json& frame : run.at("frames")) frames.push_back(frame.at("index"));
  // A limit stands beside the level that pictures were made at.
  for (const char* apart : {"version", "commit", "frames", "isa"}) run.erase(apart);
  // Reasons and bounds follow from the rest.
  for (Json& row : run.at("plan")) row = {{"effect", row.at("effect")}, {"on", row.at("on")}};
  Settings settings;
  flatten("", run, settings);
  settings["frames"] = dump(frames);
  return settings;
}

}  // namespace

Approval record_of(const fs::path& rendered) {
  const Json run = read_json(rendered / "run.json");
  const Json timing = read_json(rendered / "timing.json");
  try {
    return {"", run.at("version").get<std::string>(), run.at("commit").get<std::string>(),
            timing.at("isa").get<std::string>(), settings_of(run)};
  } catch (const Json::exception& error) {
    core::throw_input_error(core::ErrorClass::parse, core::Place{(rendered / "run.json").string()},
                            "", error.what(), "the records that fanbeam render writes");
  }
}

std::vector<SettingChange> changes(const Approval& approval, const Approval& now) {
  std::vector<SettingChange> found;
  const auto add = [&](const std::string& key, const std::string& before,
                       const std::string& after) {
    if (before != after) found.push_back({key, before, after});
  };
  add("version", approval.version, now.version);
  add("commit", approval.commit, now.commit);
  add("instruction level", approval.isa, now.isa);
  Settings keys = approval.settings;
  keys.insert(now.settings.begin(), now.settings.end());
  const auto value = [](const Settings& settings, const std::string& key) {
    const auto entry = settings.find(key);
    return entry == settings.end() ? std::string() : entry->second;
  };
  for (const auto& [key, any] : keys)
    add(key, value(approval.settings, key), value(now.settings, key));
  return found;
}

std::optional<Approval> read_approval(const fs::path& folder) {
  const fs::path file = folder / kFile;
  if (!fs::exists(file)) return std::nullopt;
  const Json json = read_json(file);
  try {
    Approval approval{json.at("reason").get<std::string>(),
                      json.at("version").get<std::string>(),
                      json.at("commit").get<std::string>(),
                      json.at("isa").get<std::string>(),
                      {}};
    for (const auto& [key, value] : json.at("settings").items())
      approval.settings[key] = dump(value);
    return approval;
  } catch (const Json::exception& error) {
    core::throw_input_error(core::ErrorClass::parse, core::Place{file.string()}, "", error.what(),
                            "reason, version, commit, isa and settings");
  }
}

void write_approval(const fs::path& folder, const Approval& approval) {
  Json json = {{"reason", approval.reason},
               {"version", approval.version},
               {"commit", approval.commit},
               {"isa", approval.isa},
               {"settings", Json::object()}};
  for (const auto& [key, value] : approval.settings) json["settings"][key] = Json::parse(value);
  core::write_file_atomically(folder / kFile,
                              json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace fanbeam::apps
