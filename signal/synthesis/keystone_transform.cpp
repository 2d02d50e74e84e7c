#include <algorithm>
#include <array>
#include <cmath>

#include "core/dispatch.h"
#include "core/parallel.h"
#include "signal/synthesis/keystone_transform_private.h"
#include "signal/synthesis/lanes_private.h"
#include "signal/synthesis/scaled_transform_private.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

using Turns = std::array<double, kLanes>;

// exp(j 2 pi (constant + linear i + quadratic i^2)) for i = 0, 1, 2, ..., with other numbers in
// every lane.
class LaneChirp {
 public:
  LaneChirp(const Turns& constant, const Turns& linear, const Turns& quadratic) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      set(values, lane, constant[lane]);
      set(steps_, lane, linear[lane] + quadratic[lane]);
      set(turn_, lane, 2.0 * quadratic[lane]);
    }
  }
  FANBEAM_LANES_INLINE void advance() {
    multiply_by(values, steps_);
    multiply_by(steps_, turn_);
  }
  ComplexLanes<double> values;

 private:
  static void set(ComplexLanes<double>& lanes, std::size_t lane, double turns) {
    const std::complex<double> value = unit_phasor(turns);
    lanes.re[lane] = value.real();
    lanes.im[lane] = value.imag();
  }
  ComplexLanes<double> steps_, turn_;
};

// 1 / transform of the kernel between 0 and 0.3 turns per cell: linear between 8193 points, 1e-7.
class InverseTransform {
 public:
  explicit InverseTransform(const SpreadingKernel& kernel) {
    for (int i = 0; i <= kPoints; ++i)
      values_.push_back(1.0 / kernel.transform(kMost * i / kPoints));
  }
  double at(double turns_per_cell) const {
    const double place = std::min(std::abs(turns_per_cell) * (kPoints / kMost), kPoints - 1e-9);
    const auto i = static_cast<std::size_t>(place);
    return values_[i] + (place - static_cast<double>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int kPoints = 8192;
  static constexpr double kMost = 0.3;
  std::vector<double> values_;
};

// Eight samples side by side.
struct Block {
  int first = 0, count = 0;
  std::array<double, kLanes> frequency_Hz{}, in_segment_s{};
};

Block block_at(const Frame& frame, int first) {
  Block block{first, std::min(kLanes, frame.shape.samples - first), {}, {}};
  for (int lane = 0; lane < kLanes; ++lane) {
    // Lanes beyond the end repeat the last sample and are thrown away.
    const int sample = first + std::min(lane, block.count - 1);
    block.frequency_Hz[static_cast<std::size_t>(lane)] = sample_frequency_Hz(frame, sample);
    block.in_segment_s[static_cast<std::size_t>(lane)] = sample / frame.sample_rate_Hz;
  }
  return block;
}

// exp(-j 2 pi f d U) and the kernel's inverse, for every sine and lane: what sums sines to one
// element: eight real parts, then eight imaginary ones.
std::vector<float> steering(const Block& block, const WaveAxis& sines,
                            const InverseTransform& inverse, double at_m) {
  std::vector<float> factors(static_cast<std::size_t>(2 * kLanes * sines.cells));
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const double per_unit = block.frequency_Hz[lane] * at_m;
    const double scale = inverse.at(per_unit * sines.step);
    for (int i = 0; i < sines.cells; ++i) {
      const std::complex<double> turn = unit_phasor(-per_unit * (sines.first + sines.step * i));
      const std::size_t at = static_cast<std::size_t>(2 * kLanes * i) + lane;
      factors[at] = static_cast<float>(scale * turn.real());
      factors[at + kLanes] = static_cast<float>(scale * turn.imag());
    }
  }
  return factors;
}

// One block's samples of the whole grid, close together: eight real parts and eight imaginary ones
// for every rate and sine. All channels read them.
std::vector<float> gather(const WaveGrid& grid, const Block& block) {
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(2 * kLanes) * static_cast<std::size_t>(grid.rates()) *
                 static_cast<std::size_t>(grid.sines()));
  for (int rate = 0; rate < grid.rates(); ++rate)
    for (int sine = 0; sine < grid.sines(); ++sine) {
      const float* row = reinterpret_cast<const float*>(grid.row(rate, sine)) + block.first;
      values.insert(values.end(), row, row + kLanes);
      values.insert(values.end(), row + grid.delays(), row + grid.delays() + kLanes);
    }
  return values;
}

