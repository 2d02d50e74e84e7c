// The runway as the radar sees it: pavement, shoulders and markings painted on the ground, a
// flattened strip around it, lights and fence posts as places for small reflectors.
//
// Marking sizes follow ICAO Annex 14 Vol. I (8th edition, 5.2): threshold stripes 30 m long, 1.8 m
// wide and 1.8 m apart, 6 m behind the threshold; centre-line stripes 30 m with 20 m gaps; aiming
// point 300 m (below 2400 m length) or 400 m behind the threshold; touchdown-zone pairs every 150
// m, one to six by the landing length, none within 50 m of the aiming point; side stripes 0.9 m. Approach
// lights follow the precision category I pattern (5.3.4): 900 m of centre line every 30 m, one cross bar at
// 300 m. Markings that would reach beyond the pavement of a narrow runway are left out: aiming points below
// 29 m of width, touchdown zones below 24 m, threshold stripes farther out than half the width. Neglected:
// runway numbers, displaced-threshold arrows, paint wear, aiming points nearer than 300 m of short runways.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "terrain/surface_map.h"

namespace fanbeam::terrain {

struct RunwayMaterials {
  MaterialId surface = 0;
  MaterialId shoulder = 0;
  MaterialId marking = 0;
};

// One end in local east-north metres; the threshold may be displaced inwards from the end of the
// pavement.
struct RunwayEnd {
  glm::dvec2 pavement_end_m{0.0};
  double displaced_m = 0.0;
  double elevation_m = 0.0;  // of the pavement end, above the vertical datum used for terrain
};

struct Runway {
  RunwayEnd ends[2];
  double width_m = 45.0;
  double shoulder_m = 7.5;  // on each side; 0 for none
  bool markings = true;
  RunwayMaterials materials;
  double strip_half_width_m = 75.0;  // level ground on each side of the centre line
  double blend_m = 100.0;            // from the strip to the natural ground

  double length_m() const;
  // Unit vector from end 0 to end 1.
  glm::dvec2 along() const;
  // Threshold of end 0 or 1.
  glm::dvec2 threshold_m(int end) const;
};

// Bottom to top: shoulders, pavement, markings; the first two belong to one object.
std::vector<SurfacePatch> runway_patches(const Runway& runway, ObjectId pavement = kTerrainObject,
                                         ObjectId markings = kTerrainObject);

// What one runway makes of the ground at a place.
struct StripHeight {
  double height_m = 0.0;       // of the straight line between the ends' elevations
  double natural_share = 0.0;  // 0 in the strip, smoothly to 1 where the blend ends
  double inside_m = 0.0;       // from the nearest border of the strip; negative beside it
};
// Nothing beyond the blend.
std::optional<StripHeight> strip_height(const Runway& runway, glm::dvec2 position_m);

// Ground height near runways: inside a strip the straight line between the published end elevations,
// outside the natural height, a smooth blend between. Where strips overlap, the mean of their lines
// weighted by the distances to the strips' borders. Pavement and shoulders keep their own line in the strip
// of a runway whose pavement does not cross theirs: between the two each weighs less by its share of the
// distances to both pavements. Where only blends overlap, the mean is by the odds of strip against
// natural ground. Neither depends on the order of the runways but by rounding. Where borders of two strips
// cross, the one point has both heights, and slopes around it are steep where the lines differ.
double flattened_height_m(const std::vector<Runway>& runways, glm::dvec2 position_m,
                          double natural_height_m);

// How much the lines of two runways differ at most where their strips overlap; 0 where they do not. Of
// samples of both strips: 300 steps along, 8 across.
double largest_step_m(const Runway& runway, const Runway& other);

// A place for a small reflector.
struct ReflectorSite {
  glm::dvec2 position_m{0.0};
  double above_ground_m = 0.0;
};

// Edge lights every 60 m, 2 m outside the pavement, 0.35 m high; threshold lights every 3 m.
std::vector<ReflectorSite> edge_light_sites(const Runway& runway);
// For a landing on the threshold of `end`: barrettes of 5 lights, 1 m apart, rising from 0.5 m at
// the threshold with `slope` (rise per metre).
std::vector<ReflectorSite> approach_light_sites(const Runway& runway, int end, double slope);
// Posts along a closed or open line, `spacing_m` apart, at half of `height_m`.
std::vector<ReflectorSite> post_sites(const std::vector<glm::dvec2>& line_m, bool closed,
                                      double spacing_m, double height_m);
// A rectangle around the strip, `beyond_m` outside it on all sides.
std::vector<glm::dvec2> perimeter(const Runway& runway, double beyond_m);

}  // namespace fanbeam::terrain
