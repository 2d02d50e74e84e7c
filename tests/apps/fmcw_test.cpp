// fanbeam fmcw: a lone target at its cells of map, cube and list; the shipped street; what it refuses.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>

#include "core/image.h"
#include "core/units.h"
#include "tests/apps/program.h"

using namespace fanbeam;
namespace fs = std::filesystem;

namespace {

// 40 m away in the middle of frame 0, at 0.025 s, 12 deg right, coming straight at the radar at
// 10 m/s: the leg ends at 50 and 30 m.
const char* const kLoneTarget = R"(
[scene]
name = "lone"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 0.0 }
vertical_datum = "scene"
earth = "plane"
[sensor]
file = "automotive-76.toml"
[materials]
allow_extrapolation = true
[terrain]
generator = "plane"
material = "short_grass"
half_extent_m = 300.0
[[runway]]
first = { name = "36", latitude_deg = 52.0, longitude_deg = 10.0, elevation_m = 0.0 }
second = { name = "18", latitude_deg = 52.002, longitude_deg = 10.0, elevation_m = 0.0 }
width_m = 5.0
shoulder_m = 0.0
surface = "short_grass"
markings = false
edge_lights = false
[[target]]
name = "comer"
rcs = { rcs_dBsm = 25.0 }
[[target.waypoint]]
time_s = -0.975
at = { runway = "36", behind_threshold_m = 48.9073800, left_m = -10.3955845 }
above_ground_m = 2.0
[[target.waypoint]]
time_s = 1.025
at = { runway = "36", behind_threshold_m = 29.3444280, left_m = -6.2373507 }
above_ground_m = 2.0
[trajectory.fixed]
at = { runway = "36", behind_threshold_m = 0.0, left_m = 0.0 }
above_ground_m = 2.0
heading_deg = 0.0
)";

const std::string kFewChirps = " --chirps 64 --quiet ";

struct Peak {
  std::vector<std::size_t> shape, place;
};

// The largest value of a complex64 file.
Peak cube_peak(const fs::path& file) {
  const std::string bytes = tests::bytes_of(file);
  REQUIRE(bytes.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t header =
      10 + static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  Peak peak;
  const std::size_t tuple = bytes.find("'shape': (") + 10;
  std::istringstream numbers(bytes.substr(tuple, bytes.find(')', tuple) - tuple));
  for (std::string number; std::getline(numbers, number, ',');)
    peak.shape.push_back(std::stoul(number));
  REQUIRE(peak.shape.size() == 3);
  std::vector<std::complex<float>> values(peak.shape[0] * peak.shape[1] * peak.shape[2]);
  REQUIRE(bytes.size() == header + 8 * values.size());
  std::memcpy(values.data(), bytes.data() + header, 8 * values.size());
  const auto largest = static_cast<std::size_t>(
      std::max_element(values.begin(), values.end(),
                       [](const auto& a, const auto& b) { return std::norm(a) < std::norm(b); }) -
      values.begin());
  peak.place = {largest / (peak.shape[1] * peak.shape[2]), largest / peak.shape[2] % peak.shape[1],
                largest % peak.shape[2]};
  return peak;
}

const nlohmann::json& nearest(const nlohmann::json& list, double range_m, double speed_mps) {
  REQUIRE(!list.empty());
  return *std::min_element(list.begin(), list.end(), [&](const auto& a, const auto& b) {
    const auto distance = [&](const nlohmann::json& found) {
      return std::hypot(found["range_m"].template get<double>() - range_m,
                        found["radial_speed_mps"].template get<double>() - speed_mps);
    };
    return distance(a) < distance(b);
  });
}

}  // namespace

