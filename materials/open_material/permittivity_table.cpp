#include "materials/open_material/permittivity_table.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "materials/open_material/metadata_private.h"
#include "materials/open_material/number_table_private.h"

namespace fanbeam::materials {
namespace {

constexpr double kLeastLossOfMetal = 100.0;

std::string millimetres(double wavelength_m) {
  return core::number_text(std::round(wavelength_m * 1e7) / 1e4) + " mm";
}

bool differs_from_one(const std::optional<double>& real, const std::optional<double>& loss) {
  return std::abs(real.value_or(1.0) - 1.0) > 0.01 || loss.value_or(0.0) > 0.01;
}

}  // namespace

PermittivityTable PermittivityTable::from_file(const std::filesystem::path& file,
                                               core::ProblemList& problems) {
  PermittivityTable table;
  const auto json = core::read_json_file(file, kLargestTableFile_bytes, kJsonLimits, problems);
  if (!json) return table;
  const core::JsonNode root(*json, problems);
  check_metadata(root, "materialVersion");
  const core::NumberRange positive{0.0, kLargestPermittivity};
  const std::vector<TableRow> rows = read_number_table(
      root.required("electromagneticProperties"), {kTableWavelength_m,
                                                   {0.0, 1e5},
                                                   {0.0, 100.0},
                                                   {1.0, kLargestPermittivity},
                                                   positive,
                                                   {-kLargestPermittivity, kLargestPermittivity},
                                                   positive});
  for (const TableRow& row : rows)
    if (row[0] && row[5] && row[6])
      table.rows_.push_back({*row[0], row[1], differs_from_one(row[3], row[4]), *row[5], *row[6]});
  std::stable_sort(table.rows_.begin(), table.rows_.end(),
                   [](const Row& a, const Row& b) { return a.wavelength_m < b.wavelength_m; });
  return table;
}

const PermittivityTable::Row* PermittivityTable::nearest(double wavelength_m,
                                                         double temperature_K) const {
  const auto distance_K = [&](const Row& row) {
    return row.temperature_K ? std::abs(*row.temperature_K - temperature_K) : 0.0;
  };
  const Row* best = nullptr;
  for (const Row& row : rows_)
    if (row.wavelength_m == wavelength_m && (!best || distance_K(row) < distance_K(*best)))
      best = &row;
  return best;
}

Lookup<Permittivity> PermittivityTable::at(const RadarQuery& query) const {
  const double asked_m = core::kSpeedOfLight_mps / query.frequency_Hz;
  if (rows_.empty()) return {{}, "no row with a wavelength, eps' and eps''"};
  const double lowest_m = rows_.front().wavelength_m, highest_m = rows_.back().wavelength_m;
  if (asked_m < lowest_m * (1.0 - kWavelengthTolerance) ||
      asked_m > highest_m * (1.0 + kWavelengthTolerance))
    return {{},
            "wavelengths " + millimetres(lowest_m) + " to " + millimetres(highest_m) + ", not " +
                millimetres(asked_m)};
  const double wavelength_m = std::clamp(asked_m, lowest_m, highest_m);
  const auto above =
      std::lower_bound(rows_.begin(), rows_.end(), wavelength_m,
                       [](const Row& row, double value_m) { return row.wavelength_m < value_m; });
  const auto below = above->wavelength_m == wavelength_m ? above : above - 1;
  const Row& low = *nearest(below->wavelength_m, query.temperature_K);
  const Row& high = *nearest(above->wavelength_m, query.temperature_K);
  if (low.magnetic || high.magnetic) return {{}, "a magnetic medium, mu other than 1"};
  const double share = below == above ? 0.0
                                      : std::log(wavelength_m / low.wavelength_m) /
                                            std::log(high.wavelength_m / low.wavelength_m);
  Permittivity eps{low.real + share * (high.real - low.real),
                   low.loss + share * (high.loss - low.loss)};
  if (eps.real < 1.0 && eps.loss >= kLeastLossOfMetal * std::abs(eps.real)) eps.real = 1.0;
  if (eps.real < 1.0)
    return {{}, "eps' = " + core::number_text(eps.real) + ", below 1 without a metal's loss"};
  return {eps, {}};
}

}  // namespace fanbeam::materials
