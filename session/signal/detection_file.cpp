#include "session/signal/detection_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <system_error>
#include <utility>

#include "session/signal/detection_readers.h"
#include "session/signal/file_order.h"
#include "session/signal/recorded_moments.h"
#include "session/signal/sources/measured_source.h"
#include "signal/detection/clusters.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;
using core::ErrorClass;

// Adds the detections of a frame to another. Each has numbered its clusters on its own: those of the added one
// count from `next`, above all numbers so far, which moves on behind them.
void append(const DetectedFrame& added, DetectedFrame& frame, int& next) {
  frame.detections.insert(frame.detections.end(), added.detections.begin(), added.detections.end());
  std::map<int, int> renumbered;
  for (const int number : added.clusters)
    frame.clusters.push_back(
        number == signal::kNoCluster
            ? number
            : renumbered.try_emplace(number, next + static_cast<int>(renumbered.size()))
                  .first->second);
  next += static_cast<int>(renumbered.size());
}

std::string words_of(const RadarVelocity_mps& velocity_mps) {
  return "[" + core::number_text(velocity_mps[0]) + ", " + core::number_text(velocity_mps[1]) + "]";
}

// Frames of one time are one frame, of a file or of several. Each file keeps the limits; so must all together.
class FramesInOrder {
 public:
  // False where more than the limits would be kept.
  bool add(std::vector<DetectedFrame> frames, const fs::path& file, core::ProblemList& problems) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      DetectedFrame& one = frames[i];
      if (frames_.empty() || one.time_s > frames_.back().time_s) {
        if (frames_.size() == kMostDetectedFrames) {
          refuse_too_many("frames", kMostDetectedFrames, {file.string()}, problems);
          return false;
        }
        next_cluster_ = 0;
        for (const int number : one.clusters) next_cluster_ = std::max(next_cluster_, number + 1);
        frames_.push_back(std::move(one));
      } else if (one.time_s == frames_.back().time_s) {
        if (frames_.back().detections.size() + one.detections.size() > kMostDetections) {
          refuse_too_many("detections in a frame", kMostDetections, {file.string()}, problems);
          return false;
        }
        keep_velocity(one, {file.string()}, "frame " + std::to_string(i), problems);
        append(one, frames_.back(), next_cluster_);
      } else if (problems.all().size() < kMostDetectionProblems) {
        problems.error(ErrorClass::time, {file.string()}, "frame " + std::to_string(i) + " time_s",
                       core::number_text(one.time_s), "times that do not go back");
      }
    }
    return true;
  }
  std::vector<DetectedFrame> taken() { return std::move(frames_); }

 private:
  // A radar moves one way at a time, whichever of the frames tells it.
  void keep_velocity(const DetectedFrame& added, const core::Place& place, const std::string& name,
                     core::ProblemList& problems) {
    std::optional<RadarVelocity_mps>& known = frames_.back().radar_velocity_mps;
    if (!added.radar_velocity_mps) return;
    if (!known) known = added.radar_velocity_mps;
    if (*known != *added.radar_velocity_mps && problems.all().size() < kMostDetectionProblems)
      problems.error(ErrorClass::range, place, name + " radar_velocity_mps",
                     words_of(*added.radar_velocity_mps),
                     words_of(*known) + ", as another frame of " + core::number_text(added.time_s) +
                         " s has it");
  }

  std::vector<DetectedFrame> frames_;
  int next_cluster_ = 0;
};

// Of a folder, by their names.
struct FilesOfDetections {
  std::vector<fs::path> json, tables;
  const std::vector<fs::path>& taken() const { return json.empty() ? tables : json; }
};

FilesOfDetections files_of_detections(const fs::path& folder) {
  std::error_code status;
  const fs::path below = folder / "detections";
  const bool is_below = fs::is_directory(below, status);
  FilesOfDetections files;
  for (const auto& entry : fs::directory_iterator(is_below ? below : folder, status)) {
    const fs::path name = entry.path().filename();
    const bool record = name == "run.json" || name == "timing.json" ||
                        name.string().starts_with('.');  // a file that was never finished
    if (record || !entry.is_regular_file(status)) continue;
    if (name.extension() == ".json") files.json.push_back(entry.path());
    if (name.extension() == ".csv") files.tables.push_back(entry.path());
  }
  // Somebody's notes.
  if (!is_below && !sample_files_in(folder).empty()) files.tables.clear();
  std::sort(files.json.begin(), files.json.end(), comes_before);
  std::sort(files.tables.begin(), files.tables.end(), comes_before);
  return files;
}

// `fanbeam fmcw` writes both of a frame, and JSON tells all that a table does: one without would be left out.
void refuse_lone_tables(const FilesOfDetections& files, core::ProblemList& problems) {
  if (files.json.empty()) return;
  for (const fs::path& table : files.tables) {
    const fs::path beside = fs::path(table).replace_extension(".json");
    if (problems.all().size() >= kMostDetectionProblems) return;
    if (!std::binary_search(files.json.begin(), files.json.end(), beside, comes_before))
      problems.error(ErrorClass::ref, {table.string()}, "detections", "a table among files *.json",
                     beside.filename().string() + " beside it, or tables alone");
  }
}

// What the record of `fanbeam fmcw` knows of a table: the radar's velocity, and when nothing was detected.
void put_moment(const RecordedMoment& moment, const fs::path& file,
                std::vector<DetectedFrame>& frames, core::ProblemList& problems) {
  constexpr double kDigit_s = 1e-6;  // the last of a table
  if (frames.empty()) frames.push_back({moment.time_s, {}, {}, {}});
  for (DetectedFrame& one : frames) {
    one.radar_velocity_mps = moment.radar_velocity_mps;
    if (std::abs(one.time_s - moment.time_s) <= kDigit_s) continue;
    return problems.error(ErrorClass::time, {file.string()}, "time_s",
                          core::number_text(one.time_s),
                          core::number_text(moment.time_s) +
                              ", as the run.json in the folder above tells of this file");
  }
}

}  // namespace

std::vector<fs::path> detection_files(const fs::path& folder) {
  return files_of_detections(folder).taken();
}

std::vector<DetectedFrame> read_detections(const fs::path& path, core::ProblemList& problems) {
  std::error_code status;
  std::vector<fs::path> files{path};
  if (fs::is_directory(path, status)) {
    const FilesOfDetections found = files_of_detections(path);
    refuse_lone_tables(found, problems);
    files = found.taken();
  }
  if (files.empty() || files.size() > kMostDetectedFrames)
    problems.error(ErrorClass::io, {path.string()}, "detections",
                   files.empty() ? "none" : "more than a million",
                   "files *.json or *.csv, here or in detections/");
  const bool tables = !files.empty() && files.front().extension() == ".csv";
  std::vector<RecordedMoment> moments;
  if (tables) moments = recorded_moments(files, "--radar-speed counts, or 0 without it", problems);
  FramesInOrder frames;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (problems.all().size() >= kMostDetectionProblems) break;
    std::vector<DetectedFrame> read =
        tables ? read_detection_table(files[i], problems) : read_detection_json(files[i], problems);
    if (!moments.empty()) put_moment(moments[i], files[i], read, problems);
    if (!frames.add(std::move(read), files[i], problems)) break;
  }
  return frames.taken();
}

}  // namespace fanbeam::session
