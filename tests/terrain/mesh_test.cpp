#include "terrain/mesh.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

namespace fanbeam::terrain {
namespace {

// A cube of 1 m with eight vertices and twelve triangles, every second one of material 1.
TriangleMesh cube() {
  TriangleMesh mesh;
  mesh.name = "truck";
  for (int i = 0; i < 8; ++i) mesh.vertices_m.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (std::uint32_t i = 0; i < 12; ++i) mesh.triangle_material.push_back(i % 2);
  mesh.material_names = {"metal", "glass"};
  return mesh;
}

void add_triangle(TriangleMesh& mesh, const glm::uvec3& triangle) {
  mesh.triangles.push_back(triangle);
  mesh.triangle_material.push_back(0);
}

std::uint32_t add_vertex(TriangleMesh& mesh, const glm::dvec3& vertex) {
  mesh.vertices_m.push_back(vertex);
  return static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
}

const core::Problem& only_problem(const core::ProblemList& problems) {
  REQUIRE(problems.all().size() == 1);
  return problems.all().front();
}

TEST_CASE("T08 degenerate and duplicate triangles leave the clean mesh behind", "[mesh]") {
  const TriangleMesh clean = cube();
  TriangleMesh mesh = cube();
  add_triangle(mesh, {3, 3, 5});  // repeated index
  add_triangle(mesh, {2, 2, 2});  // all equal
  const std::uint32_t same_place = add_vertex(mesh, mesh.vertices_m[7]);
  add_triangle(mesh, {7, same_place, 0});  // zero-length edge between two indices
  // Collinear in exact arithmetic; in double the cross product is rounding, not zero.
  const glm::dvec3 step(0.1, 0.7, -0.3);
  const std::uint32_t first = add_vertex(mesh, 1000.1 * step);
  add_vertex(mesh, 1001.7 * step);
  add_vertex(mesh, 1003.9 * step);
  add_triangle(mesh, {first, first + 1, first + 2});
  add_triangle(mesh, mesh.triangles[4]);  // exact duplicate
  add_triangle(mesh, {2, 1, 0});          // triangle 0 from another corner
  const std::uint32_t copy_of_5 = add_vertex(mesh, mesh.vertices_m[5]);
  add_triangle(mesh, {3, same_place, copy_of_5});  // triangle 11 through other indices

  core::ProblemList problems;
  check_and_clean(mesh, "truck.glb", problems);

  CHECK(mesh.triangles == clean.triangles);
  CHECK(mesh.triangle_material == clean.triangle_material);
  const core::Problem& warning = only_problem(problems);
  CHECK(warning.code == "W-DEGENERATE");
  CHECK(warning.place.file == "truck.glb");
  CHECK(warning.field == "mesh 'truck'");
  CHECK(warning.value == "4 triangles without area, 3 exact duplicates");
}

TEST_CASE("T08 vertices at zero and at minus zero are the same place", "[mesh]") {
  TriangleMesh mesh = cube();
  const std::uint32_t minus_zero = add_vertex(mesh, {-0.0, 0.0, -0.0});
  add_triangle(mesh, {minus_zero, 2, 1});
  core::ProblemList problems;
  check_and_clean(mesh, "", problems);
  CHECK(mesh.triangles == cube().triangles);
}

TEST_CASE("T08 both sides of a sheet and thin triangles are kept", "[mesh]") {
  TriangleMesh mesh;
  mesh.name = "sheet";
  mesh.material_names = {"metal"};
  // 1 m long and 1 micrometre high at 100 km from the origin: thin, and real.
  mesh.vertices_m = {{1e5, 0, 0}, {1e5 + 1.0, 0, 0}, {1e5, 1e-6, 0}};
  add_triangle(mesh, {0, 1, 2});
  add_triangle(mesh, {0, 2, 1});
  core::ProblemList problems;
  check_and_clean(mesh, "", problems);
  CHECK(mesh.triangles.size() == 2);
  CHECK(problems.all().empty());
}

TEST_CASE("T09 non-finite and absurd vertices are named", "[mesh]") {
  struct Case {
    double coordinate_m;
    std::string code;
  };
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Case& c :
       {Case{std::nan(""), "E-NONFINITE"}, Case{infinity, "E-NONFINITE"},
        Case{-infinity, "E-NONFINITE"}, Case{2e18, "E-RANGE"}, Case{-1.0000001e6, "E-RANGE"}}) {
    TriangleMesh mesh = cube();
    mesh.vertices_m[6].z = c.coordinate_m;
    core::ProblemList problems;
    check_and_clean(mesh, "truck.glb", problems);
    CHECK(only_problem(problems).code == c.code);
    CHECK(only_problem(problems).field == "mesh 'truck' vertex 6.z");
    CHECK(mesh.triangles == cube().triangles);
  }
  TriangleMesh mesh = cube();
  mesh.vertices_m[6].z = kLargestCoordinate_m;
  core::ProblemList problems;
  check_and_clean(mesh, "", problems);
  CHECK(problems.all().empty());
}

TEST_CASE("T10 a vertex index past the end is named with its triangle", "[mesh]") {
  for (const std::uint32_t index : {99u, 8u, 0xFFFFFFFFu}) {
    TriangleMesh mesh = cube();
    add_triangle(mesh, {0, 1, index});
    core::ProblemList problems;
    check_and_clean(mesh, "truck.glb", problems);
    CHECK(only_problem(problems).code == "E-REF");
    CHECK(only_problem(problems).field == "mesh 'truck' triangle 12");
    CHECK(only_problem(problems).value == std::to_string(index));
  }
}

TEST_CASE("T10 a material index past the end is named with its triangle", "[mesh]") {
  TriangleMesh mesh = cube();
  mesh.triangle_material[3] = 2;
  core::ProblemList problems;
  check_and_clean(mesh, "", problems);
  CHECK(only_problem(problems).code == "E-REF");
  CHECK(only_problem(problems).field == "mesh 'truck' triangle_material 3");
}

TEST_CASE("an empty mesh is clean", "[mesh]") {
  TriangleMesh mesh;
  core::ProblemList problems;
  check_and_clean(mesh, "", problems);
  CHECK(problems.all().empty());
}

}  // namespace
}  // namespace fanbeam::terrain
