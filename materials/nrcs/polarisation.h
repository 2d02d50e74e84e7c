// Linear polarisation of a co-polarised measurement, relative to the plane of the surface.
#pragma once

namespace fanbeam::materials {

enum class Polarisation {
  horizontal,  // HH: electric field perpendicular to the plane of incidence
  vertical,    // VV: electric field in the plane of incidence
};

}  // namespace fanbeam::materials
