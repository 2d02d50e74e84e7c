// What all measurements of a scene share: the scene, the frames looked at and their references.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "measure/effort.h"
#include "measure/figures.h"
#include "renderer/casting/sampling.h"
#include "renderer/plan/effects.h"
#include "scenes/scene.h"

namespace fanbeam::measure {

struct CostBench {
  // The scene as planned.
  const scenes::Scene& scene;
  // The same with other wishes, or without the robust flag.
  std::function<std::shared_ptr<const scenes::Scene>(const scenes::BuildOptions&)> rebuild;
  // The same with another sensor.
  std::function<std::shared_ptr<const scenes::Scene>(const sensors::Sensor&)> with_sensor;
  scenes::BuildOptions build;  // that `scene` was built with
  Effort effort;
  Pace pace;
  bool slices = true;           // the scene can be shown by them
  renderer::Sampling sampling;  // of the effects' frames
  std::vector<int> frames;
  // Told of every step and of the seconds that it is expected to take, unless empty.
  std::function<void(const std::string& step, double expected_s)> progress{};

  std::vector<Way> ways() const {
    std::vector<Way> result;
    for (const Way way : kWays)
      if (slices || way != Way::slices) result.push_back(way);
    return result;
  }
  // As errors of sampling are stated: of the expected power, with every effect of the plan.
  renderer::Effects effects() const;
  void begin(const std::string& step, double expected_s) const {
    if (progress) progress(step, expected_s);
  }
};

// Converged pictures, one per frame of the bench.
std::vector<renderer::GreyReference> render_references(const CostBench& bench,
                                                       std::vector<ReferenceFigures>& figures);

}  // namespace fanbeam::measure
