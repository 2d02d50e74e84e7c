#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/errors.h"
#include "datasets/run_makers_private.h"
#include "session/version.h"

namespace fanbeam::datasets {

using Json = nlohmann::ordered_json;

namespace {

// Drawn by another C library, a value may differ in its last digits.
bool is_same(const Json& told, const Value& drawn) {
  constexpr double kShare = 1e-9;
  if (const auto* word = std::get_if<std::string>(&drawn))
    return told.is_string() && told.get<std::string>() == *word;
  const double value = std::get<double>(drawn);
  return told.is_number() &&
         std::abs(told.get<double>() - value) <= kShare * std::max(1.0, std::abs(value));
}

std::string made_by(const Json& record) {
  std::string text;
  for (const char* key : {"isa", "version", "commit", "libraries"})
    text += (text.empty() ? "" : " ") + record.value(key, Json()).dump();
  return text;
}

// That counts most; empty of none.
std::string most_counted(const std::map<std::string, int>& counts) {
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? "" : most->first;
}

bool is_text_or_absent(const Json& owner, const char* key) {
  const auto member = owner.find(key);
  return member == owner.end() || member->is_string();
}

// Of what is asked of a record; that values are right is for others.
bool is_record(const Json& json) {
  if (!json.is_object() || !json.contains("files") || !json["files"].is_object() ||
      !json.contains("frames") || !json["frames"].is_array())
    return false;
  const auto run = json.find("run");
  return (run == json.end() || run->is_number_integer()) &&
         is_text_or_absent(json, "campaign_sha256") && is_text_or_absent(json, kSceneInput) &&
         std::all_of(json["files"].begin(), json["files"].end(), [](const Json& file) {
           return file.is_object() && is_text_or_absent(file, "sha256");
         });
}

}  // namespace

Json record_in(const RunFiles& files) {
  std::string text;
  try {
    text = files.read(kRunRecord, kLargestRecord_bytes);
  } catch (const core::InputError&) {  // not there, or cut short
    return {};
  }
  Json json = Json::parse(text, nullptr, false);
  return is_record(json) ? json : Json();
}

bool is_of_this_program(const Json& record) {
  return record.value("version", Json()) == session::version_text() &&
         record.value("commit", Json()) == session::commit_text();
}

std::string scene_of(const Campaign& campaign, const Json& record) {
  const Json parameters = record.value("parameters", Json());
  const auto scene = parameters.find("scene");
  return scene != parameters.end() && scene->is_string() ? scene->get<std::string>()
                                                         : campaign.scenes.front();
}

Survey survey(const Campaign& campaign, const std::filesystem::path& output,
              const std::vector<int>& runs) {
  Survey found;
  std::map<std::string, int> runs_of_maker;
  std::map<std::string, std::map<std::string, std::map<std::string, int>>> runs_of_input;
  for (const int run : runs) {
    const std::optional<RunFiles> files = RunFiles::of(output, run);
    const Json record = files ? record_in(*files) : Json();
    (!files ? found.missing : record.is_object() ? found.whole : found.damaged).push_back(run);
    if (!record.is_object()) continue;
    const std::string maker = made_by(record);
    ++runs_of_maker[maker];
    if (!is_of_other_file(record, campaign))
      ++runs_of_input[maker][scene_of(campaign, record)][record.value(kSceneInput, "")];
  }
  found.usual_maker = most_counted(runs_of_maker);
  for (const auto& [scene, counts] : runs_of_input[found.usual_maker])
    found.usual_inputs[scene] = most_counted(counts);
  return found;
}

std::vector<int> runs_beyond(const std::filesystem::path& campaign, int runs) {
  std::set<int> beyond;
  std::error_code none;
  for (std::filesystem::directory_iterator entry(campaign / "runs", none), end;
       !none && entry != end; entry.increment(none)) {
    const std::string name = entry->path().stem().string();
    int run = 0;
    const auto [last, status] = std::from_chars(name.data(), name.data() + name.size(), run);
    if (status == std::errc() && last == name.data() + name.size() && run >= runs &&
        RunFiles::is_there(campaign, run))
      beyond.insert(run);
  }
  return {beyond.begin(), beyond.end()};
}

std::string beyond_text(const Campaign& campaign) {
  return "beyond the " + std::to_string(campaign.runs) + " runs of " +
         campaign.file.filename().string();
}

std::string wrong_values(const Json& record, const Draw& draw) {
  const Json told = record.value("parameters", Json());
  std::string wrong;
  for (const auto& [name, value] : draw.values)
    if (!told.is_object() || !told.contains(name) || !is_same(told[name], value))
      wrong += (wrong.empty() ? "" : ", ") + name;
  return wrong.empty() ? "" : "other values than the campaign's file gives: " + wrong;
}

bool is_of_other_file(const Json& record, const Campaign& campaign) {
  return record.value("campaign_sha256", "") != campaign.text_hash;
}

std::string wrong_maker(const Json& record, const Campaign& campaign, const std::string& usual) {
  if (is_of_other_file(record, campaign))
    return "made by another version of " + campaign.file.filename().string();
  if (made_by(record) != usual)
    return "made by " + made_by(record) + ", most of the others by " + usual;
  return "";
}

std::string wrong_input(const Json& record, const Campaign& campaign, const Survey& found) {
  const std::string scene = scene_of(campaign, record), input = record.value(kSceneInput, "");
  const auto usual = found.usual_inputs.find(scene);
  if (usual == found.usual_inputs.end() || usual->second == input) return "";
  return "made of other files of scene, sensor or terrain (" + input + ") than most of scene " +
         scene + " (" + usual->second + ")";
}

}  // namespace fanbeam::datasets
