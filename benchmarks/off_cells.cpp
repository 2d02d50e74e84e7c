#include "benchmarks/off_cells.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "renderer/casting/profile/profile_caster.h"
#include "renderer/casting/ray_caster.h"
#include "renderer/frame_renderer.h"

namespace fanbeam::benchmarks {
namespace {

using renderer::FanSums;

// Slices, but the reference's rays in the sub-columns that they leave to rays.
class CompletedSlices : public renderer::Caster {
 public:
  CompletedSlices(const renderer::World& world, const renderer::Sampling& sampling,
                  const renderer::Sampling& reference)
      : slices_(world, sampling), rays_(world, sampling), reference_(world, reference) {}

  void cast(const sensors::AntennaFrame& antenna, bool with_cscope, const renderer::CastPass& pass,
            FanSums& sums, renderer::SightLines& sight) const override {
    slices_.cast(antenna, with_cscope, pass, sums, sight);
    FanSums rays, converged;
    rays_.Caster::cast(antenna, with_cscope, rays);
    reference_.Caster::cast(antenna, with_cscope, converged);
    const auto cells = static_cast<std::size_t>(sums.cells);
    const auto rows = static_cast<std::size_t>(sums.rows);
    for (std::size_t sub = 0; sub < static_cast<std::size_t>(sums.sub_columns); ++sub) {
      // Two casters only agree to the last bit where they are one and the same.
      const auto own = sums.range_W_per_rad.begin() + static_cast<std::ptrdiff_t>(sub * cells);
      if (!std::equal(own, own + static_cast<std::ptrdiff_t>(cells),
                      rays.range_W_per_rad.begin() + static_cast<std::ptrdiff_t>(sub * cells)))
        continue;
      std::copy_n(&converged.range_W_per_rad[sub * cells], cells,
                  &sums.range_W_per_rad[sub * cells]);
      if (rows > 0)
        std::copy_n(&converged.elevation_W_m3_per_rad[sub * rows], rows,
                    &sums.elevation_W_m3_per_rad[sub * rows]);
    }
  }

 private:
  renderer::ProfileCaster slices_;
  renderer::RayCaster rays_, reference_;
};

FramePower completed_slices(const View& view, const Effort& effort,
                            const renderer::Sampling& sampling) {
  renderer::Sampling reference = effort.reference(2);
  reference.jittered_passes = std::max(
      1, reference.jittered_passes * reference.sub_columns / std::max(1, sampling.sub_columns));
  reference.sub_columns = sampling.sub_columns;
  const renderer::FrameRenderer renderer(
      view.world(), sampling, {}, view.scene->effects(),
      std::make_unique<CompletedSlices>(view.world(), sampling, reference));
  return power_of(renderer.render(view.pose));
}

// One picture of each kind: grey of all, power of the first two.
struct Pictures {
  const std::vector<double>&slices, &reference, &second, &finer, &completed;
  const std::vector<double>&slices_power, &reference_power;
};

bool apart(double a, double b) { return std::abs(a - b) > kClearlyOff_grey; }

double brightest_neighbour(const std::vector<double>& power, std::size_t row, std::size_t column,
                           std::size_t columns) {
  const std::size_t rows = power.size() / columns;
  double brightest = 0.0;
  for (std::size_t r = row > 0 ? row - 1 : 0; r <= std::min(row + 1, rows - 1); ++r)
    for (std::size_t c = column > 0 ? column - 1 : 0; c <= std::min(column + 1, columns - 1); ++c)
      if (r != row || c != column) brightest = std::max(brightest, power[r * columns + c]);
  return brightest;
}

OffCause cause_of(const Pictures& of, std::size_t i, std::size_t columns) {
  const double reference = of.reference[i], second = of.second[i];
  if (std::abs(second - reference) > std::abs(of.slices[i] - reference) / 2 ||
      !apart(of.slices[i], second))
    return OffCause::reference;
  const auto back = [&](double grey) { return !apart(grey, reference) || !apart(grey, second); };
  if (back(of.finer[i])) return OffCause::slices;
  if (back(of.completed[i])) return OffCause::left_to_rays;
  const double neighbour =
      brightest_neighbour(of.reference_power, i / columns, i % columns, columns);
  return std::abs(of.slices_power[i] - of.reference_power[i]) < kSliver * neighbour
             ? OffCause::border
             : OffCause::unexplained;
}

std::vector<OffCell> explain(const Pictures& of, std::size_t columns) {
  std::vector<OffCell> cells;
  for (std::size_t i = 0; i < of.slices.size(); ++i)
    if (apart(of.slices[i], of.reference[i]))
      cells.push_back({i / columns, i % columns, cause_of(of, i, columns), of.slices[i],
                       of.reference[i], of.second[i]});
  return cells;
}

bool any_apart(const std::vector<double>& a, const std::vector<double>& b) {
  return !std::equal(a.begin(), a.end(), b.begin(),
                     [](double x, double y) { return !apart(x, y); });
}

}  // namespace

std::size_t count_of(const std::vector<OffCell>& cells, OffCause cause) {
  return static_cast<std::size_t>(std::count_if(
      cells.begin(), cells.end(), [&](const OffCell& cell) { return cell.cause == cause; }));
}

OffCells explain_off_cells(const View& view, const Effort& effort, const FramePower& slices,
                           const FramePower& reference) {
  const sensors::Sensor& sensor = view.sensor();
  const FrameGrey grey = grey_of(sensor, slices, false);
  const FrameGrey reference_grey = grey_of(sensor, reference, false);
  if (!any_apart(grey.bscope, reference_grey.bscope) &&
      !any_apart(grey.cscope, reference_grey.cscope))
    return {};
  const auto finer = renderer::profile_sampling_for(4.0 * effort.converged_slices);
  const FrameGrey second = grey_of(sensor, clock_of(view, effort.reference(2)).power(), false);
  const FrameGrey fine = grey_of(sensor, clock_of(view, finer).power(), false);
  const FrameGrey completed = view.world().solids().others.empty()
                                  ? fine
                                  : grey_of(sensor, completed_slices(view, effort, finer), false);
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  return {explain({grey.bscope, reference_grey.bscope, second.bscope, fine.bscope, completed.bscope,
                   slices.bscope_W, reference.bscope_W},
                  columns),
          explain({grey.cscope, reference_grey.cscope, second.cscope, fine.cscope, completed.cscope,
                   slices.cscope_W_m3, reference.cscope_W_m3},
                  columns)};
}

}  // namespace fanbeam::benchmarks
