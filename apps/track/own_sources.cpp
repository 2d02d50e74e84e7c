#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <system_error>

#include "apps/scene_choice.h"
#include "apps/track/own_data.h"
#include "core/files.h"
#include "core/json_node.h"
#include "core/text.h"
#include "core/units.h"
#include "scenes/scene.h"
#include "session/frame_choice.h"
#include "session/records/output_folder.h"
#include "session/session.h"
#include "session/signal/chain.h"
#include "session/signal/detection_file.h"
#include "session/signal/paths.h"
#include "session/signal/radar_file.h"
#include "session/signal/sample_file.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

const std::set<std::string> kDetections = {"detections"};

session::DetectedFrame detected(const session::FmcwFrame& frame, double time_s) {
  return {time_s, frame.found->detections, frame.found->clusters};
}

session::BodyErrors errors_of(const TrackOptions& options) {
  return {options.errors[0], options.errors[1], core::radians(options.errors[2])};
}

class SceneSource : public OwnSource {
 public:
  explicit SceneSource(const TrackOptions& options) : errors_(errors_of(options)) {
    SceneChoice choice;
    choice.scene = options.file;
    choice.sensor = options.sensor;
    choice.data = options.data;
    core::ProblemList problems;
    const scenes::SceneDescription description = read_chosen_scene(choice, problems);
    const fs::path radar_file =
        options.radar_file.empty() ? description.signal_file : fs::path(options.radar_file);
    settings_.seed = options.seed;
    if (!radar_file.empty()) session::read_radar_file(radar_file, settings_, problems);
    problems.throw_if_errors();
    scene_ = session::Session(description, {}, problems).scene();
    warnings = problems.all();
    const sensors::Sensor& sensor = scene_->description.sensor;
    const auto radar = [&] { return session::fmcw_radar(settings_, sensor); };
    radar_ = radar_file.empty() ? radar() : session::radar_in_file(radar_file, radar);
    if (!radar_.maps)
      core::throw_input_error(core::ErrorClass::unsupported, "waveform.kind", radar_.waveform_name,
                              "a chirp sequence: the other kinds have no detections");
    indices_ = session::parse_frames(options.frames.empty() ? "0:" : options.frames,
                                     scene_->frame_count());
    name = scene_->description.name;
    kind = "scene";
    const int step = indices_.size() > 1 ? indices_[1] - indices_[0] : 1;
    frame_s = step / sensor.scan.frame_rate_Hz;
    most_range_m = sensor.range.maximum_m();
    resolution = session::resolution_of(radar_);
    radar_speed_mps = options.radar_speed_mps.value_or(
        glm::length(scene_->trajectory->at(time_of(indices_.front())).v_N_mps));
  }
  int frames() const override { return static_cast<int>(indices_.size()); }

  OwnFrame frame(int number) override {
    const int index = indices_[static_cast<std::size_t>(number)];
    const session::FmcwPaths paths = session::fmcw_paths(*scene_, index, settings_);
    const session::FmcwFrame found = session::fmcw_frame(
        radar_, scene_->description.sensor, paths.paths, index, settings_, kDetections,
        {scene_->plan, scene_->accuracy_grey, scene_->options.wishes}, paths.interferers);
    if (!folding_told_ && !found.warnings.empty()) {
      warnings.insert(warnings.end(), found.warnings.begin(), found.warnings.end());
      folding_told_ = true;
    }
    const session::DetectedFrame made = detected(found, time_of(index));
    OwnFrame frame{
        made.time_s, made.detections.size(), session::measurements_of(made, &radar_, errors_), {}};
    std::set<std::uint32_t> seen;
    for (const core::Echo& echo : paths.targets)
      if (seen.insert(echo.object_id).second)  // the direct way comes before the mirrored ones
        frame.targets.push_back({scene_->world.targets[echo.object_id].name, echo.range_m,
                                 echo.radial_speed_mps, echo.azimuth_rad});
    return frame;
  }

 private:
  double time_of(int index) const {
    return scene_->trajectory->frame_time_s(index, scene_->description.sensor.scan.frame_rate_Hz);
  }

  session::BodyErrors errors_;
  session::FmcwSettings settings_;
  std::shared_ptr<const scenes::Scene> scene_;
  session::FmcwRadar radar_;
  std::vector<int> indices_;
  bool folding_told_ = false;
};

class DetectionSource : public OwnSource {
 public:
  DetectionSource(const TrackOptions& options, std::optional<session::FmcwRadar> radar)
      : errors_(errors_of(options)), radar_(std::move(radar)) {
    core::ProblemList problems;
    frames_ = session::read_detections(options.file, problems);
    problems.throw_if_errors();
    if (frames_.empty())
      core::throw_input_error(core::ErrorClass::range, core::Place{options.file}, "detections",
                              "none", "at least one frame");
    name = core::safe_word(fs::absolute(options.file).lexically_normal().stem().string());
    kind = "detections";
    radar_speed_mps =
        options.radar_speed_mps.value_or(frames_.front().radar_speed_mps.value_or(0.0));
    std::vector<double> steps_s;
    for (std::size_t i = 1; i < frames_.size(); ++i)
      if (frames_[i].time_s > frames_[i - 1].time_s)
        steps_s.push_back(frames_[i].time_s - frames_[i - 1].time_s);
    if (!steps_s.empty()) {
      std::nth_element(steps_s.begin(),
                       steps_s.begin() + static_cast<std::ptrdiff_t>(steps_s.size() / 2),
                       steps_s.end());
      frame_s = steps_s[steps_s.size() / 2];
    }
    if (radar_) resolution = session::resolution_of(*radar_);
  }
  int frames() const override { return static_cast<int>(frames_.size()); }

