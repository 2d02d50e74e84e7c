#include "terrain/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "core/errors.h"
#include "core/machine.h"

namespace fanbeam::terrain {

static_assert(sizeof(RayPacket<8>) == sizeof(RTCRayHit8) &&
              sizeof(RayPacket<16>) == sizeof(RTCRayHit16));
static_assert(offsetof(RayPacket<16>, direction_x) == offsetof(RTCRayHit16, ray.dir_x));
static_assert(offsetof(RayPacket<16>, normal_x) == offsetof(RTCRayHit16, hit.Ng_x));
static_assert(offsetof(RayPacket<16>, instance) == offsetof(RTCRayHit16, hit.instID));

struct RayScene::Library {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::string error;

  ~Library() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  void throw_on_error() const {
    if (!error.empty()) throw core::InternalError("Embree: " + error);
  }
};

namespace {

void remember_error(void* user, RTCError error, const char* message) {
  auto* text = static_cast<std::string*>(user);
  if (text->empty())
    *text = "error " + std::to_string(static_cast<int>(error)) + ": " +
            (message != nullptr ? message : "");
}

template <class T>
T* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t stride,
              std::size_t count) {
  return static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, stride, count));
}

// The names that Embree 3.13 knows; it takes an unknown one in silence for no limit.
std::string embree_set(std::optional<core::InstructionLevel> limit) {
  if (!limit) return "";
  switch (*limit) {
    case core::InstructionLevel::v4:
      return "avx512";
    case core::InstructionLevel::v3:
      return "avx2";
    default:
      return "sse4.2";
  }
}

RTCIntersectContext context_for(Packing packing) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = packing == Packing::alike ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                            : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

// The thread sanitizer sees nothing of the order that Embree's own threads keep.
#ifdef __SANITIZE_THREAD__
const std::string kBuildThreads = "threads=1,";
#else
const std::string kBuildThreads;
#endif

}  // namespace

