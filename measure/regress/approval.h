// What stands beside approved pictures: why they are right, and what they were made with.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fanbeam::measure {

// Everything that run.json says of a run but its frames' results, as "input.weather.visibility_m"
// and a JSON value.
using Settings = std::map<std::string, std::string>;

struct Approval {
  std::string reason;
  std::string version, commit;  // of the program
  std::string isa;              // "x86-64-v2": the level that the pictures were made at
  Settings settings;
};

struct SettingChange {
  std::string key;
  std::string approved, now;  // empty: not there
};

// What stands in run.json and timing.json of a folder that `fanbeam render` wrote, without a reason.
// Throws InputError as reading a file does, and E-PARSE for other files of these names.
Approval record_of(const std::filesystem::path& rendered);

// Program, level and settings that are not what they were, by key.
std::vector<SettingChange> changes(const Approval& approval, const Approval& now);

// approval.json of a case's folder; absent where there is none. Throws InputError E-PARSE where it
// is not one.
std::optional<Approval> read_approval(const std::filesystem::path& folder);
void write_approval(const std::filesystem::path& folder, const Approval& approval);

}  // namespace fanbeam::measure
