// Triangles: T01, T08, T12 of the hard cases.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "scenes/doctor/parts_private.h"

namespace fanbeam::scenes {
namespace {

// A surface may be off by this part of a range cell, or its direction by this angle, before it
// counts.
constexpr double kCellPart = 0.1;
constexpr double kLooseNormal_rad = 0.0175;
// Beyond it less than three bits of a float remain for the small triangle.
constexpr double kLargestRatio = 1048576.0;

using Corners = std::array<glm::dvec3, 3>;

template <class Use>
void for_triangles(const terrain::TriangleMesh& mesh, const Use& use) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    use(i, Corners{mesh.vertices_m[t.x], mesh.vertices_m[t.y], mesh.vertices_m[t.z]});
  }
}

double longest_m(const Corners& c) {
  return std::max(
      {glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
}
double shortest_m(const Corners& c) {
  return std::min(
      {glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
}

double largest_coordinate_m(const glm::dvec3& point_m) {
  return std::max({std::abs(point_m.x), std::abs(point_m.y), std::abs(point_m.z)});
}

// As the ray caster keeps it.
Corners in_floats(const Corners& corners) {
  Corners rounded = corners;
  for (glm::dvec3& corner : rounded) corner = glm::dvec3(glm::vec3(corner));
  return rounded;
}

double area_m2(const Corners& c) { return glm::length(glm::cross(c[1] - c[0], c[2] - c[0])) / 2.0; }

struct Loose {
  std::size_t count = 0;
  double area_m2 = 0.0, mesh_area_m2 = 0.0, thinnest_m = 1e300;
  glm::dvec3 where_m{0.0};
};

// Triangles so thin that rounding their corners to floats turns them.
Loose loose_triangles(const terrain::TriangleMesh& mesh) {
  Loose loose;
  for_triangles(mesh, [&](std::size_t, const Corners& corners) {
    const double step_m =
        float_step_m(std::max({largest_coordinate_m(corners[0]), largest_coordinate_m(corners[1]),
                               largest_coordinate_m(corners[2])}));
    const double whole_m2 = area_m2(corners);
    loose.mesh_area_m2 += whole_m2;
    const double height_m = 2.0 * area_m2(in_floats(corners)) / longest_m(corners);
    if (height_m * kLooseNormal_rad >= step_m) return;
    ++loose.count;
    loose.area_m2 += whole_m2;
    const double true_height_m = 2.0 * whole_m2 / longest_m(corners);
    if (true_height_m < loose.thinnest_m) {
      loose.thinnest_m = true_height_m;
      loose.where_m = corners[0];
    }
  });
  return loose;
}

}  // namespace

void check_coordinates(const DoctorParts& parts, Findings& findings) {
  glm::dvec3 farthest_m(0.0);
  std::string what = "terrain";
  const auto look = [&](const glm::dvec3& point_m, const std::string& name) {
    if (largest_coordinate_m(point_m) <= largest_coordinate_m(farthest_m)) return;
    farthest_m = point_m;
    what = name;
  };
  const terrain::HeightField& field = parts.ground.field();
  const auto [low, high] = std::minmax_element(field.height_m.begin(), field.height_m.end());
  look({field.west_m, field.south_m, *low}, what);
  look({field.east_m(), field.north_m(), *high}, what);
  for (const Body& body : parts.bodies)
    for (const glm::dvec3& vertex : body.placed.mesh.vertices_m) look(vertex, body.name);
  for (const Sight& sight : parts.flight) look(sight.antenna.position_m, "trajectory");
  const double error_m = float_step_m(largest_coordinate_m(farthest_m)) / parts.far_sine;
  const double cell_m = parts.sensor().range.cell_m;
  if (error_m < kCellPart * cell_m) return;
  findings.push_back(
      {error_m < cell_m ? Severity::delicate : Severity::wrong, "far-coordinates",
       what + " lies so far from the scene's origin that ranges may be off by this much",
       place_text(parts.scene, farthest_m), error_m, "m",
       "The ray caster works in floats from the origin on, and a step of height moves a grazing "
       "hit "
       "by that over the sine of the angle.",
       "Put the scene's origin at the airport and cut the terrain to what the radar sees."});
}

void check_triangle_sizes(const DoctorParts& parts, Findings& findings) {
  double largest_m = parts.ground.field().spacing_m * std::sqrt(2.0);
  std::string largest_name = "terrain";
  for (const Body& body : parts.bodies)
    for_triangles(body.placed.mesh, [&](std::size_t, const Corners& corners) {
      const double edge_m = longest_m(corners);
      if (edge_m <= largest_m) return;
      largest_m = edge_m;
      largest_name = body.name;
    });
  for (const Body& body : parts.bodies) {
    double smallest_m = 1e300;
    glm::dvec3 where_m(0.0);
    for_triangles(body.placed.mesh, [&](std::size_t, const Corners& corners) {
      const double edge_m = shortest_m(corners);
      if (edge_m >= smallest_m) return;
      smallest_m = edge_m;
      where_m = corners[0];
    });
    if (smallest_m > 0.0 && smallest_m < 1e300 && largest_m / smallest_m >= kLargestRatio)
      findings.push_back(
          {Severity::delicate, "triangle-sizes",
           "the longest edge (" + core::number_text(std::round(largest_m)) + " m, " + largest_name +
               ") is this many times the shortest one",
           body.name + ", " + place_text(parts.scene, where_m), largest_m / smallest_m, "",
           "A hit is uncertain by the rounding of the largest triangle near it, here by more than "
           "an "
           "eighth of the smallest.",
           "Cut the huge triangle into pieces of about the size of the scene's terrain posts, or "
           "leave out detail that no range cell resolves."});
    const Loose loose = loose_triangles(body.placed.mesh);
    if (loose.count > 0)
      findings.push_back(
          {loose.area_m2 > 1e-3 * loose.mesh_area_m2 ? Severity::delicate : Severity::note,
           "thin-triangles",
           std::to_string(loose.count) +
               " triangles are so thin that floats turn or flatten them; the thinnest is this high",
           body.name + ", " + place_text(parts.scene, loose.where_m), loose.thinnest_m, "m",
           "Its direction, and with it the grazing angle, follows the rounding of its corners by "
           "more than a degree.",
           "Remove needles and detail below a centimetre from the model."});
  }
}

void check_duplicates(const DoctorParts& parts, Findings& findings) {
  for (const core::Problem& problem : parts.warnings)
    if (problem.code == "W-DEGENERATE")
      findings.push_back(
          {Severity::note, "degenerate-triangles",
           "removed on loading: " + problem.value + ", " + problem.field, place_text(problem.place),
           std::strtod(problem.value.c_str(), nullptr), "",
           "They have no direction or lie in each other; left in, they would make NaN or chance.",
           "Nothing has to be done; clean the model if the number is a surprise."});

  using Key = std::array<std::array<float, 3>, 3>;
  struct First {
    std::size_t body = 0, count = 0;
    terrain::MaterialId material = 0;
  };
  std::map<Key, First> seen;
  // By the two bodies: triangles shared, those of other material, and one place.
  struct Shared {
    std::size_t count = 0, differing = 0;
    glm::dvec3 where_m{0.0};
  };
  std::map<std::pair<std::size_t, std::size_t>, Shared> shared;
  for (std::size_t b = 0; b < parts.bodies.size(); ++b) {
    const terrain::PlacedMesh& placed = parts.bodies[b].placed;
    for_triangles(placed.mesh, [&](std::size_t i, const Corners& corners) {
      Key key{};
      for (std::size_t c = 0; c < 3; ++c)
        key[c] = {static_cast<float>(corners[c].x), static_cast<float>(corners[c].y),
                  static_cast<float>(corners[c].z)};
      std::sort(key.begin(), key.end());
      const terrain::MaterialId material =
          placed.material_of_name.at(placed.mesh.triangle_material[i]);
      const auto [at, is_new] = seen.try_emplace(key, First{b, 0, material});
      if (is_new || at->second.body == b) return;  // two sides of a sheet share their corners
      Shared& pair = shared[{at->second.body, b}];
      if (pair.count++ == 0) pair.where_m = corners[0];
      if (at->second.material != material) ++pair.differing;
    });
  }
  for (const auto& [pair, found] : shared)
    findings.push_back(
        {found.differing > 0 ? Severity::wrong : Severity::note, "duplicate-triangles",
         std::to_string(found.count) + " triangles lie exactly in those of " +
             parts.bodies[pair.first].name +
             (found.differing > 0
                  ? ", " + std::to_string(found.differing) + " with another material"
                  : ", all of the same material"),
         parts.bodies[pair.second].name + ", " + place_text(parts.scene, found.where_m),
         static_cast<double>(found.count), "",
         found.differing > 0 ? "Which of the two a ray meets is chance, and with it the material."
                             : "The picture is the same, each ray just takes longer.",
         "Remove one of the two objects."});
}

}  // namespace fanbeam::scenes
