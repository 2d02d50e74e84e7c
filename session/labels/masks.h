// From layers to the cells of each labelled thing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/stages/frame_layers.h"
#include "session/labels/frame_labels.h"

namespace fanbeam::session {

inline constexpr std::uint32_t kUnlabelled = 0xFFFFFFFFU;

// Masks by label. `label_of` gives the label of an object's number, or kUnlabelled. `turned`: the
// layers begin with the nearest range, the masks with the farthest, as pictures.
std::vector<MaskLabel> masks_of(const renderer::LayerSet& layers, int columns,
                                std::span<const std::uint32_t> label_of, std::size_t labels,
                                bool turned);

// Strongest cell over what surrounds it (frame_labels.h), of a mask that has cells. `power_W` begins
// with the nearest range; `reach` columns beside the mask get echoes of it. Nothing where no cell is
// around it.
std::optional<double> signal_to_clutter_dB(const MaskLabel& mask, std::span<const double> power_W,
                                           int columns, int reach, double noise_W);

}  // namespace fanbeam::session
