// Materials for a model from ASAM OpenMATERIAL 3D 1.0 and 1.1 files, as a radar sees them.
//
// A name of the model leads through `.xoma` and `.xomm` to a `.xomp` file (mapping_file.h). Its
// reflectivity is the first of
//
//   1. customProperties.fanbeam.nrcs                        custom_nrcs.h
//   2. a BRDF in the backscatter direction                  brdf_table.h
//   3. Oh 1992 from surfaceHeightRms and the permittivity   permittivity_table.h, oh1992.h
//
// that knows the radar's frequency and polarisation. When none does, the material is refused with
// all three reasons: no reflectivity is made up. Whichever it is, a material with surfaceHeightRms
// and a permittivity also mirrors (specular_surface.h). Files are read when the first name asks for them,
// each once, and only from inside one folder. Source of the layout: ASAM OpenMATERIAL 3D 1.0.0 and
// 1.1.0, schemas asset, mapping, material, material_emp, material_brdf and material_reflCoeff.
// Neglected: humidity, layers and thickness (geometryProperties), assignment textures. Accuracy:
// that of the material's data; the conversion of a BRDF is exact at its rows, Oh's model below 20
// deg grazing is extrapolation.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "materials/dielectric/specular_surface.h"
#include "materials/nrcs/surface_model.h"
#include "materials/open_material/mapping_file.h"
#include "materials/open_material/permittivity_table.h"
#include "materials/open_material/radar_query.h"

namespace fanbeam::materials {

struct OpenSurface {
  SurfaceModel reflectivity;
  std::optional<SpecularSurface> mirror;
  // What the mirror and Oh's model were made of; without it neither depends on the temperature.
  std::shared_ptr<const PermittivityTable> permittivity;
  std::optional<double> rms_height_m;

  // The same material at another temperature, the radar being the same. Nothing where Oh's model had
  // served and the table has no answer.
  Lookup<OpenSurface> at(const RadarQuery& query) const;
};

class OpenMaterials {
 public:
  // Reads asset and mapping; problems as read_open_mapping.
  OpenMaterials(const std::filesystem::path& file, std::filesystem::path allowed_folder,
                const RadarQuery& query, core::ProblemList& problems);

  bool knows(const std::string& name) const { return mapping_.material_of_name.contains(name); }

  // What a known name looks like. Reports the problems of the material and its tables, E-PATH
  // for files outside the folder, E-UNSUPPORTED when nothing in it serves this radar;
  // E-RANGE for Oh's model beyond its data, W-EXTRAPOLATED where that is allowed. Nothing after an
  // error.
  std::optional<OpenSurface> surface_of(const std::string& name, core::ProblemList& problems);

  // All files read so far, each once, in the order of reading.
  const std::vector<std::filesystem::path>& files() const { return mapping_.files; }

 private:
  void list_file(const std::filesystem::path& file);
  std::optional<OpenSurface> read_surface(const std::filesystem::path& file,
                                          core::ProblemList& problems);
  Lookup<SurfaceModel> from_brdfs(const std::filesystem::path& file,
                                  const OpenMaterialFile& material, core::ProblemList& problems);
  // Null without one.
  std::shared_ptr<const PermittivityTable> permittivity_of(const std::filesystem::path& file,
                                                           const OpenMaterialFile& material,
                                                           core::ProblemList& problems);
  // The table that `uri` of `from` names; nothing after reporting.
  std::optional<std::filesystem::path> table_file(const std::filesystem::path& from,
                                                  const NamedUri& uri, core::ProblemList& problems);

  std::filesystem::path allowed_folder_;
  RadarQuery query_;
  OpenMapping mapping_;
  std::map<std::filesystem::path, std::optional<OpenSurface>> surfaces_;  // by material file
};

}  // namespace fanbeam::materials
