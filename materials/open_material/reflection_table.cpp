#include "materials/open_material/reflection_table.h"

#include "materials/open_material/metadata_private.h"
#include "materials/open_material/number_table_private.h"

namespace fanbeam::materials {

void check_reflection_table(const std::filesystem::path& file, core::ProblemList& problems) {
  const auto json = core::read_json_file(file, kLargestTableFile_bytes, kJsonLimits, problems);
  if (!json) return;
  const core::JsonNode root(*json, problems);
  check_metadata(root, "materialVersion");
  const core::JsonNode table = root.required("reflectionCoefficient");
  table.required("wavelengths").numbers(kTableWavelength_m, kMostTableRows);
  read_number_table(table.required("lookupTable"), {kTableWavelength_m,
                                                    kTableZenith_rad,
                                                    kTableZenith_rad,
                                                    {0.0, 6.283186},
                                                    {0.0, 3.141594},
                                                    {0.0, 1.0},
                                                    {-3.141593, 3.141593}});
}

}  // namespace fanbeam::materials
