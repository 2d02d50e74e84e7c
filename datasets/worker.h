// Renders runs of a campaign into its folder.
//
//   DIR/runs/000123/run.json          what was drawn, what was rendered, SHA-256 of every file and of itself
//                  /bscope/00600.png  (record_seal.h); written last, before the folder gets its name: a
//                                     run is there or is not. Or all of it in one archive, DIR/runs/000123.tar (run_files.h)
//   DIR/scenes/edny-24/scene.toml     of the campaign's airports (airport_scene.h)
//   DIR/failed/000123.json            why a run cannot be: problems, one a line
//
// A run is made in a hidden folder beside its place (an archive's in the temporary folder) under a lock (flock) of its own, which goes with the
// process: two workers, on one machine or on several that share the folder, never make one run at once, and
// what a killed one left is removed by the next. Same bytes for any worker, order and number of threads.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/errors.h"
#include "datasets/campaign.h"
#include "datasets/draw.h"
#include "datasets/run_files.h"
#include "session/session.h"

namespace fanbeam::datasets {

std::filesystem::path failed_file(const std::filesystem::path& campaign, int run);

enum class RunEnd { made, there, elsewhere, failed };

struct WorkerSettings {
  std::filesystem::path output{};
  std::filesystem::path shipped{};
  std::vector<std::filesystem::path> data_folders{};
  bool replace = false;  // make runs again that are there
};

class Worker {
 public:
  // Sets the level of instructions of the process; E-UNSUPPORTED where the machine has not the campaign's.
  Worker(const Campaign& campaign, WorkerSettings settings);
  ~Worker();

  // Throws InputError E-IO for a folder that cannot be written, core::Stopped; all else that is wrong with
  // a run is written as failed. Opens a scene where the last run was of another: runs in the order of
  // by_scene (draw.h) open each once.
  RunEnd make(int run);

  // What the last made run took.
  struct Cost {
    int frames = 0;
    double seconds = 0.0;
    std::uint64_t bytes = 0;
  };
  const Cost& cost() const { return cost_; }
  // What was wrong with the last run that failed.
  const std::vector<core::Problem>& refused() const { return refused_; }
  // What is odd in scenes, sensors and drawn conditions since this was asked last: each once, however many
  // runs have it, with the value of the first.
  std::vector<core::Problem> new_warnings();

 private:
  struct Stage;
  Stage& stage_of(const std::string& scene);
  std::filesystem::path scene_path(const std::string& name) const;
  void keep_warnings(const std::string& scene, const core::ProblemList& found);
  // Of a run that is whole, in its folder: gives it its name.
  void put_in_place(int run, const std::filesystem::path& made) const;
  void render(const Draw& draw, const std::filesystem::path& folder);
  std::uint64_t write_record(const Draw& draw, const Stage& stage,
                             const std::filesystem::path& folder, const std::string& fingerprint,
                             const std::vector<struct MadeFrame>& frames) const;

  const Campaign& campaign_;
  WorkerSettings settings_;
  Drawer drawer_;
  std::unique_ptr<Stage> stage_;  // of the last run: a scene may take hundreds of megabytes
  Cost cost_;
  std::vector<core::Problem> refused_, warnings_;
  std::set<std::string> told_;  // warnings, but for their values
};

}  // namespace fanbeam::datasets
