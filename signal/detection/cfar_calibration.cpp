#include "signal/detection/cfar_calibration.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <numeric>
#include <utility>

#include "core/parallel.h"
#include "core/random.h"
#include "signal/checks_private.h"
#include "signal/detection/cfar_window_private.h"
#include "signal/detection/falling_root_private.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

using Matrix = Eigen::MatrixXcd;
using Vector = Eigen::VectorXcd;

// Correlations by lag along one axis, each computed once.
class Lags {
 public:
  Lags(const std::vector<double>& weights, int length) : weights_(weights), length_(length) {}
  std::complex<double> at(int lag) {
    if (weights_.empty()) return lag == 0 ? 1.0 : 0.0;
    const auto found = known_.find(std::abs(lag));
    const std::complex<double> value = found != known_.end()
                                           ? found->second
                                           : known_[std::abs(lag)] =
                                                 cell_correlation(weights_, length_, std::abs(lag));
    return lag < 0 ? std::conj(value) : value;
  }

 private:
  const std::vector<double>& weights_;
  int length_;
  std::map<int, std::complex<double>> known_;
};

// Correlation of the cell under test, first, and its reference cells.
Matrix correlation_matrix(const std::vector<CfarOffset>& offsets,
                          const CellCorrelation& correlation) {
  std::vector<CfarOffset> cells = {{0, 0, false}};
  cells.insert(cells.end(), offsets.begin(), offsets.end());
  Lags along_columns(correlation.column_weights, correlation.column_length);
  Lags along_rows(correlation.row_weights, correlation.row_length);
  const auto count = static_cast<Eigen::Index>(cells.size());
  Matrix matrix(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index k = 0; k < count; ++k) {
      const CfarOffset& a = cells[static_cast<std::size_t>(i)];
      const CfarOffset& b = cells[static_cast<std::size_t>(k)];
      matrix(i, k) = along_columns.at(b.column - a.column) * along_rows.at(b.row - a.row);
    }
  return matrix;
}

// Where `rate`, which falls with the factor, meets `wanted`.
template <typename Rate>
double factor_for(const Rate& rate, double wanted) {
  const double factor = falling_root([&](double at) { return rate(at) - wanted; }, 1e12, 1e-12);
  if (!std::isfinite(factor))
    refuse("design_probability", wanted, "one that these reference cells can keep");
  return factor;
}

double averaging_rate(const Matrix& root, double factor) {
  const Eigen::Index references = root.rows() - 1;
  Eigen::VectorXd signs =
      Eigen::VectorXd::Constant(root.rows(), -factor / static_cast<double>(references));
  signs(0) = 1.0;
  const Matrix form = root * signs.asDiagonal() * root;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(form, Eigen::EigenvaluesOnly);
  const double positive = eigen.eigenvalues()(references);
  double log_rate = 0.0;
  for (Eigen::Index i = 0; i < references; ++i)
    log_rate -= std::log1p(std::max(0.0, -eigen.eigenvalues()(i)) / positive);
  return std::exp(log_rate);
}

double exact_averaging_factor(const Matrix& correlation, double wanted) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(correlation);
  const Matrix root = eigen.eigenvectors() *
                      eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
                      eigen.eigenvectors().adjoint();
  return factor_for([&](double factor) { return averaging_rate(root, factor); }, wanted);
}

// P(sum over looks of |mean + noise|^2 > t), noise of variance 1, snr the sum of |mean|^2:
// a Poisson mixture of gamma tails (sensors/receiver/detection.h), for snr of some hundreds: beyond, e^-snr is 0.
double exceedance(double snr, int looks, double t) {
  double term = std::exp(-t);  // e^-t t^i / i!
  double tail = term;
  for (int i = 1; i < looks; ++i) {
    term *= t / i;
    tail += term;
  }
  double weight = std::exp(-snr);
  double sum = weight * tail;
  double used = weight;
  for (int k = 1; k < 1000 && used < 1.0 - 1e-12; ++k) {
    term *= t / (looks + k - 1);
    tail += term;
    weight *= snr / k;
    used += weight;
    sum += weight * tail;
  }
  return sum;
}

// What one drawn background says.
struct Background {
  double estimate = 0.0;
  double snr = 0.0;         // of the cell's mean given the background
  double log_weight = 0.0;  // true density over drawn density
};

