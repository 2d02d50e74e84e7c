#include "terrain/pixel_map.h"

#include <gdal.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/errors.h"
#include "core/units.h"
#include "terrain/crs_definition.h"
#include "terrain/crs_limit.h"
#include "terrain/raster/gdal_messages.h"

namespace fanbeam::terrain {
namespace {

constexpr std::size_t kMostCells = 1024;
constexpr std::size_t kEdgeSamples = 128;
constexpr double kTurn_deg = 360.0;

using Geotransform = std::array<double, 6>;

struct Points {
  std::vector<double> x;
  std::vector<double> y;
  void add(double new_x, double new_y) {
    x.push_back(new_x);
    y.push_back(new_y);
  }
};

[[noreturn]] void refuse(const std::string& file, core::ErrorClass error_class,
                         const std::string& value) {
  core::throw_input_error(error_class, core::Place{file}, "georeference", value,
                          error_class == core::ErrorClass::ref
                              ? "a geotransform and a coordinate reference system on the Earth"
                              : "a raster of less than half the globe with a smooth projection");
}

void apply(const Geotransform& g, double& x, double& y) {
  const double column = x;
  const double row = y;
  x = g[0] + g[1] * column + g[2] * row;
  y = g[3] + g[4] * column + g[5] * row;
}

// Builds what PixelMap keeps; lives only as long as that takes.
class LatticeBuilder {
 public:
  LatticeBuilder(const Geotransform& geotransform, const std::string& crs_wkt, int width,
                 int height, const std::string& file)
      : file_(file), width_(width), height_(height), crs_from_pixel_(geotransform) {
    invert_geotransform();
    make_transformations(crs_wkt);
  }

  GeodeticBox find_box();
  std::vector<PixelPosition> evaluate(const GeodeticBox& box, std::size_t cells) const;

 private:
  void invert_geotransform();
  void make_transformations(const std::string& crs_wkt);
  void transform(OGRCoordinateTransformation& transformation, Points& points) const;

  const std::string& file_;
  double width_;
  double height_;
  Geotransform crs_from_pixel_;
  Geotransform pixel_from_crs_{};
  double crs_unit_deg_ = 0.0;  // 0 when the system's coordinates are not angles
  double turns_ = 0.0;         // whole turns between the file's longitudes and those of the box
  std::unique_ptr<OGRCoordinateTransformation> degrees_from_crs_;
  std::unique_ptr<OGRCoordinateTransformation> crs_from_degrees_;
};

void LatticeBuilder::invert_geotransform() {
  const bool finite = std::all_of(crs_from_pixel_.begin(), crs_from_pixel_.end(),
                                  [](double number) { return std::isfinite(number); });
  if (!finite || GDALInvGeoTransform(crs_from_pixel_.data(), pixel_from_crs_.data()) == 0)
    refuse(file_, core::ErrorClass::ref, "a geotransform without inverse");
}

void LatticeBuilder::make_transformations(const std::string& crs_wkt) {
  if (names_files(crs_wkt))
    core::throw_input_error(core::ErrorClass::path, core::Place{file_}, "georeference",
                            "a coordinate reference system that names files",
                            "a system that PROJ knows by itself");
  OGRSpatialReference crs;
  OGRSpatialReference wgs84;
  if (crs_wkt.empty() || crs.importFromWkt(crs_wkt.c_str()) != OGRERR_NONE)
    refuse(file_, core::ErrorClass::ref, "no coordinate reference system");
  crs.StripVertical();
  wgs84.importFromEPSG(4326);
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (crs.IsGeographic()) crs_unit_deg_ = core::degrees(crs.GetAngularUnits());
  degrees_from_crs_.reset(OGRCreateCoordinateTransformation(&crs, &wgs84));
  crs_from_degrees_.reset(OGRCreateCoordinateTransformation(&wgs84, &crs));
  if (!degrees_from_crs_ || !crs_from_degrees_)
    refuse(file_, core::ErrorClass::ref, "a system without a known way to WGS 84");
}

void LatticeBuilder::transform(OGRCoordinateTransformation& transformation, Points& points) const {
  bool good = true;
  for (std::size_t i = 0; i < points.x.size(); ++i)
    good = good && is_convertible(points.x[i], points.y[i]);
  good = good && transformation.Transform(static_cast<int>(points.x.size()), points.x.data(),
                                          points.y.data());
  for (std::size_t i = 0; i < points.x.size(); ++i)
    good = good && std::isfinite(points.x[i]) && std::isfinite(points.y[i]);
  if (!good)
    refuse(file_, core::ErrorClass::ref, "positions outside the coordinate reference system");
}

GeodeticBox LatticeBuilder::find_box() {
  Points points;
  points.add(0.5 * width_, 0.5 * height_);
  for (std::size_t i = 0; i <= kEdgeSamples; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(kEdgeSamples);
    points.add(part * width_, 0.0);
    points.add(part * width_, height_);
    points.add(0.0, part * height_);
    points.add(width_, part * height_);
  }
  for (std::size_t i = 0; i < points.x.size(); ++i)
    apply(crs_from_pixel_, points.x[i], points.y[i]);
  const double middle_in_crs = points.x.front();
  transform(*degrees_from_crs_, points);

  const double middle_deg = points.x.front();
  turns_ = std::round((middle_in_crs * crs_unit_deg_ - middle_deg) / kTurn_deg);
  for (double& longitude_deg : points.x)
    longitude_deg = middle_deg + std::remainder(longitude_deg - middle_deg, kTurn_deg);
  const auto [west, east] = std::minmax_element(points.x.begin(), points.x.end());
  const auto [south, north] = std::minmax_element(points.y.begin(), points.y.end());
  if (*east - *west >= 0.5 * kTurn_deg)
    refuse(file_, core::ErrorClass::unsupported, "a raster of half the globe or more");
  // Edges may bulge between their samples; about a pixel more is enough for that.
  const double margin_deg = std::min((*north - *south) / height_, (*east - *west) / width_);
  // Pixels of a raster of points may reach past a pole by half of themselves.
  if (*south < -90.0 - margin_deg || *north > 90.0 + margin_deg)
    refuse(file_, core::ErrorClass::ref, "latitudes beyond a pole");
  return {core::radians(std::max(*south - margin_deg, -90.0)),
          core::radians(std::min(*north + margin_deg, 90.0)), core::radians(*west - margin_deg),
          core::radians(*east + margin_deg)};
}

std::vector<PixelPosition> LatticeBuilder::evaluate(const GeodeticBox& box,
                                                    std::size_t cells) const {
  Points points;
  for (std::size_t j = 0; j <= cells; ++j) {
    const double north_part = static_cast<double>(j) / static_cast<double>(cells);
    const double latitude_rad = box.south_rad + north_part * (box.north_rad - box.south_rad);
    for (std::size_t i = 0; i <= cells; ++i) {
      const double east_part = static_cast<double>(i) / static_cast<double>(cells);
      const double longitude_rad = box.west_rad + east_part * (box.east_rad - box.west_rad);
      points.add(core::degrees(longitude_rad), core::degrees(latitude_rad));
    }
  }
  const std::vector<double> longitudes_deg = points.x;
  transform(*crs_from_degrees_, points);
  std::vector<PixelPosition> nodes;
  nodes.reserve(points.x.size());
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    double x = points.x[i];
    double y = points.y[i];
    if (crs_unit_deg_ > 0.0) {
      const double in_file_deg = longitudes_deg[i] + turns_ * kTurn_deg;
      x += std::round((in_file_deg - x * crs_unit_deg_) / kTurn_deg) * kTurn_deg / crs_unit_deg_;
    }
    apply(pixel_from_crs_, x, y);
    nodes.push_back({x, y});
  }
  return nodes;
}

PixelPosition between(const PixelPosition& from, const PixelPosition& to, double part) {
  return {from.column + part * (to.column - from.column), from.row + part * (to.row - from.row)};
}

// Largest error, in pixels, that a lattice of half as many cells makes at the nodes of this one.
double error_of_coarser(const std::vector<PixelPosition>& nodes, std::size_t cells) {
  const auto node = [&](std::size_t i, std::size_t j) { return nodes[j * (cells + 1) + i]; };
  double largest = 0.0;
  for (std::size_t j = 0; j <= cells; ++j) {
    for (std::size_t i = 0; i <= cells; ++i) {
      const std::size_t west = i - i % 2, east = i + i % 2;
      const std::size_t south = j - j % 2, north = j + j % 2;
      const PixelPosition guess = between(between(node(west, south), node(east, south), 0.5),
                                          between(node(west, north), node(east, north), 0.5), 0.5);
      largest = std::max({largest, std::abs(guess.column - node(i, j).column),
                          std::abs(guess.row - node(i, j).row)});
    }
  }
  return largest;
}

}  // namespace

