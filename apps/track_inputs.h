// What the INPUT of fanbeam track is, and which options it goes with.
//
//   a scene       its frames at signal level
//   a folder      of fanbeam fmcw: detections/*.json, or else beat/*.npy with its radar.toml; or of files
//                 like those
//   .csv, .json   detections (session/signal/detection_file.h), or a road scenario
//   .npy          samples (session/signal/sample_file.h), with --radar
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "apps/track_command.h"
#include "session/signal/sources/measured_source.h"

namespace fanbeam::apps {

enum class TrackInput { scenarios, scene, detections, samples };

// Whether `input` is a road scenario: a JSON file that has scenarios.
bool is_road_scenario(const std::string& input);

// E-UNSUPPORTED for each option given that says nothing of this kind of input: exit code 2.
void refuse_other_options(const TrackOptions& options, TrackInput input);

// E-RANGE of --output for a folder with a record that `fanbeam track` has not written: exit code 2.
void check_output(const std::filesystem::path& folder);

session::BodyErrors body_errors(const TrackOptions& options);

// Throws InputError for whatever is wrong with the input.
std::unique_ptr<session::MeasuredSource> own_source(const TrackOptions& options);

}  // namespace fanbeam::apps
