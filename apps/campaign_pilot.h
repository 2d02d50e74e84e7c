// A few runs of a campaign, from which `fanbeam campaign plan` tells what all of it takes.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "apps/campaign_command.h"
#include "datasets/campaign.h"

namespace fanbeam::apps {

// Of a campaign's runs those of one scene: how many, and some of them spread over all.
class SceneRuns {
 public:
  // Rising.
  void add(int run);
  int count() const { return count_; }
  // The i-th of n spread over them; in turn where there are fewer.
  int pick(std::size_t i, std::size_t n) const;

 private:
  static constexpr std::size_t kMostKept = 64;
  int count_ = 0, stride_ = 1;
  std::vector<int> kept_;  // every stride_-th
};
using RunsByScene = std::map<std::string, SceneRuns>;

// Renders runs of the scenes that most of them fly, in a folder that goes with it, and prints time and
// disk of all. A scene is opened once by each worker: that is told apart. False where a run is refused,
// which is printed. Throws core::Stopped.
bool print_pilot(const CampaignOptions& options, const datasets::Campaign& campaign,
                 const RunsByScene& scenes);

}  // namespace fanbeam::apps