PixelMap::PixelMap(const Geotransform& geotransform, const std::string& crs_wkt, int width,
                   int height, const std::string& file)
    : width_(width), height_(height) {
  const GdalMessages messages;
  LatticeBuilder builder(geotransform, crs_wkt, width, height, file);
  box_ = builder.find_box();
  // The accepted lattice is four times as good as the coarser one that was judged.
  for (cells_ = 2; cells_ <= kMostCells; cells_ *= 2) {
    nodes_ = builder.evaluate(box_, cells_);
    if (error_of_coarser(nodes_, cells_) <= kPixelMapAccuracy) return;
  }
  refuse(file, core::ErrorClass::unsupported, "a projection with a pole or a break inside");
}

std::optional<PixelPosition> PixelMap::pixel_at(double latitude_rad, double longitude_rad) const {
  const double middle_rad = 0.5 * (box_.west_rad + box_.east_rad);
  const double from_middle_rad = std::remainder(longitude_rad - middle_rad, 2.0 * core::kPi);
  const auto cells = static_cast<double>(cells_);
  const double u = (0.5 + from_middle_rad / (box_.east_rad - box_.west_rad)) * cells;
  const double v = (latitude_rad - box_.south_rad) / (box_.north_rad - box_.south_rad) * cells;
  if (!(u >= 0.0 && u <= cells && v >= 0.0 && v <= cells)) return std::nullopt;

  const auto i = std::min(static_cast<std::size_t>(u), cells_ - 1);
  const auto j = std::min(static_cast<std::size_t>(v), cells_ - 1);
  const PixelPosition* south = &nodes_[j * (cells_ + 1) + i];
  const PixelPosition* north = south + cells_ + 1;
  const double east_part = u - static_cast<double>(i);
  const PixelPosition pixel =
      between(between(south[0], south[1], east_part), between(north[0], north[1], east_part),
              v - static_cast<double>(j));
  const bool inside =
      pixel.column >= 0.0 && pixel.column <= width_ && pixel.row >= 0.0 && pixel.row <= height_;
  return inside ? std::optional(pixel) : std::nullopt;
}

}  // namespace fanbeam::terrain