RayScene::RayScene(std::optional<HeightField> terrain, std::vector<SurfacePatch> patches,
                   const std::vector<PlacedMesh>& meshes, const std::string& instruction_set,
                   bool robust)
    : library_(std::make_unique<Library>()), has_terrain_(terrain.has_value()) {
  // The number of threads of the build does not change the tree.
  const std::string set =
      instruction_set.empty() ? embree_set(core::instruction_limit()) : instruction_set;
  const std::string configuration = kBuildThreads + (set.empty() ? "" : "isa=" + set);
  library_->device = rtcNewDevice(configuration.c_str());
  if (library_->device == nullptr)
    throw core::InternalError("Embree: no device for \"" + configuration + "\"");
  rtcSetDeviceErrorFunction(library_->device, remember_error, &library_->error);
  library_->scene = rtcNewScene(library_->device);
  rtcSetSceneFlags(library_->scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(library_->scene, RTC_BUILD_QUALITY_HIGH);
  if (has_terrain_) terrain_ = std::move(*terrain);
  find_base(meshes);
  if (has_terrain_) {
    surface_map_ = std::make_unique<SurfaceMap>(terrain_, std::move(patches));
    add_terrain();
  }
  for (const PlacedMesh& mesh : meshes)
    if (!mesh.mesh.triangles.empty()) add_mesh(mesh);
  rtcCommitScene(library_->scene);
  library_->throw_on_error();
  native_packet_ =
      rtcGetDeviceProperty(library_->device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0 ? 16
                                                                                              : 8;
  std::vector<const TriangleMesh*> bodies;
  for (const PlacedMesh& placed : meshes) bodies.push_back(&placed.mesh);
  tops_ = MeshTops(bodies);
}

RayScene::~RayScene() = default;

// A coarse step: scenes whose heights count from the airport keep their own zero.
void RayScene::find_base(const std::vector<PlacedMesh>& meshes) {
  constexpr double kStep_m = 64.0;
  double height_m = 0.0;
  if (has_terrain_) {
    height_m = terrain_.height_at(0.0, 0.0).value_or(terrain_.height_m.front());
  } else if (!meshes.empty() && !meshes.front().mesh.vertices_m.empty()) {
    height_m = meshes.front().mesh.vertices_m.front().z;
  }
  base_m_ = kStep_m * std::round(height_m / kStep_m);
}

void RayScene::add_terrain() {
  RTCGeometry geometry = rtcNewGeometry(library_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto posts =
      static_cast<std::size_t>(terrain_.columns) * static_cast<std::size_t>(terrain_.rows);
  auto* vertex = new_buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 12, posts);
  auto* index = new_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 12,
                                          2 * terrain_.cell_material.size());
  library_->throw_on_error();
  for (int j = 0; j < terrain_.rows; ++j) {
    for (int i = 0; i < terrain_.columns; ++i) {
      *vertex++ = static_cast<float>(terrain_.west_m + terrain_.spacing_m * i);
      *vertex++ = static_cast<float>(terrain_.south_m + terrain_.spacing_m * j);
      *vertex++ = static_cast<float>(terrain_.height_m[terrain_.post(i, j)] - base_m_);
    }
  }
  for (int j = 0; j + 1 < terrain_.rows; ++j) {
    for (int i = 0; i + 1 < terrain_.columns; ++i) {
      const auto sw = static_cast<std::uint32_t>(terrain_.post(i, j));
      const auto nw = static_cast<std::uint32_t>(terrain_.post(i, j + 1));
      for (const std::uint32_t corner : {sw, sw + 1, nw + 1, sw, nw + 1, nw}) *index++ = corner;
    }
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(library_->scene, geometry, kTerrainGeometry);
  rtcReleaseGeometry(geometry);
  mesh_material_.emplace_back();
  mesh_object_.emplace_back();
  triangle_count_ += 2 * terrain_.cell_material.size();
}

void RayScene::add_mesh(const PlacedMesh& placed) {
  const TriangleMesh& mesh = placed.mesh;
  RTCGeometry geometry = rtcNewGeometry(library_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = new_buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 12,
                                   mesh.vertices_m.size());
  auto* index = new_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 12,
                                          mesh.triangles.size());
  library_->throw_on_error();
  for (const glm::dvec3& position_m : mesh.vertices_m) {
    const glm::dvec3 at_m = in_caster_m(position_m);
    for (int axis = 0; axis < 3; ++axis) *vertex++ = static_cast<float>(at_m[axis]);
  }
  std::vector<MaterialId> materials;
  materials.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) *index++ = mesh.triangles[i][corner];
    materials.push_back(placed.material_of_name.at(mesh.triangle_material[i]));
  }
  std::vector<ObjectId> objects;
  if (!placed.object_of_part.empty())
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      objects.push_back(
          placed.object_of_part.at(mesh.triangle_part.empty() ? 0 : mesh.triangle_part[i]));
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(library_->scene, geometry, static_cast<unsigned>(mesh_material_.size()));
  rtcReleaseGeometry(geometry);
  mesh_material_.push_back(std::move(materials));
  mesh_object_.push_back(std::move(objects));
  triangle_count_ += mesh.triangles.size();
  has_meshes_ = true;
}

std::array<glm::dvec3, 3> RayScene::triangle(std::uint32_t geometry,
                                             std::uint32_t primitive) const {
  if (has_terrain_ && geometry == kTerrainGeometry) {
    // As add_terrain numbers them: two triangles per cell, the southern one first.
    const int cell = static_cast<int>(primitive / 2);
    const int i = cell % (terrain_.columns - 1), j = cell / (terrain_.columns - 1);
    const auto post_m = [&](int column, int row) {
      return glm::dvec3(terrain_.west_m + terrain_.spacing_m * column,
                        terrain_.south_m + terrain_.spacing_m * row,
                        terrain_.height_m[terrain_.post(column, row)]);
    };
    const bool southern = primitive % 2 == 0;
    return {post_m(i, j), southern ? post_m(i + 1, j) : post_m(i + 1, j + 1),
            southern ? post_m(i + 1, j + 1) : post_m(i, j + 1)};
  }
  const RTCGeometry mesh = rtcGetGeometry(library_->scene, geometry);
  const auto* const vertices =
      static_cast<const float*>(rtcGetGeometryBufferData(mesh, RTC_BUFFER_TYPE_VERTEX, 0));
  const auto* const indices =
      static_cast<const std::uint32_t*>(rtcGetGeometryBufferData(mesh, RTC_BUFFER_TYPE_INDEX, 0));
  std::array<glm::dvec3, 3> corners{};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const float* const vertex =
        vertices + 3 * static_cast<std::size_t>(indices[3 * std::size_t{primitive} + corner]);
    corners[corner] = in_scene_m({vertex[0], vertex[1], vertex[2]});
  }
  return corners;
}

