// The ground before anything is built on it: rasters, generated country, or a plain.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "scenes/description.h"
#include "scenes/ground.h"
#include "terrain/landscape.h"
#include "terrain/raster/elevation_raster.h"
#include "terrain/raster/land_cover_raster.h"

namespace fanbeam::scenes {

class NaturalGround {
 public:
  // Loads what the description names; problems are told with the key that named the file. `level_m`
  // is the height of a plain and the mean of generated country, in the scene's datum.
  NaturalGround(const TerrainDescription& terrain, double level_m, const MaterialNames& names,
                core::ProblemList& problems);

  // False when a raster could not be read: then there is nothing to ask for.
  bool usable() const { return usable_; }

  // Null where the ground comes from no raster. Voids are filled in it, whether the scene allows
  // that or not.
  const terrain::ElevationRaster* elevation() const { return elevation_ ? &*elevation_ : nullptr; }
  bool has_land_cover() const { return cover_.has_value(); }
  bool is_covered(const core::Geodetic& position) const;
  // In the scene's datum, without trees; nothing where the elevation data end. All of these are safe
  // to call from many threads.
  std::optional<double> height_m(const core::Geodetic& position, glm::dvec2 position_m) const;
  double canopy_m(glm::dvec2 position_m, Zone zone) const;
  terrain::MaterialId material(const core::Geodetic& position, glm::dvec2 position_m,
                               Zone zone) const;

 private:
  void generate(const TerrainDescription& terrain, const MaterialNames& names);
  void load_elevation(const TerrainDescription& terrain, core::ProblemList& problems);
  void load_land_cover(const TerrainDescription& terrain, const MaterialNames& names,
                       core::ProblemList& problems);

  bool usable_ = true;
  double level_m_;
  terrain::MaterialId material_;
  std::optional<terrain::Landscape> landscape_;
  std::optional<terrain::ElevationRaster> elevation_;
  std::optional<terrain::LandCoverRaster> cover_;
  std::vector<terrain::MaterialId> material_of_class_;
};

}  // namespace fanbeam::scenes
