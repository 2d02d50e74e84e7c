// The ground itself: runways that do not fit it, voids, its extent, angles its materials are known
// at.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <set>

#include "core/units.h"
#include "scenes/doctor/parts_private.h"
#include "sensors/cells.h"
#include "terrain/raster/raster_file.h"

namespace fanbeam::scenes {
namespace {

constexpr double kDelicateOff_m = 5.0;  // what a one arc second elevation model is good for
constexpr double kWrongOff_m = 20.0;    // no survey is that far off: another vertical datum is
constexpr double kAlongStep_m = 10.0;
constexpr double kDelicateShare = 0.01;

struct Off {
  double largest_m = 0.0;
  glm::dvec3 where_m{0.0};
};

Off off_terrain(const DoctorParts& parts, const terrain::Runway& runway) {
  Off off;
  const int steps = static_cast<int>(std::ceil(runway.length_m() / kAlongStep_m));
  for (int i = 0; i <= steps; ++i) {
    const glm::dvec2 at_m =
        runway.ends[0].pavement_end_m + runway.along() * (runway.length_m() * i / steps);
    const core::Geodetic at = parts.scene.frame.to_geodetic(parts.ground.on_ground_m(at_m, 0.0));
    const auto natural_m = parts.natural.height_m(at, at_m);
    if (!natural_m) continue;
    const double off_m = terrain::strip_height(runway, at_m).value().height_m - *natural_m;
    if (std::abs(off_m) <= std::abs(off.largest_m)) continue;
    off.largest_m = off_m;
    off.where_m = parts.ground.on_ground_m(at_m, 0.0);
  }
  return off;
}

// How far the terrain reaches along a level unit vector.
double reach_m(const terrain::HeightField& field, glm::dvec2 from_m, glm::dvec2 along) {
  double reach = std::numeric_limits<double>::max();
  const auto limit = [&](double from, double slope, double low, double high) {
    if (slope > 0.0) reach = std::min(reach, (high - from) / slope);
    if (slope < 0.0) reach = std::min(reach, (low - from) / slope);
  };
  limit(from_m.x, along.x, field.west_m, field.east_m());
  limit(from_m.y, along.y, field.south_m, field.north_m());
  return std::max(reach, 0.0);
}

std::set<terrain::MaterialId> ground_materials(const DoctorParts& parts) {
  const terrain::HeightField& field = parts.ground.field();
  std::set<terrain::MaterialId> used(field.cell_material.begin(), field.cell_material.end());
  if (const terrain::SurfaceMap* map = parts.scene.world.surfaces().surface_map())
    for (const terrain::SurfacePatch& patch : map->patches()) used.insert(patch.material);
  return used;
}

// Share of range cells, over the flight, in which level ground is seen within the interval.
double share_within(const DoctorParts& parts, const materials::Interval& grazing_rad) {
  const sensors::RangeGate& gate = parts.sensor().range;
  std::size_t within = 0, all = 0;
  for (const Sight& sight : parts.sights)
    for (int cell = 0; cell < gate.cells; ++cell) {
      const double sine = sight.above_ground_m / sensors::range_middle_m(gate, cell);
      if (!(sine > 0.0 && sine <= 1.0)) continue;
      ++all;
      if (grazing_rad.contains(std::asin(sine))) ++within;
    }
  return all > 0 ? static_cast<double>(within) / static_cast<double>(all) : 1.0;
}

}  // namespace

void check_runways(const DoctorParts& parts, Findings& findings) {
  for (std::size_t i = 0; i < parts.ground.runways().size(); ++i) {
    const terrain::Runway& runway = parts.ground.runways()[i];
    const RunwayDescription& description = parts.scene.description.runways[i];
    const Off off = off_terrain(parts, runway);
    const double size_m = std::abs(off.largest_m);
    // A plain or generated country was never meant to fit.
    const bool surveyed =
        parts.scene.description.terrain.source == TerrainDescription::Source::raster;
    if (size_m <= kDelicateOff_m) continue;
    const bool delicate = surveyed || size_m > kWrongOff_m;
    findings.push_back(
        {surveyed && size_m > kWrongOff_m ? Severity::wrong
         : delicate                       ? Severity::delicate
                                          : Severity::note,
         "runway-off-terrain",
         std::string("the runway lies ") + (off.largest_m > 0.0 ? "above" : "below") +
             " the terrain by this much, joined by slopes of up to " +
             core::number_text(std::round(100.0 * size_m / runway.blend_m)) + " %",
         place_text(description.place) + ", runway " + description.ends[0].name + "/" +
             description.ends[1].name + ", " + place_text(parts.scene, off.where_m),
         size_m, "m",
         "The slopes stand in the picture like a dam or a pit, and hide what is behind them.",
         size_m > kWrongOff_m ? "Check that runway and terrain have the same vertical datum, and "
                                "the ends' elevations."
                              : "Check the ends' elevations, or take a wider blend_m."});
  }
}

void check_voids(const DoctorParts& parts, Findings& findings) {
  const TerrainDescription& terrain = parts.scene.description.terrain;
  if (terrain.source != TerrainDescription::Source::raster || !terrain.fill_voids) return;
  const terrain::RasterBand band = terrain::read_raster_band(terrain.elevation);
  if (std::none_of(band.samples.begin(), band.samples.end(),
                   [](float sample) { return std::isnan(sample); }))
    return;
  const terrain::HeightField& field = parts.ground.field();
  std::size_t in_view = 0;
  double nearest_m = 1e300;
  glm::dvec3 where_m(0.0);
  for (int j = 0; j < field.rows; ++j)
    for (int i = 0; i < field.columns; ++i) {
      const glm::dvec3 post_m(field.west_m + field.spacing_m * i,
                              field.south_m + field.spacing_m * j,
                              field.height_m[field.post(i, j)]);
      const core::Geodetic at = parts.scene.frame.to_geodetic(post_m);
      const auto pixel = band.pixel_map.pixel_at(at.latitude_rad, at.longitude_rad);
      if (!pixel) continue;
      const int column = std::clamp(static_cast<int>(pixel->column), 0, band.width - 1);
      const int row = std::clamp(static_cast<int>(pixel->row), 0, band.height - 1);
      if (!std::isnan(band.at(column, row))) continue;
      bool seen = false;
      for (const Sight& sight : parts.sights) {
        const double range_m = range_in_view_m(parts, sight, post_m);
        if (!(range_m > 0.0)) continue;
        seen = true;
        if (range_m >= nearest_m) continue;
        nearest_m = range_m;
        where_m = post_m;
      }
      if (seen) ++in_view;
    }
  if (in_view == 0) return;
  findings.push_back(
      {Severity::delicate, "voids-in-view",
       "ground of this area has no elevation in the file and was filled from around; it comes as "
       "near as " +
           core::number_text(std::round(nearest_m)) + " m",
       place_text(terrain.elevation_place) + ", " + terrain.elevation.filename().string() + ", " +
           place_text(parts.scene, where_m),
       static_cast<double>(in_view) * field.spacing_m * field.spacing_m, "m2",
       "What the picture shows there is a guess: voids lie in water, shadow and steep slopes.",
       "Take elevation data without voids there."});
}

void check_terrain_extent(const DoctorParts& parts, Findings& findings) {
  const sensors::Sensor& sensor = parts.sensor();
  const double window_m = sensor.range.maximum_m() - sensor.range.minimum_m;
  double beyond = 0.0, most = -1.0;
  int worst_frame = 0;
  glm::dvec3 where_m(0.0);
  for (const Sight& sight : parts.sights) {
    double share = 0.0;
    for (int column = 0; column < sensor.scan.columns; ++column) {
      const glm::dvec2 along(sensors::direction(sight.antenna,
                                                sensors::column_middle_rad(sensor.scan, column),
                                                0.0, sensors::ScanSurface::plane));
      if (!(glm::length(along) > 0.0)) continue;
      const double edge_m = reach_m(parts.ground.field(), glm::dvec2(sight.antenna.position_m),
                                    glm::normalize(along));
      share += std::clamp((sensor.range.maximum_m() - edge_m) / window_m, 0.0, 1.0) /
               sensor.scan.columns;
    }
    beyond += share / static_cast<double>(parts.sights.size());
    if (share <= most) continue;
    most = share;
    worst_frame = sight.frame;
    where_m = sight.antenna.position_m;
  }
  if (!(beyond > 0.0)) return;
  findings.push_back(
      {beyond > kDelicateShare ? Severity::delicate : Severity::note, "beyond-terrain",
       "this share of the pictures looks beyond the terrain's edge, most in frame " +
           std::to_string(worst_frame) + " with " +
           core::number_text(std::round(1000.0 * most) / 10.0) + " %",
       "terrain, seen from " + place_text(parts.scene, where_m), 100.0 * beyond, "%",
       "Cells beyond the edge hold noise alone, as if they lay in shadow.",
       "Give the terrain the extent of the flight plus the sensor's farthest range."});
}

void check_grazing(const DoctorParts& parts, Findings& findings) {
  std::string names;
  double least = 1.0;
  for (const terrain::MaterialId id : ground_materials(parts)) {
    if (id >= parts.scene.world.geometry->material_names.size()) continue;
    const std::string& name = parts.scene.world.geometry->material_names[id];
    for (const SurfaceRecord& record : parts.scene.surfaces) {
      if (record.material != name) continue;
      const double within = share_within(parts, record.grazing_rad);
      if (within >= 0.5) continue;
      names += (names.empty() ? "" : ", ") + name + " (" +
               core::number_text(std::round(100.0 * (1.0 - within))) + " %)";
      least = std::min(least, within);
    }
  }
  if (names.empty()) return;
  findings.push_back(
      {Severity::note, "grazing-beyond-source",
       "level ground is seen at angles outside what the source of a material covers, in most range "
       "cells: " +
           names,
       "materials of the ground", 100.0 * (1.0 - least), "%",
       "There the law goes on without anything behind it, and the levels of these surfaces are as "
       "sure as the law's form.",
       "Trust shapes and shadows more than levels; fanbeam materials shows how each is known."});
}

}  // namespace fanbeam::scenes
