#include "datasets/draw.h"

#include <boost/random/sobol.hpp>
#include <cmath>

#include "core/random.h"

namespace fanbeam::datasets {
namespace {

constexpr std::uint64_t kShiftRun = 0xFFFFFFFFU;  // of no run: the shift of a Sobol dimension

double uniform(std::uint64_t seed, std::uint64_t run, std::size_t dimension) {
  return core::uniform_from(
      core::random_words({seed, core::kStreamCampaign, run}, dimension, 0)[0]);
}

}  // namespace

struct Drawer::Sequence {
  explicit Sequence(std::size_t dimensions) : engine(dimensions), point(dimensions) {}
  boost::random::sobol engine;
  std::vector<double> point;
  std::uint64_t next = 0;  // that the engine would give

  void move_to(std::uint64_t run) {
    if (run + 1 == next) return;
    if (run != next) engine.seed(run);
    for (double& u : point) u = (static_cast<double>(engine() >> 11U) + 0.5) * 0x1p-53;
    next = run + 1;
  }
};

std::optional<double> Draw::number(const std::string& name) const {
  const auto found = values.find(name);
  if (found == values.end()) return std::nullopt;
  return std::get<double>(found->second);
}

std::optional<std::string> Draw::word(const std::string& name) const {
  const auto found = values.find(name);
  if (found == values.end()) return std::nullopt;
  return std::get<std::string>(found->second);
}

Drawer::Drawer(const Campaign& campaign) : campaign_(campaign) {
  std::size_t varying = 0;
  for (const Parameter& parameter : campaign.parameters)
    if (!parameter.distribution.is_constant()) ++varying;
  if (campaign.plan == Campaign::Plan::sobol && varying > 0)
    sequence_ = std::make_unique<Sequence>(varying);
}

Drawer::~Drawer() = default;

Draw Drawer::draw(int run) {
  Draw draw;
  draw.run = run;
  const auto number = static_cast<std::uint64_t>(run);
  if (sequence_) sequence_->move_to(number);
  std::size_t combination = 0;  // of a grid
  if (campaign_.plan == Campaign::Plan::grid) {
    std::size_t all = 1;
    for (const Parameter& parameter : campaign_.parameters) all *= parameter.distribution.count();
    combination = number % all;
  }
  std::size_t dimension = 0;
  // The last parameter turns quickest.
  std::size_t slower = 1;
  for (const Parameter& parameter : campaign_.parameters)
    slower *= std::max<std::size_t>(parameter.distribution.count(), 1);
  for (const Parameter& parameter : campaign_.parameters) {
    const Distribution& distribution = parameter.distribution;
    if (distribution.is_constant()) {
      draw.values[parameter.name] = distribution.value(0);
    } else if (campaign_.plan == Campaign::Plan::grid) {
      slower /= distribution.count();
      draw.values[parameter.name] = distribution.value(combination / slower % distribution.count());
    } else if (sequence_) {
      const double u = sequence_->point[dimension] + uniform(campaign_.seed, kShiftRun, dimension);
      draw.values[parameter.name] = distribution.at(u - std::floor(u));
      ++dimension;
    } else {
      draw.values[parameter.name] = distribution.at(uniform(campaign_.seed, number, dimension));
      ++dimension;
    }
  }
  return draw;
}

std::string scene_of(const Campaign& campaign, const Draw& draw) {
  return draw.word("scene").value_or(campaign.scenes.front());
}

std::vector<int> by_scene(const Campaign& campaign, const std::vector<int>& runs) {
  if (campaign.find("scene") == nullptr) return runs;
  Drawer drawer(campaign);
  std::map<std::string, std::vector<int>> of_scene;
  for (const int run : runs) of_scene[scene_of(campaign, drawer.draw(run))].push_back(run);
  std::vector<int> sorted;
  sorted.reserve(runs.size());
  for (const auto& [scene, its] : of_scene) sorted.insert(sorted.end(), its.begin(), its.end());
  return sorted;
}

}  // namespace fanbeam::datasets
