// How far coordinates and how thin or unequal triangles may be: T01, T12 of the hard cases.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/doctor/parts_private.h"
#include "scenes/doctor/triangles_private.h"

namespace fanbeam::scenes {
namespace {

// A surface may be off by this part of a range cell, or its direction by this angle, before it
// counts.
constexpr double kCellPart = 0.1;
constexpr double kLooseNormal_rad = 0.0175;
// Beyond it less than three bits of a float remain for the small triangle.
constexpr double kLargestRatio = 1048576.0;

double longest_m(const Corners& c) {
  return std::max(
      {glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
}
double shortest_m(const Corners& c) {
  return std::min(
      {glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
}

// As the ray caster keeps it.
Corners as_kept(const DoctorParts& parts, const Corners& corners) {
  Corners kept = corners;
  for (glm::dvec3& corner : kept) corner = glm::dvec3(glm::vec3(parts.in_caster_m(corner)));
  return kept;
}

double area_m2(const Corners& c) { return glm::length(glm::cross(c[1] - c[0], c[2] - c[0])) / 2.0; }

struct Loose {
  std::size_t count = 0;
  double area_m2 = 0.0, mesh_area_m2 = 0.0, thinnest_m = 1e300;
  glm::dvec3 where_m{0.0};
};

// Triangles so thin that rounding their corners to floats turns them.
Loose loose_triangles(const DoctorParts& parts, const terrain::TriangleMesh& mesh) {
  Loose loose;
  for_triangles(mesh, [&](std::size_t, const Corners& corners) {
    const double step_m =
        std::max({float_step_m(parts, corners[0]), float_step_m(parts, corners[1]),
                  float_step_m(parts, corners[2])});
    const double whole_m2 = area_m2(corners);
    loose.mesh_area_m2 += whole_m2;
    const double height_m = 2.0 * area_m2(as_kept(parts, corners)) / longest_m(corners);
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
  double step_m = 0.0;
  std::string what = "terrain";
  const auto look = [&](const glm::dvec3& point_m, const std::string& name) {
    const double step_there_m = float_step_m(parts, point_m);
    if (step_there_m <= step_m) return;
    step_m = step_there_m;
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
  const double error_m = step_m / parts.far_sine;
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
    const Loose loose = loose_triangles(parts, body.placed.mesh);
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

}  // namespace fanbeam::scenes
