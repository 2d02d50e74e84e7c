#include "materials/rcs/object_library.h"

#include <utility>

#include "core/decibel.h"
#include "core/spelling.h"
#include "core/units.h"

namespace fanbeam::materials {
namespace {

using core::ConfigTable;
using core::ErrorClass;
using core::radians;

constexpr core::NumberRange kRcs_dBsm{-80.0, 80.0};
constexpr core::NumberRange kSize_m{0.001, 200.0};

std::vector<double> required_numbers(ConfigTable& table, const char* key, core::NumberRange range,
                                     std::size_t count, const char* expected) {
  if (!table.has(key)) table.error(ErrorClass::ref, key, "missing", expected);
  return table.numbers(key, range, count, count);
}

AspectLobe read_lobe(ConfigTable& table) {
  AspectLobe lobe;
  lobe.azimuth_rad = radians(table.number("azimuth_deg", {-180.0, 180.0}, 0.0));
  lobe.azimuth_width_rad = radians(table.number("azimuth_width_deg", {0.0, 360.0}, 0.0));
  lobe.elevation_rad = radians(table.required_number("elevation_deg", {-90.0, 90.0}));
  lobe.elevation_width_rad = radians(table.required_number("elevation_width_deg", {0.1, 180.0}));
  lobe.peak_m2 = core::power_from_dB(table.required_number("peak_dBsm", kRcs_dBsm));
  return lobe;
}

TypicalObject read_object(ConfigTable& table, const std::string& name) {
  TypicalObject object;
  object.name = name;
  object.mean_rcs_m2 = core::power_from_dB(table.required_number("rcs_dBsm", kRcs_dBsm));
  object.spread_dB = table.required_number("spread_dB", {0.0, 40.0});
  if (!table.has("fluctuation"))
    table.error(ErrorClass::ref, "fluctuation", "missing", "a Swerling case, 0 to 4");
  object.fluctuation = static_cast<core::Swerling>(table.integer("fluctuation", 0, 4, 0));
  const std::vector<double> range =
      required_numbers(table, "frequency_range_GHz", {0.1, 1000.0}, 2, "[low, high]");
  if (range.size() == 2) {
    object.frequency_range_Hz = {range[0] * 1e9, range[1] * 1e9};
    if (range[0] > range[1])
      table.error(ErrorClass::range, "frequency_range_GHz",
                  core::number_text(range[0]) + " to " + core::number_text(range[1]),
                  "the low end first");
  }
  const std::vector<double> size =
      required_numbers(table, "size_m", kSize_m, 3, "[length, width, height]");
  if (size.size() == 3) object.size_m = {size[0], size[1], size[2]};
  for (ConfigTable& lobe : table.tables("lobe")) object.aspect.lobes.push_back(read_lobe(lobe));
  if (!object.aspect.lobes.empty())
    object.aspect.floor_m2 = core::power_from_dB(table.required_number("floor_dBsm", kRcs_dBsm));
  if (!table.has("confidence"))
    table.error(ErrorClass::ref, "confidence", "missing", "a name in quotes");
  object.confidence = static_cast<Confidence>(
      table.choice("confidence", {"seen", "fitted", "recalled", "assumed"}, 0));
  object.source = table.required_text("source");
  object.note = table.text("note", "");
  return object;
}

}  // namespace

RcsModel TypicalObject::rcs() const {
  if (aspect.lobes.empty()) return ConstantRcs{mean_rcs_m2};
  return aspect;
}

ObjectLibrary ObjectLibrary::from_file(const std::filesystem::path& file,
                                       core::ProblemList& problems) {
  return from_table(ConfigTable::from_file(file, problems), problems);
}

ObjectLibrary ObjectLibrary::from_text(std::string_view text, const std::string& file_name,
                                       core::ProblemList& problems) {
  return from_table(ConfigTable::from_text(text, file_name, problems), problems);
}

ObjectLibrary ObjectLibrary::from_table(ConfigTable root, core::ProblemList& problems) {
  ObjectLibrary library;
  const std::vector<std::string> names = root.keys();
  // A file that could not be read or parsed has been reported already.
  if (root.present() && names.empty())
    problems.error(ErrorClass::parse, root.place(""), "objects", "none",
                   "at least one table, such as [person]");
  for (const std::string& name : names) {
    const std::size_t errors_before = problems.errors();
    ConfigTable table = root.table(name);
    if (!table.present()) continue;
    TypicalObject object = read_object(table, name);
    object.place = root.place(name);
    if (problems.errors() == errors_before) library.objects_.push_back(std::move(object));
  }
  root.report_unknown_keys();
  return library;
}

const TypicalObject* ObjectLibrary::find(std::string_view name, const core::Place& place,
                                         const std::string& field,
                                         core::ProblemList& problems) const {
  for (const TypicalObject& object : objects_)
    if (object.name == name) return &object;
  std::vector<std::string> names;
  for (const TypicalObject& object : objects_) names.push_back(object.name);
  std::string expected = "an object of the library";
  const char* separator = "; nearest are ";
  for (const std::string& nearest : core::nearest_names(name, names, 3)) {
    expected += separator + nearest;
    separator = ", ";
  }
  problems.error(ErrorClass::ref, place, field, '"' + std::string(name.substr(0, 200)) + '"',
                 expected);
  return nullptr;
}

void warn_if_extrapolated(const TypicalObject& object, double frequency_Hz,
                          core::ProblemList& problems) {
  const Interval& range = object.frequency_range_Hz;
  if (range.contains(frequency_Hz)) return;
  problems.warning("EXTRAPOLATED", object.place, "object '" + object.name + "' at frequency_GHz",
                   core::number_text(frequency_Hz / 1e9),
                   "known for " + core::number_text(range.low / 1e9) + " to " +
                       core::number_text(range.high / 1e9) + " GHz; used unchanged");
}

}  // namespace fanbeam::materials
