// Highway scenario files: the shared one in full, and small ones with everything wrong.
#include "scenes/highway_reader.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cfenv>
#include <cmath>

#include "core/decibel.h"
#include "core/errors.h"
#include "tests/scenes/scene_folder.h"
#include "tests/shared_data.h"

using namespace fanbeam;
using tests::replaced;

namespace {

// With the given members of a target in place of the usual ones.
std::string file_with(const std::string& target, const std::string& rcs = "10.0") {
  return R"({"format": "highway-scenarios", "version": 1,
    "radar": {"center_frequency_hz": 76e9, "sweep_bandwidth_hz": 250e6, "tx_power_w": 0.004,
      "tx_gain_db": 32, "rx_gain_db": 27, "noise_figure_db": 4.5, "system_loss_db": 0,
      "max_range_m": 200, "virtual_ula_elements": 12, "virtual_ula_spacing_wavelengths": 0.5,
      "frame_period_s": 0.05},
    "scenarios": [{"id": "X", "title": "test", "duration_s": 3, "ego_speed_mps": 20, "targets": [
      {"id": "A", "kind": "car", "swerling": 0, "rcs_m2": )" +
         rcs + ", " + target + "}]}]}";
}

const std::string kStraight =
    R"("motion": "piecewise-acceleration", "position_m": [50, 3], "velocity_mps": [22, 1],
       "segments": [])";

core::InputError refusal(const std::string& text) {
  try {
    scenes::parse_highway(text, "test.json");
  } catch (const core::InputError& error) {
    return error;
  }
  FAIL("accepted");
  return core::InputError({});
}

void check_refused(const std::string& text, core::ErrorClass kind, const std::string& field) {
  INFO(field);
  const core::InputError error = refusal(text);
  CHECK(error.has(kind));
  CHECK(std::any_of(error.problems().begin(), error.problems().end(),
                    [&](const core::Problem& one) { return one.field == field; }));
}

// The straight target with this truth.
std::string file_with_truth(const std::string& tables) {
  return replaced(file_with(kStraight), "]}]}", "]}], \"truth\": [" + tables + "]}");
}

const std::string kTable = R"({"id": "A", "rows": [[0, 50.1, 2, 0.06]], "in_view": [true]})";

}  // namespace

TEST_CASE("Every truth row of the shared scenarios follows from the motion laws", "[highway]") {
  const auto path = tests::shared_data("../reference/highway-scenarios.json");
  if (!path) return;
  const scenes::HighwayFile file = scenes::read_highway_file(*path);
  CHECK(core::dB_from_power(file.radar.transmit_gain, -300.0) == Approx(32.0));
  CHECK(core::dB_from_power(file.radar.noise_figure, -300.0) == Approx(4.5));
  REQUIRE(file.scenarios.size() == 4);
  int rows = 0;
  for (const core::HighwayScenario& scenario : file.scenarios)
    for (std::size_t i = 0; i < scenario.targets.size(); ++i) {
      REQUIRE_FALSE(scenario.truth[i].empty());
      for (const core::HighwayTruth& row : scenario.truth[i]) {
        INFO(scenario.id << " " << scenario.targets[i].id << " at " << row.time_s << " s");
        const core::HighwayTruth truth =
            core::truth_at(scenario.targets[i], scenario.radar_speed_mps, file.radar, row.time_s);
        CHECK(truth.range_m == Approx(row.range_m).epsilon(0.0).margin(1e-6));
        CHECK(truth.range_rate_mps == Approx(row.range_rate_mps).epsilon(0.0).margin(1e-6));
        CHECK(truth.azimuth_rad == Approx(row.azimuth_rad).epsilon(0.0).margin(1e-6));
        CHECK(truth.in_view == row.in_view);
        ++rows;
      }
    }
  CHECK(rows == 7 + 6 * 13 + 2 * 25 + 3 * 10);
}

TEST_CASE("Left in a scenario file is negative here", "[highway]") {
  const auto straight = scenes::parse_highway(file_with(kStraight), "test.json");
  const core::HighwayTarget& target = straight.scenarios[0].targets[0];
  CHECK(target.position_m == std::array<double, 2>{50.0, -3.0});
  CHECK(target.velocity_mps == std::array<double, 2>{22.0, -1.0});
  const auto bent =
      scenes::parse_highway(file_with(R"("motion": "piecewise-acceleration", "position_m": [50, 3],
        "velocity_mps": [22, 1], "segments": [
          {"type": "acceleration", "t0_s": 0, "t1_s": 1, "acceleration_mps2": [2, 0.5]},
          {"type": "lane-change", "t0_s": 1, "t1_s": 3, "lateral_m": 3.5}])"),
                            "test.json");
  CHECK(bent.scenarios[0].targets[0].accelerations[0].acceleration_mps2 ==
        std::array<double, 2>{2.0, -0.5});
  CHECK(bent.scenarios[0].targets[0].lane_changes[0].lateral_m == -3.5);
  const auto ring = scenes::parse_highway(
      file_with(R"("motion": "circular", "radius_m": 50, "azimuth0_rad": -0.69,
        "angular_rate_rad_s": 0.3)"),
      "test.json");
  CHECK(ring.scenarios[0].targets[0].azimuth_rad == 0.69);
  CHECK(ring.scenarios[0].targets[0].angular_rate_rad_per_s == -0.3);
}

TEST_CASE("All that is wrong with a scenario file is told together, with its path", "[highway]") {
  const core::InputError error = refusal(file_with(
      R"("motion": "piecewise-acceleration", "position_m": [50], "velocity_mps": [22, "x"],
        "segments": [{"type": "loop", "t0_s": 2, "t1_s": 1}])",
      "-3"));
  CHECK(error.has(core::ErrorClass::range));
  CHECK(error.has(core::ErrorClass::parse));
  CHECK(error.has(core::ErrorClass::unsupported));
  for (const char* field :
       {"/scenarios/0/targets/0/rcs_m2", "/scenarios/0/targets/0/position_m",
        "/scenarios/0/targets/0/velocity_mps/1", "/scenarios/0/targets/0/segments/0/t1_s",
        "/scenarios/0/targets/0/segments/0/type"}) {
    INFO(field);
    CHECK(std::any_of(error.problems().begin(), error.problems().end(),
                      [&](const core::Problem& one) { return one.field == field; }));
  }
}

TEST_CASE("A file without scenarios is refused, and one without a format told as that alone",
          "[highway]") {
  const std::string one = file_with(kStraight);
  check_refused(one.substr(0, one.find("[{\"id\": \"X\"")) + "[]}", core::ErrorClass::range,
                "/scenarios");
  const core::InputError error = refusal("{}");
  CHECK(error.problems().size() == 2);
  CHECK_FALSE(error.has(core::ErrorClass::unsupported));
}

TEST_CASE("A member that is not there is told with those that are", "[highway]") {
  const core::InputError error = refusal(file_with(
      R"("motion": "piecewise-acceleration", "position": [50, 0], "velocity_mps": [22, 0])"));
  const auto missing =
      std::find_if(error.problems().begin(), error.problems().end(),
                   [](const core::Problem& one) { return one.value == "missing"; });
  REQUIRE(missing != error.problems().end());
  CHECK(missing->field == "/scenarios/0/targets/0/position_m");
  CHECK(missing->expected.starts_with("it to be there; there are "));
  CHECK(missing->expected.find("position") != std::string::npos);
}

TEST_CASE("Hostile scenario files are refused before they cost anything", "[highway]") {
  CHECK(refusal(std::string(100000, '[')).has(core::ErrorClass::limit));
  CHECK(refusal("{").has(core::ErrorClass::parse));
  CHECK(refusal("").has(core::ErrorClass::parse));
  CHECK(refusal("[1, 2]").has(core::ErrorClass::parse));
  CHECK(refusal(R"({"format": "other", "version": 1})").has(core::ErrorClass::unsupported));
  CHECK(refusal(file_with(R"("motion": "jump")")).has(core::ErrorClass::unsupported));
  CHECK(refusal(file_with(kStraight, "1e999")).has(core::ErrorClass::nonfinite));
  CHECK(refusal(file_with(kStraight, "\"\\ud800\"")).has(core::ErrorClass::parse));
  // A million and more values, in members that nobody reads.
  std::string values = "0";
  for (int i = 0; i < 1'000'000; ++i) values += ",0";
  CHECK(refusal(replaced(file_with(kStraight), "\"version\"",
                         "\"notes\": [" + values + "], \"version\""))
            .has(core::ErrorClass::limit));
  std::string many = "0";
  for (int i = 0; i < 2000; ++i) many += ",0";
  CHECK(refusal(file_with(R"("motion": "piecewise-acceleration", "position_m": [)" + many +
                          R"(], "velocity_mps": [1, 1], "segments": [])"))
            .has(core::ErrorClass::limit));
}

TEST_CASE("A target's id fits into a cell of a table", "[highway]") {
  const auto named = [](const char* id) {
    return replaced(file_with(kStraight), "\"id\": \"A\"", std::string("\"id\": \"") + id + "\"");
  };
  for (const char* id : {"A, left", "A \\\"left\\\"", "A\\nleft", ""}) {
    INFO(id);
    check_refused(named(id), core::ErrorClass::range, "/scenarios/0/targets/0/id");
  }
  CHECK(scenes::parse_highway(named("Käfer 2 (left)"), "test.json").scenarios[0].targets[0].id ==
        "Käfer 2 (left)");
}

TEST_CASE("A lane is not changed in no time, which has no finite rate", "[highway]") {
  check_refused(file_with(R"("motion": "piecewise-acceleration", "position_m": [50, 3],
        "velocity_mps": [22, 1], "segments": [
          {"type": "lane-change", "t0_s": -1e-320, "t1_s": 1e-320, "lateral_m": 3.5}])"),
                core::ErrorClass::range, "/scenarios/0/targets/0/segments/0/t1_s");
}

TEST_CASE("Whole numbers are whole, and none is cut or cast out of its range", "[highway]") {
  const std::string elements = "\"virtual_ula_elements\": 12";
  const auto with_elements = [&](const std::string& number) {
    return replaced(file_with(kStraight), elements, "\"virtual_ula_elements\": " + number);
  };
  CHECK(scenes::parse_highway(with_elements("7.0"), "test.json").radar.array_elements == 7);
  for (const char* number : {"12.7", "0", "0.5", "-3", "1e300", "-1e300", "2147483648"}) {
    INFO(number);
    check_refused(with_elements(number), core::ErrorClass::range, "/radar/virtual_ula_elements");
  }
  for (const char* number : {"2.5", "-1", "5", "1e300"}) {
    INFO(number);
    check_refused(
        replaced(file_with(kStraight), "\"swerling\": 0", "\"swerling\": " + std::string(number)),
        core::ErrorClass::range, "/scenarios/0/targets/0/swerling");
  }
  // The processor tells of a double that no int holds.
  const std::string far = with_elements("1e300");
  std::feclearexcept(FE_INVALID);
  refusal(far);
  CHECK(std::fetestexcept(FE_INVALID) == 0);
}

TEST_CASE("True and false are those words, not what stands in their place", "[highway]") {
  for (const char* clutter : {"1", "\"true\"", "[]"}) {
    INFO(clutter);
    check_refused(file_with("\"clutter\": " + std::string(clutter) + ", " + kStraight),
                  core::ErrorClass::parse, "/scenarios/0/targets/0/clutter");
  }
  const auto marked = scenes::parse_highway(file_with("\"clutter\": true, " + kStraight), "x.json");
  CHECK(marked.scenarios[0].targets[0].clutter);
  CHECK(scenes::parse_highway(file_with_truth(kTable), "x.json").scenarios[0].truth[0][0].in_view);
  for (const char* seen : {"[1]", "[null]"})
    check_refused(file_with_truth(replaced(kTable, "[true]", seen)), core::ErrorClass::parse,
                  "/scenarios/0/truth/0/in_view/0");
}

TEST_CASE("Truth that the motion contradicts is refused with what the motion makes", "[highway]") {
  for (const char* row : {"[0, 55.1, 2, 0.06]", "[0, 50.1, -2, 0.06]", "[0, 50.1, 2, -0.06]"}) {
    INFO(row);
    check_refused(file_with_truth(replaced(kTable, "[0, 50.1, 2, 0.06]", row)),
                  core::ErrorClass::range, "/scenarios/0/truth/0/rows/0");
  }
  // The first row of a table, with its own numbers; a fault elsewhere is told beside it.
  const std::string twice = R"({"id": "A", "rows": [[0, 55.1, 2, 0.06], [1, 99, 2, 0.06]],
                               "in_view": [true, true]})";
  const std::string file =
      replaced(file_with_truth(twice), "\"title\": \"", "\"title\": 5, \"note\": \"");
  const auto problems = refusal(file).problems();
  std::string told;
  for (const core::Problem& problem : problems) told += to_string(problem) + "\n";
  INFO(told);
  CHECK(told.find("rows/0 = 55.1 m, 2 m/s, 0.06 rad") != std::string::npos);
  CHECK(told.find("/scenarios/0/title") != std::string::npos);
  CHECK(told.find("rows/1") == std::string::npos);
  // A target that is read with a fault has no motion that could judge.
  const auto faulty = refusal(replaced(file_with_truth(twice), "\"rcs_m2\"", "\"rcs\""));
  for (const core::Problem& problem : faulty.problems())
    CHECK(problem.field.find("truth") == std::string::npos);
}

