#include "terrain/buildings/extrusion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "terrain/buildings/geos_private.h"

namespace fanbeam::terrain {
namespace {

// Puts prisms into one mesh, one after the other.
class Extruder {
 public:
  Extruder(const std::string& name, const ExtrusionMaterials& materials) {
    result_.mesh.name = name;
    result_.mesh.material_names = {materials.wall, materials.roof};
  }

  enum class Outcome { done, degenerate, not_triangulated };
  // Leaves the result as it was unless the outcome is `done`.
  Outcome add(const Prism& prism, std::uint32_t index);
  Extrusion take() { return std::move(result_); }

 private:
  bool add_polygon(const Polygon_m& rings_m, const Prism& prism);
  void add_walls(const Ring_m& ring, const Prism& prism);
  void add_triangle(const glm::uvec3& triangle, std::uint32_t slot);

  Geos geos_;
  Extrusion result_;
  std::uint32_t prism_index_ = 0;
};

Extruder::Outcome Extruder::add(const Prism& prism, std::uint32_t index) {
  prism_index_ = index;
  if (!(prism.top_m > prism.bottom_m)) return Outcome::degenerate;
  std::vector<Polygon_m> polygons = clean_footprint(prism.outer_m, prism.holes_m);
  if (polygons.empty()) return Outcome::degenerate;
  const std::size_t vertices = result_.mesh.vertices_m.size();
  const std::size_t triangles = result_.mesh.triangles.size();
  for (const Polygon_m& rings_m : polygons) {
    if (add_polygon(rings_m, prism)) continue;
    result_.mesh.vertices_m.resize(vertices);
    result_.mesh.triangles.resize(triangles);
    result_.mesh.triangle_material.resize(triangles);
    result_.mesh.triangle_part.resize(triangles);
    return Outcome::not_triangulated;
  }
  for (Polygon_m& rings_m : polygons) result_.polygons.push_back({std::move(rings_m), index});
  return Outcome::done;
}

bool Extruder::add_polygon(const Polygon_m& rings_m, const Prism& prism) {
  const auto roof = geos_.triangulate(rings_m);
  if (!roof) return false;
  // Walls put two vertices for each point of the rings, the second at the top.
  const auto first = static_cast<std::uint32_t>(result_.mesh.vertices_m.size());
  for (const Ring_m& ring : rings_m) add_walls(ring, prism);
  for (const glm::uvec3& triangle : *roof)
    add_triangle(glm::uvec3(first + 1) + 2U * triangle, kRoofSlot);
  return true;
}

// Walking a ring with the building on the left, the outside is on the right.
void Extruder::add_walls(const Ring_m& ring, const Prism& prism) {
  std::vector<glm::dvec3>& vertices = result_.mesh.vertices_m;
  const auto first = static_cast<std::uint32_t>(vertices.size());
  const auto count = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    vertices.emplace_back(ring[i].x, ring[i].y, prism.bottom_m);
    vertices.emplace_back(ring[i].x, ring[i].y, prism.top_m);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t here = first + 2 * i;
    const std::uint32_t next = first + 2 * ((i + 1) % count);
    add_triangle({here, next, next + 1}, kWallSlot);
    add_triangle({here, next + 1, here + 1}, kWallSlot);
  }
}

void Extruder::add_triangle(const glm::uvec3& triangle, std::uint32_t slot) {
  result_.mesh.triangles.push_back(triangle);
  result_.mesh.triangle_material.push_back(slot);
  result_.mesh.triangle_part.push_back(prism_index_);
}

// An error and false when a coordinate cannot be used.
bool check_coordinates(const Prism& prism, std::size_t index, const std::string& name,
                       core::ProblemList& problems) {
  std::vector<double> numbers = {prism.bottom_m, prism.top_m};
  const auto collect = [&numbers](const Ring_m& ring) {
    for (const glm::dvec2& point : ring) numbers.insert(numbers.end(), {point.x, point.y});
  };
  collect(prism.outer_m);
  std::for_each(prism.holes_m.begin(), prism.holes_m.end(), collect);
  for (const double number : numbers) {
    const bool finite = std::isfinite(number);
    if (finite && std::abs(number) <= kLargestCoordinate_m) continue;
    problems.error(finite ? core::ErrorClass::range : core::ErrorClass::nonfinite, {},
                   name + " building " + std::to_string(index), core::number_text(number),
                   "coordinates of -1000 to 1000 km");
    return false;
  }
  return true;
}

}  // namespace

Extrusion extrude(const std::vector<Prism>& prisms, const std::string& name,
                  const ExtrusionMaterials& materials, core::ProblemList& problems) {
  Extruder extruder(name, materials);
  std::size_t degenerate = 0;
  std::size_t not_triangulated = 0;
  for (std::size_t i = 0; i < prisms.size(); ++i) {
    if (!check_coordinates(prisms[i], i, name, problems)) continue;
    const auto outcome = extruder.add(prisms[i], static_cast<std::uint32_t>(i));
    if (outcome == Extruder::Outcome::degenerate) ++degenerate;
    if (outcome == Extruder::Outcome::not_triangulated) ++not_triangulated;
  }
  const auto report = [&](const char* warning, std::size_t count, const char* reason) {
    if (count > 0)
      problems.warning(warning, {}, name + " buildings " + reason, std::to_string(count),
                       "left out");
  };
  report("DEGENERATE", degenerate, "without area or height");
  report("SKIPPED", not_triangulated, "whose roof cannot be triangulated");
  Extrusion result = extruder.take();
  result.failed = degenerate + not_triangulated;
  return result;
}

}  // namespace fanbeam::terrain
