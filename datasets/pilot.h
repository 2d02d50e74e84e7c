// What a campaign comes to before it is rendered: what its runs draw, and from a few that are flown what
// all of them take.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "datasets/campaign.h"
#include "datasets/worker.h"

namespace fanbeam::datasets {

// Of a campaign's runs those of one scene: how many, and some of them spread over all.
class SceneRuns {
 public:
  // Rising.
  void add(int run);
  int count() const { return count_; }
  // How many of them `pick` knows.
  std::size_t kept() const { return kept_.size(); }
  // The i-th of n spread over them; from there on, and where there are fewer, in turn.
  int pick(std::size_t i, std::size_t n) const;

 private:
  static constexpr std::size_t kMostKept = 64;
  int count_ = 0, stride_ = 1;
  std::vector<int> kept_;  // every stride_-th
};

struct Drawn {
  // What the draws of a parameter come to.
  struct Range {
    double low = 1e300, high = -1e300;
    std::map<std::string, int> words;  // how often each
  };
  struct Refusal {
    int run = 0;      // the first
    std::string why;  // of that
    int count = 0;    // of runs
  };

  std::map<std::string, Range> ranges;     // by parameter, of all runs
  std::map<std::string, Refusal> refused;  // by what is wrong
  // Of the runs of which nothing is refused.
  int runs = 0;
  std::map<std::string, SceneRuns> scenes;
};

// Draws all runs, without a scene: weather that no radar of 35 GHz is simulated in is refused. What else a
// scene makes of them is told by the runs themselves.
Drawn drawn_of(const Campaign& campaign);

struct PilotFigures {
  struct Refusal {
    int run = 0;
    std::string scene, why;
  };

  // That were measured; of none, what follows is 0.
  int runs = 0, scenes = 0;
  // Mean of a run in a scene that is open, each scene counted by how many runs fly it.
  double run_s = 0.0, run_bytes = 0.0;
  double open_s = 0.0;                  // mean of a scene
  std::vector<Refusal> refused;         // of what was tried, each reason once
  std::vector<core::Problem> warnings;  // of the same
};

// Renders runs of the four scenes that most of them fly, in a folder that goes with it: of each scene one
// that opens it and one or more that count, at least three in all, each under other conditions than the one
// before, as in the campaign. Where a run is refused the next is tried. Of `settings`, what is shipped and
// where data are. Throws as Worker does.
PilotFigures fly_pilot(const Campaign& campaign, const Drawn& drawn, WorkerSettings settings);

}  // namespace fanbeam::datasets
