#include "terrain/buildings/cityjson.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <utility>

#include "core/json_node.h"
#include "core/text.h"
#include "terrain/buildings/city_reference.h"
#include "terrain/buildings/corner_budget.h"
#include "terrain/buildings/face_triangles.h"
#include "terrain/buildings/geos_private.h"

namespace fanbeam::terrain {
namespace {

using core::ErrorClass;
using core::JsonNode;

constexpr core::JsonLimits kLimits{64, kMostCityValues};
constexpr core::NumberRange kCoordinate{-1e12, 1e12};
constexpr int kMostAncestors = 8;
constexpr std::size_t kMostParents = 64;  // of one object, that are looked at
constexpr std::size_t kMostSurfaceKinds = 64;
// Of a face without semantics: cosine of 60 deg, between its normal and the vertical.
constexpr double kWallSlope = 0.5;

constexpr std::array<std::string_view, 9> kBuilt = {
    "Building",         "BuildingPart", "BuildingInstallation", "BuildingConstructiveElement",
    "Bridge",           "BridgePart",   "BridgeInstallation",   "BridgeConstructiveElement",
    "OtherConstruction"};
constexpr std::array<std::string_view, 5> kUnseen = {
    "GroundSurface", "ClosureSurface", "InteriorWallSurface", "CeilingSurface", "FloorSurface"};

template <std::size_t N>
bool is_one_of(const std::array<std::string_view, N>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// How many lists lie around the list of faces.
std::optional<int> levels_around_faces(const std::string& type) {
  if (type == "MultiSurface" || type == "CompositeSurface") return 0;
  if (type == "Solid") return 1;
  if (type == "MultiSolid" || type == "CompositeSolid") return 2;
  return std::nullopt;
}

class CityReader {
 public:
  CityReader(const core::JsonFile& file, const CityOptions& options, core::ProblemList& problems)
      : place_{file.name}, options_(options), problems_(problems), root_(file, errors_) {}

  CityModel read();

 private:
  void check_version();
  std::optional<int> epsg();
  void read_vertices(int epsg);
  void read_objects();
  struct Shape {
    JsonNode geometry, values;
    std::vector<std::string> semantics;  // that the values count
    // Whether there is a face to read, not grounds and closures alone.
    bool is_seen() const;
  };
  // An object, those that it is a part of, from the nearest to the building, and the geometries of its
  // highest level of detail that is read: several of one level are one shape (CityJSON has no MultiGeometry).
  struct Piece {
    std::string id;
    bool is_part = false;
    std::vector<std::string> above;
    double lod = 0.0;
    std::vector<Shape> shapes;
    bool is_seen() const;
  };
  // What is known of the parts under an object.
  struct Parts {
    int finest = 0;  // level of those that are seen; 0 for none
    bool all_seen = true;
  };
  // Groups aside; none after an error.
  std::vector<std::string> objects_above(const std::string& id);
  Piece best_geometries(const JsonNode& object) const;
  void find_parts(const std::vector<Piece>& pieces);
  void read_shape(const Shape& shape, CityBuilding& building);
  void read_faces(const JsonNode& boundary, const JsonNode& values, int levels,
                  const std::vector<std::string>& semantics, CityBuilding& building);
  void read_face(const JsonNode& face, const std::string& semantic, CityBuilding& building);
  // An error and false for one with too many corners.
  bool check_corners(const JsonNode& face, const FaceRings& rings);
  std::optional<FaceRings> rings_of(const JsonNode& face, CityBuilding& building);
  std::uint32_t corner(std::uint32_t vertex, CityBuilding& building);
  std::uint32_t surface(const std::string& name);
  void report_counts();

  core::Place place_;
  const CityOptions& options_;
  core::ProblemList& problems_;
  core::ProblemList errors_;
  JsonNode root_;
  Geos geos_;
  CornerBudget corners_;
  std::vector<std::optional<core::Geodetic>> vertices_;
  // Which building met a vertex last, and the place it has there.
  std::vector<std::pair<const CityBuilding*, std::uint32_t>> met_;
  std::map<std::string, CityBuilding> buildings_;
  std::map<std::string, Parts> parts_;  // by the object that they are under
  std::vector<std::string> surfaces_;
  std::map<std::string, std::size_t> other_types_;
  std::size_t without_geometry_ = 0, coarser_ = 0, degenerate_ = 0, not_triangulated_ = 0;
  bool off_earth_ = false;
};

CityModel CityReader::read() {
  check_version();
  const std::optional<int> code = epsg();
  errors_.throw_if_errors();
  read_vertices(*code);
  errors_.throw_if_errors();
  read_objects();
  errors_.throw_if_errors();
  report_counts();
  CityModel city{std::move(surfaces_), {}};
  for (auto& [id, building] : buildings_)
    if (!building.triangles.empty()) city.buildings.push_back(std::move(building));
  return city;
}

void CityReader::check_version() {
  const JsonNode version = root_.required("version");
  const std::string text = version.text().value_or("");
  if (version.present() && text != "1.1" && text != "2.0")
    version.error(ErrorClass::unsupported, "\"1.1\" or \"2.0\"");
}

std::optional<int> CityReader::epsg() {
  const JsonNode stated = root_.member("metadata").member("referenceSystem");
  const std::string reference = stated.text().value_or(options_.crs);
  const std::optional<int> code = epsg_code(reference);
  if (code && !options_.crs.empty() && epsg_code(options_.crs) != code)
    problems_.warning("UNUSED", place_, "crs", "\"" + options_.crs + "\"",
                      "the file says EPSG:" + std::to_string(*code) + ", which counts");
  if (code) return code;
  if (stated.present())
    stated.error(ErrorClass::ref, "a system of EPSG, https://www.opengis.net/def/crs/EPSG/0/7415");
  else if (reference.empty())
    errors_.error(ErrorClass::ref, place_, "/metadata/referenceSystem", "missing",
                  "it to be there, or crs = \"EPSG:...\" in the scene");
  else
    errors_.error(ErrorClass::ref, place_, "crs", "\"" + reference + "\"",
                  "\"EPSG:28992\" or the like");
  return std::nullopt;
}

void CityReader::read_vertices(int epsg) {
  const JsonNode transform = root_.required("transform");
  const std::vector<double> scale = transform.required("scale").numbers(kCoordinate, 3);
  const std::vector<double> translate = transform.required("translate").numbers(kCoordinate, 3);
  const JsonNode list = root_.required("vertices");
  if (!errors_.has_errors() && (scale.size() != 3 || translate.size() != 3))
    transform.error(ErrorClass::range, "three numbers of scale and three of translate");
  errors_.throw_if_errors();
  std::vector<glm::dvec3> positions;
  positions.reserve(list.elements());
  for (std::size_t i = 0; i < list.size(kMostCityValues) && !errors_.is_full(); ++i) {
    const JsonNode vertex = list.element(i);
    const std::vector<double> xyz = vertex.numbers(kCoordinate, 3);
    if (xyz.size() != 3) {
      vertex.error(ErrorClass::range, "three numbers");
      continue;
    }
    positions.emplace_back(xyz[0] * scale[0] + translate[0], xyz[1] * scale[1] + translate[1],
                           xyz[2] * scale[2] + translate[2]);
  }
  errors_.throw_if_errors();
  vertices_ = to_wgs84(positions, epsg, place_);
  met_.assign(vertices_.size(), {nullptr, 0});
}

void CityReader::read_objects() {
  const JsonNode objects = root_.required("CityObjects");
  if (objects.present() && !objects.is_object()) objects.error(ErrorClass::parse, "an object");
  std::vector<Piece> pieces;
  for (const std::string& id : objects.keys()) {
    if (errors_.is_full()) return;
    const JsonNode object = objects.member(id);
    const std::string type = object.required("type").text().value_or("");
    if (!is_one_of(kBuilt, type)) {
      if (!type.empty()) ++other_types_[core::printable_text(type.substr(0, 40))];
      continue;
    }
    Piece piece = best_geometries(object);
    piece.id = id;
    piece.is_part = type.ends_with("Part");
    if (piece.shapes.empty() && object.member("children").elements() == 0) ++without_geometry_;
    if (piece.shapes.empty() && !piece.is_part) continue;
    piece.above = objects_above(id);
    pieces.push_back(std::move(piece));
  }
  find_parts(pieces);
  for (const Piece& piece : pieces) {
    if (errors_.is_full()) return;
    if (piece.shapes.empty()) continue;
    const Parts& parts = parts_[piece.id];
    if (parts.all_seen && parts.finest > static_cast<int>(piece.lod)) {
      ++coarser_;  // would hide them
      continue;
    }
    const std::string& name = piece.above.empty() ? piece.id : piece.above.back();
    CityBuilding& building = buildings_[name];
    building.id = core::printable_text(name.substr(0, 80));
    for (const Shape& shape : piece.shapes) read_shape(shape, building);
  }
}

// A block is all that there is of a part without a shape, unless that one's own parts have it.
void CityReader::find_parts(const std::vector<Piece>& pieces) {
  for (const Piece& piece : pieces)
    if (piece.is_part && piece.is_seen())
      for (const std::string& name : piece.above)
        parts_[name].finest = std::max(parts_[name].finest, static_cast<int>(piece.lod));
  for (const Piece& piece : pieces)
    if (piece.is_part && !piece.is_seen() && parts_[piece.id].finest == 0)
      for (const std::string& name : piece.above) parts_[name].all_seen = false;
}

std::vector<std::string> CityReader::objects_above(const std::string& id) {
  const JsonNode objects = root_.member("CityObjects");
  std::vector<std::string> found;
  for (int step = 0;; ++step) {
    const JsonNode parents = objects.member(found.empty() ? id : found.back()).member("parents");
    std::string above;
    for (std::size_t i = 0; i < std::min(parents.elements(), kMostParents); ++i) {
      const std::string name = parents.element(i).text().value_or("");
      const JsonNode parent = objects.member(name);
      if (name.empty() || step == kMostAncestors || !parent.present()) {
        parents.element(i).error(ErrorClass::ref, step == kMostAncestors ? "no ring of parents"
                                                                         : "an object of the file");
        return {};
      }
      const std::string type = parent.member("type").text().value_or("");
      if (type == "CityObjectGroup") continue;
      // A room, a storey or a type of an extension leads to the building as well.
      const bool built = is_one_of(kBuilt, type);
      if (built || above.empty()) above = name;
      if (built) break;
    }
    if (above.empty()) return found;
    found.push_back(above);
  }
}

CityReader::Piece CityReader::best_geometries(const JsonNode& object) const {
  const JsonNode list = object.member("geometry");
  Piece best;
  const std::size_t count = list.size(kMostCityValues);
  for (std::size_t i = 0; i < count; ++i) {
    const JsonNode geometry = list.element(i);
    const std::string type = geometry.required("type").text().value_or("");
    if (!levels_around_faces(type)) continue;
    const JsonNode lod = geometry.required("lod");
    const core::ParsedNumber level = core::parse_number(lod.text().value_or("0"));
    if (level.error != core::NumberError::none) {
      lod.error(ErrorClass::parse, "\"1\" to \"3.3\"");
    } else if (level.value >= 1.0 && level.value < 4.0 && level.value >= best.lod) {
      if (level.value > best.lod) best.shapes.clear();
      best.lod = level.value;
      best.shapes.push_back({geometry, geometry.member("semantics").member("values"), {}});
    }
  }
  for (Shape& shape : best.shapes) {
    const JsonNode surfaces = shape.geometry.member("semantics").member("surfaces");
    const std::size_t kinds = surfaces.size(kMostCityValues);
    for (std::size_t k = 0; k < kinds; ++k)
      shape.semantics.push_back(surfaces.element(k).required("type").text().value_or(""));
  }
  return best;
}

bool CityReader::Shape::is_seen() const {
  return semantics.empty() || !values.present() ||
         std::any_of(semantics.begin(), semantics.end(),
                     [](const std::string& name) { return !is_one_of(kUnseen, name); });
}

bool CityReader::Piece::is_seen() const {
  return std::any_of(shapes.begin(), shapes.end(),
                     [](const Shape& shape) { return shape.is_seen(); });
}

void CityReader::read_shape(const Shape& shape, CityBuilding& building) {
  const JsonNode& geometry = shape.geometry;
  const int levels = levels_around_faces(geometry.member("type").text().value_or("")).value_or(0);
  read_faces(geometry.required("boundaries"), shape.values, levels, shape.semantics, building);
}

void CityReader::read_faces(const JsonNode& boundary, const JsonNode& values, int levels,
                            const std::vector<std::string>& semantics, CityBuilding& building) {
  const std::size_t count = boundary.size(kMostCityValues);
  if (values.present() && !values.is_array()) values.error(ErrorClass::parse, "an array");
  for (std::size_t i = 0; i < count && !errors_.is_full(); ++i) {
    if (levels == 1 && i > 0) return;  // a cavity
    const JsonNode value = values.element(i);
    if (levels > 0) {
      read_faces(boundary.element(i), value, levels - 1, semantics, building);
      continue;
    }
    std::string semantic;
    if (value.present() && !semantics.empty())
      if (const auto index = value.whole(0, static_cast<int>(semantics.size()) - 1))
        semantic = semantics[static_cast<std::size_t>(*index)];
    if (!is_one_of(kUnseen, semantic)) read_face(boundary.element(i), semantic, building);
  }
}

void CityReader::read_face(const JsonNode& face, const std::string& semantic,
                           CityBuilding& building) {
  const std::optional<FaceRings> rings = rings_of(face, building);
  if (!rings || !check_corners(face, *rings)) return;
  const glm::dvec3 normal_m2 = face_normal_m2(building.vertices_m, rings->front());
  const double up = normal_m2.z / std::max(glm::length(normal_m2), 1e-300);
  std::string name = semantic;
  if (name.empty()) {
    if (up < -kWallSlope) return;
    name = up > kWallSlope ? "RoofSurface" : "WallSurface";
  }
  const auto triangles = face_triangles(building.vertices_m, *rings, geos_);
  if (!triangles) {
    ++not_triangulated_;
    return;
  }
  degenerate_ += triangles->empty() ? 1 : 0;
  building.triangles.insert(building.triangles.end(), triangles->begin(), triangles->end());
  building.triangle_surface.resize(building.triangles.size(), surface(name));
}

bool CityReader::check_corners(const JsonNode& face, const FaceRings& rings) {
  std::size_t corners = 0;
  for (const auto& ring : rings) corners += ring.size();
  if (corners_.take(corners)) return true;
  errors_.error(ErrorClass::limit, place_, face.pointer(), std::to_string(corners) + " corners",
                CornerBudget::expected());
  return false;
}

std::optional<FaceRings> CityReader::rings_of(const JsonNode& face, CityBuilding& building) {
  FaceRings rings;
  const std::size_t count = face.size(kMostCityValues);
  for (std::size_t i = 0; i < count; ++i) {
    const JsonNode ring = face.element(i);
    const std::size_t corners = ring.size(kMostCityValues);
    std::vector<std::uint32_t> indices;
    for (std::size_t k = 0; k < corners && !errors_.is_full(); ++k) {
      const JsonNode index = ring.element(k);
      const auto vertex = index.whole(0, static_cast<int>(vertices_.size()) - 1);
      if (!vertex) return std::nullopt;
      if (!vertices_[static_cast<std::size_t>(*vertex)]) {
        if (!off_earth_) index.error(ErrorClass::range, "a vertex that has a place on the Earth");
        off_earth_ = true;
        return std::nullopt;
      }
      const std::uint32_t here = corner(static_cast<std::uint32_t>(*vertex), building);
      if (indices.empty() || here != indices.back()) indices.push_back(here);
    }
    while (indices.size() > 1 && indices.back() == indices.front()) indices.pop_back();
    if (indices.size() >= 3) rings.push_back(std::move(indices));
    if (rings.empty()) break;  // the outline has no area
  }
  if (!rings.empty()) return rings;
  ++degenerate_;
  return std::nullopt;
}

std::uint32_t CityReader::corner(std::uint32_t vertex, CityBuilding& building) {
  auto& [last, index] = met_[vertex];
  if (last != &building) {
    last = &building;
    index = static_cast<std::uint32_t>(building.vertices_m.size());
    building.vertices_m.push_back(options_.local_m(*vertices_[vertex]));
  }
  return index;
}

std::uint32_t CityReader::surface(const std::string& name) {
  const std::string shown = core::printable_text(name.substr(0, 40));
  auto at = std::find(surfaces_.begin(), surfaces_.end(), shown);
  // Hostile files alone have more kinds than this.
  if (at == surfaces_.end() && surfaces_.size() < kMostSurfaceKinds)
    at = surfaces_.insert(at, shown);
  return at == surfaces_.end() ? 0 : static_cast<std::uint32_t>(at - surfaces_.begin());
}

void CityReader::report_counts() {
  if (!other_types_.empty()) {
    std::string list;
    std::size_t all = 0, listed = 0;
    for (const auto& [type, count] : other_types_) {
      all += count;
      if (++listed <= 8) list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + type;
    }
    problems_.warning("SKIPPED", place_, "objects", std::to_string(all),
                      "left out, no buildings: " + list + (listed > 8 ? " and others" : ""));
  }
  const auto report = [this](const char* name, std::size_t count, const char* what,
                             const char* why) {
    if (count > 0) problems_.warning(name, place_, what, std::to_string(count), why);
  };
  report("SKIPPED", without_geometry_, "buildings without surfaces of LoD 1 to 3", "left out");
  report("SKIPPED", coarser_, "buildings coarser than their parts", "their parts alone are read");
  report("SKIPPED", not_triangulated_, "faces that cross themselves", "left out");
  report("DEGENERATE", degenerate_, "faces without area", "left out");
}

}  // namespace

bool is_cityjson(std::string_view json) {
  constexpr std::string_view kWord = "\"CityJSON\"", kKey = "\"type\"";
  for (std::size_t at = json.find(kWord); at != std::string_view::npos;
       at = json.find(kWord, at + kWord.size())) {
    const std::string_view before = core::trimmed(json.substr(0, at));
    if (!before.ends_with(':')) continue;
    if (core::trimmed(before.substr(0, before.size() - 1)).ends_with(kKey)) return true;
  }
  return false;
}

CityModel read_cityjson(const std::string& text, const std::string& name,
                        const CityOptions& options, core::ProblemList& problems) {
  core::ProblemList unread;
  const std::optional<core::JsonFile> file = core::parse_json(text, name, kLimits, unread);
  unread.throw_if_errors();
  return CityReader(*file, options, problems).read();
}

}  // namespace fanbeam::terrain
