// The profile caster against converged rays on small worlds full of difficulties.
#include <catch2/catch.hpp>

#include "sensors/display/display.h"
#include "tests/renderer/profile_closed_form.h"

namespace {

using namespace fanbeam;

constexpr double kHeight_m = 60.0;

// Twelve columns, ranges to 900 m: rays are slow.
sensors::Sensor narrow() {
  sensors::Sensor sensor = tests::hivision(12);
  sensor.range.cells = 105;
  return sensor;
}

enum Material : terrain::MaterialId { kGrass, kForest, kRunway, kMarking, kWall, kRoof };

std::vector<materials::NrcsCurve> library() {
  return {materials::PhongNrcs(0.0325, 0.136, 1.99), materials::PhongNrcs(0.08, 0.05, 1.2),
          materials::PhongNrcs(0.002, 0.01, 2.5),    materials::PhongNrcs(0.1, 0.1, 1.0),
          materials::PhongNrcs(0.05, 0.3, 4.0),      materials::PhongNrcs(0.02, 0.2, 3.0)};
}

// Independent heights from post to post, 20 m between the lowest and the highest; two land covers.
// Level behind 800 m, so that no crest rises over the end of the range gate, where the fan of rays
// ends.
terrain::HeightField rough_ground() {
  std::uint64_t post = 0;
  terrain::HeightField field = tests::ground(1000.0, 10.0, [&](double x, double y) {
    const double relief_m = std::clamp((800.0 - std::hypot(x, y)) / 10.0, 0.0, 20.0);
    return relief_m * (tests::uniform(21, ++post) - 0.5);
  });
  for (int row = 0; row < field.rows - 1; ++row)
    for (int column = 0; column < field.columns - 1; ++column)
      if ((row / 4 + column / 3) % 2 == 0) field.cell_material[field.cell(column, row)] = kForest;
  return field;
}

std::vector<terrain::SurfacePatch> paint() {
  return {terrain::rectangle_patch({5.0, 600.0}, {0.0, 1.0}, 500.0, 25.0, kRunway),
          terrain::rectangle_patch({4.0, 480.0}, {0.8, 0.6}, 40.0, 9.0, kMarking)};
}

terrain::Ring_m rectangle(const glm::dvec2& centre_m, const glm::dvec2& along, double length_m,
                          double width_m) {
  return terrain::rectangle_patch(centre_m, along, length_m, width_m, 0).outline_m;
}

std::vector<tests::Body> buildings() {
  std::vector<terrain::Prism> prisms;
  prisms.push_back(
      {rectangle({0.0, 120.0}, {0.0, 1.0}, 340.0, 80.0), {}, -30.0, 22.0});  // below us
  prisms.push_back({rectangle({-28.0, 430.0}, {0.9, 0.43589}, 34.0, 30.0),
                    {rectangle({-28.0, 430.0}, {0.9, 0.43589}, 18.0, 14.0)},
                    -30.0,
                    16.0});  // a courtyard
  prisms.push_back({rectangle({24.0, 520.0}, {1.0, 0.0}, 30.0, 20.0), {}, -30.0, 14.0});
  prisms.push_back(
      {rectangle({30.0, 527.0}, {0.8, 0.6}, 26.0, 16.0), {}, -30.0, 23.0});  // overlaps
  prisms.push_back(
      {rectangle({-12.0, 640.0}, {0.0, 1.0}, 60.0, 26.0), {}, -30.0, 2.0});  // half sunk
  prisms.push_back({rectangle({9.0, 780.0}, {0.6, 0.8}, 12.0, 12.0), {}, -30.0, 82.0});  // a tower
  std::vector<tests::Body> bodies;
  for (const terrain::Prism& prism : prisms) bodies.push_back(tests::building(prism, kWall, kRoof));
  return bodies;
}

struct Powers {
  std::vector<double> bscope_W, cscope_W_m3;
};

void add(const std::vector<double>& from, double weight, std::vector<double>& to) {
  to.resize(from.size(), 0.0);
  for (std::size_t i = 0; i < from.size(); ++i) to[i] += weight * from[i];
}

Powers render(const renderer::World& world, const renderer::Sampling& sampling,
              const renderer::FramePose& pose) {
  renderer::Frame frame = renderer::FrameRenderer(world, sampling, {}, {}).render(pose);
  return {std::move(frame.bscope_W), std::move(frame.cscope_W_m3)};
}

// Four of them together: cells of which only slivers show are still rough in one.
Powers converged_rays(const renderer::World& world, const renderer::FramePose& pose) {
  constexpr std::uint64_t kSeeds = 4;
  Powers mean;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Powers powers = render(world, renderer::reference_sampling(seed), pose);
    add(powers.bscope_W, 1.0 / kSeeds, mean.bscope_W);
    add(powers.cscope_W_m3, 1.0 / kSeeds, mean.cscope_W_m3);
  }
  return mean;
}

