#include "datasets/merge.h"

#include <fmt/format.h>

#include <numeric>
#include <optional>
#include <set>
#include <string>

#include "core/files.h"
#include "datasets/record_seal.h"
#include "datasets/run_files.h"
#include "datasets/run_makers_private.h"
#include "datasets/sha256.h"
#include "session/labels/run_labels.h"

namespace fanbeam::datasets {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char letter : text)
    result += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return result + "\"";
}

std::string cell(const Json& value) {
  return csv_text(value.is_string()   ? value.get<std::string>()
                  : value.is_number() ? core::number_text(value.get<double>())
                                      : value.dump());
}

constexpr std::string_view kSceneColumn = "scene";  // of every campaign, drawn or not

std::string index_head(const Campaign& campaign) {
  std::string head =
      "run,frame,scene,time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg";
  for (const Parameter& parameter : campaign.parameters)
    if (parameter.name != kSceneColumn) head += "," + parameter.name;
  for (const std::string& product : campaign.products) {
    head += "," + product;
    if (campaign.archives) head += fmt::format(",{0}_offset,{0}_bytes", product);
  }
  return head + "\n";
}

std::string index_rows(const Campaign& campaign, int run, const RunFiles& files,
                       const Json& record) {
  std::string rows;
  for (const Json& frame : record.at("frames")) {
    rows += fmt::format("{},{},{},{}", run, frame.at("index").get<int>(),
                        csv_text(scene_of(campaign, record)), cell(frame.at("time_s")));
    for (const char* key :
         {"latitude_deg", "longitude_deg", "height_m", "roll_deg", "pitch_deg", "heading_deg"})
      rows += "," + cell(frame.at("pose").at(key));
    for (const Parameter& parameter : campaign.parameters)
      if (parameter.name != kSceneColumn)
        rows += "," + cell(record.at("parameters").value(parameter.name, Json("")));
    for (const std::string& product : campaign.products) {
      std::optional<RunFiles::Where> found;
      for (const Json& file : frame.at("files"))
        if (file.get<std::string>().starts_with(product + "/"))
          found = files.where(file.get<std::string>());
      rows += "," + (found ? found->file : "");
      if (campaign.archives)
        rows += found ? fmt::format(",{},{}", found->offset, found->bytes) : ",,";
    }
    rows += "\n";
  }
  return rows;
}

// What of a campaign's runs is merged, one run after the other.
class Merger {
 public:
  Merger(const Campaign& campaign, const fs::path& output, const Survey& found)
      : campaign_(campaign), output_(output), found_(found), drawer_(campaign) {
    manifest_ = {{"fanbeam_campaign", 1},
                 {"campaign", campaign.name},
                 {"campaign_sha256", campaign.text_hash},
                 {"made_by", found_.usual_maker},
                 {"runs", Json::object()}};
    index_ = index_head(campaign);
  }

  void add(int run, const RunFiles& files, const Json& record, core::ProblemList& problems) {
    const core::Place place{files.shown(kRunRecord)};
    ++looked_at_;
    try {
      const std::string text = files.read(kRunRecord, kLargestRecord_bytes);
      if (!is_intact(text))
        problems.error(core::ErrorClass::parse, place, "run", "other bytes than were recorded",
                       kWhole);
      const bool other_file = is_of_other_file(record, campaign_);
      if (other_file) ++of_other_file_;
      const std::string wrong = wrong_maker(record, campaign_, found_.usual_maker);
      if (!wrong.empty() && !other_file)
        problems.error(core::ErrorClass::unsupported, place, "run", std::to_string(run),
                       "one program for all: " + wrong);
      const std::string other_input =
          wrong.empty() ? wrong_input(record, campaign_, found_) : std::string();
      if (!other_input.empty())
        problems.error(core::ErrorClass::unsupported, place, "run", std::to_string(run),
                       "one state of each scene for all: " + other_input);
      const std::string other = wrong_values(record, drawer_.draw(run));
      if (wrong.empty() && !other.empty())
        problems.error(core::ErrorClass::unsupported, place, "run", std::to_string(run),
                       kVersion + other);
      index_ += index_rows(campaign_, run, files, record);
      manifest_["runs"][fmt::format("{:06}", run)] = sha256(text);
      for (const Json& frame : record.at("frames"))
        labels_.add(fmt::format("runs/{:06}/", run), frame.at("files").get<std::set<std::string>>(),
                    record.at("frames").size(), [&](const std::string& name) {
                      return files.read(name, session::kLargestLabels_bytes);
                    });
      ++merged_.runs;
      merged_.frames += static_cast<int>(record.at("frames").size());
    } catch (const nlohmann::json::exception& error) {
      problems.error(core::ErrorClass::parse, place, "run", error.what(), kWhole);
    } catch (const core::InputError& error) {  // files that are gone or cut short
      problems.append(error.problems());
    }
  }

  // Of all runs at once.
  void tell_changed_file(core::ProblemList& problems) const {
    if (of_other_file_ > 0)
      problems.error(
          core::ErrorClass::unsupported, core::Place{campaign_.file.string()}, "campaign",
          fmt::format("changed since {} of {} runs were made", of_other_file_, looked_at_),
          "the file as it was, or these runs made anew (fanbeam campaign run --replace)");
  }

  Merged write() {
    const auto write_one = [&](const char* name, const std::string& text) {
      core::write_file_atomically(output_ / name, text);
      merged_.files.push_back(output_ / name);
    };
    write_one("index.csv", index_);
    write_one("manifest.json", manifest_.dump(1) + "\n");
    if (labels_.frames() > 0) {
      write_one("coco.json", labels_.coco());
      write_one("lard.csv", labels_.lard());
    } else {  // of an earlier merge: of other runs
      for (const char* name : {"coco.json", "lard.csv"}) fs::remove(output_ / name);
    }
    return merged_;
  }

  static constexpr const char* kVersion =
      "runs of this version of fanbeam, which draws as the file says: ";
  static constexpr const char* kWhole = "a record; fanbeam campaign verify tells how to repair it";

 private:
  const Campaign& campaign_;
  const fs::path& output_;
  const Survey& found_;
  std::string index_;
  Drawer drawer_;
  Json manifest_;
  session::RunLabels labels_;
  Merged merged_;
  int looked_at_ = 0, of_other_file_ = 0;
};

}  // namespace

Merged merge(const Campaign& campaign, const fs::path& output) {
  if (!fs::is_directory(output / "runs"))
    core::throw_input_error(core::ErrorClass::io, core::Place{output.string()}, "runs", "none",
                            "the folder of a campaign; fanbeam campaign run makes it");
  core::ProblemList problems;
  std::vector<int> runs(static_cast<std::size_t>(campaign.runs));
  std::iota(runs.begin(), runs.end(), 0);
  const Survey found = survey(campaign, output, runs);
  for (const int run : found.damaged)
    problems.error(core::ErrorClass::parse, core::Place{run_folder(output, run).string()}, "run",
                   "damaged", Merger::kWhole);
  for (const int run : runs_beyond(output, campaign.runs))
    problems.error(core::ErrorClass::unsupported, core::Place{run_folder(output, run).string()},
                   "run", std::to_string(run), "none " + beyond_text(campaign));
  Merger merger(campaign, output, found);
  for (const int run : found.whole)
    if (const std::optional<RunFiles> files = RunFiles::of(output, run))
      merger.add(run, *files, record_in(*files), problems);
  merger.tell_changed_file(problems);
  problems.throw_if_errors();
  return merger.write();
}

}  // namespace fanbeam::datasets
