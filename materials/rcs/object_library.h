// Radar cross-sections of typical objects by name, read from a TOML file; the shipped one is
// materials/objects.toml.
//
// One table per object:
//   [person]
//   rcs_dBsm = -1.37            mean of the linear cross-section over aspect
//   spread_dB = 3.94            standard deviation in dB over aspect and specimens, 0 when unknown
//   fluctuation = 3             Swerling case, 0 steady to 4; default of targets of that name
//   frequency_range_GHz = [0.5, 100]
//   size_m = [0.5, 0.5, 1.75]   length, width, height
//   confidence = "seen" | "fitted" | "recalled" | "assumed"
//   source = "..."
//   note = "..."                optional; for objects that we built from shapes, the formula
// and, where the cross-section over aspect is known (aspect_lobes.h):
//   floor_dBsm = 7.07
//   [[car.lobe]]
//   azimuth_deg = 90, azimuth_width_deg = 26.9 (0: all around), elevation_deg = 10.3,
//   elevation_width_deg = 44.42, peak_dBsm = 20.75
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/config_table.h"
#include "core/errors.h"
#include "core/swerling.h"
#include "materials/interval.h"
#include "materials/library/material.h"
#include "materials/rcs/rcs.h"

namespace fanbeam::materials {

struct TypicalObject {
  std::string name;
  double mean_rcs_m2 = 0.0;
  double spread_dB = 0.0;
  core::Swerling fluctuation = core::Swerling::steady;
  Interval frequency_range_Hz;
  std::array<double, 3> size_m{};  // length, width, height
  LobedRcs aspect;                 // without lobes: the same from everywhere
  Confidence confidence = Confidence::assumed;
  std::string source, note;
  core::Place place;  // where the library file defines it

  // The lobes where they are known, else the mean from everywhere.
  RcsModel rcs() const;
};

class ObjectLibrary {
 public:
  // Reports every problem with file and line: E-RANGE and E-NONFINITE for values, E-REF for missing
  // and unknown keys, E-PARSE for broken TOML and for a file without any object, E-IO. An object
  // with a problem is left out of the result.
  static ObjectLibrary from_file(const std::filesystem::path& file, core::ProblemList& problems);
  static ObjectLibrary from_text(std::string_view text, const std::string& file_name,
                                 core::ProblemList& problems);

  // Nothing for an unknown name, which is reported as E-REF at `place` with the nearest names.
  const TypicalObject* find(std::string_view name, const core::Place& place,
                            const std::string& field, core::ProblemList& problems) const;

  const std::vector<TypicalObject>& all() const { return objects_; }

 private:
  static ObjectLibrary from_table(core::ConfigTable root, core::ProblemList& problems);

  std::vector<TypicalObject> objects_;
};

// Records W-EXTRAPOLATED when the frequency lies outside what the object's figures are known for.
void warn_if_extrapolated(const TypicalObject& object, double frequency_Hz,
                          core::ProblemList& problems);

}  // namespace fanbeam::materials
