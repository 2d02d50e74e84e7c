#include "materials/open_material/material_file.h"

#include "materials/open_material/custom_nrcs_private.h"
#include "materials/open_material/metadata_private.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;

constexpr std::uint64_t kLargestMaterialFile_bytes = 1u << 20;
constexpr std::size_t kMostTables = 64;

std::optional<NamedUri> read_uri(const core::JsonNode& node, const std::string& ending) {
  const auto uri = node.text();
  if (!uri) return std::nullopt;
  if (!uri->ends_with(ending)) {
    node.error(ErrorClass::range, "a file name that ends in " + ending);
    return std::nullopt;
  }
  return NamedUri{*uri, node.pointer()};
}

std::vector<NamedUri> read_uris(const core::JsonNode& node, const std::string& ending) {
  std::vector<NamedUri> uris;
  const std::size_t count = node.size(kMostTables);
  for (std::size_t i = 0; i < count; ++i)
    if (auto uri = read_uri(node.element(i), ending)) uris.push_back(std::move(*uri));
  return uris;
}

}  // namespace

std::optional<OpenMaterialFile> read_open_material_file(const std::filesystem::path& file,
                                                        core::ProblemList& problems) {
  const auto json = core::read_json_file(file, kLargestMaterialFile_bytes, kJsonLimits, problems);
  if (!json) return std::nullopt;
  const core::JsonNode root(*json, problems);
  OpenMaterialFile material;
  material.name = check_metadata(root, "materialVersion");
  const core::JsonNode properties = root.required("materialProperties");
  const core::JsonNode roughness = properties.member("surfaceRoughness");
  // As far as roughness factors are defined; a metre is far beyond any surface.
  material.rms_height_m = roughness.required("surfaceHeightRms").number({0.0, 1.0});
  material.permittivity = read_uri(properties.member("electromagneticPropertiesUri"), "_emp.xompt");
  material.brdfs = read_uris(properties.member("brdfUris"), "_brdf.xompt");
  material.reflection_coefficients =
      read_uris(properties.member("reflectionCoefficientUris"), "_reflCoeff.xompt");
  material.nrcs = read_custom_nrcs(properties.member("customProperties"));
  return material;
}

}  // namespace fanbeam::materials
