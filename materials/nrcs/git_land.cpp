#include "materials/nrcs/git_land.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "core/number_range.h"

namespace fanbeam::materials {
namespace {

struct Row {
  double a;
  double b;
  double c_rad;
};

constexpr std::array<double, 3> kBand_Hz = {10e9, 35e9, 95e9};

// By band, then in the order of GitTerrain.
constexpr std::array<std::array<std::optional<Row>, 6>, 3> kRows = {{
    {{Row{0.023, 1.5, 0.012}, Row{0.006, 1.5, 0.012}, Row{0.002, 0.64, 0.002},
      Row{0.0246, 1.7, 0.0016}, Row{0.195, 1.7, 0.0016}, Row{2.0, 1.8, 0.015}}},
    {{Row{0.125, 1.5, 0.012}, Row{0.125, 1.5, 0.012}, Row{0.036, 0.64, 0.012},
      Row{0.195, 1.7, 0.008}, Row{2.45, 1.7, 0.0016}, std::nullopt}},
    {{Row{0.30, 1.5, 0.012}, Row{0.30, 1.5, 0.012}, Row{0.08, 0.64, 0.012}, Row{1.138, 0.83, 0.008},
      Row{3.6, 0.83, 0.0016}, std::nullopt}},
}};

const std::optional<Row>& row_of(GitTerrain terrain, std::size_t band) {
  return kRows[band][static_cast<std::size_t>(terrain)];
}

double evaluate(const Row& row, double grazing_rad) {
  if (!(grazing_rad >= 0.0)) return 0.0;
  return row.a * std::pow(grazing_rad + row.c_rad, row.b);
}

}  // namespace

Interval git_land_frequency_Hz(GitTerrain terrain) {
  // Every terrain has the lowest band.
  std::size_t highest = kBand_Hz.size() - 1;
  while (!row_of(terrain, highest)) --highest;
  return {kBand_Hz[0], kBand_Hz[highest]};
}

double git_land_sigma0(GitTerrain terrain, GitBand band, double grazing_rad) {
  const auto index = static_cast<std::size_t>(band);
  const std::optional<Row>& row = row_of(terrain, index);
  if (!row)
    core::throw_input_error(core::ErrorClass::range, "frequency_GHz", kBand_Hz[index] / 1e9,
                            "a band with a row for " +
                                std::string(kGitTerrainNames[static_cast<std::size_t>(terrain)]));
  return evaluate(*row, grazing_rad);
}

double git_land_sigma0(GitTerrain terrain, double frequency_Hz, double grazing_rad) {
  const Interval known = git_land_frequency_Hz(terrain);
  core::require_range("frequency_Hz", frequency_Hz, {known.low, known.high});
  for (std::size_t band = 0; band < kBand_Hz.size(); ++band)
    if (frequency_Hz == kBand_Hz[band]) return evaluate(*row_of(terrain, band), grazing_rad);
  const std::size_t lower = frequency_Hz < kBand_Hz[1] ? 0 : 1;
  const double below = evaluate(*row_of(terrain, lower), grazing_rad);
  const double above = evaluate(*row_of(terrain, lower + 1), grazing_rad);
  if (below == 0.0) return 0.0;  // a back face
  const double share =
      std::log(frequency_Hz / kBand_Hz[lower]) / std::log(kBand_Hz[lower + 1] / kBand_Hz[lower]);
  return below * std::pow(above / below, share);
}

}  // namespace fanbeam::materials
