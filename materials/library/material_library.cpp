#include "materials/library/material_library.h"

#include <utility>

#include "core/spelling.h"
#include "core/units.h"

namespace fanbeam::materials {
namespace {

using core::ConfigTable;
using core::ErrorClass;
using core::NumberRange;

constexpr std::size_t kMostMaterials = 65535;

// Two increasing numbers; a missing key is an error too.
Interval read_interval(ConfigTable& table, const char* key, NumberRange range, double unit) {
  if (!table.has(key)) table.error(ErrorClass::ref, key, "missing", "[low, high]");
  const std::vector<double> ends = table.numbers(key, range, 2, 2);
  if (ends.size() != 2) return {};
  if (ends[0] > ends[1])
    table.error(ErrorClass::range, key,
                core::number_text(ends[0]) + " to " + core::number_text(ends[1]),
                "the low end first");
  return {ends[0] * unit, ends[1] * unit};
}

std::size_t read_choice(ConfigTable& table, const char* key,
                        std::initializer_list<std::string_view> names) {
  if (!table.has(key)) table.error(ErrorClass::ref, key, "missing", "a name in quotes");
  return table.choice(key, names, 0);
}

Material read_material(ConfigTable& table, const std::string& name) {
  Material material;
  material.name = name;
  const double a = table.required_number("a", {0.0, kLargestPhongCoefficient});
  const double b = table.required_number("b", {0.0, kLargestPhongCoefficient});
  const double c = table.required_number("c", {1.0, kLargestPhongExponent});
  // A refused value came back as the fallback, which is always a valid coefficient.
  material.nrcs = PhongNrcs(a, b, c);
  material.reference_frequency_Hz =
      table.required_number("reference_frequency_GHz", {1.0, 300.0}) * 1e9;
  material.frequency_exponent = table.required_number("frequency_exponent", {-4.0, 4.0});
  material.frequency_range_Hz = read_interval(table, "frequency_range_GHz", {0.1, 1000.0}, 1e9);
  material.grazing_range_rad =
      read_interval(table, "grazing_range_deg", {0.0, 90.0}, core::radians(1.0));
  const std::initializer_list<std::string_view> polarisations = {"HH", "VV", "any"};
  material.polarisation = polarisations.begin()[read_choice(table, "polarisation", polarisations)];
  material.confidence = static_cast<Confidence>(
      read_choice(table, "confidence", {"seen", "fitted", "recalled", "assumed"}));
  material.source = table.required_text("source");
  material.note = table.text("note", "");
  return material;
}

std::size_t error_count(const core::ProblemList& problems) {
  std::size_t count = 0;
  for (const core::Problem& problem : problems.all()) count += problem.is_error() ? 1 : 0;
  return count;
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
    const std::size_t errors_before = error_count(problems);
    ConfigTable table = root.table(name);
    if (!table.present()) continue;
    Material material = read_material(table, name);
    material.place = root.place(name);
    if (error_count(problems) == errors_before) library.materials_.push_back(std::move(material));
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
  std::string expected = "a material of the library";
  const char* separator = "; nearest are ";
  for (const std::string& nearest : core::nearest_names(name, names, 3)) {
    expected += separator + nearest;
    separator = ", ";
  }
  problems.error(ErrorClass::ref, place, field, '"' + std::string(name.substr(0, 200)) + '"',
                 expected);
  return std::nullopt;
}

std::vector<PhongNrcs> MaterialLibrary::at_frequency(double frequency_Hz) const {
  std::vector<PhongNrcs> result;
  result.reserve(materials_.size());
  for (const Material& material : materials_) result.push_back(material.nrcs_at(frequency_Hz));
  return result;
}

void MaterialLibrary::warn_if_extrapolated(std::size_t index, double frequency_Hz,
                                           core::ProblemList& problems) const {
  const Material& material = materials_[index];
  const Interval& range = material.frequency_range_Hz;
  if (range.contains(frequency_Hz)) return;
  problems.warning("EXTRAPOLATED", material.place,
                   "material '" + material.name + "' at frequency_GHz",
                   core::number_text(frequency_Hz / 1e9),
                   "known for " + core::number_text(range.low / 1e9) + " to " +
                       core::number_text(range.high / 1e9) + " GHz; scaled beyond with exponent " +
                       core::number_text(material.frequency_exponent));
}

}  // namespace fanbeam::materials
