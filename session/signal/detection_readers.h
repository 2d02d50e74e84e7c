// The frames of one file of detections, as session/signal/detection_file.h describes them. What is wrong is told with
// its place.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/errors.h"
#include "session/signal/detection_file.h"

namespace fanbeam::session {

inline constexpr std::size_t kMostDetectedFrames = 1'000'000;
inline constexpr std::size_t kMostDetections = 100'000;     // in a frame
inline constexpr std::size_t kMostDetectionProblems = 100;  // with as many a reader stops

// "frames", "detections in a frame": more of them than `most`.
void refuse_too_many(const char* what, std::size_t most, const core::Place& place,
                     core::ProblemList& problems);

// In the order of time.
std::vector<DetectedFrame> read_detection_table(const std::filesystem::path& file,
                                                core::ProblemList& problems);
// In the file's order.
std::vector<DetectedFrame> read_detection_json(const std::filesystem::path& path,
                                               core::ProblemList& problems);

}  // namespace fanbeam::session
