#include "materials/library/model_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "core/decibel.h"
#include "core/units.h"
#include "materials/dielectric/dielectric_medium.h"

namespace fanbeam::materials {
namespace {

using core::ConfigTable;
using core::ErrorClass;
using core::NumberRange;

constexpr NumberRange kHeight_mm{0.0, 1000.0};
constexpr std::size_t kMostRows = 10000;

// The place of the text in `names`; 0 after reporting.
template <std::size_t N>
std::size_t read_name(ConfigTable& table, const char* key,
                      const std::array<std::string_view, N>& names) {
  const std::string text = table.required_text(key);
  for (std::size_t i = 0; i < N; ++i)
    if (text == names[i]) return i;
  if (!table.has(key)) return 0;  // reported
  std::string known;
  for (const std::string_view name : names)
    known += (known.empty() ? "" : ", ") + std::string(name);
  table.error(ErrorClass::ref, key, '"' + text.substr(0, 200) + '"', "one of " + known);
  return 0;
}

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

std::optional<Polarisation> read_polarisation(ConfigTable& table) {
  if (!table.has("polarisation"))
    table.error(ErrorClass::ref, "polarisation", "missing", "a name in quotes");
  switch (table.choice("polarisation", {"HH", "VV", "any"}, 2)) {
    case 0:
      return Polarisation::horizontal;
    case 1:
      return Polarisation::vertical;
    default:
      return std::nullopt;
  }
}

PhongSurface read_phong(ConfigTable& table) {
  PhongSurface surface;
  const double a = table.required_number("a", {0.0, kLargestPhongCoefficient});
  const double b = table.required_number("b", {0.0, kLargestPhongCoefficient});
  const double c = table.required_number("c", {1.0, kLargestPhongExponent});
  // A refused value came back as the fallback, which is always a valid coefficient.
  surface.nrcs = PhongNrcs(a, b, c);
  surface.reference_frequency_Hz =
      table.required_number("reference_frequency_GHz", {1.0, 300.0}) * 1e9;
  surface.frequency_exponent = table.required_number("frequency_exponent", {-4.0, 4.0});
  surface.frequency_range_Hz = read_interval(table, "frequency_range_GHz", {0.1, 1000.0}, 1e9);
  surface.grazing_range_rad =
      read_interval(table, "grazing_range_deg", {0.0, 90.0}, core::radians(1.0));
  surface.polarisation = read_polarisation(table);
  return surface;
}

void read_oh_medium(ConfigTable& table, OhSurface& surface) {
  if (table.has("permittivity")) {
    if (table.has("medium"))
      table.error(ErrorClass::range, "medium", "given with permittivity", "one of the two");
    const std::vector<double> parts = table.numbers("permittivity", {0.0, 1000.0}, 2, 2);
    if (parts.size() != 2) return;
    if (parts[0] < 1.0)
      table.error(ErrorClass::range, "permittivity", core::number_text(parts[0]),
                  "[real, loss] with a real part of at least 1");
    surface.medium = Permittivity{parts[0], parts[1]};
    return;
  }
  const std::string name = table.required_text("medium");
  if (const auto medium = dielectric_medium_named(name)) {
    surface.medium = *medium;
  } else if (table.has("medium")) {
    std::string known;
    for (const std::string& other : dielectric_medium_names())
      known += (known.empty() ? "" : ", ") + other;
    table.error(ErrorClass::ref, "medium", '"' + name.substr(0, 200) + '"', "one of " + known);
  }
}

void read_oh_temperature(ConfigTable& table, OhSurface& surface) {
  constexpr double kFreezing_K = 273.15;
  NumberRange range_C{-50.0, 60.0};
  Interval known_K{range_C.low + kFreezing_K, range_C.high + kFreezing_K};
  if (const auto* medium = std::get_if<DielectricMedium>(&surface.medium))
    if (const auto of_medium_K = valid_temperature_K(*medium)) {
      known_K = *of_medium_K;
      // To hundredths: 240 K are -33.15 C.
      range_C.low = std::round((known_K.low - kFreezing_K) * 100.0) / 100.0;
      range_C.high = std::round((known_K.high - kFreezing_K) * 100.0) / 100.0;
    }
  const double temperature_C =
      table.number("temperature_C", range_C, std::clamp(15.0, range_C.low, range_C.high));
  surface.temperature_K = std::clamp(temperature_C + kFreezing_K, known_K.low, known_K.high);
}

OhSurface read_oh(ConfigTable& table) {
  OhSurface surface;
  surface.rms_height_m = table.required_number("rms_height_mm", kHeight_mm) / 1000.0;
  read_oh_medium(table, surface);
  read_oh_temperature(table, surface);
  return surface;
}

std::vector<double> read_levels(ConfigTable& table) {
  if (!table.has("sigma0_dB")) {
    if (!table.has("sigma0"))
      table.error(ErrorClass::ref, "sigma0_dB", "missing", "a level for every grazing angle");
    return table.numbers("sigma0", {0.0, 1e6}, 0, kMostRows);
  }
  if (table.has("sigma0"))
    table.error(ErrorClass::range, "sigma0", "given with sigma0_dB", "one of the two");
  std::vector<double> levels = table.numbers("sigma0_dB", {-300.0, 60.0}, 0, kMostRows);
  for (double& level : levels) level = core::power_from_dB(level);
  return levels;
}

TabulatedSurface read_table(ConfigTable& table) {
  TabulatedSurface surface;
  const std::size_t problems_before = table.problems().all().size();
  surface.frequency_range_Hz = read_interval(table, "frequency_range_GHz", {0.1, 1000.0}, 1e9);
  surface.polarisation = read_polarisation(table);
  if (!table.has("grazing_deg"))
    table.error(ErrorClass::ref, "grazing_deg", "missing", "an array of increasing angles");
  const std::vector<double> angles_deg =
      table.numbers("grazing_deg", {0.0, 90.0, true}, 0, kMostRows);
  const std::vector<double> levels = read_levels(table);
  if (angles_deg.size() != levels.size()) {
    // An array with a refused value comes back empty and has been reported.
    if (!angles_deg.empty() && !levels.empty())
      table.error(ErrorClass::range, "grazing_deg", std::to_string(angles_deg.size()) + " angles",
                  "as many as levels, " + std::to_string(levels.size()));
    return surface;
  }
  if (table.problems().all().size() != problems_before) return surface;
  std::vector<NrcsSample> rows;
  for (std::size_t i = 0; i < levels.size(); ++i)
    rows.push_back({core::radians(angles_deg[i]), levels[i]});
  try {
    surface.table = TabulatedNrcs(std::move(rows));
  } catch (const core::InputError& error) {
    for (const core::Problem& problem : error.problems())
      table.problems().append({{problem.code, table.place("grazing_deg"),
                                table.path("grazing_deg") + " (" + problem.field + ")",
                                problem.value, problem.expected}});
  }
  return surface;
}

}  // namespace

SurfaceModel read_surface_model(ConfigTable& table) {
  switch (table.choice("model",
                       {"phong", "constant-gamma", "kulemin", "git-land", "nrl-sea", "oh1992",
                        "rough-metal", "tabulated"},
                       0)) {
    case 1:
      return ConstantGammaSurface{
          static_cast<GammaTerrain>(read_name(table, "terrain", kGammaTerrainNames))};
    case 2:
      return KuleminSurface{
          static_cast<KuleminTerrain>(read_name(table, "terrain", kKuleminTerrainNames))};
    case 3:
      return GitLandSurface{static_cast<GitTerrain>(read_name(table, "terrain", kGitTerrainNames))};
    case 4:
      return NrlSeaSurface{table.required_number("sea_state", {0.0, 6.0})};
    case 5:
      return read_oh(table);
    case 6:
      return RoughMetal{table.required_number("rms_slope", {0.01, 1.0}),
                        table.required_number("rms_height_mm", kHeight_mm) / 1000.0};
    case 7:
      return read_table(table);
    default:
      return read_phong(table);
  }
}

std::optional<PhongReference> read_reference(ConfigTable& row) {
  ConfigTable table = row.table("reference");
  if (!table.present()) return std::nullopt;
  PhongReference reference;
  if (!table.has("model"))
    table.error(ErrorClass::ref, "model", "missing", "the model that was fitted");
  reference.model = read_surface_model(table);
  reference.angles =
      static_cast<FitAngles>(table.choice("fit_angles", {"standard", "steep", "to-normal"}, 0));
  reference.offset_dB = table.number("offset_dB", {-40.0, 40.0}, 0.0);
  reference.exponent_to_Hz = table.number("exponent_to_GHz", {1.0, 300.0}, 0.0) * 1e9;
  return reference;
}

}  // namespace fanbeam::materials
