#include "measure/regress/approval.h"

#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "core/files.h"
#include "core/json_node.h"

namespace fanbeam::measure {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMostRecord_bytes = 64U << 20U;
constexpr core::JsonLimits kLimits{64, 20'000'000};
constexpr std::size_t kMostRows = 10'000'000;
constexpr const char* kFile = "approval.json";

core::JsonFile read_record(const fs::path& path) {
  core::ProblemList problems;
  const auto file = core::read_json_file(path, kMostRecord_bytes, kLimits, problems);
  problems.throw_if_errors();
  return *file;
}

std::string required_text(const core::JsonNode& record, const char* key) {
  return record.required(key).text().value_or("");
}

// Rows of a list are told by what they are about: a new one does not move the others.
std::string row_name(const core::JsonNode& row, std::size_t index) {
  if (row.is_object())
    for (const char* key : {"effect", "material"})
      if (const core::JsonNode name = row.member(key); name.present())
        return name.any_text().value_or("");
  return std::to_string(index);
}

void flatten(const std::string& key, const core::JsonNode& value, Settings& settings) {
  if (value.is_object()) {
    for (const std::string& name : value.keys())
      flatten(key.empty() ? name : key + "." + name, value.member(name), settings);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.elements(); ++i)
      flatten(key + "[" + row_name(value.element(i), i) + "]", value.element(i), settings);
  } else {
    settings[key] = value.dumped();
  }
}

Settings settings_of(const core::JsonNode& run) {
  Settings settings;
  for (const std::string& key : run.keys()) {
    // A limit stands beside the level that pictures were made at.
    if (key == "version" || key == "commit" || key == "isa" || key == "frames" || key == "plan")
      continue;
    flatten(key, run.member(key), settings);
  }
  // Reasons and bounds follow from the rest.
  const core::JsonNode plan = run.required("plan");
  const std::size_t effects = plan.size(kMostRows);
  for (std::size_t i = 0; i < effects; ++i)
    for (const char* key : {"effect", "on"})
      flatten("plan[" + row_name(plan.element(i), i) + "]." + key, plan.element(i).required(key),
              settings);
  const core::JsonNode frames = run.required("frames");
  const std::size_t count = frames.size(kMostRows);
  Json indices = Json::array();
  for (std::size_t i = 0; i < count; ++i)
    if (const auto index = frames.element(i).required("index").whole(0, 2'000'000'000))
      indices.push_back(*index);
  settings["frames"] = indices.dump();
  return settings;
}

}  // namespace

Approval record_of(const fs::path& rendered) {
  core::ProblemList problems;
  const core::JsonFile run_file = read_record(rendered / "run.json");
  const core::JsonFile timing_file = read_record(rendered / "timing.json");
  const core::JsonNode run(run_file, problems), timing(timing_file, problems);
  Approval record{"", required_text(run, "version"), required_text(run, "commit"),
                  required_text(timing, "isa"), settings_of(run)};
  problems.throw_if_errors();
  return record;
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
  const fs::path path = folder / kFile;
  if (!fs::exists(path)) return std::nullopt;
  const core::JsonFile file = read_record(path);
  core::ProblemList problems;
  const core::JsonNode json(file, problems);
  Approval approval{json.required("reason").any_text().value_or(""),
                    required_text(json, "version"),
                    required_text(json, "commit"),
                    required_text(json, "isa"),
                    {}};
  const core::JsonNode settings = json.required("settings");
  for (const std::string& key : settings.keys())
    approval.settings[key] = settings.member(key).dumped();
  problems.throw_if_errors();
  return approval;
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

}  // namespace fanbeam::measure
