// A tracked scenario over time: ranges with identities, and errors within their bounds.
#pragma once

#include <map>

#include "session/plots/gnuplot.h"
#include "tracking/simulation/scenario_run.h"

namespace fanbeam::session {

// What the plots show, gathered frame by frame.
class ScenarioHistory {
 public:
  void add(const core::HighwayScenario& scenario, const tracking::ScenarioFrame& frame,
           const tracking::ScenarioScore& score);

  // Truth dashed, one colour for each target; measurements as dots; tracks as points in the colour
  // of the target they follow.
  Plot ranges(const core::HighwayScenario& scenario) const;
  // Range of each track less that of its target; dashed, twice the standard deviation that the
  // track tells.
  Plot errors(const core::HighwayScenario& scenario) const;

 private:
  struct Line {
    std::vector<double> x, y;
    void add(double at, double value) {
      x.push_back(at);
      y.push_back(value);
    }
  };
  std::map<int, Line> truth_, errors_, sigmas_;  // of targets
  std::map<std::pair<int, int>, Line> tracks_;   // of target and track; target -1 for none
  Line measurements_;
};

}  // namespace fanbeam::session
