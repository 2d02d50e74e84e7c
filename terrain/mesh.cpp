#include "terrain/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace fanbeam::terrain {
namespace {

// A hostile mesh may be wrong everywhere; nobody reads more than this.
constexpr int kMostReported = 50;

class MeshCheck {
 public:
  MeshCheck(const TriangleMesh& mesh, const std::string& file, core::ProblemList& problems)
      : mesh_(mesh), file_(file), problems_(problems) {}

  bool passes() {
    for (std::size_t i = 0; i < mesh_.vertices_m.size() && reported_ < kMostReported; ++i)
      check_vertex(i);
    for (std::size_t i = 0; i < mesh_.triangles.size() && reported_ < kMostReported; ++i)
      check_triangle(i);
    return reported_ == 0;
  }

 private:
  void check_vertex(std::size_t i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double coordinate_m = mesh_.vertices_m[i][axis];
      const auto where = [&] { return "vertex " + std::to_string(i) + "." + "xyz"[axis]; };
      if (!std::isfinite(coordinate_m)) {
        report(core::ErrorClass::nonfinite, where(), core::number_text(coordinate_m),
               "a finite number of metres");
      } else if (std::abs(coordinate_m) > kLargestCoordinate_m) {
        report(core::ErrorClass::range, where(), core::number_text(coordinate_m), "-1e6 to 1e6 m");
      }
    }
  }

  void check_triangle(std::size_t i) {
    for (int corner = 0; corner < 3; ++corner)
      check_reference("triangle " + std::to_string(i), mesh_.triangles[i][corner],
                      mesh_.vertices_m.size(), "vertices");
    check_reference("triangle_material " + std::to_string(i), mesh_.triangle_material[i],
                    mesh_.material_names.size(), "materials");
  }

  void check_reference(const std::string& element, std::uint32_t index, std::size_t count,
                       const std::string& what) {
    if (index >= count)
      report(core::ErrorClass::ref, element, std::to_string(index),
             "an index below the " + std::to_string(count) + " " + what);
  }

  void report(core::ErrorClass error_class, const std::string& element, std::string value,
              std::string expected) {
    problems_.error(error_class, core::Place{file_}, "mesh '" + mesh_.name + "' " + element,
                    std::move(value), std::move(expected));
    ++reported_;
  }

  const TriangleMesh& mesh_;
  const std::string& file_;
  core::ProblemList& problems_;
  int reported_ = 0;
};

// True when the smallest height of the triangle is within the rounding of its coordinates: three
// points computed on one line rarely give a cross product of exactly zero.
bool is_degenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  double largest_m = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    largest_m = std::max({largest_m, std::abs(a[axis]), std::abs(b[axis]), std::abs(c[axis])});
  const double rounding_m = 16.0 * std::numeric_limits<double>::epsilon() * largest_m;
  const double longest_m = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
  return glm::length(glm::cross(b - a, c - a)) <= rounding_m * longest_m;
}

// For every vertex the lowest index of a vertex at the same position.
std::vector<std::uint32_t> first_vertex_at_position(const std::vector<glm::dvec3>& vertices_m) {
  std::vector<std::uint32_t> order(vertices_m.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    const glm::dvec3& v = vertices_m[i];
    return std::make_tuple(v.x, v.y, v.z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return key(i) != key(j) ? key(i) < key(j) : i < j;
  });
  std::vector<std::uint32_t> first(vertices_m.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    first[order[k]] = k > 0 && key(order[k]) == key(order[k - 1]) ? first[order[k - 1]] : order[k];
  return first;
}

// Marks every triangle that repeats an earlier one: same corners in the same turning sense,
// whichever corner comes first. The two sides of a thin sheet turn differently and both stay.
std::size_t mark_duplicates(const TriangleMesh& mesh, std::vector<bool>& removed) {
  const std::vector<std::uint32_t> first = first_vertex_at_position(mesh.vertices_m);
  using Corners = std::array<std::uint32_t, 3>;
  std::vector<std::pair<Corners, std::size_t>> sorted;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (removed[i]) continue;
    const glm::uvec3& t = mesh.triangles[i];
    Corners corners = {first[t.x], first[t.y], first[t.z]};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    sorted.emplace_back(corners, i);
  }
  std::sort(sorted.begin(), sorted.end());
  std::size_t duplicates = 0;
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    if (sorted[k].first != sorted[k - 1].first) continue;
    removed[sorted[k].second] = true;
    ++duplicates;
  }
  return duplicates;
}

void erase_marked(TriangleMesh& mesh, const std::vector<bool>& removed) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (removed[i]) continue;
    mesh.triangles[kept] = mesh.triangles[i];
    mesh.triangle_material[kept] = mesh.triangle_material[i];
    if (!mesh.triangle_part.empty()) mesh.triangle_part[kept] = mesh.triangle_part[i];
    ++kept;
  }
  mesh.triangles.resize(kept);
  mesh.triangle_material.resize(kept);
  if (!mesh.triangle_part.empty()) mesh.triangle_part.resize(kept);
}

}  // namespace

void check_and_clean(TriangleMesh& mesh, const std::string& file, core::ProblemList& problems) {
  if (mesh.triangle_material.size() != mesh.triangles.size())
    throw core::InternalError("mesh '" + mesh.name + "' needs one material per triangle");
  if (!mesh.triangle_part.empty() && mesh.triangle_part.size() != mesh.triangles.size())
    throw core::InternalError("mesh '" + mesh.name + "' needs one part per triangle, or none");
  if (!MeshCheck(mesh, file, problems).passes()) return;

  std::vector<bool> removed(mesh.triangles.size(), false);
  std::size_t without_area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    removed[i] = is_degenerate(mesh.vertices_m[t.x], mesh.vertices_m[t.y], mesh.vertices_m[t.z]);
    if (removed[i]) ++without_area;
  }
  const std::size_t duplicates = mark_duplicates(mesh, removed);
  if (without_area + duplicates == 0) return;
  erase_marked(mesh, removed);
  problems.warning("DEGENERATE", core::Place{file}, "mesh '" + mesh.name + "'",
                   std::to_string(without_area) + " triangles without area, " +
                       std::to_string(duplicates) + " exact duplicates",
                   "removed");
}

std::size_t count_borders(const TriangleMesh& mesh, const std::vector<bool>& materials) {
  const std::vector<std::uint32_t> first = first_vertex_at_position(mesh.vertices_m);
  // The lower end, the other one, which comes first (bit 1), one of the materials (bit 0).
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t from = first[mesh.triangles[i][k]];
      const std::uint64_t to = first[mesh.triangles[i][(k + 1) % 3]];
      edges.push_back((std::min(from, to) << 33U) | (std::max(from, to) << 2U) |
                      (from < to ? 2U : 0U) | (materials[mesh.triangle_material[i]] ? 1U : 0U));
    }
  std::sort(edges.begin(), edges.end());
  std::size_t borders = 0;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    bool is_run[2] = {false, false};  // this way, that way
    std::size_t asked = 0;
    for (; end < edges.size() && edges[end] >> 2U == edges[begin] >> 2U; ++end) {
      is_run[(edges[end] >> 1U) & 1U] = true;
      asked += edges[end] & 1U;
    }
    if (is_run[0] != is_run[1]) borders += asked;
  }
  return borders;
}

}  // namespace fanbeam::terrain
