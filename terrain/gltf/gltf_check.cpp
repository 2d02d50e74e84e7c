#include <algorithm>
#include <utility>

#include "terrain/gltf/gltf_limits.h"
#include "terrain/gltf/gltf_model_private.h"

namespace fanbeam::terrain {
namespace {

using core::ErrorClass;

// Whether `count` elements, `stride` bytes apart, lie inside `length` bytes; for all 64-bit values.
bool fits(std::uint64_t offset, std::uint64_t count, std::uint64_t stride, std::uint64_t element,
          std::uint64_t length) {
  if (offset > length || element > length - offset) return false;
  return count - 1 <= (length - offset - element) / stride;
}

std::uint64_t component_bytes(int component_type) {
  const bool known = component_type == TINYGLTF_COMPONENT_TYPE_BYTE ||
                     component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                     component_type == TINYGLTF_COMPONENT_TYPE_SHORT ||
                     component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                     component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT ||
                     component_type == TINYGLTF_COMPONENT_TYPE_FLOAT;
  if (!known) return 0;
  return static_cast<std::uint64_t>(
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)));
}

bool is_unsigned_type(int component_type) {
  return component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// The extension that the primitive, or the accessor itself, leaves the elements to; null for none.
const std::string* extension_of_elements(const GltfModel& model, int accessor_index,
                                         const std::string& path) {
  auto known = model.extension_of_path.find(path);
  if (known == model.extension_of_path.end())
    known = model.extension_of_path.find("accessors[" + std::to_string(accessor_index) + "]");
  return known == model.extension_of_path.end() ? nullptr : &known->second;
}

class AccessorCheck {
 public:
  AccessorCheck(const GltfModel& model, core::ProblemList& problems)
      : model_(model), parts_(model.parts), problems_(problems) {}

  void check() {
    for (std::size_t i = 0; i < parts_.bufferViews.size(); ++i) check_view(i);
    for (std::size_t i = 0; i < parts_.accessors.size(); ++i) check_accessor(i);
    for (std::size_t i = 0; i < parts_.meshes.size(); ++i)
      for (std::size_t k = 0; k < parts_.meshes[i].primitives.size(); ++k)
        check_primitive(parts_.meshes[i].primitives[k],
                        "meshes[" + std::to_string(i) + "].primitives[" + std::to_string(k) + "]");
  }

 private:
  void check_view(std::size_t i) {
    const tinygltf::BufferView& view = parts_.bufferViews[i];
    const std::uint64_t size = model_.buffer_sizes_bytes[view.buffer];
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
      report(ErrorClass::ref, "bufferViews[" + std::to_string(i) + "]",
             std::to_string(view.byteLength) + " bytes from " + std::to_string(view.byteOffset),
             "a part of buffers[" + std::to_string(view.buffer) + "] of " + std::to_string(size) +
                 " bytes");
  }

  void check_accessor(std::size_t i) {
    const tinygltf::Accessor& accessor = parts_.accessors[i];
    const std::string path = "accessors[" + std::to_string(i) + "]";
    const std::uint64_t component = component_bytes(accessor.componentType);
    if (component == 0)
      return report(ErrorClass::parse, path + ".componentType",
                    std::to_string(accessor.componentType), "5120 to 5123, 5125 or 5126");
    const std::uint64_t element =
        component * static_cast<std::uint64_t>(tinygltf::GetNumComponentsInType(
                        static_cast<std::uint32_t>(accessor.type)));
    if (accessor.count == 0) return report(ErrorClass::range, path + ".count", "0", "1 or more");
    if (accessor.bufferView >= 0)
      check_range(path, accessor.bufferView, accessor.byteOffset, accessor.count, element);
    if (accessor.sparse.isSparse) check_sparse(accessor, element, path + ".sparse");
  }

  void check_sparse(const tinygltf::Accessor& accessor, std::uint64_t element,
                    const std::string& path) {
    const auto& sparse = accessor.sparse;
    if (!is_unsigned_type(sparse.indices.componentType))
      return report(ErrorClass::parse, path + ".indices.componentType",
                    std::to_string(sparse.indices.componentType), "5121, 5123 or 5125");
    const auto count = static_cast<std::uint64_t>(sparse.count);
    if (count < 1 || count > accessor.count)
      return report(ErrorClass::range, path + ".count", std::to_string(count),
                    "1 to " + std::to_string(accessor.count));
    check_range(path + ".indices", sparse.indices.bufferView,
                static_cast<std::uint64_t>(sparse.indices.byteOffset), count,
                component_bytes(sparse.indices.componentType));
    check_range(path + ".values", sparse.values.bufferView,
                static_cast<std::uint64_t>(sparse.values.byteOffset), count, element);
  }

  void check_range(const std::string& path, int view_index, std::uint64_t offset,
                   std::uint64_t count, std::uint64_t element) {
    const tinygltf::BufferView& view = parts_.bufferViews[view_index];
    const std::uint64_t stride = view.byteStride == 0 ? element : view.byteStride;
    if (stride < element)
      return report(ErrorClass::range, "bufferViews[" + std::to_string(view_index) + "].byteStride",
                    std::to_string(stride),
                    "at least the element of " + path + ", " + std::to_string(element));
    if (!fits(offset, count, stride, element, view.byteLength))
      report(ErrorClass::ref, path,
             std::to_string(count) + " elements from byte " + std::to_string(offset),
             "elements inside bufferViews[" + std::to_string(view_index) + "] of " +
                 std::to_string(view.byteLength) + " bytes");
  }

  bool can_be_positions(int component_type) const {
    const auto& required = parts_.extensionsRequired;
    return component_type == TINYGLTF_COMPONENT_TYPE_FLOAT ||
           (component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT &&
            std::find(required.begin(), required.end(), kQuantizationExtension) != required.end());
  }

  void check_unbacked(int accessor_index, const std::string& path) {
    const tinygltf::Accessor& accessor = parts_.accessors[accessor_index];
    if (accessor.bufferView < 0 && accessor.count > kMostGltfUnbackedElements &&
        extension_of_elements(model_, accessor_index, path) == nullptr)
      report(ErrorClass::limit, path,
             std::to_string(accessor.count) + " elements without a buffer view",
             "at most " + std::to_string(kMostGltfUnbackedElements));
  }

  void check_primitive(const tinygltf::Primitive& primitive, const std::string& path) {
    if (primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
      report(ErrorClass::range, path + ".mode", std::to_string(primitive.mode), "0 to 6");
    const auto position = primitive.attributes.find("POSITION");
    if (position != primitive.attributes.end()) {
      const tinygltf::Accessor& accessor = parts_.accessors[position->second];
      const std::string position_path = path + ".attributes.POSITION";
      check_unbacked(position->second, position_path);
      if (accessor.type != TINYGLTF_TYPE_VEC3)
        report(ErrorClass::parse, position_path, "accessor of another type", "VEC3");
      else if (!can_be_positions(accessor.componentType))
        report(ErrorClass::unsupported, position_path,
               "component type " + std::to_string(accessor.componentType),
               "5126, float; or 5120 to 5123 with KHR_mesh_quantization required");
    }
    if (primitive.indices < 0) return;
    check_unbacked(primitive.indices, path + ".indices");
    const tinygltf::Accessor& accessor = parts_.accessors[primitive.indices];
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_unsigned_type(accessor.componentType))
      report(ErrorClass::parse, path + ".indices",
             "component type " + std::to_string(accessor.componentType),
             "SCALAR of 5121, 5123 or 5125");
  }

  void report(ErrorClass error_class, std::string field, std::string value, std::string expected) {
    problems_.error(error_class, core::Place{model_.file}, std::move(field), std::move(value),
                    std::move(expected));
  }

  const GltfModel& model_;
  const tinygltf::Model& parts_;
  core::ProblemList& problems_;
};

}  // namespace

