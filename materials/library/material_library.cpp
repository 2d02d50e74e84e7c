#include "materials/library/material_library.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/spelling.h"
#include "materials/dielectric/dielectric_medium.h"
#include "materials/library/model_reader.h"

namespace fanbeam::materials {
namespace {

using core::ConfigTable;
using core::ErrorClass;

constexpr std::size_t kMostMaterials = 65535;

constexpr std::array<const char*, kSurfaceStateNames.size()> kStateKeys = {
    "", "when_wet", "when_dry_snow", "when_wet_snow"};

std::size_t read_choice(ConfigTable& table, const char* key,
                        std::initializer_list<std::string_view> names) {
  if (!table.has(key)) table.error(ErrorClass::ref, key, "missing", "a name in quotes");
  return table.choice(key, names, 0);
}

std::string nearest_text(std::string_view name, const std::vector<std::string>& names) {
  std::string text;
  const char* separator = "; nearest are ";
  for (const std::string& nearest : core::nearest_names(name, names, 3)) {
    text += separator + nearest;
    separator = ", ";
  }
  return text;
}

void read_mirror(ConfigTable& table, Material& material) {
  material.dielectric = table.text("dielectric", "");
  if (!material.dielectric.empty() && !dielectric_medium_named(material.dielectric))
    table.error(ErrorClass::ref, "dielectric", '"' + material.dielectric.substr(0, 200) + '"',
                "a medium" + nearest_text(material.dielectric, dielectric_medium_names()));
  if (const auto height_mm = table.optional_number("rms_height_mm", {0.0, 1000.0}))
    material.rms_height_m = *height_mm / 1000.0;
}

// What the row turns into; `names` are all of the file, also those with problems of their own.
void read_states(ConfigTable& table, const std::vector<std::string>& names, Material& material) {
  for (std::size_t state = 1; state < kStateKeys.size(); ++state) {
    const std::string other = table.text(kStateKeys[state], "same");
    if (other == "same") continue;
    material.turns_into[state] = other;
    if (std::find(names.begin(), names.end(), other) == names.end())
      table.error(ErrorClass::ref, kStateKeys[state], '"' + other.substr(0, 200) + '"',
                  "\"same\" or a material of the library" + nearest_text(other, names));
  }
}

Material read_material(ConfigTable& table, const std::string& name,
                       const std::vector<std::string>& names) {
  Material material;
  material.name = name;
  material.model = read_surface_model(table);
  material.reference = read_reference(table);
  if (material.reference && !std::holds_alternative<PhongSurface>(material.model))
    table.error(ErrorClass::range, "reference", "given for another model",
                "a reference of a, b and c only");
  material.confidence = static_cast<Confidence>(
      read_choice(table, "confidence", {"seen", "fitted", "recalled", "assumed"}));
  material.source = table.required_text("source");
  material.note = table.text("note", "");
  read_mirror(table, material);
  read_states(table, names, material);
  return material;
}

}  // namespace

MaterialLibrary MaterialLibrary::from_file(const std::filesystem::path& file,
                                           core::ProblemList& problems) {
  return from_table(ConfigTable::from_file(file, problems), problems);
}

MaterialLibrary MaterialLibrary::from_text(std::string_view text, const std::string& file_name,
                                           core::ProblemList& problems) {
  return from_table(ConfigTable::from_text(text, file_name, problems), problems);
}

MaterialLibrary MaterialLibrary::from_table(ConfigTable root, core::ProblemList& problems) {
  MaterialLibrary library;
  const std::vector<std::string> names = root.keys();
  // A file that could not be read or parsed has been reported already.
  if (root.present() && names.empty())
    problems.error(ErrorClass::parse, root.place(""), "materials", "none",
                   "at least one table, such as [short_grass]");
  if (names.size() > kMostMaterials) {
    problems.error(ErrorClass::limit, root.place(""), "materials", std::to_string(names.size()),
                   "at most " + std::to_string(kMostMaterials));
    return library;
  }
  for (const std::string& name : names) {
    const std::size_t errors_before = problems.errors();
    ConfigTable table = root.table(name);
    if (!table.present()) continue;
    Material material = read_material(table, name, names);
    material.place = root.place(name);
    if (problems.errors() == errors_before) library.materials_.push_back(std::move(material));
  }
  root.report_unknown_keys();
  return library;
}

std::optional<std::size_t> MaterialLibrary::index_of(std::string_view name) const {
  for (std::size_t i = 0; i < materials_.size(); ++i)
    if (materials_[i].name == name) return i;
  return std::nullopt;
}

std::optional<std::size_t> MaterialLibrary::find(std::string_view name, const core::Place& place,
                                                 const std::string& field,
                                                 core::ProblemList& problems) const {
  const std::optional<std::size_t> index = index_of(name);
  if (index) return index;
  std::vector<std::string> names;
  for (const Material& material : materials_) names.push_back(material.name);
  problems.error(ErrorClass::ref, place, field, '"' + std::string(name.substr(0, 200)) + '"',
                 "a material of the library" + nearest_text(name, names));
  return std::nullopt;
}

std::size_t MaterialLibrary::in_state(std::size_t index, SurfaceState state) const {
  const std::string& other = materials_[index].turns_into[static_cast<std::size_t>(state)];
  return other.empty() ? index : index_of(other).value_or(index);
}

std::vector<NrcsCurve> MaterialLibrary::curves(SurfaceState state, Polarisation polarisation,
                                               double frequency_Hz) const {
  std::vector<NrcsCurve> result;
  result.reserve(materials_.size());
  for (std::size_t i = 0; i < materials_.size(); ++i)
    result.emplace_back(materials_[in_state(i, state)].model, polarisation, frequency_Hz);
  return result;
}

void MaterialLibrary::report_extrapolations(std::size_t index, Polarisation polarisation,
                                            double frequency_Hz, bool allowed,
                                            core::ProblemList& problems,
                                            const char* allowed_by) const {
  const Material& material = materials_[index];
  const std::string model(materials::name_of(material.model));
  for (const Extrapolation& outside :
       extrapolations_of(material.model, polarisation, frequency_Hz)) {
    const std::string field = "material '" + material.name + "' at " + outside.quantity;
    const std::string known = outside.known + " (model " + model + ")";
    if (allowed)
      problems.warning("EXTRAPOLATED", material.place, field, outside.asked,
                       "known for " + known + "; continued as docs/physics/phong.md says");
    else
      problems.error(ErrorClass::range, material.place, field, outside.asked,
                     known + ", or " + allowed_by);
  }
}

}  // namespace fanbeam::materials
