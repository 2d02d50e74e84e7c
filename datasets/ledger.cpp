#include "datasets/ledger.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "core/files.h"
#include "core/text.h"
#include "datasets/record_seal.h"
#include "datasets/run_files.h"
#include "datasets/run_lock.h"
#include "datasets/run_makers_private.h"
#include "datasets/sha256.h"
#include "datasets/worker.h"

namespace fanbeam::datasets {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kOtherBytes = ": other bytes than recorded";

std::optional<int> number_in(const std::string& text) {
  int number = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

// This program seals what it writes; earlier ones did not.
void check_record(int run, const RunFiles& files, const Json& record,
                  std::vector<Damage>& damages) {
  bool intact = false, whole = true;
  try {
    const std::string text = files.read(kRunRecord, kLargestRecord_bytes);
    intact = is_intact(text);
    whole = has_seal(text) || !is_of_this_program(record);
  } catch (const core::InputError&) {  // changed meanwhile
  }
  if (!intact) damages.push_back({run, std::string(kRunRecord) + kOtherBytes});
  if (!whole) damages.push_back({run, std::string(kRunRecord) + ": without its seal"});
}

void check_files(int run, const RunFiles& files, const Json& record, std::vector<Damage>& damages) {
  for (const auto& [name, told] : record.at("files").items()) {
    if (!files.where(name)) {
      damages.push_back({run, name + ": missing"});
      continue;
    }
    std::string hash;
    try {
      hash = sha256(files.read(name, kLargestRunFile_bytes));
    } catch (const core::InputError&) {  // cut short
    }
    if (hash != told.value("sha256", "")) damages.push_back({run, name + kOtherBytes});
  }
}

}  // namespace

bool was_made_by_other_file(const Campaign& campaign, const fs::path& output, int run) {
  const std::optional<RunFiles> files = RunFiles::of(output, run);
  const Json record = files ? record_in(*files) : Json();
  return record.is_object() && is_of_other_file(record, campaign);
}

Status status_of(const Campaign& campaign, const fs::path& output) {
  const auto entries = [&](const char* folder, const auto& use) {
    std::error_code none;
    for (fs::directory_iterator entry(output / folder, none), end; !none && entry != end;
         entry.increment(none))
      use(entry->path());
  };
  // Of one that the campaign has.
  const auto run_of = [&](const std::string& text) {
    const std::optional<int> run = number_in(text);
    return run && *run < campaign.runs ? run : std::nullopt;
  };
  std::set<int> there, under_way, failed;
  entries("runs", [&](const fs::path& path) {
    const std::string stem = path.stem().string();
    if (!stem.starts_with(".")) {
      const auto run = run_of(stem);
      if (run && RunFiles::is_there(output, *run)) there.insert(*run);
    } else if (const auto run = run_of(stem.substr(1));
               run && path.extension() == ".lock" && is_locked(path)) {
      under_way.insert(*run);
    }
  });
  entries("failed", [&](const fs::path& path) {
    const auto run = run_of(path.stem().string());
    if (run && !there.contains(*run) && !under_way.contains(*run)) failed.insert(*run);
  });
  Status status;
  status.runs = campaign.runs;
  status.under_way = static_cast<int>(under_way.size());
  status.failed = static_cast<int>(failed.size());
  status.made = static_cast<int>(
      std::count_if(there.begin(), there.end(), [&](int run) { return !under_way.contains(run); }));
  status.changed = std::any_of(there.begin(), there.end(), [&](int run) {
    return was_made_by_other_file(campaign, output, run);
  });
  return status;
}

std::string runs_text(const std::vector<int>& runs) {
  std::string text;
  for (std::size_t i = 0; i < runs.size();) {
    std::size_t end = i + 1;
    while (end < runs.size() && runs[end] == runs[end - 1] + 1) ++end;
    if (!text.empty()) text += ",";
    text +=
        end - i == 1 ? std::to_string(runs[i]) : fmt::format("{}:{}", runs[i], runs[end - 1] + 1);
    i = end;
  }
  return text;
}

std::vector<int> runs_in(const std::string& text, int runs, const std::string& field) {
  const auto refuse = [&](core::ErrorClass error_class, const std::string& part) {
    core::throw_input_error(
        error_class, field, "\"" + part + "\"",
        "runs and ranges such as 3,17,40:43, from 0 to " + std::to_string(runs - 1));
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
    if (*first >= runs) refuse(core::ErrorClass::range, part);  // the largest of int has no next
    const int end = colon == std::string::npos ? *first + 1 : *last;
    if (end > runs || end <= *first) refuse(core::ErrorClass::range, part);
    for (int run = *first; run < end; ++run) chosen.insert(run);
  }
  return {chosen.begin(), chosen.end()};
}

std::vector<int> shard_of(const std::vector<int>& runs, const std::string& text,
                          const std::string& field) {
  if (text.empty()) return runs;
  const std::size_t slash = text.find('/');
  const auto part = core::parse_number(text.substr(0, slash));
  const auto parts = core::parse_number(slash == std::string::npos ? "" : text.substr(slash + 1));
  const bool whole = part.error == core::NumberError::none &&
                     parts.error == core::NumberError::none &&
                     part.value == std::floor(part.value) && parts.value == std::floor(parts.value);
  if (!whole || part.value < 1 || part.value > parts.value || parts.value > 1e6)
    core::throw_input_error(core::ErrorClass::range, field, "\"" + text + "\"",
                            "K/N with K from 1 to N, such as 3/8");
  std::vector<int> mine;
  for (auto i = static_cast<std::size_t>(part.value) - 1; i < runs.size();
       i += static_cast<std::size_t>(parts.value))
    mine.push_back(runs[i]);
  return mine;
}

std::vector<Damage> verify(const Campaign& campaign, const fs::path& output,
                           const std::vector<int>& runs) {
  std::vector<Damage> damages;
  const Survey found = survey(campaign, output, runs);
  for (const int run : found.missing)
    damages.push_back({run, fs::exists(failed_file(output, run)) ? "failed" : "missing"});
  for (const int run : found.damaged)
    damages.push_back({run, std::string(kRunRecord) + ": no record of a run"});
  Drawer drawer(campaign);
  for (const int run : found.whole) {
    const std::optional<RunFiles> files = RunFiles::of(output, run);
    const Json record = files ? record_in(*files) : Json();
    if (!record.is_object()) {  // changed meanwhile
      damages.push_back({run, std::string(kRunRecord) + ": no record of a run"});
      continue;
    }
    check_record(run, *files, record, damages);
    std::string wrong = wrong_maker(record, campaign, found.usual_maker);
    if (wrong.empty()) wrong = wrong_input(record, campaign, found);
    if (!wrong.empty()) damages.push_back({run, wrong});
    if (record.value("run", -1) != run) damages.push_back({run, "the record of another run"});
    const std::string other = wrong_values(record, drawer.draw(run));
    if (wrong.empty() && !other.empty()) damages.push_back({run, other});
    check_files(run, *files, record, damages);
  }
  if (runs.size() == static_cast<std::size_t>(campaign.runs))
    for (const int run : runs_beyond(output, campaign.runs))
      damages.push_back({run, beyond_text(campaign)});
  std::stable_sort(damages.begin(), damages.end(),
                   [](const Damage& a, const Damage& b) { return a.run < b.run; });
  return damages;
}

}  // namespace fanbeam::datasets
