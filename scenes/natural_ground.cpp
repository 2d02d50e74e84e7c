#include "scenes/natural_ground.h"

#include "scenes/placed_problems.h"

namespace fanbeam::scenes {

NaturalGround::NaturalGround(const TerrainDescription& terrain, double level_m,
                             const MaterialNames& names, core::ProblemList& problems)
    : level_m_(level_m), material_(names.id(terrain.material, terrain.place, "terrain.material")) {
  if (terrain.source == TerrainDescription::Source::rolling) generate(terrain, names);
  if (terrain.source == TerrainDescription::Source::raster) load_elevation(terrain, problems);
  if (!terrain.land_cover.empty()) load_land_cover(terrain, names, problems);
}

void NaturalGround::generate(const TerrainDescription& terrain, const MaterialNames& names) {
  terrain::LandscapeMaterials materials;
  for (const std::string& field : terrain.fields)
    materials.fields.push_back(names.id(field, terrain.place, "terrain.fields"));
  materials.wood = names.id(terrain.wood_material, terrain.place, "terrain.wood_material");
  materials.airfield =
      names.id(terrain.airfield_material, terrain.place, "terrain.airfield_material");
  landscape_.emplace(terrain::LandscapeSettings{terrain.relief_m, terrain.field_size_m,
                                                terrain.wood_share, terrain.canopy_m, terrain.seed},
                     materials);
}

void NaturalGround::load_elevation(const TerrainDescription& terrain, core::ProblemList& problems) {
  terrain::ElevationOptions options;
  options.interpolation = terrain::Interpolation::cubic_spline;
  options.quantisation_step_m = terrain.quantisation_step_m;
  try {
    elevation_.emplace(terrain.elevation, options);
  } catch (const core::InputError& error) {
    append_placed(problems, error, terrain.elevation_place, "terrain.elevation");
    usable_ = false;
  }
}

void NaturalGround::load_land_cover(const TerrainDescription& terrain, const MaterialNames& names,
                                    core::ProblemList& problems) {
  try {
    cover_.emplace(terrain.land_cover);
  } catch (const core::InputError& error) {
    append_placed(problems, error, terrain.land_cover_place, "terrain.land_cover.file");
    usable_ = false;
    return;
  }
  const std::string classes = "terrain.land_cover.classes";
  material_of_class_.assign(terrain::kLargestLandCoverClass + 1, material_);
  for (const auto& [number, name] : terrain.classes)
    material_of_class_[static_cast<std::size_t>(number)] =
        names.id(name, terrain.place, classes + "." + std::to_string(number));
  for (const int number : cover_->classes())
    if (!terrain.classes.contains(number))
      problems.error(core::ErrorClass::ref, terrain.place, classes,
                     "class " + std::to_string(number) + " of the raster has no material",
                     std::to_string(number) + " = \"...\"");
}

std::optional<double> NaturalGround::height_m(const core::Geodetic& position,
                                              glm::dvec2 position_m) const {
  if (elevation_) return elevation_->height_m(position.latitude_rad, position.longitude_rad);
  return landscape_ ? level_m_ + landscape_->ground_m(position_m) : level_m_;
}

bool NaturalGround::is_covered(const core::Geodetic& position) const {
  return cover_ && cover_->class_at(position.latitude_rad, position.longitude_rad) >= 0;
}

double NaturalGround::canopy_m(glm::dvec2 position_m, Zone zone) const {
  return landscape_ && zone == Zone::open ? landscape_->canopy_m(position_m) : 0.0;
}

terrain::MaterialId NaturalGround::material(const core::Geodetic& position, glm::dvec2 position_m,
                                            Zone zone) const {
  if (cover_) {
    const int number = cover_->class_at(position.latitude_rad, position.longitude_rad);
    return number < 0 ? material_ : material_of_class_[static_cast<std::size_t>(number)];
  }
  if (!landscape_) return material_;
  if (zone == Zone::airfield) return landscape_->airfield();
  return zone == Zone::approach ? landscape_->field(position_m) : landscape_->material(position_m);
}

}  // namespace fanbeam::scenes
