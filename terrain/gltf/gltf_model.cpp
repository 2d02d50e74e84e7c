#include <utility>

#include "terrain/gltf/gltf_model_private.h"

namespace fanbeam::terrain {

GltfModel parse_gltf_model(const GltfDocument& document, std::vector<std::string> buffers,
                           const std::filesystem::path& file) {
  GltfModel model{file.string(), {}, std::move(buffers), {}, document.extension_of_path};
  for (const GltfBufferSource& buffer : document.buffers)
    model.buffer_sizes_bytes.push_back(buffer.byte_length);
  tinygltf::TinyGLTF parser;
  // Without callbacks the parser has no means to open a file.
  parser.SetFsCallbacks({nullptr, nullptr, nullptr, nullptr, nullptr});
  std::string errors;
  std::string warnings;
  bool parsed = false;
  try {
    parsed = parser.LoadASCIIFromString(&model.parts, &errors, &warnings, document.json.c_str(),
                                        static_cast<unsigned int>(document.json.size()), "");
  } catch (const std::exception& error) {
    errors += error.what();
  }
  // It reports some errors and goes on without the element, which would shift all later ones.
  if (!parsed || !errors.empty()) {
    constexpr std::size_t kMostShown = 300;
    while (!errors.empty() && errors.back() == '\n') errors.pop_back();
    core::throw_input_error(core::ErrorClass::parse, core::Place{model.file}, "glTF",
                            errors.substr(0, kMostShown), "a glTF 2.0 document");
  }
  for (tinygltf::Mesh& mesh : model.parts.meshes) {
    for (tinygltf::Primitive& primitive : mesh.primitives) {
      const auto indices = primitive.attributes.find(kIndicesAttribute);
      if (indices == primitive.attributes.end()) continue;
      primitive.indices = indices->second;
      primitive.attributes.erase(indices);
    }
  }
  return model;
}

}  // namespace fanbeam::terrain
