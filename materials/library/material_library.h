// The materials of a scene by name, read from a TOML file; the shipped one is
// materials/library.toml.
//
// One table per material:
//   [short_grass]
//   a = 0.0325                          the Phong-like form, the default; or another `model` with
//   b = 0.136                           its keys instead, see model_reader.h
//   c = 1.99
//   reference_frequency_GHz = 35
//   frequency_exponent = 0.6
//   frequency_range_GHz = [30, 100]     outside: see surface_model.h
//   grazing_range_deg = [1, 60]
//   polarisation = "HH" | "VV" | "any"
//   reference = { model = "git-land", terrain = "grass" }     optional; what a, b, c were fitted to
//   confidence = "seen" | "fitted" | "recalled" | "assumed"
//   source = "..."
//   note = "..."                        optional
//   dielectric = "concrete"             optional; a name of dielectric_medium.h
//   rms_height_mm = 0.2                 optional, 0 to 1000; a model with this key shares it
//   when_wet = "concrete_wet"           optional; what the row turns into, default "same"
//   when_dry_snow = "snow_dry"
//   when_wet_snow = "snow_wet"
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
  // missing and unknown keys and for names of media, terrains and materials that do not exist,
  // E-PARSE for broken TOML, an empty table and a file without any material, E-LIMIT above 65535
  // materials, E-IO. A material with a problem is left out of the result.
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

  // The index of what the material turns into; itself when dry or when its row says so.
  std::size_t in_state(std::size_t index, SurfaceState state) const;

  // The reflectivity of every material in a state, by index of the dry material. Frequency 0.1 to
  // 300 GHz, else InputError E-RANGE or E-NONFINITE. Outside what a model knows surface_model.h
  // says what is taken; report_extrapolations tells of it.
  std::vector<NrcsCurve> curves(SurfaceState state, Polarisation polarisation,
                                double frequency_Hz) const;

  // E-RANGE for a frequency or polarisation that the material is not known at, with what it is
  // known for and with `allowed_by`, what the caller's user would say; W-EXTRAPOLATED instead when
  // `allowed`.
  void report_extrapolations(
      std::size_t index, Polarisation polarisation, double frequency_Hz, bool allowed,
      core::ProblemList& problems,
      const char* allowed_by = "allow_extrapolation = true under [materials] of the scene") const;

 private:
  static MaterialLibrary from_table(core::ConfigTable root, core::ProblemList& problems);

  std::vector<Material> materials_;
};

}  // namespace fanbeam::materials
