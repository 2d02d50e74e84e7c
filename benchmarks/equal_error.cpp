#include "benchmarks/equal_error.h"

#include <cmath>

namespace fanbeam::benchmarks {
namespace {

struct Point {
  double rms, ms;
};

std::optional<double> interpolated_ms(const std::vector<Point>& points, double rms) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].rms > rms) continue;
    if (i == 0) return points[0].ms;
    const Point& a = points[i - 1];
    const Point& b = points[i];
    const double share = std::log(a.rms / rms) / std::log(a.rms / b.rms);
    return a.ms * std::pow(b.ms / a.ms, share);
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> ms_at_error(const std::vector<SamplingFigures>& ladder, double rms) {
  std::vector<Point> points;
  for (const SamplingFigures& step : ladder)
    points.push_back({step.error.bscope.noise_free.rms, step.frame_ms});
  return interpolated_ms(points, rms);
}

std::optional<double> ms_at_error(const std::vector<NaiveFigures>& ladder, renderer::NaiveKind kind,
                                  double rms) {
  std::vector<Point> points;
  for (const NaiveFigures& step : ladder)
    if (step.kind == kind) points.push_back({step.error.bscope.noise_free.rms, step.frame_ms});
  return interpolated_ms(points, rms);
}

}  // namespace fanbeam::benchmarks