class BackgroundDraw {
 public:
  BackgroundDraw(const CfarSettings& settings, const std::vector<CfarOffset>& offsets,
                 const Matrix& correlation, int looks, double tilt)
      : looks_(looks), tilt_(tilt) {
    const auto before = static_cast<int>(std::count_if(
        offsets.begin(), offsets.end(), [](const CfarOffset& offset) { return !offset.after; }));
    reference_ = reference_of(settings, before, static_cast<int>(offsets.size()) - before);
    const Eigen::Index n = correlation.rows() - 1;
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(correlation.bottomRightCorner(n, n));
    const Eigen::VectorXd values = eigen.eigenvalues().cwiseMax(0.0);
    const Eigen::VectorXd drawn = (values.array() / (1.0 + tilt * values.array())).sqrt();
    colouring_ = eigen.eigenvectors() * drawn.asDiagonal();
    log_scale_ = -looks * (1.0 + tilt * values.array()).log().sum();
    // Prediction of the cell from its background.
    const Vector cross = correlation.bottomLeftCorner(n, 1);
    Eigen::VectorXd inverse(n);
    for (Eigen::Index i = 0; i < n; ++i)
      inverse(i) = values(i) > 1e-9 * values(n - 1) ? 1.0 / values(i) : 0.0;
    prediction_ =
        eigen.eigenvectors() * inverse.asDiagonal() * (eigen.eigenvectors().adjoint() * cross);
    variance_ = std::max(1e-9, 1.0 - prediction_.dot(cross).real());
  }

  double variance() const { return variance_; }

  Background draw(std::uint64_t index) const {
    const Eigen::Index n = colouring_.rows();
    const core::RandomKey key{.seed = 0, .stream = core::kStreamCfarCalibration, .frame = 1};
    std::vector<double> powers(static_cast<std::size_t>(n), 0.0);
    Vector white(n);
    double predicted = 0.0;
    for (int look = 0; look < looks_; ++look) {
      for (Eigen::Index i = 0; i < n; ++i) {
        const auto pair =
            core::normal_pair(key, index,
                              static_cast<std::uint32_t>(look) * static_cast<std::uint32_t>(n) +
                                  static_cast<std::uint32_t>(i));
        white(i) = std::complex<double>(pair[0], pair[1]) * std::sqrt(0.5);
      }
      const Vector cells = colouring_ * white;
      for (Eigen::Index i = 0; i < n; ++i)
        powers[static_cast<std::size_t>(i)] += std::norm(cells(i));
      predicted += std::norm(prediction_.dot(cells));
    }
    double sum = 0.0;
    for (const double power : powers) sum += power;
    return {cfar_background(reference_, powers), predicted / variance_, log_scale_ + tilt_ * sum};
  }

 private:
  CfarReference reference_;
  int looks_;
  double tilt_;
  Matrix colouring_;
  Vector prediction_;
  double log_scale_ = 0.0;
  double variance_ = 1.0;
};

// How much weaker to draw the backgrounds: with a mean of the references times the factor, the
// exceedance falls as exp(-tilt sum of the references) at first order. For a known background the
// exceedance of t = factor x looks is the gamma tail, whose rate of fall is density / tail.
double useful_tilt(int looks, double references, double probability) {
  const double t = factor_for([&](double at) { return exceedance(0.0, looks, at); }, probability);
  double density = std::exp(-t);
  for (int i = 1; i < looks; ++i) density *= t / i;
  // Beyond 1/2 the weights' variance is infinite.
  return std::min(0.45, density / probability * t / looks / references);
}

// Of noise alone, over its mean: backgrounds as they are.
double drawn_mean_estimate(const CfarSettings& settings, const std::vector<CfarOffset>& offsets,
                           const Matrix& correlation, int looks) {
  constexpr std::size_t kDrawn = 500;
  const BackgroundDraw drawer(settings, offsets, correlation, looks, 0.0);
  std::vector<double> estimates(kDrawn);
  core::parallel_for(kDrawn, [&](std::size_t i) { estimates[i] = drawer.draw(i).estimate; });
  return std::accumulate(estimates.begin(), estimates.end(), 0.0) / (kDrawn * looks);
}