  OwnFrame frame(int index) override {
    const session::DetectedFrame& found = frames_[static_cast<std::size_t>(index)];
    return {found.time_s,
            found.detections.size(),
            session::measurements_of(found, radar_ ? &*radar_ : nullptr, errors_),
            {}};
  }

 private:
  session::BodyErrors errors_;
  std::optional<session::FmcwRadar> radar_;
  std::vector<session::DetectedFrame> frames_;
};

class SampleSource : public OwnSource {
 public:
  SampleSource(const TrackOptions& options, const std::vector<fs::path>& files,
               const fs::path& radar_file, session::FmcwSettings settings)
      : errors_(errors_of(options)),
        settings_(std::move(settings)),
        radar_(
            session::radar_in_file(radar_file, [this] { return session::fmcw_radar(settings_); })),
        files_(files, radar_, settings_.layout) {
    name = core::safe_word(fs::absolute(options.file).lexically_normal().stem().string());
    kind = "samples";
    radar_speed_mps = options.radar_speed_mps.value_or(0.0);
    frame_s = options.frame_period_s;
    most_range_m = radar_.axes.range_step_m * radar_.detection.transform.kept_range_cells;
    resolution = session::resolution_of(radar_);
  }
  int frames() const override { return files_.frames(); }

  OwnFrame frame(int index) override {
    session::FmcwFrame frame;
    frame.beats.push_back(files_.frame(index));
    session::process_samples(radar_, settings_, kDetections, frame);
    const session::DetectedFrame found = detected(frame, index * frame_s);
    return {found.time_s,
            found.detections.size(),
            session::measurements_of(found, &radar_, errors_),
            {}};
  }

 private:
  session::BodyErrors errors_;
  session::FmcwSettings settings_;
  session::FmcwRadar radar_;
  session::SampleFiles files_;
};

std::vector<fs::path> sample_files_in(const fs::path& folder) {
  std::error_code status;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, status)) {
    // A second stage of a waveform is no frame of its own.
    const bool stage = entry.path().stem().string().find("-stage") != std::string::npos;
    if (entry.path().extension() == ".npy" && !stage) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

session::FmcwSettings settings_in(const fs::path& file) {
  session::FmcwSettings settings;
  core::ProblemList problems;
  session::read_radar_file(file, settings, problems);
  problems.throw_if_errors();
  return settings;
}

// --radar, or what the folder that fmcw wrote says.
std::optional<fs::path> radar_file_of(const TrackOptions& options) {
  if (!options.radar_file.empty()) return options.radar_file;
  std::error_code status;
  const fs::path beside = fs::path(options.file) / session::kRadarFile;
  if (fs::is_regular_file(beside, status)) return beside;
  return std::nullopt;
}

}  // namespace

bool is_road_scenario(const std::string& input) {
  std::error_code status;
  if (fs::path(input).extension() != ".json" || fs::is_directory(input, status)) return false;
  core::ProblemList problems;
  constexpr core::JsonLimits kLimits{64, 20'000'000};
  const auto file = core::read_json_file(input, 256ULL << 20U, kLimits, problems);
  // One that cannot be read is told by the reader of scenarios.
  if (!file) return true;
  const core::JsonNode root(*file, problems);
  return !root.is_object() ||
         !(root.member("detections").present() || root.member("frames").present());
}

std::unique_ptr<OwnSource> own_source(const TrackOptions& options) {
  const fs::path input = options.file;
  std::error_code status;
  const bool is_folder = fs::is_directory(input, status);
  const bool is_scene = is_folder ? fs::is_regular_file(input / "scene.toml", status)
                                  : input.extension() != ".csv" && input.extension() != ".json" &&
                                        input.extension() != ".npy";
  if (is_scene) {
    refuse_other_options(options, TrackInput::scene);
    return std::make_unique<SceneSource>(options);
  }
  const auto radar_file = radar_file_of(options);
  std::vector<fs::path> samples;
  if (input.extension() == ".npy") samples = {input};
  if (is_folder && session::detection_files(input).empty()) {
    samples = sample_files_in(input);
    if (samples.empty()) samples = sample_files_in(input / "beat");
  }
  refuse_other_options(options, samples.empty() ? TrackInput::detections : TrackInput::samples);
  if (!samples.empty()) {
    if (!radar_file)
      core::throw_input_error(core::ErrorClass::ref, "--radar", "not given",
                              "the radar file that belongs to the samples");
    return std::make_unique<SampleSource>(options, samples, *radar_file, settings_in(*radar_file));
  }
  std::optional<session::FmcwRadar> radar;
  if (radar_file)
    radar = session::radar_in_file(*radar_file,
                                   [&] { return session::fmcw_radar(settings_in(*radar_file)); });
  return std::make_unique<DetectionSource>(options, std::move(radar));
}

}  // namespace fanbeam::apps
