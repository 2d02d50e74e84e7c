// The B-scope made from beat signals against the B-scope of powers, on the shipped approach cropped
// to a few columns; and as product of fanbeam fmcw.
#include "session/signal/signal_bscope.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/image.h"
#include "renderer/accuracy/swept_picture.h"
#include "renderer/frame.h"
#include "scenes/scene.h"
#include "scenes/scene_reader.h"
#include "tests/apps/program.h"

using namespace fanbeam;

namespace {

constexpr int kFrame = 400;  // 3.3 km before the threshold: fields, woods, lights, runway
constexpr int kColumns = 2;
constexpr int kParts = 8;

scenes::SceneDescription approach() {
  core::ProblemList problems;
  scenes::SceneDescription description = scenes::read_scene(
      FANBEAM_SOURCE_DIR "/scenes/braunschweig-26", {FANBEAM_SOURCE_DIR, {}, ""}, problems);
  sensors::Scan& scan = description.sensor.scan;
  scan.field_of_view_rad *= static_cast<double>(kColumns) / scan.columns;
  scan.columns = kColumns;
  return description;
}

std::unique_ptr<scenes::Scene> built(const scenes::SceneDescription& description) {
  core::ProblemList problems;
  return scenes::build_scene(description, {}, problems);
}

// The converged B-scope of powers with the sweep's range response, without noise.
std::vector<double> converged_W(scenes::SceneDescription description) {
  const sensors::Sensor sensor = session::with_sweep_window(description.sensor);
  description.sensor = renderer::thin_cells(description.sensor, kParts);
  const auto scene = built(description);
  renderer::Sampling sampling = renderer::reference_sampling(1, 4);
  sampling.rays_per_cell = 1.0;  // and thin cell: 512 a cell
  const renderer::Frame frame = renderer::render_frame(
      scene->world, sampling, {.bscope = true, .cscope = false}, {}, scene->frame_pose(kFrame));
  return renderer::swept_power_W(sensor, frame.bscope_W, kParts);
}

const std::vector<double>& picture_W() {
  static const std::vector<double> kPicture = converged_W(approach());
  return kPicture;
}

session::SignalBscope from_signals(const scenes::Scene& scene, int looks) {
  const core::Pose pose = scene.trajectory->at(
      scene.trajectory->frame_time_s(kFrame, scene.description.sensor.scan.frame_rate_Hz));
  const renderer::FramePose frame_pose = scene.frame_pose(kFrame);
  session::SignalBscopeSettings settings;
  settings.looks = looks;
  settings.own_velocity_mps = frame_pose.north_east_down * pose.v_N_mps;
  CHECK(glm::length(settings.own_velocity_mps) > 65.0);
  return session::signal_bscope(scene.world, frame_pose, settings);
}

struct Agreement {
  int cells = 0;
  double mean_dB = 0.0, rms_dB = 0.0;
};

// Over cells whose power is ten times the noise.
Agreement agreement(const std::vector<double>& signal_W, const std::vector<double>& picture_W,
                    double noise_W) {
  Agreement result;
  double squares = 0.0;
  for (std::size_t i = 0; i < picture_W.size(); ++i) {
    if (!(picture_W[i] >= 10.0 * noise_W)) continue;
    const double dB = 10.0 * std::log10(signal_W[i] / (picture_W[i] + noise_W));
    result.mean_dB += dB;
    squares += dB * dB;
    ++result.cells;
  }
  result.mean_dB /= result.cells;
  result.rms_dB = std::sqrt(squares / result.cells);
  return result;
}

}  // namespace

TEST_CASE("Signal level and picture level show the same B-scope", "[scan]") {
  const scenes::SceneDescription description = approach();
  const auto scene = built(description);
  const std::vector<double>& expected_W = picture_W();
  const session::SignalBscope bscope = from_signals(*scene, 256);
  CHECK(bscope.looks == 256);
  const Agreement found =
      agreement(bscope.power_W, expected_W, scene->world.sensor.noise_power_W());
  INFO(found.cells << " cells 10 dB above noise: mean " << found.mean_dB << " dB, RMS "
                   << found.rms_dB << " dB");
  CHECK(found.cells > 500);
  CHECK(std::abs(found.mean_dB) <= 0.1);
  // 4.34 dB / sqrt(256) = 0.27 dB of it is speckle.
  CHECK(found.rms_dB <= 0.35);
  CHECK(found.rms_dB > 0.2);  // and it is there
}

TEST_CASE("The watts of a B-scope from signals hold the noise that its display hides", "[scan]") {
  scenes::SceneDescription description = approach();
  description.sensor.display.mapping = sensors::Display::Mapping::log;
  description.sensor.display.low_dB = 200.0;
  description.sensor.display.high_dB = 260.0;
  const session::SignalBscope bscope = from_signals(*built(description), 1);
  CHECK(bscope.plan.runs(core::EffectId::receiver_noise));
  CHECK(std::ranges::all_of(bscope.power_W, [](double power_W) { return power_W > 0.0; }));
}

