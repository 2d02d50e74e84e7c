// The labels of all frames of a run in the formats that training programs read.
//
//   labels.json  all that labels_json says of each frame; schema docs/labels.schema.json
//   coco.json    COCO: a picture for each B-scope and C-scope that is there, and in it everything that
//                has cells there: box and run-length mask; of runways the four corners too, as keypoints (0
//                outside, 1 hidden, 2 in sight)
//   lard.csv     LARD's columns, a row for each picture that all four corners of a runway are in.
//                Distances in NM, height in ft; its yaw is 0 at south, its pitch 90 level, its roll
//                anticlockwise; corners by rising y, then x. Path angles, positive right and up, are seen from
//                3050 m (lateral) and 305 m (vertical) behind the near threshold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "session/records/run_record.h"

namespace fanbeam::session {

inline constexpr std::uint64_t kLargestLabels_bytes = 1ULL << 28U;  // of a frame
inline constexpr std::array<std::string_view, 3> kRunLabelFiles = {"labels.json", "coco.json",
                                                                   "lard.csv"};

// Of one run, or of many: whose frames are added in their order.
class RunLabels {
 public:
  RunLabels();
  ~RunLabels();
  RunLabels(const RunLabels&) = delete;
  RunLabels& operator=(const RunLabels&) = delete;

  // A frame whose `files` hold labels, which `text_of` answers by name; others are left out. Its pictures
  // are named with the prefix. `frames`: of its run, for LARD's scenario. Throws InputError E-PARSE.
  void add(const std::string& prefix, const std::set<std::string>& files, std::size_t frames,
           const std::function<std::string(const std::string& name)>& text_of);

  std::size_t frames() const { return frames_; }
  std::string all() const;
  std::string coco() const;
  std::string lard() const;

 private:
  struct Coco;
  std::unique_ptr<Coco> coco_;
  std::string all_, lard_;
  std::size_t frames_ = 0;
};

// The three files of a run, of the frames that have labels.
void write_run_labels(const std::filesystem::path& folder, const std::vector<FrameRecord>& frames);

}  // namespace fanbeam::session
