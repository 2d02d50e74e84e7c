// OpenMATERIAL files. The input stands for every file at once: asset, mapping, material and table.
#include "materials/open_material/open_materials.h"
#include "materials/open_material/permittivity_table.h"
#include "materials/open_material/reflection_table.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const std::filesystem::path table = fuzz::scratch_file("table.xompt", text);
  const std::filesystem::path material = fuzz::scratch_file("material.xomp", text);
  for (const char* name : {"asset.xoma", "mapping.xomm"}) {
    const std::filesystem::path file = fuzz::scratch_file(name, text);
    fuzz::expect_answer([&](core::ProblemList& problems) {
      materials::OpenMaterials materials(file, fuzz::scratch_folder(), {}, problems);
      for (const char* wanted : {"concrete", "steel"})
        if (materials.knows(wanted)) materials.surface_of(wanted, problems);
    });
  }
  fuzz::expect_answer(
      [&](core::ProblemList& problems) { materials::read_open_material_file(material, problems); });
  fuzz::expect_answer([&](core::ProblemList& problems) {
    materials::PermittivityTable::from_file(table, problems).at({});
  });
  fuzz::expect_answer(
      [&](core::ProblemList& problems) { materials::check_reflection_table(table, problems); });
  return 0;
}
