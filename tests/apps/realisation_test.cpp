// Realisations and detections as products of fanbeam render.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/errors.h"
#include "core/image.h"
#include "sensors/display/display.h"
#include "sensors/sensor_file.h"
#include "tests/apps/program.h"

using namespace fanbeam;
using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

const std::string kCheapRender = "render obstacle-field --frames 100:160:20 --rays-per-cell 1 ";

void run(const std::string& words, const fs::path& folder) {
  const Result result = run_fanbeam(kCheapRender + words + " -q -o " + quoted(folder));
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
}

}  // namespace

TEST_CASE("--realisation sample shows one draw per frame, the same however it is run", "[render]") {
  const TemporaryFolder folder;
  const std::string products = "--products bscope,cscope,detections,power --seed 5 ";
  run("--realisation sample --threads 1 " + products, folder.path() / "one");
  const auto first = results(folder.path() / "one");
  run("--realisation sample --threads 3 " + products, folder.path() / "three");
  CHECK((results(folder.path() / "three") == first));
  run("--effects +speckle " + products, folder.path() / "forced");
  CHECK(bytes_of(folder.path() / "forced/power/00100.exr").size() ==
        first.at("power/00100.exr").size());
  CHECK(json_of(folder.path() / "forced/run.json")["realisation"] == "sample");

  run("--realisation sample --products bscope --seed 6", folder.path() / "seed");
  CHECK(bytes_of(folder.path() / "seed/bscope/00100.png") != first.at("bscope/00100.png"));
  CHECK(json_of(folder.path() / "one/run.json")["realisation"] == "sample");
}

TEST_CASE("By default frames show the expected power, whatever the seed", "[render]") {
  const TemporaryFolder folder;
  run("--products power --seed 5", folder.path() / "a");
  run("--products power --seed 6 --realisation mean", folder.path() / "b");
  const core::Image a = core::read_image(folder.path() / "a/power/00120.exr");
  const core::Image b = core::read_image(folder.path() / "b/power/00120.exr");
  CHECK(a.layers[0].values == b.layers[0].values);
  const nlohmann::json record = json_of(folder.path() / "a/run.json");
  CHECK(record["realisation"] == "mean");
  const nlohmann::json& receiver = record["receiver"];
  CHECK(receiver["noise_W"].get<double>() == Approx(4.1825e-17).epsilon(1e-4));
  CHECK(receiver["threshold_W"].get<double>() / receiver["noise_W"].get<double>() ==
        Approx(13.8155).epsilon(1e-5));
  CHECK(receiver["false_alarms_per_frame"] == 0.0);
  CHECK(receiver["looks"] == 1);
  CHECK(receiver["detection_probability"] == 0.9);
  CHECK(receiver["minimum_detectable_signal_W"].get<double>() / receiver["noise_W"].get<double>() ==
        Approx(20.813).epsilon(1e-3));
}

TEST_CASE("The expected power is refused beside effects of a draw, which would show one",
          "[render]") {
  const TemporaryFolder folder;
  for (const std::string effect : {"+speckle", "+swerling"}) {
    const Result result = run_fanbeam(kCheapRender + "--realisation mean --effects " + effect +
                                      " -o " + quoted(folder.path() / "out"));
    INFO(result.output);
    CHECK(result.exit_code == 2);
    CHECK(result.output.find("E-UNSUPPORTED --effects = \"" + effect + "\"") != std::string::npos);
  }
}

