// Ground truth beside a picture: what stands in each cell, from where it is seen.
//
// A cell of the B-scope is the ground, and what stands on it, inside its own column of azimuth and
// its own range cell; one of the C-scope inside its column and its row of elevation. The azimuth
// beam does not smear it as it smears the picture: the layers tell what a cell stands for.
//
// Layers, by cell, each 0 where nothing is seen:
//   visibility     of the azimuths cast in the column, the share that sees something in the cell: 1
//                  lit, 0 in shadow or in the air
//   range_m        mean (C-scope alone)
//   grazing_rad    of the local grazing angle on the facets, by the mean of its sine
//   nrcs           mean sigma0, linear
//   elevation_rad  of the strongest single echo (B-scope alone)
//   material, object  of the strongest single echo; of a point target where it sends more than all
//                  surfaces of the cell, with object number Geometry::object_names.size() plus its
//                  index and material kNoMaterial
//   double_bounce  of the picture's power from surfaces and rain, beam and all, the share that came
//                  by two or three reflections
// Means are weighted with the power that surfaces send on the direct way; point targets are not in
// them.
//
// From rays of its own, whichever caster draws the picture, so that the two give the same truth:
// kLayerAzimuths azimuths a column, dithered along range as in ray_caster.h, one ray for eight range
// cells of visible ground in each and one in two C-scope rows of what stands above it; then, twice,
// one more wherever two neighbours a few cells or rows apart do not tell what lies between them:
// another surface, slope or part of a model. What neighbours on one slope step over, up to eleven
// range cells or all rows, is put between them, ground with the cover and paint of its own place.
// Echoes beyond the range gate are in neither picture, nor here. Accuracy: a thing narrower than half
// a column, or lower than a ray's step, may be missed; a cell at its foot may be left dark
// (docs/performance-notes.md tells how many are). Neglected: rain cells, and all that ray_caster.h
// neglects.
// Deterministic, and the same for any number of threads. Cost: docs/performance-notes.md.
#pragma once

#include <cstdint>
#include <vector>

#include "core/echo.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"
#include "terrain/height_field.h"

namespace fanbeam::renderer {

inline constexpr int kLayerAzimuths = 2;
inline constexpr terrain::MaterialId kNoMaterial = 0xFFFF;

// Row-major [row][column], as the powers of the picture; empty where the scope has no such layer.
struct LayerSet {
  std::vector<float> visibility, range_m, grazing_rad, nrcs, elevation_rad, double_bounce;
  std::vector<terrain::MaterialId> material;  // kNoMaterial where nothing is seen
  std::vector<terrain::ObjectId> object;
};

struct FrameLayers {
  LayerSet bscope;
  LayerSet cscope;  // empty unless asked for
};

// Nothing is seen.
FrameLayers empty_layers(const sensors::Sensor& sensor, bool with_cscope);

// All but the double bounce. `targets`: the echoes that are seen (point_targets.h).
FrameLayers frame_layers(const World& world, const sensors::AntennaFrame& antenna,
                         const std::vector<core::Echo>& targets, bool with_cscope);

// What part of `total` is not in `direct`: 0 where there is no power.
std::vector<float> added_share(const std::vector<double>& direct, const std::vector<double>& total);

}  // namespace fanbeam::renderer
