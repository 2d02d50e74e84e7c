#include "renderer/stages/bounce_weights.h"

#include <algorithm>
#include <cmath>

#include "core/series.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/stages/bounce_limits.h"
#include "terrain/secondary_origin.h"

namespace fanbeam::renderer {
namespace {

sensors::BeamCut without_side_lobes(sensors::BeamCut cut) {
  cut.side_lobe_gain = cut.side_lobe_extent_rad = 0.0;
  return cut;
}

double power_left(double loss_dB) {
  constexpr double kNepersPerDB = 0.23025850929940456840;  // ln 10 / 10
  return core::series_decay(kNepersPerDB * loss_dB);
}

}  // namespace

BounceWeights::BounceWeights(const World& world, bool noise)
    : world_(world),
      nrcs_(world.nrcs.bistatic()),
      elevation_gain_(world.sensor.antenna.elevation),
      azimuth_gain_(without_side_lobes(world.sensor.antenna.azimuth)),
      radar_constant_W_m2_(world.sensor.radar_constant_W_m2()),
      faintest_W_per_rad2_(faintest_echoes_W_per_rad2(world.sensor, noise)),
      faintest_mirror_(renderer::faintest_mirror(world.sensor, nrcs_, faintest_W_per_rad2_)) {}

void BounceWeights::weigh(const BounceView& view, const MirroredRays& ways, std::size_t first,
                          std::vector<BounceEcho>& images, BounceReturns& returns) const {
  for (int k = 0; k < ways.rays.count; ++k)
    if (ways.rays.geometry[k] != terrain::kNoHit && ways.hits.sin_grazing[k] > 0.0)
      weigh_one(view, ways, k, first + static_cast<std::size_t>(ways.first[k]), images, returns);
}

void BounceWeights::weigh_one(const BounceView& view, const MirroredRays& ways, int k,
                              std::size_t ray, std::vector<BounceEcho>& images,
                              BounceReturns& returns) const {
  const glm::dvec3& antenna_m = view.antenna.position_m;
  const glm::dvec3 mirror_m = ways.mirrors.point_m.at(k), point_m = ways.hits.point_m.at(k);
  const BistaticNrcs& nrcs = nrcs_[world_.surfaces().material(
      ways.rays.geometry[k], ways.rays.primitive[k], point_m.x, point_m.y)];
  BounceEcho image = image_of(ways, k, nrcs), pair;
  const bool image_shows = shows(image);
  if (ways.returns[k] > 0.0) pair = pair_of(ways, k, nrcs);
  const bool pair_shows = shows(pair);
  if (!image_shows && !pair_shows) return;
  const double there_dB = loss_dB(antenna_m, mirror_m, ways.mirrors.distance_m[k]) +
                          loss_dB(mirror_m, point_m, ways.hits.distance_m[k]);
  image.ray = pair.ray = ray;
  if (image_shows) {
    image.left = power_left(2.0 * there_dB);
    images.push_back(image);
  }
  if (!pair_shows) return;
  pair.left = power_left(there_dB + loss_dB(point_m, antenna_m, ways.back_m[k]));
  returns.pairs.push_back(pair);
  const glm::dvec3 start_m =
      terrain::secondary_origin_m(point_m, ways.hits.normal.at(k), ways.hits.distance_m[k]);
  returns.rays.aim(returns.rays.count++, world_.surfaces().in_caster_m(start_m),
                   antenna_m - start_m, 1.0);
}

double BounceWeights::loss_dB(const glm::dvec3& a_m, const glm::dvec3& b_m, double length_m) const {
  double one_way_dB = 0.0;
  if (!world_.attenuation.is_clear())
    one_way_dB = world_.attenuation.one_way_dB(a_m.z, b_m.z, length_m);
  if (world_.rain_cells) one_way_dB += world_.rain_cells->one_way_dB(a_m, b_m);
  return one_way_dB;
}

bool BounceWeights::shows(const BounceEcho& echo) const {
  const sensors::RangeGate& gate = world_.sensor.range;
  // What a ray stands for may reach beyond it by a cell or two.
  const double cell = (echo.range_m - gate.minimum_m) / gate.cell_m;
  if (!(cell > -kSpreadCells && cell < gate.cells + kSpreadCells)) return false;
  const auto at = static_cast<std::size_t>(std::clamp(cell, 0.0, gate.cells - 1.0));
  return echo.density_W_per_rad2 > faintest_W_per_rad2_[at];
}

BounceEcho BounceWeights::image_of(const MirroredRays& ways, int k,
                                   const BistaticNrcs& nrcs) const {
  const double elevation_rad = ways.angles.elevation_rad[k];
  BounceEcho echo;
  echo.range_m = ways.length_m[k];
  echo.range_m_per_rad = ways.m_per_rad[k];
  echo.azimuth_rad = ways.angles.azimuth_rad[k];
  echo.elevation_rad = elevation_rad;
  echo.elevation_rate = 1.0;
  echo.density_W_per_rad2 =
      radar_constant_W_m2_ *
      elevation_gain_(elevation_rad - world_.sensor.antenna.boresight_elevation_rad) *
      ways.reflection[k] * ways.reflection[k] *
      nrcs.monostatic().sigma0_over_sine(ways.hits.sin_grazing[k]) * jacobian(ways, k) /
      (echo.range_m * echo.range_m);
  return echo;
}

BounceEcho BounceWeights::pair_of(const MirroredRays& ways, int k, const BistaticNrcs& nrcs) const {
  const double azimuth_rad = ways.angles.azimuth_rad[k];
  const double elevation_rad = ways.angles.elevation_rad[k];
  // Exact for a Gaussian beam: g(x + d) g(x - d) = g(x)^2 g(d)^2.
  const double apart = azimuth_gain_((azimuth_rad - ways.azimuth_rad[k]) / 2);
  if (!(apart > 0.0)) return {};
  const double boresight_rad = world_.sensor.antenna.boresight_elevation_rad;
  const double gain = std::sqrt(elevation_gain_(elevation_rad - boresight_rad) *
                                elevation_gain_(ways.elevation_rad[k] - boresight_rad)) *
                      apart;
  const double scatter =
      nrcs.sigma0_over_sine(ways.hits.sin_grazing[k], ways.sin_out[k], ways.normal_on_half[k]);
  BounceEcho echo;
  echo.range_m = (ways.length_m[k] + ways.back_m[k]) / 2;
  echo.range_m_per_rad = (ways.m_per_rad[k] + ways.back_m_per_rad[k]) / 2;
  echo.azimuth_rad = (azimuth_rad + ways.azimuth_rad[k]) / 2;
  echo.elevation_rad = (elevation_rad + ways.elevation_rad[k]) / 2;
  echo.elevation_rate = (1.0 + ways.turn[k]) / 2;
  echo.density_W_per_rad2 = 4.0 * radar_constant_W_m2_ * gain * ways.reflection[k] * scatter *
                            jacobian(ways, k) / (ways.back_m[k] * ways.back_m[k]);
  return echo;
}

// As in ray_caster.h.
double BounceWeights::jacobian(const MirroredRays& ways, int k) const {
  return world_.sensor.scan.surface == sensors::ScanSurface::cone
             ? std::max(ways.angles.cos_azimuth[k], 0.0)
             : 1.0;
}

}  // namespace fanbeam::renderer
