#include "session/records/output_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/errors.h"
#include "core/files.h"
#include "core/image.h"
#include "core/json_size.h"
#include "core/text.h"
#include "session/labels/run_labels.h"
#include "session/products/frame_table.h"
#include "session/products/frame_writer.h"
#include "session/products/layers_product.h"
#include "session/products/products.h"
#include "session/records/frame_metadata.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostNamed = 8;
constexpr std::uint64_t kLargestRecord_bytes = 1ULL << 30U;
// The note of a run that has not ended. Hidden: it is no result.
constexpr const char* kUnfinished = ".unfinished.json";
// With which the names of a frame's files begin, and what they are called where all frames have one.
constexpr int kDigits = 5;
constexpr const char* kOfAllFrames = "all";

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

bool is_product(const std::string& name) {
  return std::any_of(kProducts.begin(), kProducts.end(),
                     [&](const Product& product) { return product.name == name; });
}

// The number of the frame that "bscope/00012.png" shows.
std::optional<int> frame_of(const fs::path& relative) {
  if (std::distance(relative.begin(), relative.end()) != 2) return std::nullopt;
  const std::string stem = relative.stem().string();
  const std::string extension = relative.extension().string();
  int index = 0;
  const auto [end, status] = std::from_chars(stem.data(), stem.data() + stem.size(), index);
  const bool number = status == std::errc() && end == stem.data() + stem.size() && index >= 0 &&
                      fmt::format("{:05}", index) == stem;
  const bool picture = extension == ".png" || extension == ".exr" || extension == ".csv" ||
                       (extension == ".json" && *relative.begin() == "labels");
  if (!number || !picture || !is_product(relative.begin()->string())) return std::nullopt;
  return index;
}

// What is written of all frames together.
bool is_of_run(const std::string& name) {
  return name == kLayersFile || name == kRadarFile ||
         std::find(kRunLabelFiles.begin(), kRunLabelFiles.end(), name) != kRunLabelFiles.end();
}

// The record of a run, with what is written of all frames together.
std::vector<std::string> record_files() {
  std::vector<std::string> files = {"run.json", "timing.json", kLayersFile, kRadarFile};
  files.insert(files.end(), kRunLabelFiles.begin(), kRunLabelFiles.end());
  return files;
}

bool is_film(const fs::path& relative) {
  return relative.parent_path().empty() && relative.stem() == "preview";
}

// A film, or a file in the folder of a product: what a record may have removed, whoever wrote it.
bool may_be_replaced(const fs::path& relative) {
  return is_film(relative) || is_of_run(relative.generic_string()) ||
         (std::distance(relative.begin(), relative.end()) == 2 &&
          std::all_of(relative.begin(), relative.end(),
                      [](const fs::path& part) { return core::is_safe_word(part.string()); }));
}

// As far as the file can be read: it may be anybody's.
nlohmann::json json_in(const fs::path& file) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return {};
  const std::string text = core::read_file(file, kLargestRecord_bytes);
  constexpr core::JsonLimits kLimits{64, 100'000'000};
  if (core::json_excess(text, kLimits)) return {};
  return nlohmann::json::parse(text, nullptr, false);
}

void add_words(const nlohmann::json& owner, const char* key, std::set<std::string>& words) {
  if (!owner.is_object() || !owner.contains(key) || !owner[key].is_array()) return;
  for (const nlohmann::json& word : owner[key])
    if (word.is_string()) words.insert(word.get<std::string>());
}

// Every file below the folder that is not hidden, until `visit` answers false.
template <typename Visit>
void each_file(const fs::path& folder, Visit visit) {
  std::error_code status;
  fs::recursive_directory_iterator entry(folder, status), end;
  for (; !status && entry != end; entry.increment(status)) {
    if (is_hidden(entry->path())) {
      entry.disable_recursion_pending();
    } else if (!entry->is_directory(status) && !visit(entry->path().lexically_relative(folder))) {
      return;
    }
  }
}

}  // namespace

const char* const kRadarFile = "radar.toml";

void check_can_be_folder(const fs::path& folder) {
  std::error_code none;
  fs::path there = folder;  // or what is there of the folders around it
  while (there.has_parent_path() && there.has_relative_path() && !fs::exists(there, none))
    there = there.parent_path();
  if (fs::exists(there, none) && !fs::is_directory(there, none))
    core::throw_input_error(core::ErrorClass::io, "--output", "\"" + folder.string() + "\"",
                            "a folder, there or to be made: " + there.string() + " is a file");
}

