// `fanbeam campaign`: thousands of short flights under conditions drawn for each, on one machine or many.
#pragma once

#include <string>

#include "apps/common.h"

namespace fanbeam::apps {

struct CampaignOptions {
  enum class Task { plan, run, status, merge, verify, slurm };
  Task task = Task::plan;
  std::string file;    // campaign.toml
  std::string output;  // folder; empty: out/<campaign's name>; of slurm the script
  std::string runs;    // as datasets::runs_in takes them; empty: all
  std::string shard;   // "K/N"
  std::string data, folder;
  bool replace = false, json = false, pilot = true;
  int threads = 0, tasks = 1;
};

}  // namespace fanbeam::apps
