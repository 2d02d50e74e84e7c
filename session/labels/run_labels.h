// The labels of all frames of a run in the formats that training programs read.
//
//   labels.json  all that labels_json says of each frame; schema docs/labels.schema.json
//   coco.json    COCO: a picture for each B-scope and C-scope that is there, its runways with four corners
//                as keypoints (0 outside, 1 hidden, 2 in sight), and everything that has cells: box and
//                run-length mask
//   lard.csv     LARD's columns, a row for each picture that all four corners of a runway are in.
//                Distances in NM, height in ft; its yaw is 0 at south, its pitch 90 level, its roll
//                anticlockwise; corners by rising y, then x. Path angles, positive right and up, are seen from
//                3050 m (lateral) and 305 m (vertical) behind the near threshold.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/scene.h"
#include "session/records/run_record.h"

namespace fanbeam::session {

inline constexpr std::array<std::string_view, 3> kRunLabelFiles = {"labels.json", "coco.json",
                                                                   "lard.csv"};

// Of the frames whose files hold labels. Throws InputError E-IO and E-PARSE.
void write_run_labels(const std::filesystem::path& folder, const scenes::Scene& scene,
                      const std::vector<FrameRecord>& frames);

}  // namespace fanbeam::session