TEST_CASE("Uncompensated, 70 m/s shift the B-scope from signals by 41.5 m", "[scan]") {
  scenes::SceneDescription description = approach();
  const std::vector<double>& expected_W = picture_W();
  description.sensor.waveform.doppler_compensated = false;
  const auto scene = built(description);
  const session::SignalBscope bscope = from_signals(*scene, 32);
  const double noise_W = scene->world.sensor.noise_power_W();
  const double cell_m = scene->world.sensor.range.cell_m;
  // Least mean square difference in dB over shifts by whole cells, a parabola between them.
  const auto mean_square_at = [&](int shift) {
    double squares = 0.0;
    int count = 0;
    for (std::size_t i = 20 * kColumns; i < expected_W.size() - 20 * kColumns; ++i) {
      const std::size_t from = i + static_cast<std::size_t>(shift * kColumns);
      if (!(expected_W[from] >= 10.0 * noise_W)) continue;
      const double dB = 10.0 * std::log10(bscope.power_W[i] / (expected_W[from] + noise_W));
      squares += dB * dB;
      ++count;
    }
    return squares / count;
  };
  int best = 0;
  for (int shift = 0; shift <= 12; ++shift)
    if (mean_square_at(shift) < mean_square_at(best)) best = shift;
  REQUIRE(best >= 1);
  const double before = mean_square_at(best - 1), at = mean_square_at(best);
  const double after = mean_square_at(best + 1);
  const double shift_m = (best + 0.5 * (before - after) / (before - 2.0 * at + after)) * cell_m;
  const core::Pose pose = scene->trajectory->at(
      scene->trajectory->frame_time_s(kFrame, description.sensor.scan.frame_rate_Hz));
  // 41.5 m at 70 m/s, and the trajectory's speed is near it. The ground lies 2 to 15 deg below the
  // flight path: up to 3 % less.
  CHECK(shift_m ==
        Approx(41.5 * glm::length(pose.v_N_mps) / 70.0).epsilon(0.0).margin(0.02 * 41.5));
}

TEST_CASE("fanbeam fmcw writes the B-scope, the same for any number of threads", "[scan]") {
  const tests::TemporaryFolder folder;
  folder.write("few.toml", tests::narrow_sensor(3));
  const auto run = [&](const std::string& name, const std::string& words) {
    const auto result =
        tests::run_fanbeam("fmcw braunschweig-26 --frames 400 --products bscope --quiet --sensor " +
                           tests::quoted(folder.path() / "few.toml") + " -o " +
                           tests::quoted(folder.path() / name) + " " + words);
    INFO(result.output);
    REQUIRE(result.exit_code == 0);
    return tests::results(folder.path() / name);
  };
  const auto first = run("one", "--looks 2 --threads 1");
  CHECK(first.size() == 4);  // folder, two files, record
  CHECK(run("two", "--looks 2") == first);
  CHECK(run("other", "--looks 2 --seed 3").at("bscope/00400.exr") != first.at("bscope/00400.exr"));
  const core::Image picture = core::read_image(folder.path() / "one" / "bscope" / "00400.png");
  CHECK(picture.columns == 3);
  CHECK(picture.rows == 524);
  const nlohmann::json record = tests::json_of(folder.path() / "one" / "run.json");
  CHECK(record["bscope"]["window_assumed"] == true);
  CHECK(record["bscope"]["doppler_compensated"] == true);
  CHECK(record["frames"][0]["bscope"]["looks"] == 2);
  CHECK(tests::run_fanbeam("fmcw braunschweig-26 --products bscope --sensor " +
                           tests::quoted(FANBEAM_SOURCE_DIR "/sensors/hivision-seed.toml"))
            .exit_code == 3);
}

TEST_CASE("A sensor file may leave own-ship Doppler in: fmcw has the shift, pictures refuse it",
          "[scan]") {
  const tests::TemporaryFolder folder;
  std::string sensor = tests::narrow_sensor(1);
  folder.write("taken_off.toml", sensor);
  const std::string key = "doppler_compensated = true";
  REQUIRE(sensor.find(key) != std::string::npos);
  folder.write("left_in.toml",
               sensor.replace(sensor.find(key), key.size(), "doppler_compensated = false"));
  const auto run = [&](const std::string& command, const std::string& name) {
    return tests::run_fanbeam(command + " braunschweig-26 --frames 400 --quiet --sensor " +
                              tests::quoted(folder.path() / (name + ".toml")) + " -o " +
                              tests::quoted(folder.path() / name));
  };
  for (const char* name : {"taken_off", "left_in"}) {
    const auto scan = run("fmcw --products bscope", name);
    INFO(scan.output);
    REQUIRE(scan.exit_code == 0);
    CHECK(tests::json_of(folder.path() / name / "run.json")["bscope"]["doppler_compensated"] ==
          (std::string(name) == "taken_off"));
  }
  CHECK(tests::bytes_of(folder.path() / "taken_off" / "bscope" / "00400.exr") !=
        tests::bytes_of(folder.path() / "left_in" / "bscope" / "00400.exr"));
  const auto refused = run("render --overwrite", "left_in");
  CHECK(refused.exit_code == 3);
  CHECK(refused.output.find("left_in.toml:") != std::string::npos);
  CHECK(refused.output.find("E-UNSUPPORTED waveform.doppler_compensated") != std::string::npos);
  // The scene is valid, for signals.
  const auto look = [&](const std::string& command) {
    return tests::run_fanbeam(command + " flat-grass --sensor " +
                              tests::quoted(folder.path() / "left_in.toml"));
  };
  const auto valid = look("validate");
  INFO(valid.output);
  CHECK(valid.exit_code == 0);
  CHECK(valid.output.find("pictures    of fanbeam fmcw --products bscope alone") !=
        std::string::npos);
  CHECK(look("doctor").output.find("E-UNSUPPORTED") == std::string::npos);
}
