// The point scatterers of a [[line]]: evenly spaced, so many that none is farther from its
// neighbour than asked, each in the middle of its share of the line.
//
// A ray would hit a 20 mm wire by luck and the wire would flicker; points cannot be missed. Each
// adds its power to the one range cell it lies in, without common phase with the others.
//
//   even    sigma = rcs_per_m L / count
//   wire    a round wire (materials/rcs/round_wire.h) of length L / count, straight over a
//           coherence length c: its lobe is lambda / 2c wide. The sum over the points of a long
//           wire does not depend on c: it is the flash of the whole wire at its distance R,
//               sigma = s(ka) R,   pi a R for a thick one
//           s the cross-section per length of the endless cylinder; exactly, and steady while the
//           radar moves, for R >= 2 c spacing / lambda (the lobe is sampled densely enough)
//   object  one typical object at each point
// Neglected: phases between the points (what a perfectly straight wire adds up to, glints), sag,
// strands, the shadow that the points throw. docs/physics/thin-objects.md.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/polarisation.h"
#include "renderer/world.h"
#include "scenes/description.h"

namespace fanbeam::scenes {

// At least one. The ends may coincide.
int line_point_count(const LineDescription& line, double length_m);

// The angle between the electric field and a wire that rises with this slope, seen from the side at
// level flight: 0 along the wire, pi / 2 across it.
double across_wire_rad(double sin_slope, core::Polarisation polarisation);

// The radar's polarisation matters to wires alone.
void add_line_points(const LineDescription& line, const glm::dvec3& begin_m,
                     const glm::dvec3& end_m, core::Polarisation polarisation,
                     std::vector<renderer::PointTarget>& targets);

}  // namespace fanbeam::scenes