TEST_CASE("No scenario, target or truth table replaces another of its name", "[highway]") {
  check_refused(file_with_truth(kTable + ", " + kTable), core::ErrorClass::ref,
                "/scenarios/0/truth/1/id");
  check_refused(file_with_truth(replaced(kTable, "\"A\"", "\"B\"")), core::ErrorClass::ref,
                "/scenarios/0/truth/0/id");
  const std::string file = file_with(kStraight);
  const std::size_t first = file.find("{\"id\": \"X\"");
  const std::string scenario = file.substr(first, file.size() - 2 - first);
  check_refused(replaced(file, scenario, scenario + ", " + scenario), core::ErrorClass::ref,
                "/scenarios/1/id");
}

TEST_CASE("A scenario's own radar and targets that are not measured for a while are read",
          "[highway]") {
  const auto with = [](const std::string& members) {
    return replaced(file_with(kStraight), "]}]}", "]}], " + members + "}");
  };
  const scenes::HighwayFile file = scenes::parse_highway(
      with(R"("radar_overrides": {"noise_figure_db": 10, "frame_period_s": 0.1},
              "suppressed_detections": [{"id": "A", "from_s": 1, "to_s": 1.6}])"),
      "test.json");
  const core::HighwayScenario& scenario = file.scenarios.at(0);
  CHECK(core::dB_from_power(scenario.radar.noise_figure, -300.0) == Approx(10.0));
  CHECK(scenario.radar.frame_s == 0.1);
  CHECK(scenario.radar.bandwidth_Hz == file.radar.bandwidth_Hz);
  CHECK(core::dB_from_power(file.radar.noise_figure, -300.0) == Approx(4.5));
  CHECK_FALSE(core::is_suppressed(scenario.targets[0], 0.99));
  CHECK(core::is_suppressed(scenario.targets[0], 1.0));
  CHECK_FALSE(core::is_suppressed(scenario.targets[0], 1.6));
  check_refused(with(R"("radar_overrides": {"noise_figure_db": -1})"), core::ErrorClass::range,
                "/scenarios/0/radar_overrides/noise_figure_db");
  check_refused(with(R"("suppressed_detections": [{"id": "B", "from_s": 1, "to_s": 2}])"),
                core::ErrorClass::ref, "/scenarios/0/suppressed_detections/0/id");
  check_refused(with(R"("suppressed_detections": [{"id": "A", "from_s": 2, "to_s": 2}])"),
                core::ErrorClass::range, "/scenarios/0/suppressed_detections/0/to_s");
}

