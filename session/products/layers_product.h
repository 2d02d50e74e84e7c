// The products "layers" and "cscope_layers": ground truth by cell as EXR, and what its numbers name.
#pragma once

#include <string>

#include "core/image.h"
#include "renderer/stages/frame_layers.h"
#include "scenes/scene.h"

namespace fanbeam::session {

// Layers by name with their units, top row the farthest range, or the highest elevation. NRCS is
// kNoNrcs_dB and the material -1 where nothing is seen, all else 0.
core::Image bscope_layers(const renderer::LayerSet& layers, const sensors::Sensor& sensor);
core::Image cscope_layers(const renderer::LayerSet& layers, const sensors::Sensor& sensor);
inline constexpr double kNoNrcs_dB = -400.0;

inline constexpr const char* kLayersFile = "layers.json";
// Beside the frames: what every layer is, and the names of materials and objects by number; numbers
// of point targets come after those of all other objects.
std::string layers_json(const scenes::Scene& scene);

}  // namespace fanbeam::session
