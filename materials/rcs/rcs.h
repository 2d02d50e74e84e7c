// Radar cross-section of point scatterers: standard shapes seen from one direction.
//
//   constant              sigma = given
//   sphere                exact series, pi a^2 above ka = 50 (sphere.h)
//   triangular trihedral  4 pi A^2 / lambda^2, peak 4 pi a^4 / (3 lambda^2), A the area that triple
//                         reflection uses (trihedral.h)
//   square trihedral      the same with its own A, peak 12 pi a^4 / lambda^2
//   dihedral              4 pi A^2 / lambda^2 cos^2(e) sinc^2(k h sin e), e along the crease,
//                         A = 2 w h sin(45 deg - |az|); peak 8 pi (w h)^2 / lambda^2
//   rectangular plate     4 pi (w h)^2 / lambda^2 cos^2(t) sinc^2(k w u) sinc^2(k h v),
//                         u and v the direction cosines to its sides
//   cylinder              2 pi r L^2 / lambda cos(e) sinc^2(k L sin e), e off broadside
//   round wire            any thickness and polarisation (round_wire.h); a wire that is straight
//                         only over a coherence length c is L / c such wires without common phase
//   lobed                 measured lobes of vehicles (aspect_lobes.h)
//
// Physical and geometrical optics, textbook forms (Knott, Shaeffer, Tuley, Radar Cross Section;
// Ruck, Radar Cross Section Handbook 1970). Two published reflector values are reproduced to
// 0.01 dB in the tests. docs/physics/rcs-shapes.md draws the lobes.
//
// Target axes: x is the boresight, y to the left, z up. A trihedral's symmetry axis is x and its
// upper edge lies in the x-z plane; the dihedral's crease is along z and its bisector along x; the
// plate's normal is x with the width along y and the height along z; the axis of cylinder and wire
// is z; a vehicle's front is x. Where no mechanism named above works (behind a plate, outside a
// trihedral's octant, more than 45 deg from the dihedral's bisector) the cross-section is 0.
//
// Neglected: edges, single and double bounces of a trihedral, losses, polarisation but of the wire,
// and the near field: sizes are taken as large against the wavelength (ka > 5 for the cylinder, 0.5
// dB; the wire and the sphere hold for all sizes), and 2 D^2 / lambda as small against the range.
// Nearer than that the shape does not add up in phase: what is used is an upper bound of its peak.
#pragma once

#include <glm/vec3.hpp>
#include <variant>

#include "materials/rcs/aspect_lobes.h"

namespace fanbeam::materials {

struct ConstantRcs {
  double rcs_m2 = 1.0;  // 0 to 1e9
};

struct Sphere {
  double radius_m = 0.1;
};

struct TriangularTrihedral {
  double edge_m = 0.1;  // inner edge, 1e-6 to 1e3
};

struct SquareTrihedral {
  double edge_m = 0.1;
};

struct Dihedral {
  double width_m = 0.1;   // of each of the two plates, across the crease
  double height_m = 0.1;  // along the crease
};

struct RectangularPlate {
  double width_m = 0.1;
  double height_m = 0.1;
};

struct Cylinder {
  double radius_m = 0.1;
  double length_m = 1.0;
};

struct RoundWire {
  double radius_m = 0.01;
  double length_m = 1.0;
  double polarisation_rad = 0.0;    // between electric field and wire, 0 parallel
  double coherence_length_m = 0.0;  // over which it is straight; 0 for the length
};

using RcsModel = std::variant<ConstantRcs, Sphere, TriangularTrihedral, SquareTrihedral, Dihedral,
                              RectangularPlate, Cylinder, RoundWire, LobedRcs>;

// Throws InputError E-RANGE or E-NONFINITE for sizes outside 1e-6 to 1e3 m, RCS outside 0 to
// 1e9 m2, angles outside +-2 pi.
void check_rcs_model(const RcsModel& model);

// The model as check_rcs_model accepts it; the direction needs no unit length but must not be zero;
// wavelength 1e-6 to 1e3 m. Throws InputError E-RANGE or E-NONFINITE.
double rcs_m2(const RcsModel& model, const glm::dvec3& direction_to_radar_in_target_axes,
              double wavelength_m);

// Upper bound over all directions. Exact peaks, but for the round wire (round_wire.h). Wavelength as above.
double largest_rcs_m2(const RcsModel& model, double wavelength_m);

// 2 D^2 / lambda, D the largest dimension that must add up in phase: the mouth's diagonal, the
// length of a cylinder, the coherence length of a wire. 0 for models without such a dimension
// (constant, lobed) and for the sphere, whose echo comes from one small spot.
double far_field_distance_m(const RcsModel& model, double wavelength_m);

}  // namespace fanbeam::materials