TEST_CASE("Members that the format does not have are told, with those like them", "[highway]") {
  const core::InputError error = refusal(replaced(
      replaced(file_with(kStraight), "\"tx_power_w\"", "\"noise_figre_db\": 3, \"tx_power_w\""),
      "\"swerling\": 0", "\"swerling\": 0, \"colour\": 1"));
  CHECK(error.problems().size() == 2);
  for (const core::Problem& problem : error.problems()) {
    const std::string text = core::to_string(problem);
    CHECK((text.find("/radar/noise_figre_db = unknown") != std::string::npos ||
           text.find("/scenarios/0/targets/0/colour = unknown") != std::string::npos));
    if (problem.field == "/radar/noise_figre_db")
      CHECK(text.find("noise_figure_db") != std::string::npos);
  }
}

TEST_CASE("A truth table has the format's members alone, those for people among them",
          "[highway]") {
  const std::string people = R"("columns": ["t_s"], "snr_2ms_ramp_db_worst": 50, "id")";
  CHECK(scenes::parse_highway(file_with_truth(replaced(kTable, "\"id\"", people)), "x.json")
            .scenarios[0]
            .truth[0]
            .size() == 1);
  const auto problems =
      refusal(file_with_truth(replaced(kTable, "\"id\"", "\"in_veiw\": [], \"id\""))).problems();
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].field == "/scenarios/0/truth/0/in_veiw");
  CHECK(problems[0].expected.find("in_view") != std::string::npos);
}