std::set<std::string> frame_files(const std::set<std::string>& products, int index) {
  std::set<std::string> files;
  for (const std::string& product : products) {
    if (product == "preview") continue;
    if (product == "detections" || product == "obstacles")
      files.insert(frame_table_path("", product, index).string());
    if (product != "obstacles") files.insert(frame_path("", product, index).string());
  }
  return files;
}

bool OutputFolder::Listed::contains(const fs::path& relative) const {
  if (files.contains(relative.generic_string()) || begun.contains(relative.generic_string()))
    return true;
  const std::string name = relative.filename().string();
  return std::distance(relative.begin(), relative.end()) == 2 &&
         products.contains(relative.begin()->string()) &&
         (relative.stem() == kOfAllFrames ||
          (name.size() > kDigits && std::all_of(name.begin(), name.begin() + kDigits,
                                                [](char c) { return c >= '0' && c <= '9'; })));
}

OutputFolder::Listed OutputFolder::listed_in(const fs::path& folder) {
  Listed listed;
  const nlohmann::json record = json_in(folder / "run.json");
  add_words(record, "files", listed.files);
  if (record.is_object() && record.contains("frames") && record["frames"].is_array())
    for (const nlohmann::json& frame : record["frames"]) add_words(frame, "files", listed.files);
  const nlohmann::json note = json_in(folder / kUnfinished);
  add_words(note, "products", listed.products);
  add_words(note, "files", listed.begun);
  return listed;
}

bool OutputFolder::has_record_of_another() const {
  if (listed_.files.empty()) return false;
  if (fingerprint_.empty()) return true;
  // A record lists frames of one input.
  const auto one =
      std::find_if(listed_.files.begin(), listed_.files.end(), [&](const std::string& name) {
        std::error_code none;
        return frame_of(name) && fs::exists(folder_ / name, none);
      });
  return one == listed_.files.end() || !is_of_this_input(*one);
}

void OutputFolder::begin_frames(const std::function<std::set<std::string>()>& files) {
  if (!std::exchange(begun_, true) && has_record_of_another()) take_place({}, files());
}

// The note says what the record listed, and what will be written.
void OutputFolder::take_place(const std::set<std::string>& products,
                              const std::set<std::string>& files) {
  noted_.begun.insert(listed_.files.begin(), listed_.files.end());
  write_note(products, files);
  set_aside_ = true;
  std::error_code ignored;  // of those that are there
  for (const std::string& name : record_files())
    if (!is_of_run(name) || listed_.files.contains(name))
      fs::rename(folder_ / name, aside(name), ignored);
  before_ = times();
}

// Of the files that the note says: a file that is written anew has another.
std::map<std::string, fs::file_time_type> OutputFolder::times() const {
  std::map<std::string, fs::file_time_type> found;
  each_file(folder_, [&](const fs::path& relative) {
    std::error_code gone;
    if (noted_.contains(relative))
      found[relative.generic_string()] = fs::last_write_time(folder_ / relative, gone);
    return true;
  });
  return found;
}

fs::path OutputFolder::aside(const std::string& name) const {
  return folder_ / ("." + name + ".before");
}

OutputFolder::~OutputFolder() {
  if (!set_aside_) return;
  const auto now = times();
  const bool replaced = std::any_of(now.begin(), now.end(), [&](const auto& file) {
    const auto before = before_.find(file.first);
    return before == before_.end() || before->second != file.second;
  });
  std::error_code ignored;
  for (const std::string& name : record_files())
    if (replaced)
      fs::remove(aside(name), ignored);
    else
      fs::rename(aside(name), folder_ / name, ignored);
  if (!replaced) restore_note();
}

// As it was before this run.
void OutputFolder::restore_note() noexcept {
  noted_ = listed_;
  std::error_code ignored;
  if (listed_.products.empty() && listed_.begun.empty()) {
    fs::remove(folder_ / kUnfinished, ignored);
    return;
  }
  try {
    write_note({}, {});
  } catch (const std::exception&) {  // a full disk: the note says more than is there
  }
}

void OutputFolder::begin(const std::set<std::string>& products,
                         const std::set<std::string>& files) {
  if (!std::exchange(begun_, true) && has_record_of_another()) take_place(products, files);
  write_note(products, files);
}

