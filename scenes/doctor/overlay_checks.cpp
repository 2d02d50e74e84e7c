// What lies in or just over the ground (T07), or is thinner than a ray (R09).
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/casting/sampling.h"
#include "scenes/doctor/parts_private.h"

namespace fanbeam::scenes {
namespace {

constexpr double kOverlay_m = 0.25;      // higher than that it is an object, not an overlay
constexpr double kParallel = 0.985;      // cosine of 10 deg
constexpr double kCoplanarSteps = 16.0;  // float steps within which either surface may win
constexpr double kSmallOverlay_m2 = 10.0;
constexpr double kSmallShare = 0.01;  // of an object: a few sunken roofs of a town

struct Overlay {
  double all_m2 = 0.0, coplanar_m2 = 0.0, crossing_m2 = 0.0, gap_m = 0.0;
  glm::dvec3 where_m{0.0};
};

// Slope of the ground there, as a unit normal.
glm::dvec3 ground_normal(const terrain::HeightField& field, double x_m, double y_m) {
  const double d_m = field.spacing_m / 4.0;
  const auto height_m = [&](double x, double y) { return field.height_at(x, y).value_or(0.0); };
  return glm::normalize(glm::dvec3(height_m(x_m - d_m, y_m) - height_m(x_m + d_m, y_m),
                                   height_m(x_m, y_m - d_m) - height_m(x_m, y_m + d_m), 2.0 * d_m));
}

void look_at_triangle(const DoctorParts& parts, const std::array<glm::dvec3, 3>& c,
                      Overlay& overlay) {
  const terrain::HeightField& field = parts.ground.field();
  const glm::dvec3 cross = glm::cross(c[1] - c[0], c[2] - c[0]);
  const double area_m2 = glm::length(cross) / 2.0;
  overlay.all_m2 += area_m2;
  if (!(area_m2 > 0.0) || std::abs(cross.z) < 0.9 * glm::length(cross)) return;
  double lowest_m = 1e300, highest_m = -1e300;
  for (const glm::dvec3& point : {c[0], c[1], c[2], (c[0] + c[1]) / 2.0, (c[1] + c[2]) / 2.0,
                                  (c[2] + c[0]) / 2.0, (c[0] + c[1] + c[2]) / 3.0}) {
    const auto ground_m = field.height_at(point.x, point.y);
    if (!ground_m || std::abs(point.z - *ground_m) > kOverlay_m) return;
    lowest_m = std::min(lowest_m, point.z - *ground_m);
    highest_m = std::max(highest_m, point.z - *ground_m);
  }
  const glm::dvec3 middle = (c[0] + c[1] + c[2]) / 3.0;
  if (std::abs(glm::dot(glm::normalize(cross), ground_normal(field, middle.x, middle.y))) <
      kParallel)
    return;
  const double gap_m = std::max(std::abs(lowest_m), std::abs(highest_m));
  const bool coplanar = gap_m <= kCoplanarSteps * float_step_m(parts, middle);
  if (!coplanar && !(lowest_m < 0.0 && highest_m > 0.0)) return;
  (coplanar ? overlay.coplanar_m2 : overlay.crossing_m2) += area_m2;
  if (gap_m >= overlay.gap_m) {
    overlay.gap_m = gap_m;
    overlay.where_m = middle;
  }
}

// Width and height across the line of sight, seen from there.
glm::dvec2 presented_m(const std::vector<glm::dvec3>& outline_m, const glm::dvec3& from_m,
                       const glm::dvec3& middle_m) {
  const glm::dvec3 sight = glm::normalize(middle_m - from_m);
  const glm::dvec3 right = glm::normalize(glm::cross(sight, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 up = glm::cross(right, sight);
  glm::dvec2 low_m(1e300), high_m(-1e300);
  for (const glm::dvec3& point : outline_m) {
    const glm::dvec2 across_m(glm::dot(point, right), glm::dot(point, up));
    low_m = glm::min(low_m, across_m);
    high_m = glm::max(high_m, across_m);
  }
  return high_m - low_m;
}

// All corners of something simple, else those of the box around it.
std::vector<glm::dvec3> outline_of(const terrain::TriangleMesh& mesh, glm::dvec3& low_m,
                                   glm::dvec3& high_m) {
  low_m = glm::dvec3(1e300);
  high_m = glm::dvec3(-1e300);
  for (const glm::dvec3& vertex : mesh.vertices_m) {
    low_m = glm::min(low_m, vertex);
    high_m = glm::max(high_m, vertex);
  }
  if (mesh.vertices_m.size() <= 64) return mesh.vertices_m;
  return {low_m, {low_m.x, high_m.y, low_m.z}, {high_m.x, low_m.y, low_m.z}, high_m};
}

}  // namespace

void check_overlays(const DoctorParts& parts, Findings& findings) {
  for (const Body& body : parts.bodies) {
    Overlay overlay;
    const terrain::TriangleMesh& mesh = body.placed.mesh;
    for (const glm::uvec3& t : mesh.triangles)
      look_at_triangle(parts, {mesh.vertices_m[t.x], mesh.vertices_m[t.y], mesh.vertices_m[t.z]},
                       overlay);
    const bool coplanar = overlay.coplanar_m2 > 0.0;
    const double found_m2 = coplanar ? overlay.coplanar_m2 : overlay.crossing_m2;
    if (!(found_m2 > 0.0)) continue;
    const bool small = found_m2 < kSmallOverlay_m2 || found_m2 < kSmallShare * overlay.all_m2;
    findings.push_back(
        {small      ? Severity::note
         : coplanar ? Severity::wrong
                    : Severity::delicate,
         coplanar ? "coplanar-overlay" : "overlay-crosses-ground",
         coplanar ? "faces of this area lie in the ground itself"
                  : "faces of this area dip into the ground and come out again, by up to " +
                        core::number_text(std::round(overlay.gap_m * 1000.0) / 1000.0) + " m",
         body.name + ", " + place_text(parts.scene, overlay.where_m), found_m2, "m2",
         coplanar ? "Rounding decides ray by ray which of two surfaces in one plane is seen."
                  : "The picture shows a pattern of the two surfaces that follows the terrain's "
                    "posts.",
         "Paint it with [[surface]] or [[runway]], which have no height of their own, or raise "
         "it."});
  }
}

void check_thin_bodies(const DoctorParts& parts, Findings& findings) {
  const sensors::Sensor& sensor = parts.sensor();
  const double asked = parts.scene.description.rays_per_cell;
  const double per_column =
      renderer::sampling_for(asked > 0.0 ? asked : renderer::kDefaultRaysPerCell).sub_columns;
  const double spacing_rad = sensor.scan.column_width_rad() / per_column;
  const double row_rad = sensor.display.cscope_span_rad / sensor.display.cscope_rows;
  for (const Body& body : parts.bodies) {
    if (!body.single || body.placed.mesh.vertices_m.empty()) continue;
    glm::dvec3 low_m, high_m;
    const std::vector<glm::dvec3> outline_m = outline_of(body.placed.mesh, low_m, high_m);
    const glm::dvec3 middle_m = (low_m + high_m) / 2.0;
    // Of the size over the distance of two rays: at its best and at its worst.
    double best = 0.0, worst = 1e300, worst_range_m = 0.0;
    for (const Sight& sight : parts.sights) {
      const double range_m = range_in_view_m(parts, sight, middle_m);
      if (!(range_m > 0.0)) continue;
      const glm::dvec2 size_m = presented_m(outline_m, sight.antenna.position_m, middle_m);
      double rays = size_m.x / (range_m * spacing_rad);
      if (body.floating) rays = std::min(rays, size_m.y / (range_m * row_rad));
      best = std::max(best, rays);
      if (rays < worst) worst_range_m = range_m;
      worst = std::min(worst, rays);
    }
    if (!(worst < 1.0)) continue;
    findings.push_back(
        {best < 1.0 ? Severity::delicate : Severity::note, "thinner-than-a-ray",
         "seen from " + core::number_text(std::round(worst_range_m)) +
             " m it covers only this part of the distance between two rays" +
             (best < 1.0 ? ", and never a whole one" : ""),
         body.name + ", " + place_text(parts.scene, middle_m), worst, "",
         "Rays meet it by luck, so that it flickers from frame to frame.",
         best < 1.0 ? "Describe it as [[line]] or [[target]]: points cannot be missed."
                    : "Ask for more --rays-per-cell or an --accuracy if it matters that far out."});
  }
}

}  // namespace fanbeam::scenes
