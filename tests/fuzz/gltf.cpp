// glTF and GLB models; buffers beside the model are any bytes.
#include <algorithm>
#include <cmath>

#include "terrain/gltf/gltf_loader.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(fuzz::text_of(data, size));
  const std::filesystem::path folder =
      "/fanbeam_fuzz_models";  // nothing is there, nothing is opened
  const std::filesystem::path file = folder / "model.gltf";
  const auto read_file = [&](const std::filesystem::path& asked, std::uint64_t largest_bytes) {
    std::string content = asked == file ? bytes : std::string(4096, '?');
    if (content.size() > largest_bytes)
      core::throw_input_error(core::ErrorClass::limit, "file size", asked.string(), "less");
    return content;
  };
  fuzz::expect_answer([&](core::ProblemList& problems) {
    const terrain::TriangleMesh mesh = terrain::load_gltf(file, folder, problems, read_file);
    for (const glm::dvec3& v : mesh.vertices_m)
      fuzz::must(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z), "finite vertices");
    for (const glm::uvec3& t : mesh.triangles)
      fuzz::must(std::max({t.x, t.y, t.z}) < mesh.vertices_m.size(), "indices of vertices");
    for (const std::uint32_t slot : mesh.triangle_material)
      fuzz::must(slot < mesh.material_names.size(), "slots of materials");
    fuzz::must(mesh.triangle_material.size() == mesh.triangles.size(), "a material per triangle");
  });
  return 0;
}
