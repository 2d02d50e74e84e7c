// Ground truth beside a picture: what stands in each cell, from where it is seen.
//
// A cell of the B-scope is the ground, and what stands on it, inside its own column of azimuth and
// its own range cell; one of the C-scope inside its column and its row of elevation. The azimuth
// beam does not smear it as it smears the picture: the layers tell what a cell stands for.
//
// Layers, by cell, each 0 where nothing is seen:
//   visibility     of the column's width, the share in which something in the cell is seen: 1 lit, 0
//                  in shadow or in the air
//   range_m        mean (C-scope alone)
//   grazing_rad    of the local grazing angle on the facets, by the mean of its sine
//   nrcs           mean sigma0, linear
//   object         that sends more than half of the cell's power; where none does, one that is seen
//                  there. A point target where it sends more than all surfaces of the cell, with number
//                  Geometry::object_names.size() plus its index
//   material       of that object: the one that sends more than half of what it sent since it was found
//                  to lead, where one does; kNoMaterial of a point target
//   elevation_rad  of a strong part of that object, or of that target (B-scope alone)
//   double_bounce  of the picture's power from surfaces and rain, beam and all, the share that came
//                  by two or three reflections
// Means are weighted with the power that surfaces send on the direct way; point targets are not in
// them. Power is that of the picture: in the C-scope, which sums over range, P R^3.
//
// The same whichever caster draws the picture, from a pass of its own:
//   where slices can show the view  one azimuth slice a column, clipped to buildings
//                  (layer_slices.h): walls and what they hide with their true widths, ground as the
//                  slice in the column's middle cuts it
//   else           (columns with models or prisms over open air; tilted antennas, cone scans, fans
//                  wider than 150 deg, no ground) rays in
//                  kLayerAzimuths azimuths a column (layer_lines.h), dithered along range as in
//                  ray_caster.h: one for eight range cells of visible ground and one in two C-scope
//                  rows of what stands above it; then, twice, one more wherever two neighbours a few
//                  cells or rows apart do not tell what lies between them: another surface, slope or
//                  part of a model. What neighbours on one slope step over, up to eleven range cells or
//                  all rows, is put between them, ground with the cover and paint of its own place
// Echoes beyond the range gate are in neither picture, nor here. Accuracy (docs/performance-notes.md has
// figures): of slices, that of the ground's azimuth, and 8 mrad at the ends of the antenna's pattern; of rays, a thing narrower than half a column, or
// lower than a ray's step, may be missed, and a cell at its foot left dark. Neglected: rain cells, and all
// that the casters neglect.
// Deterministic, and the same for any number of threads. Cost: docs/performance-notes.md.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
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

// Of a number in LayerSet::object, seen or not: point targets follow the objects. nullptr beyond the last.
const std::string* object_name(const World& world, terrain::ObjectId object);

// Nothing is seen.
FrameLayers empty_layers(const sensors::Sensor& sensor, bool with_cscope);

class SliceScene;

class GroundTruth {
 public:
  explicit GroundTruth(const World& world);  // which must outlive it
  ~GroundTruth();

  // All layers but the double bounce. `targets`: the echoes that are seen (point_targets.h).
  FrameLayers of(const sensors::AntennaFrame& antenna, const std::vector<core::Echo>& targets,
                 bool with_cscope) const;

 private:
  const World& world_;
  std::unique_ptr<const SliceScene> slices_;  // where they can show the world
};

// What part of `total` is `part`: 0 where there is no power.
std::vector<float> share_of(const std::vector<double>& part, const std::vector<double>& total);

}  // namespace fanbeam::renderer
