#include "apps/track_inputs.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <vector>

#include "apps/scene_choice.h"
#include "core/errors.h"
#include "core/json_node.h"
#include "core/units.h"
#include "session/records/output_folder.h"
#include "session/signal/detection_file.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using Inputs = std::vector<TrackInput>;

constexpr std::uint64_t kLargest_bytes = 1ULL << 30U;

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

// Of run.json and of inputs.
constexpr core::JsonLimits kLimits{64, 20'000'000};

// What a run of `fanbeam track` leaves says one of these.
bool is_ours(const fs::path& record) {
  core::ProblemList problems;
  const auto file = core::read_json_file(record, kLargest_bytes, kLimits, problems);
  if (!file) return false;
  const core::JsonNode json(*file, problems);
  return json.member("scenarios").present() || json.member("confirmed_tracks").present();
}

session::SourceSettings settings_of(const TrackOptions& options) {
  return {body_errors(options), options.radar_speed_mps, options.frame_period_s, options.frames,
          options.seed};
}

// --radar, or what the folder that fmcw wrote says.
std::optional<fs::path> radar_file_of(const TrackOptions& options) {
  if (!options.radar_file.empty()) return options.radar_file;
  std::error_code status;
  const fs::path beside = fs::path(options.file) / session::kRadarFile;
  if (fs::is_regular_file(beside, status)) return beside;
  return std::nullopt;
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

void refuse_other_options(const TrackOptions& options, TrackInput input) {
  core::ProblemList problems;
  for (const Belongs& one : kBelong)
    if (options.given.contains(one.option) &&
        std::find(one.inputs.begin(), one.inputs.end(), input) == one.inputs.end())
      problems.error(
          core::ErrorClass::unsupported, {}, one.option, "given",
          words_of(one.inputs) + " as INPUT, which is " + kWords[static_cast<std::size_t>(input)]);
  problems.throw_if_errors();
}

void check_output(const fs::path& folder) {
  std::error_code status;
  const fs::path record = folder / "run.json";
  if (fs::is_regular_file(record, status) && !is_ours(record))
    core::throw_input_error(core::ErrorClass::range, "--output", "\"" + folder.string() + "\"",
                            "a folder without the record of another command (run.json)");
}

bool is_road_scenario(const std::string& input) {
  std::error_code status;
  if (fs::path(input).extension() != ".json" || fs::is_directory(input, status)) return false;
  core::ProblemList problems;
  const auto file = core::read_json_file(input, 256ULL << 20U, kLimits, problems);
  // One that cannot be read is told by the reader of scenarios.
  if (!file) return true;
  const core::JsonNode root(*file, problems);
  return !root.is_object() ||
         !(root.member("detections").present() || root.member("frames").present());
}

session::BodyErrors body_errors(const TrackOptions& options) {
  return {options.errors[0], options.errors[1], core::radians(options.errors[2])};
}

namespace {

std::unique_ptr<session::MeasuredSource> measured_source(const TrackOptions& options) {
  const fs::path input = options.file;
  std::error_code status;
  const bool is_folder = fs::is_directory(input, status);
  const bool is_scene = is_folder ? fs::is_regular_file(input / "scene.toml", status)
                                  : input.extension() != ".csv" && input.extension() != ".json" &&
                                        input.extension() != ".npy";
  if (is_scene) {
    refuse_other_options(options, TrackInput::scene);
    return chosen_scene(options);
  }
  const auto radar_file = radar_file_of(options);
  std::vector<fs::path> samples;
  if (input.extension() == ".npy") samples = {input};
  if (is_folder && session::detection_files(input).empty())
    samples = session::sample_files_in(input);
  refuse_other_options(options, samples.empty() ? TrackInput::detections : TrackInput::samples);
  if (samples.empty()) return session::detection_source(input, radar_file, settings_of(options));
  if (!radar_file)
    core::throw_input_error(core::ErrorClass::ref, "--radar", "not given",
                            "the radar file that belongs to the samples");
  return session::sample_source(input, samples, *radar_file, settings_of(options));
}

// Of the folder that a command writes, or of a product's in it.
bool is_of_unfinished_run(const fs::path& input) {
  std::error_code status;
  return fs::is_directory(input, status) &&
         (session::is_unfinished(input) || session::is_unfinished(input / ".."));
}

}  // namespace

std::unique_ptr<session::MeasuredSource> own_source(const TrackOptions& options) {
  auto source = measured_source(options);
  if (!is_of_unfinished_run(options.file)) return source;
  core::ProblemList problems;
  problems.warning("UNFINISHED", {options.file}, "run.json", "not written",
                   "its run has not ended: files of another run may lie among them");
  source->warnings.insert(source->warnings.begin(), problems.all().begin(), problems.all().end());
  return source;
}

}  // namespace fanbeam::apps
