// What layers of ground truth cost beside a picture.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/report_effort.h"

namespace fanbeam::benchmarks {

// A frame at the default sampling of the scene's caster, as planned.
struct LayerCost {
  std::string scene;
  double plain_ms = 0.0, layers_ms = 0.0;  // without layers, and with those of both scopes
  double beside_ms = 0.0;                  // without, in a session that gives them to others

  double ratio() const { return layers_ms / plain_ms; }
  double unasked_ratio() const { return beside_ms / plain_ms; }
};

// Of every shipped scene whose data are there, in turns, medians; plain frames in a session that never
// gave layers.
std::vector<LayerCost> measure_layers(const Effort& effort);

}  // namespace fanbeam::benchmarks
