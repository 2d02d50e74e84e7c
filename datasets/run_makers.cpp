#include <algorithm>
#include <map>
#include <optional>

#include "core/errors.h"
#include "datasets/run_makers_private.h"

namespace fanbeam::datasets {

using Json = nlohmann::ordered_json;

namespace {

std::string made_by(const Json& record) {
  std::string text;
  for (const char* key : {"isa", "version", "commit", "libraries"})
    text += (text.empty() ? "" : " ") + record.value(key, Json()).dump();
  return text;
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
  if (!json.is_object() || !json.contains("files") || !json["files"].is_object() ||
      !json.contains("frames") || !json["frames"].is_array())
    return {};
  return json;
}

Survey survey(const std::filesystem::path& campaign, const std::vector<int>& runs) {
  Survey found;
  std::map<std::string, int> runs_of_maker;
  for (const int run : runs) {
    const std::optional<RunFiles> files = RunFiles::of(campaign, run);
    const Json record = files ? record_in(*files) : Json();
    (!files ? found.missing : record.is_object() ? found.whole : found.damaged).push_back(run);
    if (record.is_object()) ++runs_of_maker[made_by(record)];
  }
  const auto most =
      std::max_element(runs_of_maker.begin(), runs_of_maker.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most != runs_of_maker.end()) found.usual_maker = most->first;
  return found;
}

std::string wrong_maker(const Json& record, const Campaign& campaign, const std::string& usual) {
  if (record.value("campaign_sha256", "") != campaign.text_hash)
    return "made by another version of " + campaign.file.filename().string();
  if (made_by(record) != usual)
    return "made by " + made_by(record) + ", most of the others by " + usual;
  return "";
}

}  // namespace fanbeam::datasets
