#include "datasets/ledger.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "core/files.h"
#include "core/text.h"
#include "datasets/sha256.h"
#include "datasets/worker.h"
#include "session/labels/run_labels.h"

namespace fanbeam::datasets {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t kLargestRecord_bytes = 1ULL << 28U;

std::optional<int> number_in(const std::string& text) {
  int number = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

// Somebody holds it.
bool is_locked(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0;
  ::close(descriptor);
  return locked;
}

// Nothing where there is none that can be read.
std::optional<Json> record_of(const fs::path& folder) {
  const fs::path file = folder / kRunRecord;
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return std::nullopt;
  Json json = Json::parse(core::read_file(file, kLargestRecord_bytes), nullptr, false);
  if (!json.is_object() || !json.contains("files") || !json["files"].is_object() ||
      !json.contains("frames") || !json["frames"].is_array())
    return Json();  // damaged
  return json;
}

// What must be the same of all runs.
std::string made_by(const Json& record) {
  std::string text;
  for (const char* key : {"isa", "version", "commit", "libraries"})
    text += (text.empty() ? "" : " ") + record.value(key, Json()).dump();
  return text;
}

// Of most of them.
std::string usual_maker(const std::map<int, Json>& records) {
  std::map<std::string, int> count;
  for (const auto& [run, record] : records) ++count[made_by(record)];
  const auto most = std::max_element(
      count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == count.end() ? "" : most->first;
}

std::string wrong_maker(const Json& record, const Campaign& campaign, const std::string& usual) {
  if (record.value("campaign_sha256", "") != campaign.text_hash)
    return "made by another version of " + campaign.file.filename().string();
  if (made_by(record) != usual)
    return "made by " + made_by(record) + ", most of the others by " + usual;
  return "";
}

void check_files(int run, const fs::path& folder, const Json& record,
                 std::vector<Damage>& damages) {
  for (const auto& [name, told] : record.at("files").items()) {
    std::error_code none;
    if (!fs::is_regular_file(folder / name, none))
      damages.push_back({run, name + ": missing"});
    else if (!told.is_object() || sha256_of_file(folder / name) != told.value("sha256", ""))
      damages.push_back({run, name + ": other bytes than recorded"});
  }
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char letter : text) result += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return result + "\"";
}

std::string cell(const Json& value) {
  return csv_text(value.is_string() ? value.get<std::string>()
                : value.is_number() ? core::number_text(value.get<double>())
                                    : value.dump());
}

constexpr std::string_view kSceneColumn = "scene";  // of every campaign, drawn or not

std::string index_head(const Campaign& campaign) {
  std::string head =
      "run,frame,scene,time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg";
  for (const Parameter& parameter : campaign.parameters)
    if (parameter.name != kSceneColumn) head += "," + parameter.name;
  for (const std::string& product : campaign.products) head += "," + product;
  return head + "\n";
}

std::string index_rows(const Campaign& campaign, int run, const Json& record) {
  std::string rows;
  for (const Json& frame : record.at("frames")) {
    rows += fmt::format("{},{},{},{}", run, frame.at("index").get<int>(), cell(record.at("scene")),
                        cell(frame.at("time_s")));
    for (const char* key :
         {"latitude_deg", "longitude_deg", "height_m", "roll_deg", "pitch_deg", "heading_deg"})
      rows += "," + cell(frame.at("pose").at(key));
    for (const Parameter& parameter : campaign.parameters)
      if (parameter.name != kSceneColumn) rows += "," + cell(record.at("parameters").value(parameter.name, Json("")));
    for (const std::string& product : campaign.products) {
      std::string found;
      for (const Json& file : frame.at("files"))
        if (file.get<std::string>().starts_with(product + "/"))
          found = fmt::format("runs/{:06}/{}", run, file.get<std::string>());
      rows += "," + found;
    }
    rows += "\n";
  }
  return rows;
}

}  // namespace

Status status_of(const Campaign& campaign, const fs::path& output) {
  Status status;
  status.runs = campaign.runs;
  std::error_code none;
  for (fs::directory_iterator entry(output / "runs", none), end; !none && entry != end;
       entry.increment(none)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(".")) {
      const auto run = number_in(name);
      if (run && *run < campaign.runs && fs::exists(entry->path() / kRunRecord)) ++status.made;
    } else if (name.ends_with(".lock") && is_locked(entry->path())) {
      ++status.under_way;
    }
  }
  for (fs::directory_iterator entry(output / "failed", none), end; !none && entry != end;
       entry.increment(none)) {
    const auto run = number_in(entry->path().stem().string());
    if (run && *run < campaign.runs && !fs::exists(run_folder(output, *run))) ++status.failed;
  }
  return status;
}