TEST_CASE("A waveform has to fit the frames of the scenarios that name it, and no others",
          "[highway]") {
  // Of 0.2 s, in frames of 0.05 s or of 0.5.
  const auto with = [](const std::string& members) {
    return replaced(
        replaced(file_with(kStraight), "\"scenarios\"",
                 R"("waveforms": {"w": {"type": "triangle", "ramp_s": 0.1}}, "scenarios")"),
        "]}]}", "]}]" + members + "}");
  };
  CHECK_NOTHROW(scenes::parse_highway(with(""), "x.json"));
  CHECK_NOTHROW(scenes::parse_highway(
      with(R"(, "waveforms": ["w"], "radar_overrides": {"frame_period_s": 0.5})"), "x.json"));
  check_refused(with(R"(, "waveforms": ["w"])"), core::ErrorClass::range,
                "/scenarios/0/waveforms/0");
  check_refused(
      replaced(with(R"(, "waveforms": ["w"], "radar_overrides": {"frame_period_s": 0.1})"),
               "\"frame_period_s\": 0.05", "\"frame_period_s\": 0.5"),
      core::ErrorClass::range, "/scenarios/0/waveforms/0");
}

TEST_CASE("A waveform that a scenario names and the file has not is told with those it has",
          "[highway]") {
  const std::string named = replaced(file_with(kStraight), "\"duration_s\"",
                                     R"("waveforms": ["two-stages"], "duration_s")");
  const auto refused = [&](const std::string& waveforms) {
    const core::InputError error = refusal(
        replaced(named, "\"scenarios\"", "\"waveforms\": {" + waveforms + "}, \"scenarios\""));
    REQUIRE(error.problems().size() == 1);
    CHECK(error.has(core::ErrorClass::ref));
    CHECK(error.problems()[0].field == "/scenarios/0/waveforms/0");
    return error.problems()[0].expected;
  };
  CHECK(refused(R"("slow": {"type": "triangle", "ramp_s": 0.002},
                   "two-stage": {"type": "two-stage", "coarse": {}, "fine": {}})") ==
        "the name of one of /waveforms; perhaps two-stage of slow, two-stage");
  CHECK(refused("") == "the name of one of /waveforms; there are none");
}

