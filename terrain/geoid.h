// Height of the mean sea level surface above the WGS 84 ellipsoid: the EGM96 geoid.
//
// Model: the 15-minute grid of EGM96 (Lemoine et al., NASA/TP-1998-206861, 1998) in the file
// egm96_15.gtx of Debian's package proj-data, bilinear between its points, read by PROJ.
// Accuracy: the grid reproduces the full EGM96 series to about 0.1 m, 1 m at worst in high
// mountains; EGM96 itself is good to 0.5-1 m. Neglected: later geoids (EGM2008), tides.
#pragma once

#include "core/geodetic.h"

namespace fanbeam::terrain {

// Geoid height N in metres: height above the ellipsoid = height above mean sea level + N.
// Latitude in [-pi/2, pi/2], any finite longitude. May be called from many threads at once: each
// thread opens the grid for itself on its first call.
// Throws InputError: E-IO when the grid is not installed, E-NONFINITE, E-RANGE.
double egm96_geoid_height_m(double latitude_rad, double longitude_rad);

// Above the ellipsoid, of a place whose height counts from `datum`; in the unknown datum of a scene
// heights stay what they are.
double ellipsoidal_height_m(const core::Geodetic& at, core::VerticalDatum datum);

}  // namespace fanbeam::terrain
