// All surfaces of a scene in one Embree scene: the only place that talks to the ray-casting
// library.
//
// Coordinates inside the caster are floats, east and north from the scene's origin, which lies near
// the airport, up from a height near that of the ground there (`in_caster_m`): what is added to all
// heights costs no digits. With vertices and sensor within 10 km of the origin a range is good to
// 25 mm worst case and 0.15 mm median. The robust flag is on unless switched off to measure it:
// rays aimed at shared edges are not lost. Instances of this class are read-only after construction and safe to use from many threads. Embree's error callback
// turns its errors into exceptions of ours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "terrain/height_field.h"
#include "terrain/mesh.h"
#include "terrain/mesh_tops.h"
#include "terrain/surface_map.h"

namespace fanbeam::terrain {

inline constexpr std::uint32_t kNoHit = 0xFFFFFFFFU;
inline constexpr std::uint32_t kTerrainGeometry =
    0;  // the terrain's geometry number when there is one

// N rays and their hits side by side. The layout is Embree's own ray packet, so nothing is copied
// around a cast. Directions need not be unit vectors; `distance` is in units of their length (`far`
// before the cast, hit distance after it). The normal is not normalised.
template <int N>
struct alignas(N * 4) RayPacket {
  float origin_x[N], origin_y[N], origin_z[N];
  float near[N];
  float direction_x[N], direction_y[N], direction_z[N];
  float time[N];
  float distance[N];
  std::uint32_t mask[N], id[N], flags[N];
  float normal_x[N], normal_y[N], normal_z[N];
  float u[N], v[N];
  std::uint32_t primitive[N], geometry[N], instance[N];

  // Makes lane `i` a ray that has hit nothing yet.
  void aim(int i, const glm::dvec3& origin_m, const glm::dvec3& direction, double far_m) noexcept {
    origin_x[i] = static_cast<float>(origin_m.x);
    origin_y[i] = static_cast<float>(origin_m.y);
    origin_z[i] = static_cast<float>(origin_m.z);
    near[i] = 0.0F;
    direction_x[i] = static_cast<float>(direction.x);
    direction_y[i] = static_cast<float>(direction.y);
    direction_z[i] = static_cast<float>(direction.z);
    time[i] = 0.0F;
    distance[i] = static_cast<float>(far_m);
    mask[i] = 0xFFFFFFFFU;
    id[i] = 0;
    flags[i] = 0;
    geometry[i] = kNoHit;
    instance[i] = kNoHit;
  }
};

// What the rays of a packet have in common, which tells the library a way through its tree: begin and
// go nearly alike, or each its own way. What is hit does not depend on it, but for a ray that meets
// two facets at one distance.
enum class Packing { alike, apart };

// A mesh in local metres together with the material id of each of its triangles.
struct PlacedMesh {
  TriangleMesh mesh;
  std::vector<MaterialId> material_of_name;  // parallel to mesh.material_names
  std::vector<ObjectId> object_of_part{};    // empty: kTerrainObject
};

struct SceneHit {
  double distance_m = 0.0;
  glm::dvec3 normal{0.0};  // unit, towards the outside of the surface
  MaterialId material = 0;
  std::uint32_t geometry = 0;
};

class RayScene {
 public:
  // `terrain` may be absent. `instruction_set` limits Embree: "sse4.2", "avx", "avx2", "avx512";
  // empty, that of core::instruction_limit(), and without a limit the best that Embree finds.
  RayScene(std::optional<HeightField> terrain, std::vector<SurfacePatch> patches,
           const std::vector<PlacedMesh>& meshes, const std::string& instruction_set = "",
           bool robust = true);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // Nearest hits; `active` has all bits set (-1) for lanes to cast and 0 elsewhere. Origins are
  // `in_caster_m`. Rays must be finite with near >= 0 and |coordinate| < 1e18: the packaged library
  // ends the process otherwise. The casters build rays from checked poses; rays from elsewhere go
  // through `check_ray`.
  void intersect(const int* active, RayPacket<8>& packet,
                 Packing packing = Packing::alike) const noexcept;
  void intersect(const int* active, RayPacket<16>& packet,
                 Packing packing = Packing::alike) const noexcept;

  // The same question without where, of rays that lie apart: `distance` becomes negative for active
  // lanes that meet something nearer than it, and stays for others.
  void find_occluded(const int* active, RayPacket<8>& packet) const noexcept;
  void find_occluded(const int* active, RayPacket<16>& packet) const noexcept;

