// fanbeam track on what is no road scenario: a scene's signals, recorded samples, detections at hand.
//
//   a scene       its frames at signal level, to detections, to tracks; targets of the scene are the truth
//   a folder      of fanbeam fmcw: detections/*.json, or else beat/*.npy with its radar.toml; or of files
//                 like those
//   .csv, .json   detections (session/signal/detection_file.h)
//   .npy          samples (session/signal/sample_file.h), with --radar
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/common.h"
#include "apps/track_command.h"
#include "session/signal/fmcw_settings.h"
#include "session/signal/measurements.h"
#include "tracking/tracker/tracker.h"

namespace fanbeam::apps {

// Whether `input` is a road scenario: a JSON file that has scenarios.
bool is_road_scenario(const std::string& input);

int track_own_data(const TrackOptions& options, const CommonOptions& common);

// What is measured frame after frame, from one of the sources.
struct OwnTarget {
  std::string name;
  double range_m = 0.0, range_rate_mps = 0.0, azimuth_rad = 0.0;
};
struct OwnFrame {
  double time_s = 0.0;
  std::size_t detections = 0;
  std::vector<tracking::RadarMeasurement> measurements;
  std::vector<OwnTarget> targets;  // in view; of a scene
};

class OwnSource {
 public:
  virtual ~OwnSource() = default;
  virtual int frames() const = 0;
  virtual OwnFrame frame(int index) = 0;

  std::string name, kind;  // "street-76ghz", "scene"
  double radar_speed_mps = 0.0, frame_s = 0.05, most_range_m = 1e6;
  std::optional<tracking::Resolution> resolution{};  // where the radar is known
  std::vector<core::Problem> warnings{};             // of the scene, and of folding, once
};

// What INPUT may be.
enum class TrackInput { scenarios, scene, detections, samples };

// E-UNSUPPORTED for each option given that says nothing of this kind of input: exit code 2.
void refuse_other_options(const TrackOptions& options, TrackInput input);

// E-RANGE of --output for a folder with a record that `fanbeam track` has not written: exit code 2.
void check_output(const std::filesystem::path& folder);

// Throws InputError for whatever is wrong with the input.
std::unique_ptr<OwnSource> own_source(const TrackOptions& options);

}  // namespace fanbeam::apps
