// What the input of a tracker is, by its path:
//
//   a scene       its frames at signal level
//   a folder      of fanbeam fmcw: detections/*.json, or else *.csv there, or else beat/*.npy with its
//                 radar.toml; or of files like those
//   .csv, .json   detections (session/signal/detection_file.h), or a road scenario
//   .npy          samples (session/signal/sample_file.h), with the file of their radar
#pragma once

#include <filesystem>
#include <memory>

#include "session/signal/sources/measured_source.h"

namespace fanbeam::session {

enum class TrackInput { scenarios, scene, detections, samples };

// A road scenario is any JSON file that holds no detections, unreadable ones too: the reader of scenarios
// tells what is wrong with them. A scene is a folder with scene.toml, or a word that is none of the others.
TrackInput track_input(const std::filesystem::path& input);

// Of an input of detections or samples. `radar_file`: empty for the one that a folder of fanbeam fmcw has.
// Warns (W-UNFINISHED) where the run that writes the folder has not ended. Throws InputError for whatever is
// wrong with the input: E-REF of --radar for samples without one.
std::unique_ptr<MeasuredSource> recorded_source(const std::filesystem::path& input,
                                                const std::filesystem::path& radar_file,
                                                const SourceSettings& settings);

}  // namespace fanbeam::session
