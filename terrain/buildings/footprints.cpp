#include "terrain/buildings/footprints.h"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include "core/files.h"
#include "core/spelling.h"
#include "core/text.h"
#include "core/units.h"
#include "terrain/buildings/corner_budget.h"
#include "terrain/buildings/crossings_private.h"
#include "terrain/crs_definition.h"
#include "terrain/crs_limit.h"
#include "terrain/raster/gdal_messages.h"

namespace fanbeam::terrain {
namespace {

constexpr double kHighestBuilding_m = 1000.0;
constexpr double kLargestLongitude_deg = 540.0;

// Rings come closed from OGR and leave open, in the direction asked for.
GeodeticRing ring_from(const OGRLinearRing& source, bool counter_clockwise) {
  GeodeticRing ring;
  for (int i = 0; i + 1 < source.getNumPoints(); ++i)
    ring.push_back({core::radians(source.getY(i)), core::radians(source.getX(i))});
  if ((source.isClockwise() == 0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
  return ring;
}

// False for coordinates that are no numbers.
bool is_on_earth(double longitude_deg, double latitude_deg) {
  return std::abs(longitude_deg) <= kLargestLongitude_deg && std::abs(latitude_deg) <= 90.0;
}

bool all_points(const OGRPolygon& polygon, bool (*holds)(double, double)) {
  for (const OGRLinearRing* ring : polygon)
    for (int i = 0; i < ring->getNumPoints(); ++i)
      if (!holds(ring->getX(i), ring->getY(i))) return false;
  return true;
}

void collect_polygons(OGRGeometry& geometry, std::vector<OGRPolygon*>& polygons) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPolygon) {
    polygons.push_back(geometry.toPolygon());
  } else if (type == wkbMultiPolygon || type == wkbGeometryCollection) {
    for (OGRGeometry* part : *geometry.toGeometryCollection()) collect_polygons(*part, polygons);
  }
}

// Rings that bound nothing, of one position or two alike: GEOS refuses them, and with them the file. Holes of
// that kind go; false where the outer ring is one.
bool drop_points(OGRPolygon& polygon) {
  const auto is_point = [](const OGRLinearRing* ring) {
    return ring == nullptr || ring->getNumPoints() < 3;
  };
  if (is_point(polygon.getExteriorRing())) return false;
  for (int i = polygon.getNumInteriorRings(); i > 0; --i)
    if (is_point(polygon.getInteriorRing(i - 1))) polygon.removeRing(i);
  return true;
}

// The outline of a building whose parts are features as well: its block would hide them.
bool is_hidden(const OGRFeature& feature) {
  const int index = feature.GetFieldIndex("hide_3d");
  if (index < 0 || !feature.IsFieldSetAndNotNull(index)) return false;
  const char* text = feature.GetFieldAsString(index);  // "1" of true
  return EQUAL(text, "1") || EQUAL(text, "true");
}

class FootprintReader {
 public:
  FootprintReader(const std::filesystem::path& path, const FootprintOptions& options,
                  core::ProblemList& problems)
      : file_(path.string()), options_(options), problems_(problems) {}

  std::vector<Footprint> read();
  std::vector<std::string> properties();

 private:
  void check_size() const;
  void check_crs() const;
  GDALDatasetUniquePtr open() const;
  void read_layer(OGRLayer& layer);
  void read_feature(OGRFeature& feature);
  void add_polygon(OGRPolygon& polygon, double min_height_m, double height_m);
  // GEOS refuses a polygon with an open one, and with it the file.
  void close_rings(OGRPolygon& polygon);
  // An error and false for one with too many corners.
  bool check_corners(const OGRPolygon& polygon);
  void add_valid_polygon(const OGRPolygon& polygon, double min_height_m, double height_m);
  // Nothing, and an error, when the property is there but no height.
  std::optional<double> height_of(const OGRFeature& feature, const std::string& property,
                                  double otherwise_m, std::size_t& defaults);
  void report_counts();
  void refuse_feature(const std::string& what, const std::string& value,
                      const std::string& expected);