CfarCalibration drawn_calibration(const CfarSettings& settings,
                                  const std::vector<CfarOffset>& offsets, const Matrix& correlation,
                                  int looks) {
  const auto n = static_cast<double>(offsets.size());
  const double tilt = useful_tilt(looks, n, settings.design_probability);
  const BackgroundDraw drawer(settings, offsets, correlation, looks, tilt);
  if (drawer.variance() < kLeastUntold) return {};
  const double most = std::clamp(4e7 / (n * n * looks), 4000.0, 100000.0);
  std::vector<Background> backgrounds(static_cast<std::size_t>(most));
  constexpr std::size_t kBlock = 500;
  core::parallel_for((backgrounds.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
    const std::size_t end = std::min(backgrounds.size(), (block + 1) * kBlock);
    for (std::size_t i = block * kBlock; i < end; ++i) backgrounds[i] = drawer.draw(i);
  });
  double squares = 0.0;
  const auto rate = [&](double factor) {
    double sum = 0.0;
    squares = 0.0;
    for (const Background& background : backgrounds) {
      const double one =
          std::exp(background.log_weight) *
          exceedance(background.snr, looks, factor * background.estimate / drawer.variance());
      sum += one;
      squares += one * one;
    }
    return sum / static_cast<double>(backgrounds.size());
  };
  CfarCalibration found;
  found.factor = factor_for(rate, settings.design_probability);
  const double mean = rate(found.factor);
  const auto count = static_cast<double>(backgrounds.size());
  found.relative_error = std::sqrt(std::max(0.0, squares / count - mean * mean) / count) / mean;
  return found;
}

CfarCalibration calibrate(const CfarSettings& settings, const CellCorrelation& correlation,
                          int looks) {
  const std::vector<CfarOffset> offsets = cfar_offsets(settings);
  if (offsets.size() > static_cast<std::size_t>(kMostCalibratedCells))
    refuse("reference cells", static_cast<double>(offsets.size()),
           std::to_string(kMostCalibratedCells) + " at most");
  const CfarReference reference = cfar_reference(settings);
  cfar_factor(reference, settings.design_probability);  // refuses what cannot be
  const Matrix matrix = correlation_matrix(offsets, correlation);
  CfarCalibration found;
  if (reference.kind == CfarKind::cell_averaging && looks == 1)
    found.factor = exact_averaging_factor(matrix, settings.design_probability);
  else
    found = drawn_calibration(settings, offsets, matrix, looks);
  if (!found.covered()) return found;
  if (reference.kind != CfarKind::cell_averaging)
    found.mean_estimate = drawn_mean_estimate(settings, offsets, matrix, looks);
  found.design_probability = cfar_false_alarm_probability(reference, found.factor);
  return found;
}

struct CalibrationQuestion {
  CfarSettings settings;
  CellCorrelation correlation;
  int looks = 1;
  bool operator==(const CalibrationQuestion&) const = default;
};

}  // namespace

std::complex<double> cell_correlation(const std::vector<double>& weights, int length, int lag) {
  if (weights.empty() || static_cast<std::size_t>(std::max(0, length)) < weights.size())
    refuse("cell_correlation.length", length, "at least the length of the window, not empty");
  std::complex<double> sum = 0.0;
  double squares = 0.0;
  for (std::size_t n = 0; n < weights.size(); ++n) {
    sum += weights[n] * weights[n] *
           unit_phasor(static_cast<double>(lag) * static_cast<double>(n) / length);
    squares += weights[n] * weights[n];
  }
  return sum / squares;
}

CfarCalibration calibrated_cfar(const CfarSettings& settings, const CellCorrelation& correlation,
                                int looks) {
  check_count("looks", looks, 1, kMostLooks);
  // A radar asks the same for every frame, and a sum over many channels takes seconds.
  constexpr std::size_t kMostKept = 8;
  static std::mutex mutex;
  static std::deque<std::pair<CalibrationQuestion, CfarCalibration>> answers;
  CalibrationQuestion question{settings, correlation, looks};
  {
    const std::lock_guard lock(mutex);
    for (const auto& [asked, answer] : answers)
      if (asked == question) return answer;
  }
  const CfarCalibration found = calibrate(settings, correlation, looks);
  const std::lock_guard lock(mutex);
  answers.emplace_front(std::move(question), found);
  if (answers.size() > kMostKept) answers.pop_back();
  return found;
}

}  // namespace fanbeam::signal
