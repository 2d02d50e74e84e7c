#include "materials/open_material/open_materials.h"

#include <algorithm>

#include "core/relative_uri.h"
#include "materials/open_material/brdf_table.h"
#include "materials/open_material/reflection_table.h"

namespace fanbeam::materials {
namespace {

namespace fs = std::filesystem;
using core::ErrorClass;

std::string radar_text(const RadarQuery& query) {
  return core::number_text(query.frequency_Hz / 1e9) + " GHz, " + core::name_of(query.polarisation);
}

Lookup<SurfaceModel> from_custom_properties(const OpenMaterialFile& material,
                                            const RadarQuery& query) {
  if (material.nrcs.empty()) return {{}, "missing"};
  const CustomNrcs* best = best_of(material.nrcs, query);
  if (best == nullptr) return {{}, "no entry for this frequency and polarisation"};
  return {best->surface, {}};
}

void report_extrapolations(const SurfaceModel& surface, const RadarQuery& query,
                           const fs::path& file, core::ProblemList& problems) {
  for (const Extrapolation& beyond :
       extrapolations_of(surface, query.polarisation, query.frequency_Hz)) {
    const std::string field = std::string(name_of(surface)) + " at " + beyond.quantity;
    if (query.allow_extrapolation)
      problems.warning("EXTRAPOLATED", {file.string()}, field, beyond.asked,
                       "known for " + beyond.known);
    else
      problems.error(ErrorClass::range, {file.string()}, field, beyond.asked,
                     beyond.known + ", or allow_extrapolation = true in [materials]");
  }
}

Lookup<SpecularSurface> rough_boundary(const PermittivityTable* table,
                                       const std::optional<double>& rms_height_m,
                                       const RadarQuery& query) {
  if (table == nullptr) return {{}, "no permittivity"};
  const Lookup<Permittivity> permittivity = table->at(query);
  if (!permittivity.value) return {{}, permittivity.why_not};
  if (!rms_height_m) return {{}, "no surface height"};
  return {SpecularSurface{*permittivity.value, *rms_height_m}, {}};
}

OhSurface oh_surface(const SpecularSurface& rough, double temperature_K) {
  return {rough.permittivity, rough.rms_height_m, temperature_K};
}

// The three ways to a reflectivity, with what each of them lacks.
struct Ways {
  Lookup<SurfaceModel> custom, brdf;
  Lookup<SpecularSurface> rough;

  std::optional<SurfaceModel> first(double temperature_K) const {
    if (custom.value) return custom.value;
    if (brdf.value) return brdf.value;
    if (!rough.value) return std::nullopt;
    return oh_surface(*rough.value, temperature_K);
  }
  std::string why_not() const {
    return "customProperties.fanbeam.nrcs (" + custom.why_not + "), brdfUris (" + brdf.why_not +
           ") or surfaceRoughness with electromagneticPropertiesUri (" + rough.why_not + ")";
  }
};

}  // namespace

Lookup<OpenSurface> OpenSurface::at(const RadarQuery& query) const {
  const Lookup<SpecularSurface> rough = rough_boundary(permittivity.get(), rms_height_m, query);
  OpenSurface result = *this;
  result.mirror = rough.value;
  if (!std::holds_alternative<OhSurface>(reflectivity)) return {result, {}};
  if (!rough.value) return {{}, rough.why_not};
  result.reflectivity = oh_surface(*rough.value, query.temperature_K);
  return {result, {}};
}

OpenMaterials::OpenMaterials(const fs::path& file, fs::path allowed_folder, const RadarQuery& query,
                             core::ProblemList& problems)
    : allowed_folder_(std::move(allowed_folder)),
      query_(query),
      mapping_(read_open_mapping(file, allowed_folder_, problems)) {}

void OpenMaterials::list_file(const fs::path& file) {
  if (std::find(files().begin(), files().end(), file) == files().end())
    mapping_.files.push_back(file);
}

std::optional<fs::path> OpenMaterials::table_file(const fs::path& from, const NamedUri& uri,
                                                  core::ProblemList& problems) {
  try {
    fs::path file = core::file_of_uri(allowed_folder_, from, uri.uri, {from.string()}, uri.pointer);
    list_file(file);
    return file;
  } catch (const core::InputError& error) {
    problems.append(error.problems());
    return std::nullopt;
  }
}

std::optional<OpenSurface> OpenMaterials::surface_of(const std::string& name,
                                                     core::ProblemList& problems) {
  const NamedUri& uri = mapping_.material_of_name.at(name);
  try {
    const fs::path file = core::file_of_uri(allowed_folder_, mapping_.file, uri.uri,
                                            {mapping_.file.string()}, uri.pointer);
    const auto known = surfaces_.find(file);
    if (known != surfaces_.end()) return known->second;  // its problems have been told
    list_file(file);
    return surfaces_[file] = read_surface(file, problems);
  } catch (const core::InputError& error) {
    problems.append(error.problems());
    return std::nullopt;
  }
}

Lookup<SurfaceModel> OpenMaterials::from_brdfs(const fs::path& file,
                                               const OpenMaterialFile& material,
                                               core::ProblemList& problems) {
  Lookup<SurfaceModel> found{{}, "missing"};
  for (const NamedUri& uri : material.brdfs) {
    const auto table = table_file(file, uri, problems);
    if (!table) continue;
    // Also after a find: every table is checked.
    const auto answer = BrdfTable::from_file(*table, problems).backscatter_at(query_);
    if (answer.value && !found.value) found.value = *answer.value;
    found.why_not = answer.why_not;
  }
  return found;
}

std::shared_ptr<const PermittivityTable> OpenMaterials::permittivity_of(
    const fs::path& file, const OpenMaterialFile& material, core::ProblemList& problems) {
  if (!material.permittivity) return nullptr;
  const auto table = table_file(file, *material.permittivity, problems);
  if (!table) return nullptr;
  return std::make_shared<const PermittivityTable>(PermittivityTable::from_file(*table, problems));
}

std::optional<OpenSurface> OpenMaterials::read_surface(const fs::path& file,
                                                       core::ProblemList& outer_problems) {
  core::ProblemList problems;
  std::optional<OpenSurface> surface;
  if (const auto material = read_open_material_file(file, problems)) {
    const Lookup<SurfaceModel> brdf = from_brdfs(file, *material, problems);
    auto permittivity = permittivity_of(file, *material, problems);
    const Ways ways{from_custom_properties(*material, query_), brdf,
                    rough_boundary(permittivity.get(), material->rms_height_m, query_)};
    for (const NamedUri& uri : material->reflection_coefficients)
      if (const auto table = table_file(file, uri, problems))
        check_reflection_table(*table, problems);
    if (auto reflectivity = ways.first(query_.temperature_K))
      surface = OpenSurface{std::move(*reflectivity), ways.rough.value, std::move(permittivity),
                            material->rms_height_m};
    if (!surface && !problems.has_errors())
      problems.error(ErrorClass::unsupported, {file.string()}, "/materialProperties",
                     "no reflectivity at " + radar_text(query_), ways.why_not());
  }
  if (surface) report_extrapolations(surface->reflectivity, query_, file, problems);
  if (problems.has_errors()) surface.reset();
  outer_problems.append(problems.all());
  return surface;
}

}  // namespace fanbeam::materials
