// `fanbeam materials` as a user meets it: list, plot, fit.
#include <filesystem>

#include "core/units.h"
#include "materials/nrcs/measurement_csv.h"
#include "session/plots/gnuplot.h"
#include "tests/apps/program.h"

using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

const std::string kLibrary = std::string(FANBEAM_SOURCE_DIR) + "/materials/library.toml";

nlohmann::json json_from(const std::string& words) {
  const Result result = run_fanbeam(words);
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  return nlohmann::json::parse(result.output);
}

TEST_CASE("fanbeam materials lists every row with levels, range, confidence and source",
          "[cli][materials]") {
  const Result result = run_fanbeam("materials");
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  for (const char* text : {"short_grass", "roof_wet", "-26.8", "recalled", "GIT land model"})
    CHECK(result.output.find(text) != std::string::npos);
  const nlohmann::json json = json_from("materials --json");
  CHECK(json["materials"].size() == 34);
  const nlohmann::json& grass = json["materials"][0];
  CHECK(grass["material"] == "short_grass");
  CHECK(grass["a"] == 0.032527);
  CHECK(grass["sigma0_dB"]["3"].get<double>() == Approx(-26.81).epsilon(0.0).margin(0.01));
  CHECK(grass["confidence"] == "recalled");
  CHECK(grass["extrapolated"] == false);
}

TEST_CASE("fanbeam materials shows states, and what lies outside a row's range",
          "[cli][materials]") {
  const nlohmann::json wet = json_from("materials --json --state wet");
  CHECK(wet["materials"][0]["shown_as"] == "short_grass_wet");
  CHECK(wet["materials"][0]["sigma0_dB"]["3"].get<double>() ==
        Approx(-24.81).epsilon(0.0).margin(0.01));
  const nlohmann::json high = json_from("materials --json --frequency 94");
  for (const nlohmann::json& row : high["materials"])
    if (row["material"] == "water_calm") CHECK(row["extrapolated"] == true);
  CHECK(run_fanbeam("materials --state soaked").exit_code == 2);
  CHECK(run_fanbeam("materials --polarisation HV").exit_code == 2);
  CHECK(run_fanbeam("materials --library /nowhere/library.toml").exit_code == 4);
}

TEST_CASE("fanbeam materials plot draws SVG and PNG through gnuplot", "[cli][materials]") {
  const TemporaryFolder folder;
  const auto file = [&](const char* name) { return quoted(folder.path() / name); };
  REQUIRE(
      run_fanbeam("materials plot -q -o " + file("a.svg") + " short_grass concrete").exit_code ==
      0);
  const std::string svg = bytes_of(folder.path() / "a.svg");
  CHECK(svg.find("<svg") != std::string::npos);
  CHECK(svg.find("short_grass") != std::string::npos);
  CHECK(svg.find("grazing angle, deg") != std::string::npos);
  CHECK(svg.find("water_calm") == std::string::npos);
  REQUIRE(run_fanbeam("materials plot -o " + file("b.png")).exit_code == 0);
  CHECK(bytes_of(folder.path() / "b.png").substr(1, 3) == "PNG");
  const Result unknown = run_fanbeam("materials plot -o " + file("c.svg") + " short_gras");
  CHECK(unknown.exit_code == 3);
  CHECK(unknown.output.find("nearest are short_grass") != std::string::npos);
  CHECK(run_fanbeam("materials plot -o " + file("c.pdf") + " paint").exit_code == 3);
  CHECK(run_fanbeam("materials plot").exit_code == 2);
  // Without gnuplot nothing is left behind.
  const Result missing =
      run_fanbeam("materials plot -o " + file("d.svg") + " paint", "PATH=/nowhere");
  CHECK(missing.exit_code == 4);
  CHECK(missing.output.find("gnuplot cannot be started: expected a working gnuplot program "
                            "(Debian package gnuplot-nox)") != std::string::npos);
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 2);
}

