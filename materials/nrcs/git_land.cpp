#include "materials/nrcs/git_land.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace fanbeam::materials {
namespace {

struct Coefficients {
  double a;
  double b;
  double c_rad;
};

// Rows in the order of GitTerrain.
constexpr std::array<Coefficients, 5> kAt35GHz = {{
    {0.125, 1.5, 0.012},
    {0.125, 1.5, 0.012},
    {0.036, 0.64, 0.012},
    {0.195, 1.7, 0.008},
    {2.45, 1.7, 0.0016},
}};
constexpr std::array<Coefficients, 5> kAt95GHz = {{
    {0.30, 1.5, 0.012},
    {0.30, 1.5, 0.012},
    {0.08, 0.64, 0.012},
    {1.138, 0.83, 0.008},
    {3.6, 0.83, 0.0016},
}};

}  // namespace

double git_land_sigma0(GitTerrain terrain, GitBand band, double grazing_rad) {
  if (!(grazing_rad >= 0.0)) return 0.0;
  const auto& rows = band == GitBand::ka_35GHz ? kAt35GHz : kAt95GHz;
  const Coefficients& row = rows[static_cast<std::size_t>(terrain)];
  return row.a * std::pow(grazing_rad + row.c_rad, row.b);
}

}  // namespace fanbeam::materials
