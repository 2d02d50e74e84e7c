#include "scenes/elevation_voids.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "core/units.h"

namespace fanbeam::scenes {
namespace {

class UsedPosts {
 public:
  UsedPosts(const terrain::ElevationRaster& raster, const terrain::HeightField& field,
            const terrain::LocalFrame& frame)
      : raster_(raster),
        field_(field),
        frame_(frame),
        used_(static_cast<std::size_t>(raster.width()) *
              static_cast<std::size_t>(raster.height())) {
    core::parallel_for(static_cast<std::size_t>(field.rows), [&](std::size_t row) {
      for (int i = 0; i < field_.columns; ++i) mark(position(i, static_cast<int>(row)));
    });
  }

  std::size_t count() const {
    return static_cast<std::size_t>(std::count(used_.begin(), used_.end(), std::uint8_t{1}));
  }

  struct Voids {
    std::size_t count = 0;
    int first_column = 0, first_row = 0;
  };
  Voids voids() const {
    Voids voids;
    for (int row = 0; row < raster_.height(); ++row)
      for (int column = 0; column < raster_.width(); ++column) {
        if (used_[post(column, row)] == 0 || !raster_.is_void(column, row)) continue;
        if (voids.count++ == 0) voids = {1, column, row};
      }
    return voids;
  }

  // A place of the scene whose height that post has a part in.
  core::Geodetic place_of(int column, int row) const {
    for (int j = 0; j < field_.rows; ++j)
      for (int i = 0; i < field_.columns; ++i) {
        const core::Geodetic at = position(i, j);
        const auto posts = raster_.posts_at(at.latitude_rad, at.longitude_rad);
        if (posts && posts->first_column <= column && column <= posts->last_column &&
            posts->first_row <= row && row <= posts->last_row)
          return at;
      }
    return {};
  }

 private:
  std::size_t post(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(raster_.width()) +
           static_cast<std::size_t>(column);
  }

  core::Geodetic position(int i, int j) const {
    return frame_.to_geodetic({field_.west_m + field_.spacing_m * i,
                               field_.south_m + field_.spacing_m * j,
                               field_.height_m[field_.post(i, j)]});
  }

  void mark(const core::Geodetic& at) {
    const auto posts = raster_.posts_at(at.latitude_rad, at.longitude_rad);
    if (!posts) return;
    for (int row = posts->first_row; row <= posts->last_row; ++row)
      for (int column = posts->first_column; column <= posts->last_column; ++column)
        std::atomic_ref<std::uint8_t>(used_[post(column, row)]).store(1, std::memory_order_relaxed);
  }

  const terrain::ElevationRaster& raster_;
  const terrain::HeightField& field_;
  const terrain::LocalFrame& frame_;
  std::vector<std::uint8_t> used_;  // by post of the raster
};

}  // namespace

bool is_in_hole(const terrain::ElevationRaster& raster, const core::Geodetic& position) {
  if (raster.holes() == 0) return false;
  const auto posts = raster.posts_at(position.latitude_rad, position.longitude_rad);
  if (!posts) return false;
  for (int row = posts->first_row; row <= posts->last_row; ++row)
    for (int column = posts->first_column; column <= posts->last_column; ++column)
      if (!raster.post_height_m(column, row)) return true;
  return false;
}

void tell_used_voids(const TerrainDescription& terrain, const terrain::ElevationRaster& raster,
                     const terrain::HeightField& field, const terrain::LocalFrame& frame,
                     core::ProblemList& problems) {
  if (raster.voids() == 0) return;
  const UsedPosts used(raster, field, frame);
  const UsedPosts::Voids voids = used.voids();
  if (voids.count == 0) return;
  const core::Geodetic at = used.place_of(voids.first_column, voids.first_row);
  const auto degrees = [](double angle_rad) {
    return core::number_text(std::round(core::degrees(angle_rad) * 1e4) / 1e4);
  };
  const std::string found =
      terrain.elevation.filename().string() + ", " + std::to_string(voids.count) + " of the " +
      std::to_string(used.count()) +
      " posts that the scene uses have no height, the first at column " +
      std::to_string(voids.first_column) + ", row " + std::to_string(voids.first_row) + ", near " +
      degrees(at.latitude_rad) + ", " + degrees(at.longitude_rad) + " deg";
  if (terrain.fill_voids)
    problems.warning("VOID", terrain.elevation_place, "terrain.elevation", found,
                     "filled from around");
  else
    problems.error(core::ErrorClass::range, terrain.elevation_place, "terrain.elevation", found,
                   "a height at every one, or voids = \"fill\" under [terrain] to fill them from "
                   "around");
}

}  // namespace fanbeam::scenes