std::string runs_text(const std::vector<int>& runs) {
  std::string text;
  for (std::size_t i = 0; i < runs.size();) {
    std::size_t end = i + 1;
    while (end < runs.size() && runs[end] == runs[end - 1] + 1) ++end;
    if (!text.empty()) text += ",";
    text += end - i == 1 ? std::to_string(runs[i])
                         : fmt::format("{}:{}", runs[i], runs[end - 1] + 1);
    i = end;
  }
  return text;
}

std::vector<int> runs_in(const std::string& text, int runs, const std::string& field) {
  const auto refuse = [&](core::ErrorClass error_class, const std::string& part) {
    core::throw_input_error(error_class, field, "\"" + part + "\"",
                            "runs and ranges such as 3,17,40:43, from 0 to " +
                                std::to_string(runs - 1));
  };
  std::set<int> chosen;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::string part = text.substr(from, comma - from);
    from = comma + 1;
    const std::size_t colon = part.find(':');
    const auto first = number_in(part.substr(0, colon));
    const auto last = colon == std::string::npos ? first : number_in(part.substr(colon + 1));
    if (!first || !last) refuse(core::ErrorClass::parse, part);
    const int end = colon == std::string::npos ? *last + 1 : *last;
    if (*first >= runs || end > runs || end <= *first) refuse(core::ErrorClass::range, part);
    for (int run = *first; run < end; ++run) chosen.insert(run);
  }
  return {chosen.begin(), chosen.end()};
}

std::vector<Damage> verify(const Campaign& campaign, const fs::path& output,
                           const std::vector<int>& runs) {
  std::vector<Damage> damages;
  std::map<int, Json> records;
  for (const int run : runs) {
    std::optional<Json> record = record_of(run_folder(output, run));
    if (!record)
      damages.push_back({run, fs::exists(failed_file(output, run)) ? "failed" : "missing"});
    else if (!record->is_object())
      damages.push_back({run, std::string(kRunRecord) + ": no record of a run"});
    else
      records.emplace(run, std::move(*record));
  }
  const std::string usual = usual_maker(records);
  for (const auto& [run, record] : records) {
    const std::string wrong = wrong_maker(record, campaign, usual);
    if (!wrong.empty()) damages.push_back({run, wrong});
    if (record.value("run", -1) != run) damages.push_back({run, "the record of another run"});
    check_files(run, run_folder(output, run), record, damages);
  }
  std::stable_sort(damages.begin(), damages.end(),
                   [](const Damage& a, const Damage& b) { return a.run < b.run; });
  return damages;
}

Merged merge(const Campaign& campaign, const fs::path& output) {
  if (!fs::is_directory(output / "runs"))
    core::throw_input_error(core::ErrorClass::io, core::Place{output.string()}, "runs", "none",
                            "the folder of a campaign; fanbeam campaign run makes it");
  std::map<int, Json> records;
  core::ProblemList problems;
  for (int run = 0; run < campaign.runs; ++run) {
    std::optional<Json> record = record_of(run_folder(output, run));
    if (record && !record->is_object())
      problems.error(core::ErrorClass::parse,
                     core::Place{(run_folder(output, run) / kRunRecord).string()}, "run", "damaged",
                     "a record; fanbeam campaign verify tells how to repair it");
    else if (record)
      records.emplace(run, std::move(*record));
  }
  const std::string usual = usual_maker(records);
  Merged merged;
  std::string index = index_head(campaign);
  Json manifest = {{"fanbeam_campaign", 1},
                   {"campaign", campaign.name},
                   {"campaign_sha256", campaign.text_hash},
                   {"made_by", usual},
                   {"runs", Json::object()}};
  session::RunLabels labels;
  for (const auto& [run, record] : records) {
    const fs::path folder = run_folder(output, run);
    try {
    const std::string wrong = wrong_maker(record, campaign, usual);
    if (!wrong.empty())
      problems.error(core::ErrorClass::unsupported, core::Place{folder.string()}, "run",
                     std::to_string(run), "one program for all: " + wrong);
    index += index_rows(campaign, run, record);
    manifest["runs"][fmt::format("{:06}", run)] = sha256_of_file(folder / kRunRecord);
    for (const Json& frame : record.at("frames"))
      labels.add(output, fmt::format("runs/{:06}/", run),
                 frame.at("files").get<std::set<std::string>>(), record.at("frames").size());
    ++merged.runs;
    merged.frames += static_cast<int>(record.at("frames").size());
    } catch (const nlohmann::json::exception& error) {
      problems.error(core::ErrorClass::parse, core::Place{(folder / kRunRecord).string()}, "run",
                     error.what(), "a record; fanbeam campaign verify tells how to repair it");
    }
  }
  problems.throw_if_errors();
  const auto write = [&](const char* name, const std::string& text) {
    core::write_file_atomically(output / name, text);
    merged.files.push_back(output / name);
  };
  write("index.csv", index);
  write("manifest.json", manifest.dump(1) + "\n");
  if (labels.frames() > 0) {
    write("coco.json", labels.coco());
    write("lard.csv", labels.lard());
  }
  return merged;
}

}  // namespace fanbeam::datasets
