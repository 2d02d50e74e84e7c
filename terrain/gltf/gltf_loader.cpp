#include "terrain/gltf/gltf_loader.h"

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "terrain/gltf/gltf_limits.h"
#include "terrain/gltf/gltf_model_private.h"
#include "terrain/gltf/gltf_nodes_private.h"

namespace fanbeam::terrain {
namespace {

using core::ErrorClass;

// A primitive in its own frame, read once however many nodes place it.
struct Patch {
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;
  std::uint32_t material = 0;
};

bool is_drawn(const tinygltf::Primitive& primitive) {
  return primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.attributes.contains("POSITION");
}

// Corners in the order of section 3.7.2.1 of the specification.
std::vector<glm::uvec3> assembled(const std::vector<std::uint32_t>& indices, int mode) {
  std::vector<glm::uvec3> triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
      triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (std::size_t i = 0; i + 2 < indices.size(); ++i)
      triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
  } else {
    for (std::size_t i = 0; i + 2 < indices.size(); ++i)
      triangles.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
  }
  return triangles;
}

class MeshBuilder {
 public:
  MeshBuilder(const GltfModel& model, core::ProblemList& problems)
      : model_(model), problems_(problems) {}

  TriangleMesh build(const std::vector<GltfInstance>& instances) {
    check_size(instances);
    for (const GltfInstance& instance : instances) {
      mesh_.part_names.push_back(name_of(instance.node));
      for (const Patch& patch : patches_of(instance.mesh)) add(patch, instance.world);
    }
    return std::move(mesh_);
  }

  // By slot of those drawn: one of its materials is double-sided.
  const std::vector<bool>& double_sided() const { return double_sided_; }

 private:
  // Throws E-LIMIT before any element is read.
  void check_size(const std::vector<GltfInstance>& instances) const {
    std::uint64_t vertices_left = kMostGltfVertices;
    std::uint64_t corners_left = 3 * kMostGltfTriangles;
    const auto take = [&](std::uint64_t& left, std::uint64_t count, std::uint64_t most,
                          const std::string& what) {
      if (count > left)
        core::throw_input_error(ErrorClass::limit, core::Place{model_.file}, "scene " + what,
                                "more than " + std::to_string(most),
                                "at most " + std::to_string(most) + " over all nodes");
      left -= count;
    };
    const auto& accessors = model_.parts.accessors;
    for (const GltfInstance& instance : instances) {
      for (const tinygltf::Primitive& primitive : model_.parts.meshes[instance.mesh].primitives) {
        const bool drawn = is_drawn(primitive);
        // What is not drawn counts too, or millions of it could be placed by as many nodes.
        const std::uint64_t vertices =
            drawn ? accessors[primitive.attributes.at("POSITION")].count : 1;
        take(vertices_left, vertices, kMostGltfVertices, "vertices");
        if (drawn)
          take(corners_left, primitive.indices < 0 ? vertices : accessors[primitive.indices].count,
               3 * kMostGltfTriangles, "triangle corners");
      }
    }
  }

  const std::vector<Patch>& patches_of(int mesh_index) {
    const auto known = patches_.find(mesh_index);
    if (known != patches_.end()) return known->second;
    std::vector<Patch>& patches = patches_[mesh_index];
    const auto& primitives = model_.parts.meshes[mesh_index].primitives;
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      const std::string path =
          "meshes[" + std::to_string(mesh_index) + "].primitives[" + std::to_string(k) + "]";
      if (is_drawn(primitives[k]))
        patches.push_back(read_patch(primitives[k], path));
      else
        problems_.warning("SKIPPED", core::Place{model_.file}, path,
                          "points, lines or no positions", "not drawn");
    }
    return patches;
  }

  Patch read_patch(const tinygltf::Primitive& primitive, const std::string& path) {
    Patch patch;
    const int position = primitive.attributes.at("POSITION");
    const std::string position_path = path + ".attributes.POSITION";
    const bool has_positions = has_elements(model_, position, position_path, problems_);
    const bool has_indices = primitive.indices < 0 ||
                             has_elements(model_, primitive.indices, path + ".indices", problems_);
    if (!has_positions || !has_indices) return patch;
    patch.positions = read_positions(model_, position, position_path, problems_);
    std::vector<std::uint32_t> indices;
    if (primitive.indices >= 0) {
      indices = read_indices(model_, primitive.indices, patch.positions.size(), path + ".indices",
                             problems_);
    } else {
      for (std::uint32_t i = 0; i < patch.positions.size(); ++i) indices.push_back(i);
    }
    patch.triangles = assembled(indices, primitive.mode);
    patch.material = material_slot(primitive.material);
    return patch;
  }

