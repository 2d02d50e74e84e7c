#include "terrain/buildings/city_reference.h"

#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include "core/text.h"
#include "core/units.h"
#include "terrain/crs_limit.h"
#include "terrain/raster/gdal_messages.h"

namespace fanbeam::terrain {
namespace {

constexpr int kLargestCode = 1'000'000;

// What a unit of height is, in metres.
double height_unit_m(const OGRSpatialReference& system) {
  if (system.IsCompound() != 0) return system.GetTargetLinearUnits("COMPD_CS|VERT_CS");
  return system.IsProjected() != 0 ? system.GetLinearUnits() : 1.0;
}

}  // namespace

std::optional<int> epsg_code(const std::string& reference) {
  const std::size_t word = reference.find("EPSG");
  const std::size_t digits = reference.find_last_of("/:");
  if (word == std::string::npos || digits == std::string::npos || digits < word)
    return std::nullopt;
  const std::string_view code = std::string_view(reference).substr(digits + 1);
  const core::ParsedNumber number = core::parse_number(code);
  if (number.error != core::NumberError::none || number.value < 1.0 ||
      number.value > kLargestCode || number.value != std::floor(number.value))
    return std::nullopt;
  return static_cast<int>(number.value);
}

std::vector<std::optional<core::Geodetic>> to_wgs84(const std::vector<glm::dvec3>& positions,
                                                    int epsg, const core::Place& place) {
  GdalMessages messages;
  const std::string name = "EPSG:" + std::to_string(epsg);
  OGRSpatialReference system, wgs84;
  if (system.importFromEPSG(epsg) != OGRERR_NONE)
    core::throw_input_error(core::ErrorClass::ref, place, "reference system", name,
                            "a system that PROJ knows");
  if (system.IsGeocentric() != 0)
    core::throw_input_error(core::ErrorClass::unsupported, place, "reference system",
                            name + ", from the Earth's centre",
                            "eastings and northings, or degrees");
  const double unit_m = height_unit_m(system);
  if (system.IsCompound() != 0) system.StripVertical();
  wgs84.importFromEPSG(4326);
  system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> way(
      OGRCreateCoordinateTransformation(&system, &wgs84));
  if (!way)
    core::throw_input_error(core::ErrorClass::ref, place, "reference system", name,
                            "a system with a known way to WGS 84");
  const std::size_t count = positions.size();
  std::vector<double> x(count), y(count);
  std::vector<int> converted(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const bool fit = is_convertible(positions[i].x, positions[i].y);
    x[i] = fit ? positions[i].x : HUGE_VAL;
    y[i] = fit ? positions[i].y : HUGE_VAL;
  }
  if (count > 0)
    way->Transform(static_cast<int>(count), x.data(), y.data(), nullptr, converted.data());
  std::vector<std::optional<core::Geodetic>> wgs(count);
  for (std::size_t i = 0; i < count; ++i)
    if (converted[i] != 0 && std::abs(x[i]) <= 540.0 && std::abs(y[i]) <= 90.0)
      wgs[i] = core::Geodetic{core::radians(y[i]), core::radians(x[i]), positions[i].z * unit_m};
  return wgs;
}

}  // namespace fanbeam::terrain