bool has_elements(const GltfModel& model, int accessor_index, const std::string& path,
                  core::ProblemList& problems) {
  const auto unsupported = [&](const std::string& field, const std::string& extension) {
    problems.error(ErrorClass::unsupported, core::Place{model.file}, field,
                   "data that only " + extension + " holds",
                   "data in a buffer: a model written without this extension");
    return false;
  };
  const tinygltf::Accessor& accessor = model.parts.accessors[accessor_index];
  const std::string* extension = extension_of_elements(model, accessor_index, path);
  if (accessor.bufferView < 0 && extension != nullptr) return unsupported(path, *extension);
  std::vector<int> views;
  if (accessor.bufferView >= 0) views.push_back(accessor.bufferView);
  if (accessor.sparse.isSparse) {
    views.push_back(accessor.sparse.indices.bufferView);
    views.push_back(accessor.sparse.values.bufferView);
  }
  for (const int view : views) {
    const int buffer = model.parts.bufferViews[view].buffer;
    if (!model.buffers[buffer].empty()) continue;
    if (extension != nullptr) return unsupported(path, *extension);
    const std::string view_path = "bufferViews[" + std::to_string(view) + "]";
    const std::string buffer_path = "buffers[" + std::to_string(buffer) + "]";
    for (const std::string& part : {view_path, buffer_path})
      if (const auto known = model.extension_of_path.find(part);
          known != model.extension_of_path.end())
        return unsupported(part, known->second);
    problems.error(ErrorClass::ref, core::Place{model.file}, buffer_path + ".uri", "missing",
                   "the data that " + path + " reads: a URI, or the BIN chunk of a .glb");
    return false;
  }
  return true;
}

void check_gltf_accessors(const GltfModel& model, core::ProblemList& problems) {
  AccessorCheck(model, problems).check();
}

}  // namespace fanbeam::terrain