struct Difference {
  double bscope_rms = 0.0, cscope_rms = 0.0;  // grey, the mean noise in both pictures
  double mean_dB = 0.0;                       // over cells above the noise
};

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

Difference against_rays(const sensors::Sensor& sensor, const renderer::FramePose& pose) {
  const renderer::World world =
      tests::world(sensor, rough_ground(), library(), buildings(), paint());
  const Powers rays = converged_rays(world, pose);
  const Powers profile = render(world, renderer::profile_sampling_for(64.0), pose);
  const double noise_W = sensor.noise_power_W();
  const auto plus = [](std::vector<double> values, double constant) {
    for (double& value : values) value += constant;
    return values;
  };
  const auto bscope = [&](const Powers& powers) {
    return sensors::bscope_grey(sensor, plus(powers.bscope_W, noise_W));
  };
  const auto cscope = [&](const Powers& powers) {
    return sensors::cscope_grey(sensor,
                                plus(powers.cscope_W_m3, sensors::cscope_noise_W_m3(sensor)));
  };
  Difference result{rms(bscope(profile), bscope(rays)), rms(cscope(profile), cscope(rays)), 0.0};
  int lit = 0;
  for (std::size_t i = 0; i < rays.bscope_W.size(); ++i) {
    if (!(rays.bscope_W[i] > noise_W && profile.bscope_W[i] > 0.0)) continue;
    result.mean_dB += 10.0 * std::log10(profile.bscope_W[i] / rays.bscope_W[i]);
    ++lit;
  }
  REQUIRE(lit > static_cast<int>(rays.bscope_W.size() / 10));
  result.mean_dB /= lit;
  return result;
}

void check(const Difference& difference) {
  CHECK(difference.bscope_rms < 0.5);
  CHECK(difference.cscope_rms < 0.5);
  CHECK(std::abs(difference.mean_dB) < 0.02);
}

renderer::FramePose rolled_pose() {
  renderer::FramePose pose = tests::level_pose(kHeight_m);
  pose.q_NB = core::quaternion_from({core::radians(10.0), core::radians(-5.0), 0.0});
  return pose;
}

}  // namespace

TEST_CASE("Rough ground, buildings and paint look as converged rays see them", "[profile]") {
  check(against_rays(narrow(), tests::level_pose(kHeight_m)));
}

TEST_CASE("The same under a beam that weighs all elevations alike", "[profile]") {
  // Visibility, land cover, walls and roofs alone, without the elevation pattern.
  sensors::Sensor sensor = narrow();
  sensor.antenna.elevation = tests::even_hivision(12).antenna.elevation;
  check(against_rays(sensor, tests::level_pose(kHeight_m)));
}

TEST_CASE("A rolled and pitched antenna sees what its rays see", "[profile]") {
  sensors::Sensor sensor = narrow();
  sensor.scan.stabilised = false;
  check(against_rays(sensor, rolled_pose()));
}

TEST_CASE("A cone scan sees what its rays see, level and tilted", "[profile]") {
  sensors::Sensor sensor = narrow();
  sensor.scan.surface = sensors::ScanSurface::cone;
  sensor.scan.stabilised = false;
  check(against_rays(sensor, tests::level_pose(kHeight_m)));
  check(against_rays(sensor, rolled_pose()));
}
