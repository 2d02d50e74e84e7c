// What the parts of `fanbeam cost` share: the scene, the frames looked at and their references.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/cost/cost_progress.h"
#include "apps/cost/effort.h"
#include "apps/cost/figures.h"
#include "renderer/casting/sampling.h"
#include "scenes/scene.h"

namespace fanbeam::apps {

struct CostBench {
  // The scene as planned.
  const scenes::Scene& scene;
  // The same with other wishes, or without the robust flag.
  std::function<std::unique_ptr<scenes::Scene>(const scenes::BuildOptions&)> rebuild;
  // The same with another sensor.
  std::function<std::unique_ptr<scenes::Scene>(const sensors::Sensor&)> with_sensor;
  scenes::BuildOptions build;  // that `scene` was built with
  CostEffort effort;
  Pace pace;
  bool slices = true;           // the scene can be shown by them
  renderer::Sampling sampling;  // of the effects' frames
  std::vector<int> frames;
  CostProgress* progress = nullptr;  // told of every step, unless null

  std::vector<Way> ways() const {
    std::vector<Way> result;
    for (const Way way : kWays)
      if (slices || way != Way::slices) result.push_back(way);
    return result;
  }
  // As errors of sampling are stated: of the expected power, with every effect of the plan.
  renderer::Effects effects() const;
  void begin(const std::string& step, double expected_s) const {
    if (progress != nullptr) progress->begin(step, expected_s);
  }
};

// Converged pictures, one per frame of the bench.
std::vector<renderer::GreyReference> render_references(const CostBench& bench,
                                                       std::vector<ReferenceFigures>& figures);

}  // namespace fanbeam::apps
