// The sampling error of C-scopes that are drawn from the B-scope, in the modes flat_earth and shadow.
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "renderer/accuracy/column_error.h"
#include "renderer/frame_renderer.h"
#include "tests/renderer/city_world.h"

using namespace fanbeam;
using tests::kHeight_m;

namespace {

using Mode = sensors::Display::CScopeMode;

const renderer::Effects kNoisy{{core::EffectId::thermal_noise}};

renderer::World city_in(Mode mode) {
  sensors::Sensor sensor = tests::narrow(24);
  sensor.display.cscope_mode = mode;
  return tests::city_world(sensor, tests::everywhere);
}

renderer::Frame frame_of(const renderer::World& world, const renderer::Sampling& sampling,
                         const renderer::Products& products = {}) {
  return renderer::render_frame(world, sampling, products, kNoisy, tests::level_pose(kHeight_m));
}

double rms_apart(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

TEST_CASE("Two samplings are as far apart as the C-scopes that are drawn of them", "[refinement]") {
  for (const Mode mode : {Mode::flat_earth, Mode::shadow}) {
    const renderer::World world = city_in(mode);
    const sensors::AntennaFrame antenna =
        renderer::antenna_of(world.sensor, tests::level_pose(kHeight_m));
    const auto sums_of = [&](const renderer::Sampling& sampling) {
      renderer::FanSums sums;
      tests::caster_of(world, sampling)->cast(antenna, false, sums);
      return sums;
    };
    const renderer::ColumnError::Squares apart =
        renderer::ColumnError(world.sensor, true, kHeight_m)
            .between(sums_of(tests::slices(2)), sums_of(tests::slices(4)));
    const double found_grey = std::sqrt(
        std::accumulate(apart.cscope_grey2.begin(), apart.cscope_grey2.end(), 0.0) / 24.0);
    INFO("mode " << static_cast<int>(mode));
    CHECK(found_grey > 0.1);
    CHECK(found_grey == Approx(rms_apart(frame_of(world, tests::slices(2)).cscope_grey,
                                         frame_of(world, tests::slices(4)).cscope_grey))
                            .epsilon(1e-9));
  }
}

TEST_CASE("Estimates and accuracies count the C-scope that is drawn from the B-scope",
          "[refinement]") {
  renderer::Sampling coarse = renderer::sampling_for(1.0);
  coarse.estimate_error = true;
  renderer::Sampling converged = tests::slices(8);
  converged.sub_columns = 16;
  converged.slices_per_sub_column = 8;
  for (const Mode mode : {Mode::flat_earth, Mode::shadow}) {
    INFO("mode " << static_cast<int>(mode));
    const renderer::World world = city_in(mode);
    const renderer::Frame frame = frame_of(world, coarse);
    REQUIRE(frame.error.has_value());
    CHECK(frame.error->cscope_rms_grey > 0.1);
    CHECK(frame_of(world, coarse, {.cscope = false}).error->cscope_rms_grey == 0.0);
    if (mode == Mode::shadow) continue;
    const renderer::Frame refined =
        frame_of(world, renderer::refined_sampling(renderer::CasterKind::rays, 1.0));
    CHECK(refined.error->cscope_rms_grey > 0.0);
    CHECK(refined.error->reached);
    CHECK(refined.error->largest_grey() <= 1.0);
    const double true_grey = rms_apart(frame.cscope_grey, frame_of(world, converged).cscope_grey);
    CHECK(true_grey < 3.0 * frame.error->cscope_rms_grey);
    CHECK(true_grey > frame.error->cscope_rms_grey / 3.0);
  }
}

TEST_CASE("No column is refined for an obstacle that is raised in one picture alone",
          "[refinement]") {
  const renderer::Sampling sampling = renderer::refined_sampling(renderer::CasterKind::rays, 1.0);
  const auto refined = [&](Mode mode) { return frame_of(city_in(mode), sampling); };
  const renderer::Frame flat = refined(Mode::flat_earth), raised = refined(Mode::shadow);
  REQUIRE(flat.error->reached);
  CHECK(raised.error->levels == flat.error->levels);
  CHECK(raised.rays == flat.rays);
  CHECK(raised.bscope_W == flat.bscope_W);
  CHECK(raised.error->cscope_rms_grey > 0.0);
}
