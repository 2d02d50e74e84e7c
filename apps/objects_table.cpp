#include "apps/objects_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/common.h"

namespace fanbeam::apps {

std::string objects_table(const materials::ObjectLibrary& library) {
  std::size_t width = 6;
  for (const materials::TypicalObject& object : library.all())
    width = std::max(width, object.name.size());
  std::string table =
      fmt::format("{:<{}}  {:>7}  {:>6}  {:>8}  {:>10}  {:>18}  {:<10}  {}\n", "object", width,
                  "dBsm", "+-dB", "Swerling", "GHz", "l x w x h, m", "confidence", "source");
  for (const materials::TypicalObject& object : library.all()) {
    const std::string frequencies = fmt::format("{:g}-{:g}", object.frequency_range_Hz.low / 1e9,
                                                object.frequency_range_Hz.high / 1e9);
    const std::string size =
        fmt::format("{:g} x {:g} x {:g}", object.size_m[0], object.size_m[1], object.size_m[2]);
    table += fmt::format("{:<{}}  {:>7.2f}  {:>6.2f}  {:>8}  {:>10}  {:>18}  {:<10}  {}\n",
                         object.name, width, 10.0 * std::log10(object.mean_rcs_m2),
                         object.spread_dB, static_cast<int>(object.fluctuation), frequencies, size,
                         materials::name_of(object.confidence), object.source);
  }
  table += '\n';
  for (const materials::TypicalObject& object : library.all()) {
    if (!object.aspect.lobes.empty())
      table += fmt::format("{}: {} lobes over aspect; the mean is shown.\n", object.name,
                           object.aspect.lobes.size());
    if (!object.note.empty()) table += fmt::format("{}: {}\n", object.name, object.note);
  }
  return table;
}

int list_objects(const std::string& library_file) {
  core::ProblemList problems;
  const auto library = materials::ObjectLibrary::from_file(
      library_file.empty() ? shipped_folder() / "materials" / "objects.toml"
                           : std::filesystem::path(library_file),
      problems);
  problems.throw_if_errors();
  fmt::print("{}", objects_table(library));
  return kExitDone;
}

}  // namespace fanbeam::apps
