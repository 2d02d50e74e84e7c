// The materials of a scene by name, read from a TOML file; the shipped one is
// materials/library.toml.
//
// One table per material:
//   [short_grass]
//   a = 0.0325
//   b = 0.136
//   c = 1.99
//   reference_frequency_GHz = 35
//   frequency_exponent = 0.6
//   frequency_range_GHz = [30, 100]
//   grazing_range_deg = [1, 60]
//   polarisation = "HH" | "VV" | "any"
//   confidence = "seen" | "fitted" | "recalled" | "assumed"
//   source = "..."
//   note = "..."          optional
//
// Materials keep the order of the file; their index is the material id of terrain and echoes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config_table.h"
#include "core/errors.h"
#include "materials/library/material.h"

namespace fanbeam::materials {

class MaterialLibrary {
 public:
  // Reports every problem with file and line: E-RANGE and E-NONFINITE for coefficients, E-REF for
  // missing and unknown keys, E-PARSE for broken TOML and for a file without any material, E-LIMIT
  // above 65535 materials, E-IO. A material with a problem is left out of the result.
  static MaterialLibrary from_file(const std::filesystem::path& file, core::ProblemList& problems);
  static MaterialLibrary from_text(std::string_view text, const std::string& file_name,
                                   core::ProblemList& problems);

  std::optional<std::size_t> index_of(std::string_view name) const;

  // As index_of; an unknown name is reported as E-REF at `place`, with the nearest names of the
  // library.
  std::optional<std::size_t> find(std::string_view name, const core::Place& place,
                                  const std::string& field, core::ProblemList& problems) const;

  const Material& operator[](std::size_t index) const { return materials_[index]; }
  std::size_t size() const { return materials_.size(); }
  const std::vector<Material>& all() const { return materials_; }

  // The reflectivity of every material, by index. Frequency 1 to 300 GHz, else InputError E-RANGE
  // or E-NONFINITE.
  std::vector<PhongNrcs> at_frequency(double frequency_Hz) const;

  // Records W-EXTRAPOLATED when the frequency lies outside the material's range; the caller knows
  // which are in use.
  void warn_if_extrapolated(std::size_t index, double frequency_Hz,
                            core::ProblemList& problems) const;

 private:
  static MaterialLibrary from_table(core::ConfigTable root, core::ProblemList& problems);

  std::vector<Material> materials_;
};

}  // namespace fanbeam::materials
