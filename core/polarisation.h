// Linear polarisation of a co-polarised radar, relative to the plane of the surface.
#pragma once

namespace fanbeam::core {

enum class Polarisation {
  horizontal,  // HH: electric field perpendicular to the plane of incidence
  vertical,    // VV: electric field in the plane of incidence
};

inline const char* name_of(Polarisation polarisation) {
  return polarisation == Polarisation::horizontal ? "HH" : "VV";
}

}  // namespace fanbeam::core
