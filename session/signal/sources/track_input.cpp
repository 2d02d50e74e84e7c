#include "session/signal/sources/track_input.h"

#include <system_error>

#include "core/json_node.h"
#include "core/npy.h"
#include "session/records/output_folder.h"
#include "session/signal/detection_file.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

bool is_road_scenario(const fs::path& json_file) {
  constexpr core::JsonLimits kLimits{64, 20'000'000};
  core::ProblemList problems;
  const auto file = core::read_json_file(json_file, 256ULL << 20U, kLimits, problems);
  if (!file) return true;
  const core::JsonNode root(*file, problems);
  return !root.is_object() ||
         !(root.member("detections").present() || root.member("frames").present());
}

// None of an input of detections.
std::vector<fs::path> samples_of(const fs::path& input) {
  std::error_code status;
  if (fs::is_directory(input, status) && detection_files(input).empty())
    return sample_files_in(input);
  if (!fs::is_directory(input, status) && input.extension() == ".npy") return {input};
  return {};
}

std::optional<fs::path> radar_file_of(const fs::path& input, const fs::path& told) {
  if (!told.empty()) return told;
  std::error_code status;
  const fs::path beside = input / kRadarFile;
  if (fs::is_regular_file(beside, status)) return beside;
  return std::nullopt;
}

// They are not read, and what is no file of samples is told all the same.
[[noreturn]] void refuse_without_radar(const std::vector<fs::path>& samples) {
  core::ProblemList problems;
  problems.error(core::ErrorClass::ref, {}, "--radar", "not given",
                 "the radar file that belongs to the samples");
  for (const fs::path& file : samples) {
    if (problems.is_full()) break;
    try {
      core::read_npy_header(file);
    } catch (const core::InputError& error) {
      problems.append(error.problems());
    }
  }
  throw core::InputError(problems.all());
}

std::unique_ptr<MeasuredSource> source_of(const fs::path& input, const fs::path& told_radar_file,
                                          const SourceSettings& settings) {
  const auto radar_file = radar_file_of(input, told_radar_file);
  const std::vector<fs::path> samples = samples_of(input);
  if (samples.empty()) return detection_source(input, radar_file, settings);
  if (!radar_file) refuse_without_radar(samples);
  return sample_source(input, samples, *radar_file, settings);
}

// Of the folder that a command writes, or of a product's in it.
bool is_of_unfinished_run(const fs::path& input) {
  std::error_code status;
  return fs::is_directory(input, status) && (is_unfinished(input) || is_unfinished(input / ".."));
}

}  // namespace

TrackInput track_input(const fs::path& input) {
  std::error_code status;
  const bool is_folder = fs::is_directory(input, status);
  const fs::path ending = input.extension();
  if (is_folder ? fs::is_regular_file(input / "scene.toml", status)
                : ending != ".csv" && ending != ".json" && ending != ".npy")
    return TrackInput::scene;
  if (!is_folder && ending == ".json" && is_road_scenario(input)) return TrackInput::scenarios;
  return samples_of(input).empty() ? TrackInput::detections : TrackInput::samples;
}

std::unique_ptr<MeasuredSource> recorded_source(const fs::path& input, const fs::path& radar_file,
                                                const SourceSettings& settings) {
  auto source = source_of(input, radar_file, settings);
  if (!is_of_unfinished_run(input)) return source;
  core::ProblemList problems;
  problems.warning("UNFINISHED", {input}, "run.json", "not written",
                   "its run has not ended: files of another run may lie among them");
  source->warnings.insert(source->warnings.begin(), problems.all().begin(), problems.all().end());
  return source;
}

}  // namespace fanbeam::session
