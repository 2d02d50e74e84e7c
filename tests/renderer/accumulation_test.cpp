// R15: strong and weak scatterers that share a cell.
#include <catch2/catch.hpp>
#include <vector>

#include "renderer/casting/deposit.h"
#include "renderer/casting/guarded_bins.h"
#include "renderer/stages/point_targets.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

namespace {

constexpr int kWeak = 20'000'000;

// One cell in the middle of a beam.
class EchoSum {
 public:
  EchoSum() : sensor_(tests::hivision(1)) {
    sensor_.range.cells = 1;
    echo_.range_m = sensor_.range.minimum_m + 0.5 * sensor_.range.cell_m;
    cells_W_.assign(1, 0.0);
  }
  void add(double power_W, int times) {
    constexpr int kAtOnce = 100'000;
    for (int left = times; left > 0; left -= kAtOnce) {
      echo_.power_W = power_W;
      echoes_.assign(static_cast<std::size_t>(std::min(left, kAtOnce)), echo_);
      renderer::add_echoes(echoes_, sensor_, cells_W_, no_cscope_);
    }
  }
  double sum_W() const { return cells_W_[0]; }

 private:
  sensors::Sensor sensor_;
  core::Echo echo_;
  std::vector<core::Echo> echoes_;
  std::vector<double> cells_W_, no_cscope_;
};

}  // namespace

TEST_CASE("R15: one echo of 1 and twenty million of 1e-9 are 1.02, whichever comes first",
          "[accumulation]") {
  EchoSum strong_first, weak_first;
  strong_first.add(1.0, 1);
  strong_first.add(1e-9, kWeak);
  weak_first.add(1e-9, kWeak);
  weak_first.add(1.0, 1);
  CHECK(strong_first.sum_W() == Approx(1.02).epsilon(1e-9));
  CHECK(weak_first.sum_W() == Approx(1.02).epsilon(1e-9));
}

TEST_CASE("R15: twenty million echoes of 1 are 20 000 000 exactly", "[accumulation]") {
  EchoSum echoes;
  echoes.add(1.0, kWeak);
  CHECK(echoes.sum_W() == 2e7);
  renderer::GuardedBins bins;
  bins.reset(1);
  double point_bin = 0.0, rays_bin = 0.0;
  for (int i = 0; i < kWeak; ++i) {
    renderer::deposit(0.5, 0.5, 1.0, &point_bin, 1);
    bins.add_two(0, 1.0, 0.0);
  }
  bins.copy_to(&rays_bin);
  CHECK(point_bin == 2e7);
  CHECK(rays_bin == 2e7);
}
