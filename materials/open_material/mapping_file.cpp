#include "materials/open_material/mapping_file.h"

#include "core/json_node.h"
#include "core/relative_uri.h"
#include "core/spelling.h"
#include "materials/open_material/metadata_private.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;

constexpr std::uint64_t kLargestMappingFile_bytes = 1u << 20;
constexpr std::size_t kMostRows = 4096;

// A row of texts; empty after reporting.
std::vector<std::string> read_row(const core::JsonNode& node, std::size_t length) {
  std::vector<std::string> row = node.texts(kMostRows);
  if (row.size() == length) return row;
  const bool told = node.present() && (!node.is_array() || node.elements() == length);
  if (!told)
    node.problems().error(ErrorClass::parse, node.place(), node.pointer(), "another row",
                          "exactly " + std::to_string(length) + " texts");
  return {};
}

void read_mapping(const std::filesystem::path& file, core::ProblemList& problems,
                  OpenMapping& mapping) {
  const auto json = core::read_json_file(file, kLargestMappingFile_bytes, kJsonLimits, problems);
  mapping.file = file;
  mapping.files.push_back(file);
  if (!json) return;
  const core::JsonNode root(*json, problems);
  check_metadata(root, "mappingVersion");
  const core::JsonNode rows = root.required("materialMapping");
  const std::size_t count = rows.size(kMostRows);
  for (std::size_t i = 0; i < count; ++i) {
    const core::JsonNode node = rows.element(i);
    const std::vector<std::string> row = read_row(node, 3);
    if (row.empty()) continue;
    if (!row[1].ends_with(".xomp"))
      node.element(1).error(ErrorClass::range, "a file name that ends in .xomp");
    else if (!mapping.material_of_name.emplace(row[0], NamedUri{row[1], node.pointer() + "/1"})
                  .second)
      node.element(0).error(ErrorClass::range, "each name once");
  }
}

std::string names_there(const std::string& wanted, const OpenMapping& mapping) {
  std::vector<std::string> names;
  for (const auto& [name, uri] : mapping.material_of_name) names.push_back(name);
  return core::names_there_text(wanted, names);
}

void replace_names(const core::JsonNode& replacements, OpenMapping& mapping) {
  std::map<std::string, NamedUri> replaced = mapping.material_of_name;
  const std::size_t count = replacements.size(kMostRows);
  for (std::size_t i = 0; i < count; ++i) {
    const core::JsonNode node = replacements.element(i);
    const std::vector<std::string> row = read_row(node, 2);
    if (row.empty()) continue;
    const auto key = mapping.material_of_name.find(row[1]);
    if (key != mapping.material_of_name.end())
      replaced[row[0]] = key->second;
    else if (!node.problems().is_full())
      node.element(1).error(ErrorClass::ref, "a name of " + mapping.file.filename().string() +
                                                 names_there(row[1], mapping));
  }
  mapping.material_of_name = std::move(replaced);
}

void read_asset(const std::filesystem::path& file, const std::filesystem::path& allowed_folder,
                core::ProblemList& problems, OpenMapping& mapping) {
  mapping.files.push_back(file);
  const auto json = core::read_json_file(file, kLargestMappingFile_bytes, kJsonLimits, problems);
  if (!json) return;
  const core::JsonNode root(*json, problems);
  check_metadata(root, "assetVersion");
  const core::JsonNode uri = root.required("materialMappingUri");
  if (root.member("materialTextureAssignment").present())
    problems.warning("SKIPPED", uri.place(), "/materialTextureAssignment", "assignment textures",
                     "not read: materials are found by name only");
  const auto text = uri.text();
  if (!text) return;
  core::ProblemList mapping_problems;
  try {
    read_mapping(core::file_of_uri(allowed_folder, file, *text, uri.place(), uri.pointer()),
                 mapping_problems, mapping);
  } catch (const core::InputError& error) {
    mapping_problems.append(error.problems());
  }
  problems.append(mapping_problems.all());
  if (mapping_problems.has_errors()) return;  // a name may be missing because of them
  for (const char* key : {"materialReplacements", "materialReplacement"})
    replace_names(root.member(key), mapping);
}

}  // namespace

OpenMapping read_open_mapping(const std::filesystem::path& file,
                              const std::filesystem::path& allowed_folder,
                              core::ProblemList& problems) {
  OpenMapping mapping;
  if (file.extension() == ".xoma")
    read_asset(file, allowed_folder, problems, mapping);
  else if (file.extension() == ".xomm")
    read_mapping(file, problems, mapping);
  else
    problems.error(ErrorClass::unsupported, {file.string()}, "", file.extension().string(),
                   ".xoma or .xomm");
  return mapping;
}

}  // namespace fanbeam::materials