void OutputFolder::write_note(const std::set<std::string>& products,
                              const std::set<std::string>& files) {
  noted_.products.insert(products.begin(), products.end());
  noted_.begun.insert(files.begin(), files.end());
  const nlohmann::json note = {{"products", noted_.products}, {"files", noted_.begun}};
  core::write_file_atomically(folder_ / kUnfinished, note.dump() + "\n");
}

void OutputFolder::end() {
  set_aside_ = false;
  std::error_code ignored;
  for (const std::string& name : record_files()) fs::remove(aside(name), ignored);
  fs::remove(folder_ / kUnfinished, ignored);
}

bool is_unfinished(const fs::path& folder) {
  std::error_code none;
  return fs::is_regular_file(folder / kUnfinished, none);
}

OutputFolder::OutputFolder(fs::path folder, std::string fingerprint, bool overwrite)
    : folder_(std::move(folder)),
      fingerprint_(std::move(fingerprint)),
      overwrite_(overwrite),
      listed_(listed_in(folder_)) {
  check_can_be_folder(folder_);
  noted_.products = listed_.products;
  noted_.begun = listed_.begun;
  if (!has_record_of_another())
    for (const std::string& name : listed_.files) {
      std::error_code none;
      if (is_film(name) && fs::is_regular_file(folder_ / name, none)) films_.insert(name);
    }
  if (overwrite_) return;
  std::vector<std::string> others;
  const bool has_record = !listed_.files.empty();
  each_file(folder_, [&](const fs::path& relative) {
    const std::string name = relative.generic_string();
    const bool record = has_record && (name == "run.json" || name == "timing.json");
    if (!record && !listed_.contains(relative) && !is_of_this_input(relative))
      others.push_back(name);
    return others.size() <= kMostNamed;
  });
  if (others.empty()) return;
  const bool more = others.size() > kMostNamed;
  if (more) others.pop_back();
  std::sort(others.begin(), others.end());
  core::throw_input_error(
      core::ErrorClass::range, "--overwrite",
      fmt::format("not given, and {} holds {}{}", folder_.string(), fmt::join(others, ", "),
                  more ? " and more" : ""),
      "a folder that is new, empty, or made by fanbeam alone; --overwrite replaces frames of other "
      "renders there and leaves other files as they are");
}

// What a frame says; nothing of a file that is damaged, or no picture of ours.
std::optional<std::string> OutputFolder::input_of(const fs::path& relative) const {
  if (!frame_of(relative)) return std::nullopt;
  try {
    for (const auto& [key, value] : metadata_of(folder_ / relative))
      if (key == "fanbeam:input") return value;
  } catch (const core::InputError&) {
  }
  return std::nullopt;
}

bool OutputFolder::is_of_this_input(const fs::path& relative) const {
  return input_of(relative) == fingerprint_;
}

std::map<int, std::set<std::string>> OutputFolder::frames(
    const std::map<int, std::set<std::string>>& written) const {
  std::map<int, std::set<std::string>> frames = written;
  each_file(folder_, [&](const fs::path& relative) {
    const std::optional<int> index = frame_of(relative);
    if (!index) return true;
    const std::string product = relative.begin()->string();
    const auto known = frames.find(*index);
    if ((known == frames.end() || !known->second.contains(product)) && is_of_this_input(relative))
      frames[*index].insert(product);
    return true;
  });
  return frames;
}

int OutputFolder::keep_only(const std::set<std::string>& files) const {
  std::vector<fs::path> old;
  each_file(folder_, [&](const fs::path& relative) {
    const std::string name = relative.generic_string();
    const bool replaced = (listed_.contains(relative) && may_be_replaced(relative)) ||
                          (overwrite_ && input_of(relative));
    if (!files.contains(name) && replaced) old.push_back(relative);
    return true;
  });
  std::error_code ignored;  // what cannot be removed is not listed
  std::set<int> frames;
  for (const fs::path& relative : old) {
    // Asked of each only now: another part of the sequence may have put its own in the place since
    // this one looked for what to list.
    if (is_of_this_input(relative)) continue;
    fs::remove(folder_ / relative, ignored);
    if (const std::optional<int> index = frame_of(relative)) frames.insert(*index);
  }
  for (const fs::path& relative : old)
    if (relative.has_parent_path()) fs::remove(folder_ / relative.parent_path(), ignored);
  return static_cast<int>(frames.size());
}

}  // namespace fanbeam::session