FANBEAM_HOT(void, sum_sines, (const float* values, const float* factors, int sines, float* sum),
            (values, factors, sines, sum)) {
  Lanes<float> re = {}, im = {};
  for (int i = 0; i < sines; ++i) {
    Lanes<float> value_re, value_im, factor_re, factor_im;
    load<float>(factors + 2 * kLanes * i, factor_re);
    load<float>(factors + 2 * kLanes * i + kLanes, factor_im);
    load<float>(values + 2 * kLanes * i, value_re);
    load<float>(values + 2 * kLanes * i + kLanes, value_im);
    re += value_re * factor_re - value_im * factor_im;
    im += value_re * factor_im + value_im * factor_re;
  }
  std::memcpy(sum, &re, sizeof(re));
  std::memcpy(sum + kLanes, &im, sizeof(im));
}

void do_channel(const Frame& frame, const KeystoneAxes& axes, const Block& block, int channel,
                const InverseTransform& inverse, const std::vector<float>& values,
                ScaledTransform& transform, FloatCube& cube) {
  const std::vector<float> factors =
      steering(block, axes.sine_s_per_m, inverse, element_m(frame, channel));
  const double start_s = frame.segment(channel, 0).start_s - axes.reference_s;
  Turns constant, linear, curve, after_linear;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const double f_Hz = block.frequency_Hz[lane];
    const double t_s = start_s + block.in_segment_s[lane];
    constant[lane] = f_Hz * axes.rate.first * t_s;
    linear[lane] = f_Hz * axes.rate.step * t_s;
    curve[lane] = 0.5 * f_Hz * axes.rate.step * frame.interval_s;
    after_linear[lane] = f_Hz * axes.rate.first * frame.interval_s;
  }
  transform.clear();
  LaneChirp before(constant, linear, curve);
  const int sines = axes.sine_s_per_m.cells;
  for (int j = 0; j < axes.rate.cells; ++j) {
    float sum[2 * kLanes];
    sum_sines(
        values.data() + static_cast<std::size_t>(2 * kLanes * sines) * static_cast<std::size_t>(j),
        factors.data(), sines, sum);
    for (int lane = 0; lane < block.count; ++lane) {
      const auto turn_re = static_cast<float>(before.values.re[lane]);
      const auto turn_im = static_cast<float>(before.values.im[lane]);
      const float re = sum[lane], im = sum[lane + kLanes];
      transform.input(lane, j) = {re * turn_re - im * turn_im, re * turn_im + im * turn_re};
    }
    before.advance();
  }
  transform.run();
  LaneChirp after(Turns{}, after_linear, curve);
  for (int m = 0; m < frame.shape.chirps; ++m) {
    for (int lane = 0; lane < block.count; ++lane) {
      const auto l = static_cast<std::size_t>(lane);
      const double t_s = start_s + block.in_segment_s[l] + m * frame.interval_s;
      const double scale = inverse.at(block.frequency_Hz[l] * t_s * axes.rate.step);
      const std::complex<double> value(transform.output(lane, m));
      const double re = after.values.re[lane] * scale, im = after.values.im[lane] * scale;
      cube.at(channel, m, block.first + lane) = {
          static_cast<float>(re * value.real() - im * value.imag()),
          static_cast<float>(re * value.imag() + im * value.real())};
    }
    after.advance();
  }
}

}  // namespace

void transform_rates_and_sines(const Frame& frame, const std::vector<int>& channels,
                               const KeystoneAxes& axes, const SpreadingKernel& kernel,
                               const WaveGrid& grid, FloatCube& cube) {
  const InverseTransform inverse(kernel);
  const int blocks = (frame.shape.samples + kLanes - 1) / kLanes;
  core::parallel_for(static_cast<std::size_t>(blocks), [&](std::size_t at) {
    const Block block = block_at(frame, static_cast<int>(at) * kLanes);
    Turns turns_per_step;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      turns_per_step[lane] = block.frequency_Hz[lane] * axes.rate.step * frame.interval_s;
    const std::vector<float> values = gather(grid, block);
    ScaledTransform transform(grid.rates(), frame.shape.chirps, turns_per_step);
    for (const int channel : channels)
      do_channel(frame, axes, block, channel, inverse, values, transform, cube);
  });
}

}  // namespace fanbeam::signal
