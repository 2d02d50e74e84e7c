// What a tracker is fed with, frame after frame, where the input is no road scenario:
//
//   a scene       its frames at signal level, to detections; its point targets are the truth
//   detections    (session/signal/detection_file.h)
//   samples       (session/signal/sample_file.h), with the radar that they are of
//
// Times of samples: where they are the beats of `fanbeam fmcw`, as the run.json in the folder above them
// says, and so is the radar's velocity, also of tables of detections; else a period apart, and 0. A speed alone,
// told by an option or a file, is one along the antenna's axis.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "scenes/description.h"
#include "session/signal/fmcw_settings.h"
#include "session/signal/measurements.h"
#include "session/signal/radar_velocity.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::session {

// As measurements are: on the plane where the radar tells elevations.
struct SeenTarget {
  std::string name;
  double range_m = 0.0, range_rate_mps = 0.0, azimuth_rad = 0.0;
};

struct MeasuredFrame {
  double time_s = 0.0;
  RadarVelocity_mps radar_velocity_mps{};
  std::size_t detections = 0;
  std::vector<tracking::RadarMeasurement> measurements;
  std::vector<SeenTarget> targets;  // in view; of a scene
};

inline constexpr double kFramePeriod_s = 0.05;  // where nothing tells it

class MeasuredSource {
 public:
  virtual ~MeasuredSource() = default;
  virtual int frames() const = 0;
  virtual MeasuredFrame frame(int index) = 0;

  std::string name, kind;                  // "street-76ghz", "scene"
  RadarVelocity_mps radar_velocity_mps{};  // at the first frame
  double frame_s = kFramePeriod_s, most_range_m = 1e6;
  std::optional<tracking::Resolution> resolution{};  // where the radar is known
  bool tells_azimuth = true;                         // else all lies along the line of sight
  std::vector<core::Problem> warnings{};             // of the scene, of times, and of folding, once

 protected:
  void set_radar(const FmcwRadar& radar) {
    resolution = resolution_of(radar);
    tells_azimuth = session::tells_azimuth(radar);
  }
};

struct SourceSettings {
  BodyErrors errors;
  std::optional<double> radar_speed_mps{};  // along the antenna's axis, not what the input says
  std::optional<double> frame_period_s{};   // of samples, instead of what the input says
  std::string frames{};                     // of a scene, A:B[:STEP]; empty: all
  std::uint64_t seed = 0;                   // of a scene
};

// The three throw InputError for whatever is wrong with the input. `radar_file`: empty for the scene's
// own, or its sensor. `problems`: of reading the scene; they are told together with the radar file's, and
// what is left of them becomes the source's warnings.
std::unique_ptr<MeasuredSource> scene_source(const scenes::SceneDescription& description,
                                             const std::filesystem::path& radar_file,
                                             const SourceSettings& settings,
                                             core::ProblemList& problems);
// Without a radar measurements have the errors of a body alone, and no resolution.
std::unique_ptr<MeasuredSource> detection_source(
    const std::filesystem::path& path, const std::optional<std::filesystem::path>& radar_file,
    const SourceSettings& settings);
// `path`: as it was asked for, of which the source has its name. All values are read once before
// (SampleFiles).
std::unique_ptr<MeasuredSource> sample_source(const std::filesystem::path& path,
                                              const std::vector<std::filesystem::path>& files,
                                              const std::filesystem::path& radar_file,
                                              const SourceSettings& settings);

// From one time to the next, of those that rise; nothing where none does.
std::optional<double> median_step_s(const std::vector<double>& times_s);

// Samples in a folder, or in beat/ below it, by name, numbers in names by their value; none where it has none. Later
// stages of waveforms are left out (NAME-stage1.npy beside NAME.npy).
std::vector<std::filesystem::path> sample_files_in(const std::filesystem::path& folder);

}  // namespace fanbeam::session
