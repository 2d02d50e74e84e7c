// All runs of a campaign together.
#pragma once

#include <filesystem>
#include <vector>

#include "datasets/campaign.h"

namespace fanbeam::datasets {

struct Merged {
  int runs = 0, frames = 0;
  std::vector<std::filesystem::path> files;
};
// Writes, of the runs that are there, into the campaign's folder:
//   index.csv      a row for each frame: run, frame, scene as the campaign names it, time, pose, every drawn value, its files; of archives also where in
//                  them a file begins and how many bytes it has
//   manifest.json  campaign, program, and the SHA-256 of every run's record
//   coco.json, lard.csv   of all runs, where they have labels, else those of an earlier merge go; pictures as runs/000123/bscope/00600.png,
//                  where they lie in archives once each is unpacked into a folder of its name
// Throws InputError E-UNSUPPORTED for runs that another file, program, library or level of instructions
// made than the rest, or of other files of their scene, of other values than the file gives and beyond its runs, E-PARSE for records that
// cannot be read, E-IO for a folder without runs.
Merged merge(const Campaign& campaign, const std::filesystem::path& output);

}  // namespace fanbeam::datasets
