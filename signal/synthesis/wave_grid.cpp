#include <algorithm>
#include <cmath>

#include "core/dispatch.h"
#include "core/parallel.h"
#include "signal/synthesis/lanes_private.h"
#include "signal/synthesis/wave_grid_private.h"

namespace fanbeam::signal {
namespace {

// First cell of a point at `place`, and the weights of it and the next seven (zero beyond the
// width).
FANBEAM_LANES_INLINE int weigh_taps(const float* taps, int powers, int width, double place,
                                    Lanes<float>& weights) {
  const double begin = place - 0.5 * width;
  const double first = std::ceil(begin);
  const auto u = static_cast<float>(2.0 * (first - begin) - 1.0);
  load<float>(taps + (powers - 1) * kLanes, weights);
  for (int power = powers - 2; power >= 0; --power) {
    Lanes<float> coefficients;
    load<float>(taps + power * kLanes, coefficients);
    weights = weights * u + coefficients;
  }
  return static_cast<int>(first);
}

struct GridPlanes {
  float* values;
  std::size_t row, plane;  // floats
  int delays;
};

FANBEAM_HOT(void, add_point,
            (const float* taps, int powers, int width, const WavePoint& point,
             const GridPlanes& target),
            (taps, powers, width, point, target)) {
  Lanes<float> by_rate, by_sine, by_delay;
  const int rate = weigh_taps(taps, powers, width, point.rate_cell, by_rate);
  const int sine = weigh_taps(taps, powers, width, point.sine_cell, by_sine);
  const double turned = point.delay_cell - 0.5 * width;
  const double place = turned - target.delays * std::floor(turned / target.delays);
  const int delay = weigh_taps(taps, powers, width, place + 0.5 * width, by_delay);
  float run[2 * kLanes];
  const auto re = static_cast<float>(point.value.real());
  const auto im = static_cast<float>(point.value.imag());
  for (int i = 0; i < kLanes; ++i) {
    run[2 * i] = by_delay[i] * re;
    run[2 * i + 1] = by_delay[i] * im;
  }
  Lanes<float> low, high;
  load<float>(run, low);
  load<float>(run + kLanes, high);
  for (int i = 0; i < width; ++i)
    for (int j = 0; j < width; ++j) {
      const float weight = by_rate[i] * by_sine[j];
      float* at = target.values + static_cast<std::size_t>(rate + i) * target.plane +
                  static_cast<std::size_t>(sine + j) * target.row +
                  static_cast<std::size_t>(2 * delay);
      add_to<float>(at, weight * low);
      add_to<float>(at + kLanes, weight * high);
    }
}

// Indices of the points in order of rate, then sine; points of one place keep their order. Returns
// where each rate begins.
std::vector<std::uint32_t> sort_by_place(const std::vector<WavePoint>& points, int rates, int sines,
                                         std::vector<std::uint32_t>& order) {
  const auto key_of = [&](const WavePoint& point) {
    return static_cast<std::size_t>(point.rate_cell) * static_cast<std::size_t>(sines) +
           static_cast<std::size_t>(point.sine_cell);
  };
  const std::size_t keys = static_cast<std::size_t>(rates) * static_cast<std::size_t>(sines);
  std::vector<std::uint32_t> begin(keys + 1, 0);
  for (const WavePoint& point : points) ++begin[key_of(point) + 1];
  for (std::size_t key = 0; key < keys; ++key) begin[key + 1] += begin[key];
  std::vector<std::uint32_t> rate_begin;
  for (int rate = 0; rate <= rates; ++rate)
    rate_begin.push_back(begin[static_cast<std::size_t>(rate) * static_cast<std::size_t>(sines)]);
  order.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    order[begin[key_of(points[i])]++] = static_cast<std::uint32_t>(i);
  return rate_begin;
}

}  // namespace

WaveGrid::WaveGrid(const SpreadingKernel& kernel, int rates, int sines, int delays)
    : width_(kernel.width()),
      rates_(rates),
      sines_(sines),
      delays_(delays),
      stride_(static_cast<std::size_t>(delays + kLanes)) {
  const int powers = kernel.degree() + 1;
  for (int power = 0; power < powers; ++power)
    for (int tap = 0; tap < kLanes; ++tap)
      taps_.push_back(
          tap < width_
              ? static_cast<float>(kernel.taps()[static_cast<std::size_t>(tap * powers + power)])
              : 0.0f);
  values_.resize(static_cast<std::size_t>(rates) * static_cast<std::size_t>(sines) * stride_);
}

void WaveGrid::spread(const std::vector<WavePoint>& points) {
  std::vector<std::uint32_t> order;
  const std::vector<std::uint32_t> rate_begin = sort_by_place(points, rates_, sines_, order);
  const GridPlanes target{reinterpret_cast<float*>(values_.data()), 2 * stride_,
                          2 * stride_ * static_cast<std::size_t>(sines_), delays_};
  const int powers = static_cast<int>(taps_.size()) / kLanes;
  const int slab = 2 * width_;
  const int slabs = (rates_ + slab - 1) / slab;
  for (int parity = 0; parity < 2; ++parity)
    core::parallel_for(static_cast<std::size_t>((slabs + 1 - parity) / 2), [&](std::size_t job) {
      const int first = (2 * static_cast<int>(job) + parity) * slab;
      const int last = std::min(rates_, first + slab);
      for (std::uint32_t i = rate_begin[static_cast<std::size_t>(first)];
           i < rate_begin[static_cast<std::size_t>(last)]; ++i)
        add_point(taps_.data(), powers, width_, points[order[i]], target);
    });
  core::parallel_for(static_cast<std::size_t>(rates_), [&](std::size_t rate) {
    for (int sine = 0; sine < sines_; ++sine) {
      std::complex<float>* values = row(static_cast<int>(rate), sine);
      for (int i = 0; i < kLanes; ++i) values[i] += values[delays_ + i];
    }
  });
}

}  // namespace fanbeam::signal