TEST_CASE("fanbeam materials plot leaves out what is dark, and says so where nothing else is",
          "[cli][materials]") {
  const TemporaryFolder folder;
  std::string library;
  for (const auto& [name, levels] : {std::pair("dark", "0, 0"), std::pair("grey", "0.1, 0.2")})
    library += std::string("[") + name +
               "]\nmodel = \"tabulated\"\ngrazing_deg = [1, 90]\nsigma0 = [" + levels +
               "]\nfrequency_range_GHz = [1, 100]\npolarisation = \"any\"\n"
               "confidence = \"assumed\"\nsource = \"none\"\n";
  folder.write("lib.toml", library);
  const auto plot = [&](const std::string& names) {
    return run_fanbeam("materials plot --library " + quoted(folder.path() / "lib.toml") + " -o " +
                       quoted(folder.path() / "a.svg") + " " + names);
  };
  const Result dark = plot("dark");
  CHECK(dark.exit_code == 3);
  CHECK(dark.output.find("E-RANGE material = dark: expected one that returns something") !=
        std::string::npos);
  CHECK_FALSE(fs::exists(folder.path() / "a.svg"));
  REQUIRE(plot("dark grey").exit_code == 0);
  const std::string svg = bytes_of(folder.path() / "a.svg");
  CHECK(svg.find("grey") != std::string::npos);
  CHECK(svg.find("dark") == std::string::npos);
}

TEST_CASE("A plot's script quotes texts, leaves gaps and does not depend on anything else",
          "[cli][gnuplot]") {
  using namespace fanbeam::session;
  Plot plot;
  plot.title = "it's\nhere";
  plot.x = {"x", true, 1.0, {}};
  plot.y = {"y", true, 1.5, 80.0};
  plot.series = {{"one", {1.0, 2.0, 3.0}, {1.0, std::nan(""), 3.0}, PlotSeries::Style::points}};
  const std::string script = gnuplot_script(plot, "out.svg");
  CHECK(script.find("set terminal svg size 960,640") != std::string::npos);
  CHECK(script.find("set title 'it''s here'") != std::string::npos);
  CHECK(script.find("set logscale x\n") != std::string::npos);
  CHECK(script.find("set xrange [1:*]") != std::string::npos);
  // A short logarithmic axis holds one power of ten, 10.
  CHECK(script.find("set ytics add (2, 5, 20, 50)\n") != std::string::npos);
  CHECK(script.find("set xtics") == std::string::npos);
  CHECK(script.find("$series0 << END\n1 1\n\n3 3\nEND\n") != std::string::npos);
  CHECK(script == gnuplot_script(plot, "out.svg"));
}

TEST_CASE("fanbeam materials fit gives the figures of the library", "[cli][materials]") {
  const nlohmann::json urban =
      json_from("materials fit --model kulemin --terrain urban --frequency 35 --json");
  CHECK(urban["a"].get<double>() == Approx(0.89451).epsilon(1e-4));
  CHECK(urban["b"] == 0.0);
  CHECK(urban["rms_dB"].get<double>() == Approx(2.61).epsilon(0.0).margin(0.01));
  CHECK(urban["largest_dB"].get<double>() == Approx(4.69).epsilon(0.0).margin(0.01));
  const nlohmann::json concrete = json_from(
      "materials fit --model oh1992 --medium concrete --rms-height-mm 0.2 --angles steep --json");
  CHECK(concrete["a"].get<double>() == Approx(0.00015916).epsilon(1e-3));
  // VV is brighter.
  const nlohmann::json vertical = json_from(
      "materials fit --model oh1992 --medium concrete --rms-height-mm 0.2 --angles steep --json "
      "--polarisation VV");
  CHECK(vertical["a"].get<double>() > 2.0 * concrete["a"].get<double>());
  const Result text = run_fanbeam("materials fit --model nrl-sea --sea-state 0");
  CHECK(text.output.find("c = 7.0315\n# misses its source by 1.21 dB RMS") != std::string::npos);
}