  // Where a packet's ray must start for one that starts here in the scene, and the way back.
  glm::dvec3 in_caster_m(const glm::dvec3& scene_m) const noexcept {
    return {scene_m.x, scene_m.y, scene_m.z - base_m_};
  }
  glm::dvec3 in_scene_m(const glm::dvec3& caster_m) const noexcept {
    return {caster_m.x, caster_m.y, caster_m.z + base_m_};
  }

  // One ray in double precision, checked: R12's inputs are InputError E-NONFINITE or E-RANGE.
  std::optional<SceneHit> intersect(const glm::dvec3& origin_m, const glm::dvec3& direction,
                                    double far_m) const;
  // True when something lies between the two points, `clearance_m` before the second one.
  bool occluded(const glm::dvec3& from_m, const glm::dvec3& to_m, double clearance_m) const;

  // Material of a hit: land cover and patches for the terrain, the triangle's own otherwise.
  MaterialId material(std::uint32_t geometry, std::uint32_t primitive, double x_m,
                      double y_m) const noexcept {
    if (has_terrain_ && geometry == kTerrainGeometry) return surface_map_->material_at(x_m, y_m);
    return mesh_material_[geometry][primitive];
  }

  // What was hit belongs to: ground and what is painted on it, or a part of a mesh.
  ObjectId object(std::uint32_t geometry, std::uint32_t primitive, double x_m,
                  double y_m) const noexcept {
    if (has_terrain_ && geometry == kTerrainGeometry)
      return surface_map_->cover_at(x_m, y_m).object;
    return mesh_object_[geometry].empty() ? kTerrainObject : mesh_object_[geometry][primitive];
  }

  // Corners of a triangle that was hit: the posts of the terrain, or what the library keeps of a
  // mesh (floats). For checks, not for the ray loop.
  std::array<glm::dvec3, 3> triangle(std::uint32_t geometry, std::uint32_t primitive) const;

  // How many geometries there are, the terrain among them, and triangles of a mesh: what to go
  // through with object() and triangle().
  std::size_t geometry_count() const { return mesh_material_.size(); }
  std::size_t mesh_triangles(std::uint32_t geometry) const {
    return mesh_material_[geometry].size();
  }

  const HeightField* terrain() const { return has_terrain_ ? &terrain_ : nullptr; }
  // Over the ground's border where there is none below; over the origin's height without ground.
  double height_above_ground_m(const glm::dvec3& at_m) const {
    return has_terrain_ ? at_m.z - terrain_.nearest_height(at_m.x, at_m.y) : at_m.z;
  }
  // On the ground or below it; false where there is none.
  bool in_ground(const glm::dvec3& at_m) const {
    const auto ground_m = has_terrain_ ? terrain_.height_at(at_m.x, at_m.y) : std::nullopt;
    return ground_m && at_m.z <= *ground_m;
  }
  const SurfaceMap* surface_map() const { return surface_map_.get(); }
  bool empty() const { return triangle_count_ == 0; }
  bool has_meshes() const { return has_meshes_; }
  std::size_t triangle_count() const { return triangle_count_; }
  // Widest packet that the library runs natively here: 16 with AVX-512, 8 otherwise.
  int native_packet() const { return native_packet_; }

  // Upper bound of the height of mesh geometry (terrain/mesh_tops.h). Guides the elevation fan.
  double mesh_top_m(double x_m, double y_m) const noexcept { return tops_.top_m(x_m, y_m); }
  // Points so far apart miss no top; it stands no farther than tops_reach_m from where it was found.
  static constexpr double kTopsStep_m = 2.0 * MeshTops::kBeside_m;
  double tops_reach_m() const noexcept { return tops_.spacing_m() + MeshTops::kBeside_m; }

 private:
  struct Library;
  void find_base(const std::vector<PlacedMesh>& meshes);
  void add_terrain();
  void add_mesh(const PlacedMesh& placed);

  std::unique_ptr<Library> library_;
  bool has_terrain_ = false;
  bool has_meshes_ = false;
  double base_m_ = 0.0;  // height in the scene of the caster's zero
  HeightField terrain_;
  std::unique_ptr<SurfaceMap> surface_map_;
  std::vector<std::vector<MaterialId>>
      mesh_material_;                               // [geometry][triangle]; empty for the terrain
  std::vector<std::vector<ObjectId>> mesh_object_;  // the same; empty where none was named
  std::size_t triangle_count_ = 0;
  int native_packet_ = 8;
  MeshTops tops_;
};

// "embree 3.13.5": what casts, for records.
std::string ray_library();

// Throws InputError E-NONFINITE or E-RANGE for a ray that the library must not see.
void check_ray(const glm::dvec3& origin_m, const glm::dvec3& direction, double near_m,
               double far_m);

}  // namespace fanbeam::terrain
