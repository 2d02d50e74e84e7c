// A campaign as jobs of Slurm.
#pragma once

#include <filesystem>
#include <string>

#include "datasets/campaign.h"

namespace fanbeam::datasets {

struct SlurmSettings {
  std::filesystem::path program;   // fanbeam, as the nodes find it
  std::filesystem::path output{};  // shared by all nodes
  std::string data{};              // --data of the runs, and of what repairs them; empty: none
  int tasks = 1;                   // of the array: one process each, with a whole node's processors
  int threads = 0;                 // of each; 0: as many as Slurm gives
};

// A script that hands three jobs to sbatch: an array of `tasks` shards, requeued when a node fails, each a
// process that renders all its runs from scenes opened once; then merge, then verify, after all shards
// have ended. Standing in the queue twice does no harm: what is there is not made again.
std::string slurm_script(const Campaign& campaign, const SlurmSettings& settings);

}  // namespace fanbeam::datasets