  std::string file_;
  const FootprintOptions& options_;
  core::ProblemList& problems_;
  core::ProblemList errors_;
  GdalMessages messages_;
  std::vector<Footprint> footprints_;
  std::unique_ptr<OGRCoordinateTransformation> to_wgs84_;
  std::set<std::string> properties_;  // that any feature has
  std::size_t feature_ = 0;
  CornerBudget corners_;
  std::size_t crossings_left_ = kMostFileCrossings;
  std::size_t unclosed_ = 0;
  std::size_t repaired_ = 0;
  std::size_t without_height_ = 0;
  std::size_t no_polygons_ = 0;
  std::size_t hidden_ = 0;
  std::size_t degenerate_ = 0;
};

std::vector<Footprint> FootprintReader::read() {
  check_size();
  check_crs();
  const GDALDatasetUniquePtr dataset = open();
  for (OGRLayer* layer : dataset->GetLayers()) read_layer(*layer);
  if (messages_.has_errors())
    errors_.error(core::ErrorClass::parse, core::Place{file_}, "GeoJSON",
                  messages_.first_error_or(""), "a whole, well-formed file");
  errors_.throw_if_errors();
  report_counts();
  return std::move(footprints_);
}

std::vector<std::string> FootprintReader::properties() {
  check_size();
  check_crs();
  const GDALDatasetUniquePtr dataset = open();
  std::vector<std::string> names;
  for (OGRLayer* layer : dataset->GetLayers())
    for (int i = 0; i < layer->GetLayerDefn()->GetFieldCount(); ++i)
      names.emplace_back(layer->GetLayerDefn()->GetFieldDefn(i)->GetNameRef());
  return names;
}

void FootprintReader::check_size() const {
  std::error_code error;
  const bool regular = std::filesystem::is_regular_file(file_, error);
  const std::uintmax_t size_bytes = regular ? std::filesystem::file_size(file_, error) : 0;
  if (!regular || error)
    core::throw_input_error(core::ErrorClass::io, core::Place{file_}, "footprints",
                            "no such file, or not readable", "a readable file");
  if (size_bytes > kLargestFootprintFile_bytes)
    core::throw_input_error(core::ErrorClass::limit, core::Place{file_}, "footprints",
                            std::to_string(size_bytes) + " bytes", "at most 200 MB");
}

void FootprintReader::check_crs() const {
  if (crs_names_files(core::read_file(file_, kLargestFootprintFile_bytes), file_))
    core::throw_input_error(core::ErrorClass::path, core::Place{file_}, "crs",
                            "a system that names files", "a system that PROJ knows by itself");
}

GDALDatasetUniquePtr FootprintReader::open() const {
  constexpr std::array<const char*, 2> kDrivers = {"GeoJSON", nullptr};
  GDALDatasetUniquePtr dataset(GDALDataset::Open(file_.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY,
                                                 kDrivers.data(), nullptr, nullptr));
  if (!dataset)
    core::throw_input_error(core::ErrorClass::parse, core::Place{file_}, "GeoJSON",
                            messages_.first_error_or("a file of another format"),
                            "a whole, well-formed GeoJSON file");
  return dataset;
}

void FootprintReader::read_layer(OGRLayer& layer) {
  OGRSpatialReference wgs84;
  wgs84.importFromEPSG(4326);
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const OGRSpatialReference* crs = layer.GetSpatialRef();
  if (crs != nullptr) {
    to_wgs84_.reset(OGRCreateCoordinateTransformation(crs, &wgs84));
    if (!to_wgs84_)
      core::throw_input_error(core::ErrorClass::ref, core::Place{file_}, "crs", crs->GetName(),
                              "a system with a known way to WGS 84");
  }
  const OGRFeatureDefn& definition = *layer.GetLayerDefn();
  for (int i = 0; i < definition.GetFieldCount(); ++i)
    properties_.insert(definition.GetFieldDefn(i)->GetNameRef());
  for (const OGRFeatureUniquePtr& feature : layer) {
    read_feature(*feature);
    ++feature_;
  }
}

void FootprintReader::read_feature(OGRFeature& feature) {
  OGRGeometry* geometry = feature.GetGeometryRef();
  std::vector<OGRPolygon*> polygons;
  if (geometry != nullptr) collect_polygons(*geometry, polygons);
  if (polygons.empty()) {
    ++no_polygons_;
    return;
  }
  if (is_hidden(feature)) {
    ++hidden_;
    return;
  }
  for (OGRPolygon* polygon : polygons)
    if (to_wgs84_ && (!all_points(*polygon, is_convertible) ||
                      polygon->transform(to_wgs84_.get()) != OGRERR_NONE))
      return refuse_feature("coordinates", "outside their reference system",
                            "positions on the Earth");
  std::size_t unused = 0;
  const auto height_m =
      height_of(feature, options_.height_property, options_.default_height_m, without_height_);
  const auto min_height_m = height_of(feature, options_.min_height_property, 0.0, unused);
  if (!height_m || !min_height_m) return;
  for (OGRPolygon* polygon : polygons) add_polygon(*polygon, *min_height_m, *height_m);
}

void FootprintReader::close_rings(OGRPolygon& polygon) {
  for (OGRLinearRing* ring : polygon) {
    const int last = ring->getNumPoints() - 1;
    if (last < 1 || (ring->getX(0) == ring->getX(last) && ring->getY(0) == ring->getY(last)))
      continue;
    ring->addPoint(ring->getX(0), ring->getY(0));
    ++unclosed_;
  }
}

void FootprintReader::add_polygon(OGRPolygon& polygon, double min_height_m, double height_m) {
  if (!all_points(polygon, is_on_earth))
    return refuse_feature("coordinates", "beyond the Earth",
                          "longitude -540 to 540, latitude -90 to 90 deg");
  close_rings(polygon);
  if (!drop_points(polygon)) {
    ++degenerate_;
    return;
  }
  if (polygon.IsValid()) return add_valid_polygon(polygon, min_height_m, height_m);
  const std::size_t most = std::min(kMostPolygonCrossings, crossings_left_) + 1;
  const std::size_t found = crossings(polygon, most);
  if (found == most)
    return errors_.error(core::ErrorClass::limit, core::Place{file_},
                         "feature " + std::to_string(feature_) + " outline",
                         "crosses itself more than " + std::to_string(most - 1) + " times",
                         "at most " + std::to_string(kMostPolygonCrossings) + " a polygon and " +
                             std::to_string(kMostFileCrossings) + " in the file");
  crossings_left_ -= found;
  const std::unique_ptr<OGRGeometry> repaired(polygon.MakeValid());
  std::vector<OGRPolygon*> parts;
  if (repaired) collect_polygons(*repaired, parts);
  if (parts.empty()) {
    ++degenerate_;
    return;
  }
  ++repaired_;
  for (const OGRPolygon* part : parts) add_valid_polygon(*part, min_height_m, height_m);
}

bool FootprintReader::check_corners(const OGRPolygon& polygon) {
  std::size_t corners = 0;
  for (const OGRLinearRing* ring : polygon)
    corners += static_cast<std::size_t>(std::max(ring->getNumPoints() - 1, 0));
  if (corners_.take(corners)) return true;
  errors_.error(core::ErrorClass::limit, core::Place{file_},
                "feature " + std::to_string(feature_) + " corners", std::to_string(corners),
                CornerBudget::expected());
  return false;
}

void FootprintReader::add_valid_polygon(const OGRPolygon& polygon, double min_height_m,
                                        double height_m) {
  if (polygon.IsEmpty() || !(polygon.get_Area() > 0.0) || height_m <= min_height_m) {
    ++degenerate_;
    return;
  }
  if (!check_corners(polygon)) return;
  Footprint footprint;
  footprint.outer = ring_from(*polygon.getExteriorRing(), true);
  for (int i = 0; i < polygon.getNumInteriorRings(); ++i)
    footprint.holes.push_back(ring_from(*polygon.getInteriorRing(i), false));
  footprint.min_height_m = min_height_m;
  footprint.height_m = height_m;
  footprint.feature = feature_;
  footprints_.push_back(std::move(footprint));
}

std::optional<double> FootprintReader::height_of(const OGRFeature& feature,
                                                 const std::string& property, double otherwise_m,
                                                 std::size_t& defaults) {
  const int index = feature.GetFieldIndex(property.c_str());
  if (index < 0 || !feature.IsFieldSetAndNotNull(index)) {
    ++defaults;
    return otherwise_m;
  }
  if (feature.GetFieldDefnRef(index)->GetSubType() == OFSTBoolean) {
    errors_.error(core::ErrorClass::parse, core::Place{file_},
                  "feature " + std::to_string(feature_) + " " + property,
                  feature.GetFieldAsInteger(index) != 0 ? "true" : "false",
                  "a height of 0 to 1000 m");
    return std::nullopt;
  }
  // Through text, so that "12 m" is no number instead of 12.
  const std::string text = feature.GetFieldAsString(index);
  const core::ParsedNumber number = core::parse_number(text);
  if (number.error != core::NumberError::none || number.value < 0.0 ||
      number.value > kHighestBuilding_m) {
    refuse_feature(property, text, "a height of 0 to 1000 m");
    return std::nullopt;
  }
  return number.value;
}

void FootprintReader::refuse_feature(const std::string& what, const std::string& value,
                                     const std::string& expected) {
  errors_.error(core::ErrorClass::range, core::Place{file_},
                "feature " + std::to_string(feature_) + " " + what, value, expected);
}

void FootprintReader::report_counts() {
  const auto report = [this](const char* name, std::size_t count, const std::string& what,
                             const std::string& done) {
    if (count > 0) problems_.warning(name, core::Place{file_}, what, std::to_string(count), done);
  };
  report("UNCLOSED", unclosed_, "rings that do not end where they begin", "closed");
  report("REPAIRED", repaired_, "polygons that cross or touch themselves", "their area is kept");
  // The usual cause where no feature has it is another name.
  report("DEFAULT", without_height_, "features without " + options_.height_property,
         core::number_text(options_.default_height_m) + " m is used" +
             (properties_.contains(options_.height_property)
                  ? ""
                  : core::names_there_text(options_.height_property,
                                           {properties_.begin(), properties_.end()})));
  report("SKIPPED", no_polygons_, "features that are no polygons", "left out");
  report("SKIPPED", hidden_, "features with hide_3d", "left out: outlines around building parts");
  report("DEGENERATE", degenerate_, "footprints without area or height", "left out");
}

}  // namespace

std::vector<Footprint> read_footprints(const std::filesystem::path& file,
                                       const FootprintOptions& options,
                                       core::ProblemList& problems) {
  return FootprintReader(file, options, problems).read();
}

std::vector<std::string> footprint_properties(const std::filesystem::path& file) {
  core::ProblemList none;
  return FootprintReader(file, {}, none).properties();
}

}  // namespace fanbeam::terrain