TEST_CASE("A lone target stands at its cell of map, cube and list", "[fmcw]") {
  const tests::TemporaryFolder folder;
  folder.write("scene.toml", kLoneTarget);
  const fs::path out = folder.path() / "out";
  const auto run =
      tests::run_fanbeam("fmcw " + tests::quoted(folder.path()) + kFewChirps +
                         "--products beat,cube,range-doppler,detections -o " + tests::quoted(out));
  INFO(run.output);
  REQUIRE(run.exit_code == 0);
  const nlohmann::json record = tests::json_of(out / "run.json");
  const nlohmann::json& axes = record["axes"];
  // 64 chirps of 3 slots of 20 us: 3.84 ms, in whose middle ranges are told.
  const double range_m = 40.0 - 10.0 * 0.5 * 3.84e-3;
  const double range_cell = (range_m + axes["range_read_long_m_per_mps"].get<double>() * -10.0) /
                            axes["range_step_m"].get<double>();
  const double speed_cell =
      (-10.0 - axes["speed_first_mps"].get<double>()) / axes["speed_step_mps"].get<double>();
  CHECK(axes["speed_step_mps"].get<double>() == Approx(0.513625).epsilon(1e-4));
  // Chebyshev's windows of 400 samples and of 64 chirps, by the sums over their weights.
  const nlohmann::json& windows = record["processing"];
  const auto window_has = [](const nlohmann::json& figures, double width_cells, double loss_dB,
                             double scalloping_dB) {
    CHECK(figures["half_power_width_cells"].get<double>() == Approx(width_cells).epsilon(1e-5));
    CHECK(figures["peak_side_lobe_dB"].get<double>() == Approx(-60.0).epsilon(1e-4));
    CHECK(figures["snr_loss_dB"].get<double>() == Approx(loss_dB).epsilon(1e-5));
    CHECK(figures["scalloping_dB"].get<double>() == Approx(scalloping_dB).epsilon(1e-5));
  };
  window_has(windows["range_window_figures"], 1.448033, 1.818876, 1.418165);
  window_has(windows["doppler_window_figures"], 1.463885, 1.865678, 1.387289);

  const core::Image map = core::read_image(out / "range-doppler" / "00000.exr");
  const std::vector<double>& powers = map.layers.at(0).values;
  const auto peak = std::max_element(powers.begin(), powers.end()) - powers.begin();
  CHECK(std::abs(static_cast<double>(peak % map.columns) - range_cell) <= 0.51);
  CHECK(std::abs(static_cast<double>(peak / map.columns) - speed_cell) <= 0.51);

  const Peak cube = cube_peak(out / "cube" / "00000.npy");
  CHECK(cube.shape[1] == 64);
  // Cells of azimuth are 1/32 in its sine, the middle one is cell 32.
  CHECK(std::abs(static_cast<double>(cube.place[0]) -
                 (32.0 + 32.0 * std::sin(core::radians(12.0)))) <= 0.51);
  CHECK(std::abs(static_cast<double>(cube.place[1]) - speed_cell) <= 0.51);
  CHECK(std::abs(static_cast<double>(cube.place[2]) - range_cell) <= 0.51);
  CHECK(cube_peak(out / "beat" / "00000.npy").shape == std::vector<std::size_t>{12, 64, 400});

  const nlohmann::json list = tests::json_of(out / "detections" / "00000.json")["detections"];
  const nlohmann::json& found = nearest(list, range_m, -10.0);
  CHECK(found["range_m"].get<double>() == Approx(range_m).epsilon(0.0).margin(0.03));
  CHECK(found["radial_speed_mps"].get<double>() == Approx(-10.0).epsilon(0.0).margin(0.03));
  CHECK(core::degrees(found["azimuth_rad"].get<double>()) == Approx(12.0).epsilon(0.0).margin(0.3));
  const nlohmann::json& truth = record["frames"][0]["targets"][0];
  CHECK(truth["name"] == "comer");
  CHECK(truth["range_m"].get<double>() == Approx(40.0).epsilon(0.0).margin(1e-3));
  CHECK(truth["radial_speed_mps"].get<double>() == Approx(-10.0).epsilon(0.0).margin(1e-3));
  // The element's Gaussian with it; clutter 10 %.
  CHECK(found["power_W"].get<double>() == Approx(truth["power_W"].get<double>()).epsilon(0.1));
}

