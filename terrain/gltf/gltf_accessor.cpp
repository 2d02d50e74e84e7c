#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "terrain/gltf/gltf_model_private.h"

namespace fanbeam::terrain {
namespace {

// A poisoned accessor may be wrong everywhere; nobody reads more than this.
constexpr int kMostReported = 10;

int size_of(int component_type) {
  return tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type));
}

// Numbers of one kind in a buffer view, `stride` bytes apart.
struct Elements {
  const char* first = nullptr;  // none: every number is zero
  std::size_t stride_bytes = 0;

  // glTF is little-endian and its numbers need not be aligned in memory.
  std::uint32_t number(std::size_t element, std::size_t offset_bytes, int size_bytes) const {
    if (first == nullptr) return 0;
    const char* bytes = first + element * stride_bytes + offset_bytes;
    std::uint32_t value = 0;
    for (int i = 0; i < size_bytes; ++i)
      value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    return value;
  }

  // As the file holds it, not yet normalised.
  glm::dvec3 position(std::size_t element, int component_type) const {
    const int size_bytes = size_of(component_type);
    glm::dvec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint32_t bits =
          number(element, static_cast<std::size_t>(axis * size_bytes), size_bytes);
      switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
          p[axis] = static_cast<double>(std::bit_cast<float>(bits));
          break;
        case TINYGLTF_COMPONENT_TYPE_BYTE:
          p[axis] = static_cast<std::int8_t>(bits);
          break;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
          p[axis] = static_cast<std::int16_t>(bits);
          break;
        default:
          p[axis] = bits;
      }
    }
    return p;
  }
};

Elements elements_at(const GltfModel& model, int view_index, std::size_t offset_bytes,
                     std::size_t element_bytes) {
  if (view_index < 0) return {};
  const tinygltf::BufferView& view = model.parts.bufferViews[view_index];
  return {model.buffers[view.buffer].data() + view.byteOffset + offset_bytes,
          view.byteStride == 0 ? element_bytes : view.byteStride};
}

// Calls use(k, index) for the k-th value of a sparse accessor and the element it replaces.
template <typename Use>
void for_sparse_values(const GltfModel& model, const tinygltf::Accessor& accessor,
                       const std::string& path, core::ProblemList& problems, Use use) {
  if (!accessor.sparse.isSparse) return;
  const auto& source = accessor.sparse.indices;
  const int size_bytes = size_of(source.componentType);
  const Elements indices =
      elements_at(model, source.bufferView, static_cast<std::size_t>(source.byteOffset),
                  static_cast<std::size_t>(size_bytes));
  for (std::size_t k = 0; k < static_cast<std::size_t>(accessor.sparse.count); ++k) {
    const std::uint32_t index = indices.number(k, 0, size_bytes);
    if (index >= accessor.count)
      return problems.error(core::ErrorClass::ref, core::Place{model.file},
                            path + " sparse index " + std::to_string(k), std::to_string(index),
                            "below the count " + std::to_string(accessor.count));
    use(k, index);
  }
}

void check_bounds(const GltfModel& model, const tinygltf::Accessor& accessor,
                  const std::vector<glm::dvec3>& positions, const std::string& path,
                  core::ProblemList& problems) {
  if (accessor.minValues.empty() && accessor.maxValues.empty()) return;
  const double infinity = std::numeric_limits<double>::infinity();
  glm::dvec3 least(infinity);
  glm::dvec3 most(-infinity);
  for (const glm::dvec3& p : positions) {
    for (int axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], p[axis]);
      most[axis] = std::max(most[axis], p[axis]);
    }
  }
  // Writers round the decimals of these members.
  constexpr double kRounding = 1e-4;
  bool agrees = accessor.minValues.size() == 3 && accessor.maxValues.size() == 3;
  for (std::size_t axis = 0; agrees && axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    const double allowed = kRounding * std::max(std::abs(least[i]), std::abs(most[i]));
    agrees = std::abs(accessor.minValues[axis] - least[i]) <= allowed &&
             std::abs(accessor.maxValues[axis] - most[i]) <= allowed;
  }
  if (!agrees)
    problems.warning("BOUNDS", core::Place{model.file}, path, "min and max differ from the data",
                     "ignored");
}