TEST_CASE("The power EXR holds what the display shows: the echoes' watts and the mean noise",
          "[render]") {
  const TemporaryFolder folder;
  run("--products power,bscope", folder.path() / "mean");
  run("--products power --effects=-thermal-noise", folder.path() / "quiet");
  run("--products power --realisation sample", folder.path() / "sample");
  const auto exr = [&](const char* name) { return folder.path() / name / "power/00120.exr"; };
  const auto noise_W = [&](const char* name) {
    for (const auto& [key, value] : core::read_metadata(exr(name)))
      if (key == "fanbeam:noise_W") return std::stod(value);
    return -1.0;
  };
  const std::vector<double> with_W = core::read_image(exr("mean")).layers[0].values;
  const std::vector<double> without_W = core::read_image(exr("quiet")).layers[0].values;
  // k T0 F / dwell of docs/physics/receiver.md.
  const double expected_W = 1.380649e-23 * 290.0 * std::pow(10.0, 0.6) * 16.0 * 164.0;
  CHECK(noise_W("mean") == Approx(expected_W).epsilon(1e-12));
  CHECK(noise_W("sample") == Approx(expected_W).epsilon(1e-12));
  CHECK(noise_W("quiet") == 0.0);
  REQUIRE(with_W.size() == without_W.size());
  double most = 0.0;
  for (std::size_t i = 0; i < with_W.size(); ++i)  // floats: 24 bits
    most = std::max(most, std::abs(with_W[i] / (without_W[i] + expected_W) - 1.0));
  CHECK(most < 2e-7);
  CHECK(*std::min_element(without_W.begin(), without_W.end()) == 0.0);

  // Watts, farthest range on top, to the pixels of the B-scope.
  core::ProblemList problems;
  const sensors::Sensor sensor =
      sensors::read_sensor(FANBEAM_SOURCE_DIR "/sensors/hivision.toml", problems);
  std::vector<double> nearest_first;
  for (int row = sensor.range.cells; row-- > 0;)
    nearest_first.insert(nearest_first.end(), with_W.begin() + row * sensor.scan.columns,
                         with_W.begin() + (row + 1) * sensor.scan.columns);
  const core::Picture8 shown =
      sensors::bscope_picture(sensor, sensors::bscope_grey(sensor, nearest_first));
  const std::vector<double> png =
      core::read_image(folder.path() / "mean/bscope/00120.png").layers[0].values;
  REQUIRE(png.size() == shown.pixels.size());
  int others = 0;
  for (std::size_t i = 0; i < png.size(); ++i) others += png[i] == shown.pixels[i] ? 0 : 1;
  CHECK(others < 5);  // a float's rounding next to a half
}

TEST_CASE("Detections: a mask laid out as the B-scope and a table with the same cells",
          "[render]") {
  const TemporaryFolder folder;
  run("--products detections --realisation sample", folder.path());
  const core::Image mask = core::read_image(folder.path() / "detections/00120.png");
  REQUIRE(mask.columns == 164);
  REQUIRE(mask.rows == 524);
  std::vector<std::string> lines = lines_of(bytes_of(folder.path() / "detections/00120.csv"));
  CHECK(lines[0] == "# threshold detections");
  CHECK(std::count(lines.begin(), lines.end(), "# fanbeam:frame 120") == 1);
  // One comment stays, for the numbers of lines below.
  lines.erase(lines.begin(), std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
                               return !line.starts_with("#");
                             }) - 1);
  REQUIRE(lines.size() > 100);
  CHECK(lines[1] == "frame,time_s,row,column,range_m,azimuth_deg,power_W,snr_dB");
  const std::vector<double>& pixels = mask.layers[0].values;
  CHECK(std::count(pixels.begin(), pixels.end(), 255.0) ==
        static_cast<std::ptrdiff_t>(lines.size()) - 2);
  for (std::size_t i = 2; i < lines.size(); ++i) {
    int frame = 0, row = 0, column = 0;
    double time_s = 0.0, range_m = 0.0, azimuth_deg = 0.0, power_W = 0.0, snr_dB = 0.0;
    REQUIRE(std::sscanf(lines[i].c_str(), "%d,%lf,%d,%d,%lf,%lf,%lf,%lf", &frame, &time_s, &row,
                        &column, &range_m, &azimuth_deg, &power_W, &snr_dB) == 8);
    const bool right = frame == 120 && time_s == 120.5 / 16.0 &&
                       pixels[static_cast<std::size_t>((523 - row) * 164 + column)] == 255.0 &&
                       std::abs(range_m - (200.0 + 6.67 * (row + 0.5))) < 0.01 &&
                       std::abs(azimuth_deg - (0.25 * (column + 0.5) - 20.5)) < 0.001 &&
                       power_W > 13.8 * 4.18e-17 && snr_dB > 11.0;
    if (!right) FAIL(lines[i]);
  }
  CHECK(json_of(folder.path() / "run.json")["receiver"]["false_alarms_per_frame"].get<double>() ==
        Approx(0.0859).epsilon(0.0).margin(1e-4));
}

TEST_CASE("--resume takes a frame's detections over only with both of their files", "[render]") {
  const TemporaryFolder folder;
  const std::string words = "--products detections --realisation sample";
  run(words, folder.path());
  const auto whole = results(folder.path());
  fs::remove(folder.path() / "detections/00120.csv");
  fs::remove(folder.path() / "detections/00140.png");
  const Result resumed =
      run_fanbeam(kCheapRender + words + " --resume -o " + quoted(folder.path()));
  CHECK(resumed.exit_code == 0);
  CHECK(resumed.output.find("(1 already there)") != std::string::npos);
  CHECK((results(folder.path()) == whole));
  // A table of another input does not count.
  const Result other =
      run_fanbeam(kCheapRender + words + " --seed 8 --resume -o " + quoted(folder.path()));
  CHECK(other.output.find("already there") == std::string::npos);
}