void RayScene::intersect(const int* active, RayPacket<8>& packet, Packing packing) const noexcept {
  RTCIntersectContext context = context_for(packing);
  rtcIntersect8(active, library_->scene, &context, reinterpret_cast<RTCRayHit8*>(&packet));
}

void RayScene::intersect(const int* active, RayPacket<16>& packet, Packing packing) const noexcept {
  RTCIntersectContext context = context_for(packing);
  rtcIntersect16(active, library_->scene, &context, reinterpret_cast<RTCRayHit16*>(&packet));
}

// A ray packet begins as the library's packet of rays without hits.
void RayScene::find_occluded(const int* active, RayPacket<8>& packet) const noexcept {
  RTCIntersectContext context = context_for(Packing::apart);
  rtcOccluded8(active, library_->scene, &context, reinterpret_cast<RTCRay8*>(&packet));
}

void RayScene::find_occluded(const int* active, RayPacket<16>& packet) const noexcept {
  RTCIntersectContext context = context_for(Packing::apart);
  rtcOccluded16(active, library_->scene, &context, reinterpret_cast<RTCRay16*>(&packet));
}

std::optional<SceneHit> RayScene::intersect(const glm::dvec3& origin_m, const glm::dvec3& direction,
                                            double far_m) const {
  check_ray(origin_m, direction, 0.0, far_m);
  const double length = glm::length(direction);
  if (length == 0.0) return std::nullopt;
  const glm::dvec3 unit = direction / length;
  const glm::dvec3 start_m = in_caster_m(origin_m);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(start_m.x);
  ray.ray.org_y = static_cast<float>(start_m.y);
  ray.ray.org_z = static_cast<float>(start_m.z);
  ray.ray.dir_x = static_cast<float>(unit.x);
  ray.ray.dir_y = static_cast<float>(unit.y);
  ray.ray.dir_z = static_cast<float>(unit.z);
  ray.ray.tfar = static_cast<float>(far_m);
  ray.ray.mask = 0xFFFFFFFFU;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(library_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  SceneHit hit;
  hit.distance_m = static_cast<double>(ray.ray.tfar);
  hit.normal = glm::normalize(glm::dvec3(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z));
  const glm::dvec3 point = origin_m + unit * hit.distance_m;
  hit.geometry = ray.hit.geomID;
  hit.material = material(hit.geometry, ray.hit.primID, point.x, point.y);
  return hit;
}

bool RayScene::occluded(const glm::dvec3& from_m, const glm::dvec3& to_m,
                        double clearance_m) const {
  const glm::dvec3 path = to_m - from_m;
  const double length = glm::length(path);
  if (length <= clearance_m) return false;
  const glm::dvec3 unit = path / length;
  check_ray(from_m, unit, 0.0, length);
  const glm::dvec3 start_m = in_caster_m(from_m);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray{};
  ray.org_x = static_cast<float>(start_m.x);
  ray.org_y = static_cast<float>(start_m.y);
  ray.org_z = static_cast<float>(start_m.z);
  ray.dir_x = static_cast<float>(unit.x);
  ray.dir_y = static_cast<float>(unit.y);
  ray.dir_z = static_cast<float>(unit.z);
  ray.tfar = static_cast<float>(length - clearance_m);
  ray.mask = 0xFFFFFFFFU;
  rtcOccluded1(library_->scene, &context, &ray);
  return ray.tfar < 0.0F;
}

void check_ray(const glm::dvec3& origin_m, const glm::dvec3& direction, double near_m,
               double far_m) {
  constexpr double kLargest = 1.0e18;
  const auto check = [](const char* field, double value, double low, double high) {
    if (!std::isfinite(value))
      core::throw_input_error(core::ErrorClass::nonfinite, field, value, "a finite number");
    if (value < low || value > high)
      core::throw_input_error(core::ErrorClass::range, field, value,
                              core::number_text(low) + " to " + core::number_text(high));
  };
  for (int axis = 0; axis < 3; ++axis) {
    check("ray origin", origin_m[axis], -kLargest, kLargest);
    check("ray direction", direction[axis], -kLargest, kLargest);
  }
  check("ray near limit", near_m, 0.0, kLargest);
  check("ray far limit", far_m, -kLargest, kLargest);
}

std::string ray_library() { return std::string("embree ") + RTC_VERSION_STRING; }

}  // namespace fanbeam::terrain
