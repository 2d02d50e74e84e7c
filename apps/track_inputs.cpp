#include "apps/track_inputs.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/scene_choice.h"
#include "core/errors.h"
#include "core/files.h"
#include "core/json_node.h"
#include "core/units.h"
#include "session/records/output_folder.h"
#include "session/signal/tracks/track_table.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using session::TrackInput;
using Inputs = std::vector<TrackInput>;

constexpr std::array<const char*, 4> kWords = {"highway scenarios", "a scene", "detections",
                                               "samples"};

struct Belongs {
  const char* option;
  Inputs inputs;
};
const Belongs kBelong[] = {
    {"--scenario", {TrackInput::scenarios}},
    {"--waveform", {TrackInput::scenarios}},
    {"--detection-probability", {TrackInput::scenarios}},
    {"--false-measurements", {TrackInput::scenarios}},
    {"--noise-figure", {TrackInput::scenarios}},
    {"--range-only", {TrackInput::scenarios}},
    {"--samples", {TrackInput::scenarios}},
    {"--study", {TrackInput::scenarios}},
    {"--run", {TrackInput::scenarios}},
    {"--seed", {TrackInput::scenarios, TrackInput::scene}},
    {"--frames", {TrackInput::scene}},
    {"--sensor", {TrackInput::scene}},
    {"--data", {TrackInput::scene}},
    {"--radar", {TrackInput::scene, TrackInput::detections, TrackInput::samples}},
    {"--radar-speed", {TrackInput::scene, TrackInput::detections, TrackInput::samples}},
    {"--body-errors", {TrackInput::scene, TrackInput::detections, TrackInput::samples}},
    {"--frame-period", {TrackInput::samples}},
};

std::string words_of(const Inputs& inputs) {
  std::string text;
  for (const TrackInput input : inputs)
    text += (text.empty() ? "" : " or ") + std::string(kWords[static_cast<std::size_t>(input)]);
  return text;
}

// What a run of `fanbeam track` leaves says one of these.
bool is_ours(const fs::path& record) {
  constexpr std::uint64_t kLargest_bytes = 1ULL << 30U;
  constexpr core::JsonLimits kLimits{64, 20'000'000};
  core::ProblemList problems;
  const auto file = core::read_json_file(record, kLargest_bytes, kLimits, problems);
  if (!file) return false;
  const core::JsonNode json(*file, problems);
  return json.member("commit").present() &&
         (json.member("scenarios").present() || json.member("confirmed_tracks").present());
}

// What a table of `fanbeam track` begins with, whichever run wrote it: one that was stopped leaves no record.
constexpr std::array<std::pair<const char*, std::string_view>, 2> kTables = {
    {{"tracks.csv", session::kTrackColumns}, {"measurements.csv", session::kMeasurementColumns}}};

[[noreturn]] void refuse_output(core::ErrorClass kind, const fs::path& folder,
                                const std::string& expected) {
  core::throw_input_error(kind, "--output", "\"" + folder.string() + "\"", expected);
}

// The folder that files of INPUT are in: tables there would be read with them.
void refuse_input_folder(const fs::path& input, const fs::path& folder) {
  std::error_code status;
  if (!fs::is_directory(input, status)) return;
  for (const char* below : {".", "detections", "beat"})
    if (core::lies_inside(input / below, folder) && core::lies_inside(folder, input / below))
      refuse_output(core::ErrorClass::path, folder, "a folder apart from the files of INPUT");
}

session::SourceSettings settings_of(const TrackOptions& options) {
  return {body_errors(options), options.radar_speed_mps, options.frame_period_s, options.frames,
          options.seed};
}

std::unique_ptr<session::MeasuredSource> chosen_scene(const TrackOptions& options) {
  SceneChoice choice;
  choice.scene = options.file;
  choice.sensor = options.sensor;
  choice.data = options.data;
  core::ProblemList problems;
  const scenes::SceneDescription description = read_chosen_scene(choice, problems);
  return session::scene_source(description, options.radar_file, settings_of(options), problems);
}

}  // namespace

void refuse_other_options(const TrackOptions& options, session::TrackInput input) {
  core::ProblemList problems;
  for (const Belongs& one : kBelong)
    if (options.given.contains(one.option) &&
        std::find(one.inputs.begin(), one.inputs.end(), input) == one.inputs.end())
      problems.error(
          core::ErrorClass::unsupported, {}, one.option, "given",
          words_of(one.inputs) + " as INPUT, which is " + kWords[static_cast<std::size_t>(input)]);
  problems.throw_if_errors();
}

void check_output(const std::string& input, const fs::path& folder,
                  const std::vector<std::string>& parts) {
  session::check_can_be_folder(folder);
  std::error_code status;
  refuse_input_folder(input, folder);
  const bool is_file = fs::is_regular_file(input, status);
  for (const char* name : {"run.json", "timing.json"})
    if (is_file) refuse_output_among({input}, folder / name, "--output");
  const bool has_record = fs::is_regular_file(folder / "run.json", status);
  if (has_record && !is_ours(folder / "run.json"))
    refuse_output(core::ErrorClass::range, folder,
                  "a folder without the record of another command (run.json)");
  for (const std::string& part : parts)
    for (const auto& [name, columns] : kTables) {
      const fs::path table = (folder / part / name).lexically_normal();
      if (is_file) refuse_output_among({input}, table, "--output");
      // Beside a record of ours a table is ours, of an earlier version with other columns too.
      if (!has_record && fs::exists(table, status) && !core::file_begins_with(table, columns))
        refuse_output(core::ErrorClass::range, folder,
                      "a folder without " + (part / fs::path(name)).string() +
                          " of something else than fanbeam track");
    }
  if (!has_record && fs::exists(folder / "timing.json", status))
    refuse_output(core::ErrorClass::range, folder,
                  "a folder without timing.json of something else than fanbeam track");
}

session::BodyErrors body_errors(const TrackOptions& options) {
  return {options.errors[0], options.errors[1], core::radians(options.errors[2])};
}

std::unique_ptr<session::MeasuredSource> own_source(const TrackOptions& options,
                                                    session::TrackInput input) {
  if (input == session::TrackInput::scene) return chosen_scene(options);
  return session::recorded_source(options.file, options.radar_file, settings_of(options));
}

}  // namespace fanbeam::apps