TEST_CASE("The power of a target is what reaches the samples, and the same from real ones",
          "[fmcw]") {
  // At 45 deg the element, a Gaussian 90 deg wide, takes 3.01 dB twice.
  const auto target_at = [](const std::string& place) {
    std::string scene = kLoneTarget;
    const std::size_t from = scene.find("[[target.waypoint]]"),
                      to = scene.find("[trajectory.fixed]");
    return scene.replace(from, to - from,
                         "at = { runway = \"36\", " + place + " }\nabove_ground_m = 2.0\n");
  };
  double truth_W[2] = {}, found_W[2] = {}, snr_dB[2] = {};
  for (const bool aside : {false, true})
    for (const char* samples : {"", "--real "}) {
      const tests::TemporaryFolder folder;
      folder.write("scene.toml", target_at(aside ? "behind_threshold_m = 28.2843, left_m = 28.2843"
                                                 : "behind_threshold_m = 40.0"));
      const fs::path out = folder.path() / "out";
      const auto run =
          tests::run_fanbeam("fmcw " + tests::quoted(folder.path()) + kFewChirps + samples +
                             "--products detections -o " + tests::quoted(out));
      INFO(run.output);
      REQUIRE(run.exit_code == 0);
      const nlohmann::json list = tests::json_of(out / "detections" / "00000.json")["detections"];
      const nlohmann::json& found = nearest(list, 40.0, 0.0);
      const double power_W = tests::json_of(out / "run.json")["frames"][0]["targets"][0]["power_W"];
      CHECK(found["power_W"].get<double>() == Approx(power_W).epsilon(0.12));
      truth_W[aside ? 1 : 0] = power_W;
      if (*samples == '\0') {
        found_W[aside ? 1 : 0] = found["power_W"];
        snr_dB[aside ? 1 : 0] = found["snr_dB"];
      } else {
        CHECK(found["power_W"].get<double>() == Approx(found_W[aside ? 1 : 0]).epsilon(0.05));
        CHECK(found["snr_dB"].get<double>() ==
              Approx(snr_dB[aside ? 1 : 0]).epsilon(0.0).margin(3.0));  // of other noise
      }
    }
  CHECK(10.0 * std::log10(truth_W[0] / truth_W[1]) == Approx(6.02).epsilon(0.0).margin(0.02));
}

TEST_CASE("fmcw gives the same bytes again, for any number of threads", "[fmcw]") {
  const tests::TemporaryFolder folder;
  folder.write("scene.toml", kLoneTarget);
  const auto render = [&](const char* name, const std::string& words) {
    const fs::path out = folder.path() / name;
    const auto run = tests::run_fanbeam("fmcw " + tests::quoted(folder.path()) + kFewChirps +
                                        "--products cube,range-azimuth,top-view,detections " +
                                        words + " -o " + tests::quoted(out));
    INFO(run.output);
    REQUIRE(run.exit_code == 0);
    return tests::results(out);
  };
  const auto first = render("a", "");
  CHECK(first.contains("range-azimuth/00000.png"));
  CHECK(first.contains("detections/00000.csv"));
  CHECK(render("b", "--threads 1") == first);
  CHECK(render("c", "--threads 3") == first);
  CHECK(render("d", "--seed 7").at("cube/00000.npy") != first.at("cube/00000.npy"));
}

TEST_CASE("Samples alone are recorded with the cube's azimuths and without detections", "[fmcw]") {
  const tests::TemporaryFolder folder;
  folder.write("scene.toml", kLoneTarget);
  const fs::path out = folder.path() / "out";
  const auto run = tests::run_fanbeam("fmcw " + tests::quoted(folder.path()) +
                                      " --chirps 16 --products beat -o " + tests::quoted(out));
  INFO(run.output);
  REQUIRE(run.exit_code == 0);
  const nlohmann::json record = tests::json_of(out / "run.json");
  // Cells of azimuth are 1/32 in its sine.
  const nlohmann::json& azimuths_rad = record["axes"]["azimuths_rad"];
  REQUIRE(azimuths_rad.size() == 64);
  CHECK(std::sin(azimuths_rad[40].get<double>()) == Approx(0.25).epsilon(1e-12));
  // None were looked for: to tell 0 of them would be wrong.
  CHECK(run.output.find("detections") == std::string::npos);
  CHECK_FALSE(record["frames"][0].contains("detections"));
  CHECK_FALSE(record["frames"][0].contains("clusters"));
}

