#include "materials/open_material/brdf_table.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/constants.h"
#include "core/units.h"
#include "materials/open_material/metadata_private.h"
#include "materials/open_material/number_table_private.h"

namespace fanbeam::materials {
namespace {

constexpr double kAngleTolerance_rad = 1e-3;
constexpr double kFinestStep_rad = 1e-6;
constexpr double kLargestBrdf_per_sr = 7e4;  // times 4 pi below the largest sigma0 of a table

bool is_backscatter(double incident_rad, double exit_rad, double azimuth_rad) {
  if (std::abs(incident_rad - exit_rad) > kAngleTolerance_rad) return false;
  return incident_rad < kAngleTolerance_rad || azimuth_rad < kAngleTolerance_rad ||
         azimuth_rad > 2.0 * core::kPi - kAngleTolerance_rad;
}

// Grazing angles that carry a curve like sin^2: close together where it falls steeply.
std::vector<double> grazing_grid_rad() {
  std::vector<double> grid_rad;
  for (const double grazing_deg : {0.1, 0.2, 0.5}) grid_rad.push_back(core::radians(grazing_deg));
  for (int grazing_deg = 1; grazing_deg < 90; ++grazing_deg)
    grid_rad.push_back(core::radians(grazing_deg));
  grid_rad.push_back(core::kPi / 2.0);
  return grid_rad;
}

}  // namespace

BrdfTable BrdfTable::from_file(const std::filesystem::path& file, core::ProblemList& problems) {
  BrdfTable table;
  const auto json = core::read_json_file(file, kLargestTableFile_bytes, kJsonLimits, problems);
  if (!json) return table;
  const core::JsonNode root(*json, problems);
  check_metadata(root, "materialVersion");
  const core::JsonNode brdf = root.required("brdf");
  brdf.required("wavelengths").numbers(kTableWavelength_m, kMostTableRows);
  const std::vector<TableRow> rows =
      read_number_table(brdf.required("lookupTable"), {kTableWavelength_m,
                                                       kTableZenith_rad,
                                                       kTableZenith_rad,
                                                       {0.0, 6.283186},
                                                       {0.0, kLargestBrdf_per_sr}});
  const auto complete = [](const TableRow& row) {
    return std::all_of(row.begin(), row.end(), [](const auto& cell) { return cell.has_value(); });
  };
  for (const TableRow& row : rows)
    if (complete(row) && is_backscatter(*row[1], *row[2], *row[3]))
      table.rows_.push_back({*row[0], *row[1], *row[4]});
  std::stable_sort(table.rows_.begin(), table.rows_.end(), [](const Row& a, const Row& b) {
    return std::tie(a.wavelength_m, a.zenith_rad) < std::tie(b.wavelength_m, b.zenith_rad);
  });
  return table;
}

Lookup<TabulatedSurface> BrdfTable::backscatter_at(const RadarQuery& query) const {
  if (rows_.empty()) return {{}, "no row in the backscatter direction"};
  const double asked_m = core::kSpeedOfLight_mps / query.frequency_Hz;
  const auto distance = [&](const Row& row) { return std::abs(asked_m / row.wavelength_m - 1.0); };
  const Row& nearest =
      *std::min_element(rows_.begin(), rows_.end(),
                        [&](const Row& a, const Row& b) { return distance(a) < distance(b); });
  if (distance(nearest) > kWavelengthTolerance)
    return {{}, "no backscatter within 10 % of the wavelength"};

  std::vector<Row> curve;
  for (const Row& row : rows_)
    if (row.wavelength_m == nearest.wavelength_m &&
        (curve.empty() || row.zenith_rad > curve.back().zenith_rad))
      curve.push_back(row);
  const auto brdf_per_sr = [&](double zenith_rad) {
    const auto above = std::find_if(curve.begin(), curve.end(),
                                    [&](const Row& row) { return row.zenith_rad >= zenith_rad; });
    if (above == curve.begin()) return above->brdf_per_sr;
    const Row& low = *(above - 1);
    if (above == curve.end()) return low.brdf_per_sr;
    const double share = (zenith_rad - low.zenith_rad) / (above->zenith_rad - low.zenith_rad);
    return low.brdf_per_sr + share * (above->brdf_per_sr - low.brdf_per_sr);
  };
  std::vector<double> grid_rad = grazing_grid_rad();
  for (const Row& row : curve) grid_rad.push_back(core::kPi / 2.0 - row.zenith_rad);
  std::sort(grid_rad.begin(), grid_rad.end());
  std::vector<NrcsSample> samples;
  for (const double grazing_rad : grid_rad) {
    const double last_rad = samples.empty() ? 0.0 : samples.back().grazing_rad;
    if (grazing_rad - last_rad < kFinestStep_rad) continue;
    const double cos_zenith = std::sin(grazing_rad);
    samples.push_back({grazing_rad, 4.0 * core::kPi * cos_zenith * cos_zenith *
                                        brdf_per_sr(core::kPi / 2.0 - grazing_rad)});
  }
  const double frequency_Hz = core::kSpeedOfLight_mps / nearest.wavelength_m;
  return {TabulatedSurface{TabulatedNrcs(std::move(samples)),
                           {frequency_Hz / (1.0 + kWavelengthTolerance),
                            frequency_Hz / (1.0 - kWavelengthTolerance)},
                           {}},
          {}};
}

}  // namespace fanbeam::materials
