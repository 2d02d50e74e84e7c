// A surface material: its reflectivity at a reference frequency, how that changes with frequency,
// and where the figures come from.
//
//   a(f) = a (f / f_ref)^n,  b(f) = b (f / f_ref)^n,  c unchanged
//
// which is exact for a reference model that separates into angle and frequency (Kulemin, constant
// gamma) and a linearisation in decibels for the others; docs/materials.md gives the deviation. The
// exponents between 35 and 94 GHz are the least certain figures of the library.
#pragma once

#include <string>

#include "core/errors.h"
#include "materials/nrcs/phong_nrcs.h"

namespace fanbeam::materials {

// The weakest link between a measurement and the coefficients.
enum class Confidence {
  seen,      // coefficients follow directly from a source that was read
  fitted,    // our fit to a published model that was read, without inputs of our own
  recalled,  // our fit to a model whose coefficients were not checked against the source
  assumed,   // rests on an input that we assumed, such as a surface height
};

const char* name_of(Confidence confidence);

struct Interval {
  double low = 0.0;
  double high = 0.0;

  bool contains(double value) const { return value >= low && value <= high; }
};

struct Material {
  std::string name;
  PhongNrcs nrcs;  // at the reference frequency
  double reference_frequency_Hz = 35e9;
  double frequency_exponent = 0.0;
  Interval frequency_range_Hz;
  Interval grazing_range_rad;
  std::string polarisation;  // "HH", "VV", or "any" where the reference does not tell them apart
  Confidence confidence = Confidence::assumed;
  std::string source;
  std::string note;
  core::Place place;  // where the library file defines it

  // Frequency 1 to 300 GHz, else InputError E-RANGE or E-NONFINITE.
  PhongNrcs nrcs_at(double frequency_Hz) const;
};

}  // namespace fanbeam::materials