TEST_CASE("fmcw refuses what it cannot use", "[fmcw]") {
  const tests::TemporaryFolder folder;
  folder.write("scene.toml", kLoneTarget);
  const std::string command = "fmcw " + tests::quoted(folder.path()) + kFewChirps + "-o " +
                              tests::quoted(folder.path() / "out") + " ";
  const auto code = [&](const std::string& words) {
    return tests::run_fanbeam(command + words).exit_code;
  };
  CHECK(code("--waveform sawteeth") == 2);
  CHECK(code("--products maps") == 2);
  CHECK(code("--waveform chirp-sequence --slots 2") == 2);
  const auto staged = tests::run_fanbeam(command + "--waveform two-stage --slots 3");
  CHECK(staged.exit_code == 2);
  CHECK(staged.output.find("--slots = 3: expected 1 with two-stage") != std::string::npos);
  CHECK(code("--frames 3") == 2);
  // What would do nothing in silence: no turns that tell a fold, no other radar, too few channels for sub-arrays.
  CHECK(code("--unfold --slots 1") == 2);
  CHECK(code("--unfold --transmitters 1") == 2);
  CHECK(code("--products interference") == 2);
  for (const char* method : {"capon", "music"}) {
    const auto few =
        tests::run_fanbeam(command + "--transmitters 1 --receivers 3 --angle-method " + method);
    CHECK(few.exit_code == 3);
    CHECK(few.output.find("4 channels") != std::string::npos);
  }
  CHECK(code("--pfa nan") == 2);
  // Ranges to 151 m against 75 m of 12.5 MHz / 2.
  CHECK(code("--sample-rate 5 --refuse-folding --products detections") == 3);
  const auto triangle = tests::run_fanbeam("fmcw " + tests::quoted(folder.path()) +
                                           " --waveform triangle --products cube");
  CHECK(triangle.exit_code == 2);
  CHECK(triangle.output.find("chirp sequence") != std::string::npos);
  // What no memory holds is told, and told before rays are sent.
  const std::string bare = "fmcw " + tests::quoted(folder.path()) + " --receivers 64 ";
  for (const char* words : {"--waveform continuous --duration 1e9",
                            "--chirps 4000 --transmitters 1 --sample-rate 1200 --products beat"}) {
    const auto huge = tests::run_fanbeam(bare + words);
    INFO(huge.output);
    CHECK(huge.exit_code == 3);
    CHECK(huge.output.find("E-LIMIT") != std::string::npos);
    CHECK(huge.output.find("samples x chirps x channels") != std::string::npos);
  }
  folder.write("scene.toml", std::string(kLoneTarget) + "\n[weather]\nvisibility_m = nan\n");
  CHECK(code("") == 3);
  CHECK(tests::run_fanbeam("fmcw /nowhere").exit_code == 4);
  CHECK_FALSE(fs::exists(folder.path() / "out" / "run.json"));
  const auto help = tests::run_fanbeam("fmcw --help");
  CHECK(help.exit_code == 0);
  for (const char* word : {"SCENE", "--waveform", "--products", "--pfa", "--chirps", "receding"})
    CHECK(help.output.find(word) != std::string::npos);
}

TEST_CASE("The shipped street shows its moving cars with their speeds", "[fmcw]") {
  const tests::TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const auto run = tests::run_fanbeam("fmcw street-76ghz --products detections --quiet -o " +
                                      tests::quoted(out));
  INFO(run.output);
  REQUIRE(run.exit_code == 0);
  const nlohmann::json record = tests::json_of(out / "run.json");
  const nlohmann::json list = tests::json_of(out / "detections" / "00000.json")["detections"];
  for (const char* name : {"car ahead, plate", "oncoming car, plate"}) {
    const auto& targets = record["frames"][0]["targets"];
    const auto truth = std::find_if(targets.begin(), targets.end(),
                                    [&](const auto& target) { return target["name"] == name; });
    REQUIRE(truth != targets.end());
    const double range_m = (*truth)["range_m"].get<double>();
    const double speed_mps = (*truth)["radial_speed_mps"].get<double>();
    INFO(name << " at " << range_m << " m, " << speed_mps << " m/s");
    CHECK(std::abs(speed_mps) > 7.0);
    const nlohmann::json& found = nearest(list, range_m, speed_mps);
    // Four scatterers share a few cells: within the car's front, and a cell of speed (0.13 m/s).
    CHECK(found["range_m"].get<double>() == Approx(range_m).epsilon(0.0).margin(1.0));
    CHECK(found["radial_speed_mps"].get<double>() == Approx(speed_mps).epsilon(0.0).margin(0.13));
    CHECK(core::degrees(found["azimuth_rad"].get<double>()) ==
          Approx(core::degrees((*truth)["azimuth_rad"].get<double>())).epsilon(0.0).margin(2.0));
  }
}