TEST_CASE("What another kind of waveform or motion has is refused, not passed over", "[highway]") {
  const auto with_waveforms = [](const std::string& text) {
    return replaced(file_with(kStraight), "\"scenarios\"",
                    "\"waveforms\": {" + text + "}, \"scenarios\"");
  };
  check_refused(with_waveforms(R"("w": {"type": "triangle", "ramp_s": 0.002, "flat_s": 0.002})"),
                core::ErrorClass::ref, "/waveforms/w/flat_s");
  check_refused(
      with_waveforms(R"("w": {"type": "two-stage", "ramp_s": 0.002, "coarse": {}, "fine": {}})"),
      core::ErrorClass::ref, "/waveforms/w/ramp_s");
  check_refused(with_waveforms(R"("w": {"type": "triangle-pair", "ramp_s": [0.003, 0.003]})"),
                core::ErrorClass::range, "/waveforms/w/ramp_s");
  // Its stages have rates of their own, and no study averages buffers of it.
  for (const char* key : {"sample_rate_hz", "ramps_per_buffer"})
    check_refused(with_waveforms(R"("w": {"type": "two-stage", "coarse": {}, "fine": {}, ")" +
                                 std::string(key) + "\": 1000}"),
                  core::ErrorClass::ref, "/waveforms/w/" + std::string(key));
  const std::string circle =
      R"("motion": "circular", "radius_m": 50, "azimuth0_rad": 0, "angular_rate_rad_s": 0.1)";
  check_refused(file_with(circle + R"(, "velocity_mps": [1, 2])"), core::ErrorClass::ref,
                "/scenarios/0/targets/0/velocity_mps");
  check_refused(file_with(kStraight + R"(, "radius_m": 50)"), core::ErrorClass::ref,
                "/scenarios/0/targets/0/radius_m");
  for (const char* fixed : {"\"reference_temperature_k\": 5000", "\"propagation_speed_mps\": 3e8"})
    CHECK(refusal(replaced(file_with(kStraight), "\"max_range_m\"",
                           std::string(fixed) + ", \"max_range_m\""))
              .has(core::ErrorClass::unsupported));
  for (const char* segment :
       {R"("type": "acceleration", "acceleration_mps2": [1, 0], "lateral_m": 3.5)",
        R"("type": "lane-change", "lateral_m": 3.5, "acceleration_mps2": [1, 0])"}) {
    const bool lane = std::string(segment).find("lane") != std::string::npos;
    check_refused(file_with(replaced(kStraight, "[]",
                                     "[{\"t0_s\": 0, \"t1_s\": 1, " + std::string(segment) + "}]")),
                  core::ErrorClass::ref,
                  std::string("/scenarios/0/targets/0/segments/0/") +
                      (lane ? "acceleration_mps2" : "lateral_m"));
  }
  // Members of JSON have no order: of two triangles the first by name counts.
  const auto radar = scenes::parse_highway(with_waveforms(
                                               R"("z": {"type": "triangle", "ramp_s": 0.001},
                 "a": {"type": "triangle", "ramp_s": 0.004, "sample_rate_hz": 2e6})"),
                                           "test.json")
                         .radar;
  CHECK(radar.waveforms.triangle_ramp_s == 0.004);
  CHECK(radar.waveforms.triangle_rate_Hz == 2e6);
}