TEST_CASE("fanbeam materials refuses options without an effect, by the names they were given",
          "[cli][materials]") {
  for (const char* words :
       {"fit", "fit --model kulemin --csv x.csv", "fit --angles all", "fit --model phong",
        "fit --csv x.csv --terrain urban", "fit --csv x.csv --sea-state 1",
        "fit --csv x.csv --rms-slope 0.1", "fit --csv x.csv --angles steep",
        "fit --csv x.csv --frequency 94", "fit --csv x.csv --polarisation VV",
        "fit --library --terrain urban", "fit --library --frequency 94", "fit --library --json",
        "fit --model kulemin --terrain moor", "fit --model nrl-sea --sea-state 9",
        "fit --model kulemin --terrain urban --sea-state 1", "--json objects",
        "--state wet fit --model kulemin --terrain urban", "--frequency 94 plot -o x.svg"}) {
    INFO("fanbeam materials " << words);
    const Result result = run_fanbeam(std::string("materials ") + words);
    INFO(result.output);
    CHECK(result.exit_code == 2);
  }
  const auto output = [](const char* words) { return run_fanbeam(words).output; };
  CHECK(output("materials fit --model kulemin --terrain urban --sea-state 1")
            .rfind("E-REF --sea-state = given: expected an option of the model kulemin\n", 0) == 0);
  CHECK(output("materials fit --model rough-metal --rms-slope 2 --rms-height-mm 0.1")
            .rfind("E-RANGE --rms-slope = 2: expected 0.01 to 1\n", 0) == 0);
  CHECK(output("materials fit --model nrl-sea --sea-state 1 --frequency 94")
            .rfind("E-RANGE --frequency = 94: expected 0.5 to 35", 0) == 0);
}

TEST_CASE("fanbeam materials fit --library prints the shipped library byte for byte",
          "[cli][materials]") {
  const Result shipped = run_fanbeam("materials fit --library");
  CHECK(shipped.exit_code == 0);
  CHECK(shipped.output == bytes_of(kLibrary));
  const Result named = run_fanbeam("materials fit --library " + quoted(fs::path(kLibrary)));
  CHECK(named.output == shipped.output);
}

TEST_CASE("fanbeam materials fit --csv fits measurements", "[cli][materials]") {
  const TemporaryFolder folder;
  // 10 log10(0.05 sin(psi)) at five angles, given to 0.01 dB.
  folder.write("gamma.csv",
               "# a test\nsite,grazing_deg,sigma0_dB\nA,2,-27.58\nA,5,-23.61\n\nB,10,-20.61\n"
               "B,30,-16.02\nB,60,-13.64\n");
  const nlohmann::json fit =
      json_from("materials fit --json --csv " + quoted(folder.path() / "gamma.csv"));
  CHECK(fit["rms_dB"].get<double>() < 0.01);
  CHECK(fit["a"].get<double>() == Approx(0.05).epsilon(0.01));
}

TEST_CASE("Every problem of a measurement file is told with its line", "[cli][materials]") {
  fanbeam::core::ProblemList problems;
  const auto read = [&](const std::string& text) {
    problems = {};
    return fanbeam::materials::read_measurements(text, "m.csv", problems);
  };
  const auto rows =
      read("grazing_deg,sigma0_dB\r\n2,-30\r\n1,-20\nx,-20\n5,nan\n95,-20\n6\n7,-1e9\n8,-12\n");
  std::vector<std::pair<int, std::string>> found;
  for (const auto& problem : problems.all()) found.emplace_back(problem.place.line, problem.code);
  const std::vector<std::pair<int, std::string>> expected = {{3, "E-RANGE"},     {4, "E-PARSE"},
                                                             {5, "E-NONFINITE"}, {6, "E-RANGE"},
                                                             {7, "E-PARSE"},     {8, "E-RANGE"}};
  CHECK(found == expected);
  REQUIRE(rows.size() == 2);
  CHECK(rows[1].grazing_rad == Approx(fanbeam::core::radians(8.0)));
  for (const char* text : {"", "grazing_deg,sigma0_dB\n", "angle,level\n1,-20\n", "# nothing\n"}) {
    INFO(text);
    CHECK(read(text).empty());
    CHECK(problems.all().front().code == "E-PARSE");
  }
  CHECK(read("angle_deg,level\n1,-20\n").empty());
  CHECK(problems.all().front().expected == "grazing_deg and sigma0_dB; there are angle_deg, level");
  CHECK(read("\xEF\xBB\xBFsigma0_dB,grazing_deg\n-20,3").size() == 1);
  CHECK(problems.all().empty());
}

}  // namespace