  std::string name_of(int node) const {
    const std::string& name = model_.parts.nodes[node].name;
    return name.empty() ? "node_" + std::to_string(node) : name;
  }

  std::uint32_t material_slot(int material) {
    std::string name = "default";
    if (material >= 0) name = model_.parts.materials[material].name;
    if (name.empty()) name = "material_" + std::to_string(material);
    const auto next = static_cast<std::uint32_t>(mesh_.material_names.size());
    const auto slot = slots_.emplace(name, next).first->second;
    if (slot == next) mesh_.material_names.push_back(name);
    double_sided_.resize(mesh_.material_names.size(), false);
    if (material >= 0 && model_.parts.materials[material].doubleSided) double_sided_[slot] = true;
    return slot;
  }

  void add(const Patch& patch, const glm::dmat4& world) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices_m.size());
    for (const glm::dvec3& position : patch.positions) {
      const glm::dvec4 p = world * glm::dvec4(position, 1.0);
      mesh_.vertices_m.emplace_back(-p.x, p.z, p.y);
    }
    const bool mirrored = glm::determinant(glm::dmat3(world)) < 0.0;
    for (const glm::uvec3& t : patch.triangles) {
      mesh_.triangles.push_back(first + (mirrored ? glm::uvec3(t.x, t.z, t.y) : t));
      mesh_.triangle_material.push_back(patch.material);
      mesh_.triangle_part.push_back(static_cast<std::uint32_t>(mesh_.part_names.size() - 1));
    }
  }

  const GltfModel& model_;
  core::ProblemList& problems_;
  TriangleMesh mesh_;
  std::map<int, std::vector<Patch>> patches_;
  std::map<std::string, std::uint32_t> slots_;
  std::vector<bool> double_sided_;
};

// Rays would meet either of two triangles in one place by chance, so that the back is not drawn. Of a
// closed body, which exporters like to call double-sided, nobody sees it.
void tell_one_sided(const TriangleMesh& mesh, const std::vector<bool>& double_sided,
                    const std::string& file, core::ProblemList& problems) {
  if (std::find(double_sided.begin(), double_sided.end(), true) == double_sided.end()) return;
  const std::size_t borders = count_borders(mesh, double_sided);
  if (borders == 0) return;
  problems.warning("ONE-SIDED", core::Place{file}, "doubleSided",
                   std::to_string(borders) + " edges where open surfaces end",
                   "their front alone echoes, their back hides what is behind: give sheets a "
                   "thickness");
}

GltfModel read_model(const std::filesystem::path& file, const std::filesystem::path& allowed_folder,
                     const FileReader& read_file, core::ProblemList& problems) {
  const std::string bytes = read_file(file, kLargestGltfFile_bytes);
  const GltfContainer container = open_gltf_container(bytes, file);
  check_json_size(container, file);
  const GltfDocument document = read_gltf_document(container, file);
  std::vector<std::string> buffers =
      load_gltf_buffers(document, container, file, allowed_folder, read_file, problems);
  problems.throw_if_errors();
  return parse_gltf_model(document, std::move(buffers), file);
}

}  // namespace

TriangleMesh load_gltf(const std::filesystem::path& file,
                       const std::filesystem::path& allowed_folder, core::ProblemList& problems,
                       const FileReader& read_file) {
  core::ProblemList found;
  const GltfModel model = read_model(file, allowed_folder, read_file, found);
  check_gltf_accessors(model, found);
  check_gltf_nodes(model, found);
  found.throw_if_errors();
  const std::vector<GltfInstance> instances = gltf_instances(model, found);
  MeshBuilder builder(model, found);
  TriangleMesh mesh = builder.build(instances);
  mesh.name = file.stem().string();
  found.throw_if_errors();
  check_and_clean(mesh, model.file, found);
  found.throw_if_errors();
  tell_one_sided(mesh, builder.double_sided(), model.file, found);
  if (mesh.triangles.empty())
    found.warning("EMPTY", core::Place{model.file}, "scene", "no triangles", "nothing is drawn");
  problems.append(found.all());
  return mesh;
}

}  // namespace fanbeam::terrain
