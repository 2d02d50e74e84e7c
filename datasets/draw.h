// The values of a run: a pure function of campaign and run number.
//
//   grid    run r takes the combination r modulo their number, the first parameter turning slowest
//   sobol   point r of the Sobol sequence (Bratley and Fox 1988, ACM 659; Boost's), a dimension for each
//           parameter that varies, shifted by a number that the seed gives each dimension, modulo 1
//   random  independent numbers by seed, run and parameter (core/random.h)
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "datasets/campaign.h"

namespace fanbeam::datasets {

struct Draw {
  int run = 0;
  std::map<std::string, Value> values;  // of every parameter, constants too

  std::optional<double> number(const std::string& name) const;
  std::optional<std::string> word(const std::string& name) const;
};

// Draws runs of a campaign, which must outlive it. Rising runs are quick: a million takes seconds. One
// thread at a time.
class Drawer {
 public:
  explicit Drawer(const Campaign& campaign);
  ~Drawer();
  Draw draw(int run);

 private:
  struct Sequence;
  const Campaign& campaign_;
  std::unique_ptr<Sequence> sequence_;
};

// The scene that a run flies, as the campaign's file names it.
std::string scene_of(const Campaign& campaign, const Draw& draw);

// The same runs, those of a scene one after the other, in their order: whoever makes them opens each scene
// once and holds one at a time.
std::vector<int> by_scene(const Campaign& campaign, const std::vector<int>& runs);

}  // namespace fanbeam::datasets