// Integers to -1 .. 1 or 0 .. 1: section 3.11 of the specification.
void normalise(std::vector<glm::dvec3>& positions, int component_type) {
  const bool is_signed = component_type == TINYGLTF_COMPONENT_TYPE_BYTE ||
                         component_type == TINYGLTF_COMPONENT_TYPE_SHORT;
  const int bits = 8 * size_of(component_type) - (is_signed ? 1 : 0);
  const double largest = std::exp2(bits) - 1.0;
  for (glm::dvec3& p : positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::max(p[axis] / largest, -1.0);
}

}  // namespace

std::vector<glm::dvec3> read_positions(const GltfModel& model, int accessor_index,
                                       const std::string& path, core::ProblemList& problems) {
  const tinygltf::Accessor& accessor = model.parts.accessors[accessor_index];
  const int type = accessor.componentType;
  const auto position_bytes = static_cast<std::size_t>(3 * size_of(type));
  const Elements elements =
      elements_at(model, accessor.bufferView, accessor.byteOffset, position_bytes);
  std::vector<glm::dvec3> positions(accessor.count);
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = elements.position(i, type);
  if (accessor.sparse.isSparse) {
    const auto& source = accessor.sparse.values;
    const Elements values = elements_at(
        model, source.bufferView, static_cast<std::size_t>(source.byteOffset), position_bytes);
    for_sparse_values(model, accessor, path, problems, [&](std::size_t k, std::size_t index) {
      positions[index] = values.position(k, type);
    });
  }
  int reported = 0;
  for (std::size_t i = 0; i < positions.size() && reported < kMostReported; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::isfinite(positions[i][axis])) continue;
      problems.error(core::ErrorClass::nonfinite, core::Place{model.file},
                     path + " element " + std::to_string(i), core::number_text(positions[i][axis]),
                     "a finite number of metres");
      ++reported;
    }
  }
  if (reported == 0) check_bounds(model, accessor, positions, path, problems);
  if (accessor.normalized && type != TINYGLTF_COMPONENT_TYPE_FLOAT) normalise(positions, type);
  return positions;
}

std::vector<std::uint32_t> read_indices(const GltfModel& model, int accessor_index,
                                        std::size_t vertex_count, const std::string& path,
                                        core::ProblemList& problems) {
  const tinygltf::Accessor& accessor = model.parts.accessors[accessor_index];
  const int size_bytes = size_of(accessor.componentType);
  const auto stride_bytes = static_cast<std::size_t>(size_bytes);
  const Elements elements =
      elements_at(model, accessor.bufferView, accessor.byteOffset, stride_bytes);
  std::vector<std::uint32_t> indices(accessor.count);
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = elements.number(i, 0, size_bytes);
  if (accessor.sparse.isSparse) {
    const auto& source = accessor.sparse.values;
    const Elements values = elements_at(model, source.bufferView,
                                        static_cast<std::size_t>(source.byteOffset), stride_bytes);
    for_sparse_values(model, accessor, path, problems, [&](std::size_t k, std::size_t index) {
      indices[index] = values.number(k, 0, size_bytes);
    });
  }
  int reported = 0;
  for (std::size_t i = 0; i < indices.size() && reported < kMostReported; ++i) {
    if (indices[i] < vertex_count) continue;
    problems.error(core::ErrorClass::ref, core::Place{model.file},
                   path + " element " + std::to_string(i), std::to_string(indices[i]),
                   "an index below the " + std::to_string(vertex_count) + " positions");
    ++reported;
  }
  return indices;
}

}  // namespace fanbeam::terrain
