#include "signal/detection/cfar_factor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "signal/checks_private.h"
#include "signal/detection/cfar_window_private.h"
#include "signal/detection/falling_root_private.h"

namespace fanbeam::signal {
namespace {

void check_reference(const CfarReference& reference) {
  const std::int64_t count = std::int64_t{reference.before} + reference.after;
  if (reference.before < 0 || reference.after < 0 || count < 1 || count > 2000000000)
    refuse("reference cells", static_cast<double>(count), "1 to 2e9");
  if (reference.kind == CfarKind::ordered_statistic &&
      (reference.rank < 1 || reference.rank > count))
    refuse("rank", reference.rank, "1 to the number of reference cells");
  if (has_halves(reference.kind) &&
      (std::min(reference.before, reference.after) < 1 || count > 100000))
    refuse("reference cells", static_cast<double>(count), "1e5 at most, some on both sides");
}

void check_probability(double probability) {
  if (!(probability > 0.0 && probability < 1.0))
    refuse("false_alarm_probability", probability, "above 0 and below 1");
}

// Part of the exceedance in which side a has the smaller mean.
double half(int a, int b, double factor) {
  const double r = static_cast<double>(b) / a;
  const double rate = std::log1p(factor / a + r);
  double log_term = -a * rate;
  double sum = 0.0;
  for (int j = 0; j < b; ++j) {
    sum += std::exp(log_term);
    log_term += std::log(static_cast<double>(a + j) / (j + 1)) + std::log(r) - rate;
  }
  return sum;
}

double log_false_alarm(const CfarReference& reference, double factor) {
  const int count = reference.before + reference.after;
  switch (reference.kind) {
    case CfarKind::cell_averaging:
      return -count * std::log1p(factor / count);
    case CfarKind::ordered_statistic: {
      double sum = 0.0;
      for (int i = 0; i < reference.rank; ++i) sum -= std::log1p(factor / (count - i));
      return sum;
    }
    case CfarKind::greatest_of:
    case CfarKind::smallest_of: {
      const int a = reference.before;
      const int b = reference.after;
      const double smallest = half(a, b, factor) + half(b, a, factor);
      if (reference.kind == CfarKind::smallest_of) return std::log(smallest);
      return std::log(std::exp(-a * std::log1p(factor / a)) +
                      std::exp(-b * std::log1p(factor / b)) - smallest);
    }
  }
  throw core::InternalError("unknown detector");
}

template <typename Function>
double factor_root(const Function& falling) {
  const double factor = falling_root(falling, 1e300, 1e-15);
  if (!std::isfinite(factor)) throw core::InternalError("no threshold factor");
  return factor;
}

}  // namespace

std::string_view name(CfarKind kind) {
  switch (kind) {
    case CfarKind::cell_averaging:
      return "CA";
    case CfarKind::ordered_statistic:
      return "OS";
    case CfarKind::greatest_of:
      return "GO";
    case CfarKind::smallest_of:
      return "SO";
  }
  throw core::InternalError("unknown detector");
}

double cfar_false_alarm_probability(const CfarReference& reference, double factor) {
  check_reference(reference);
  if (!(factor >= 0.0)) refuse("factor", factor, "0 or more");
  return std::exp(log_false_alarm(reference, factor));
}

double cfar_factor(const CfarReference& reference, double false_alarm_probability) {
  check_reference(reference);
  check_probability(false_alarm_probability);
  const double log_probability = std::log(false_alarm_probability);
  if (reference.kind == CfarKind::cell_averaging) {
    const double count = reference.before + reference.after;
    return count * std::expm1(-log_probability / count);
  }
  return factor_root(
      [&](double factor) { return log_false_alarm(reference, factor) - log_probability; });
}

}  // namespace fanbeam::signal
