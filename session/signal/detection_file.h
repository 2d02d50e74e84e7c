// Detections that are at hand already: of this program (product detections) or of somebody's radar.
//
// CSV: a line of column names, then a row a detection. Needed: time_s, range_m, radial_speed_mps
// (positive receding), azimuth_deg (positive right); taken where they are there: elevation_deg
// (positive up, missing: 0), power_W, snr_dB, cluster (a whole number, -1 or empty for none). Other
// columns are passed over. Rows in the order of time; those of one time are a frame.
// JSON: {"time_s", "detections": [...]} of one frame, or {"frames": [those]}; a detection has range_m,
// radial_speed_mps and azimuth_rad, and may have elevation_rad, power_W, snr_dB and cluster; a frame
// may have radar_velocity_mps, [forward, right] over ground in the antenna's axes, or radar_speed_mps,
// forward alone. What `fanbeam fmcw` writes beside these (frame, forward_m, right_m) is passed over,
// any other member is E-REF.
// A folder: the files *.json in it (but run.json and timing.json), or in detections/ below it, in the
// order of the numbers in their names (file_order.h); where there are none, the files *.csv likewise, but
// not beside samples. A table among JSON without a file of its name in JSON is E-REF.
// A table does not tell the radar's velocity: it is that of the run.json of `fanbeam fmcw` in the folder
// above (recorded_moments.h), which also tells the time of a table without rows (without it, no frame) and
// may not contradict a row's (E-TIME).
// Frames of one time are one, with the velocity that any of them tells (E-RANGE where two tell different ones);
// clusters are each frame's own, whatever their numbers.
//
// Limits: files of 256 MiB; a million frames, 100 000 detections in a frame (a tracker takes fewer
// measurements), of all files together; ranges above 0 to 1e6 m, speeds within 1e5 m/s, azimuths within a half turn,
// elevations within a quarter. Ranges are slant ones at the middle of the chirps, times those of the
// waveform's clock at 0 (factories.h: of a chirp sequence its beginning), as `fanbeam fmcw` writes
// them. What is wrong is told with its place; times that go back are E-TIME.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "session/signal/radar_velocity.h"
#include "signal/detection/detections.h"

namespace fanbeam::session {

struct DetectedFrame {
  double time_s = 0.0;
  std::vector<signal::RadarDetection> detections;
  std::vector<int> clusters;                              // of each, or signal::kNoCluster
  std::optional<RadarVelocity_mps> radar_velocity_mps{};  // where the file or its record tells it
};

// Of a folder; none where it holds none.
std::vector<std::filesystem::path> detection_files(const std::filesystem::path& folder);

// Warns (W-TIMES) where that record does not know all tables.
std::vector<DetectedFrame> read_detections(const std::filesystem::path& path,
                                           core::ProblemList& problems);

}  // namespace fanbeam::session
