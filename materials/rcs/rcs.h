// Radar cross-section of point scatterers: standard shapes seen from one direction.
//
//   constant              sigma = given
//   triangular trihedral  4 pi A^2 / lambda^2, peak 4 pi a^4 / (3 lambda^2). A is the area that
//                         triple reflection uses: with l <= m <= n the direction cosines to the
//                         edges, A / a^2 = 4 l m / (l + m + n) where l + m <= n,
//                         and (l + m + n) - 2 / (l + m + n) elsewhere
//   dihedral              4 pi A^2 / lambda^2 cos^2(e) sinc^2(k h sin e), e along the crease,
//                         A = 2 w h sin(45 deg - |az|); peak 8 pi (w h)^2 / lambda^2
//   rectangular plate     4 pi (w h)^2 / lambda^2 cos^2(t) sinc^2(k w u) sinc^2(k h v),
//                         u and v the direction cosines to its sides
//   cylinder              2 pi r L^2 / lambda cos(e) sinc^2(k L sin e), e off broadside
//
// Physical and geometrical optics, textbook forms (Knott, Shaeffer, Tuley, Radar Cross Section;
// Ruck, Radar Cross Section Handbook 1970; trihedral area: Robertson, Bell Syst. Tech. J. 26,
// 1947). Two published reflector values are reproduced to 0.01 dB in the tests.
//
// Target axes: x is the boresight, y to the left, z up. The trihedral's symmetry axis is x and its
// upper edge lies in the x-z plane; the dihedral's crease is along z and its bisector along x; the
// plate's normal is x with the width along y and the height along z; the cylinder's axis is z.
// Where no mechanism named above works (behind a plate, outside the trihedral's octant, more than
// 45 deg from the dihedral's bisector) the cross-section is 0.
//
// Neglected: edges, single and double bounces of the trihedral, losses, polarisation, and the near
// field: sizes are taken as large against the wavelength, and 2 D^2 / lambda as small against the
// range.
#pragma once

#include <glm/vec3.hpp>
#include <variant>

namespace fanbeam::materials {

struct ConstantRcs {
  double rcs_m2 = 1.0;  // 0 to 1e9
};

struct TriangularTrihedral {
  double edge_m = 0.1;  // inner edge, 1e-6 to 1e3
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

using RcsModel =
    std::variant<ConstantRcs, TriangularTrihedral, Dihedral, RectangularPlate, Cylinder>;

// Throws InputError E-RANGE or E-NONFINITE for sizes outside 1e-6 to 1e3 m, RCS outside 0 to
// 1e9 m2.
void check_rcs_model(const RcsModel& model);

// The model as check_rcs_model accepts it; the direction needs no unit length but must not be zero;
// wavelength 1e-6 to 1e3 m. Throws InputError E-RANGE or E-NONFINITE.
double rcs_m2(const RcsModel& model, const glm::dvec3& direction_to_radar_in_target_axes,
              double wavelength_m);

}  // namespace fanbeam::materials
