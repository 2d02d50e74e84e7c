// fanbeam regress: what differs from approved pictures is told, what is approved is kept with its
// reason, and nothing leaves the folders that it belongs to.
#include <algorithm>
#include <filesystem>

#include "core/image.h"
#include "core/machine.h"
#include "measure/regress/markup.h"
#include "measure/regress/suite.h"
#include "tests/apps/markup_check.h"
#include "tests/apps/program.h"

using namespace fanbeam;
using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

// Flat grass from some height, for a radar of a few columns.
class Workplace {
 public:
  Workplace() {
    folder_.write("radar.toml", narrow_sensor(4));
    set_height("60.0");
  }

  void set_height(const std::string& height_m) {
    fs::create_directories(folder_.path() / "grass");
    std::string scene = bytes_of(FANBEAM_SOURCE_DIR "/scenes/flat-grass/scene.toml");
    const std::string line = "above_ground_m = 60.0";
    REQUIRE(scene.find(line) != std::string::npos);
    scene.replace(scene.find(line), line.size(), "above_ground_m = " + height_m);
    folder_.write("grass/scene.toml", scene);
  }

  // One case; `more` are lines of its table, `head` lines before it.
  void set_suite(const std::string& more = "", const std::string& head = "",
                 const std::string& name = "grass") {
    folder_.write("suite.toml", "name = \"test\"\nisa = \"v2\"\n" + head +
                                    "\n[[case]]\nname = '''" + name +
                                    "'''\nscene = \"grass\"\nsensor = \"radar.toml\"\n"
                                    "frames = \"0\"\nrays_per_cell = 1\n" +
                                    more + "\n");
  }

  Result run(const std::string& words = "") const {
    return run_fanbeam("regress run " + quoted(suite()) + " -o " + quoted(out()) + " " + words);
  }
  Result approve(const std::string& words = "--reason 'first pictures'") const {
    return run_fanbeam("regress approve " + quoted(suite()) + " -o " + quoted(out()) + " " + words);
  }

  fs::path path() const { return folder_.path(); }
  fs::path suite() const { return folder_.path() / "suite.toml"; }
  fs::path out() const { return folder_.path() / "out"; }
  fs::path approved() const { return folder_.path() / "approved"; }
  nlohmann::json results() const { return json_of(out() / "results.json"); }
  nlohmann::json only_case() const { return results().at("cases").at(0); }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_.path() / name).parent_path());
    folder_.write(name, text);
  }

 private:
  TemporaryFolder folder_;
};

void require_exit(const Result& result, int exit_code) {
  INFO(result.output);
  REQUIRE(result.exit_code == exit_code);
}

void check_markup(const fs::path& file) {
  std::set<std::string> names;
  INFO(file);
  REQUIRE(fs::exists(file));
  CHECK(markup_fault(bytes_of(file), names) == "");
  CHECK_FALSE(names.contains("script"));
}

const nlohmann::json& picture(const nlohmann::json& one, const std::string& file) {
  for (const nlohmann::json& entry : one.at("pictures"))
    if (entry.at("file") == file) return entry;
  FAIL("no picture " << file << " in " << one.dump(1));
  return one;
}

}  // namespace

TEST_CASE("Pictures are approved with a reason, and then pass", "[regress]") {
  Workplace place;
  place.set_suite();
  const Result first = place.run();
  require_exit(first, 1);
  CHECK(first.output.find("rendered, but not approved") != std::string::npos);
  CHECK(place.only_case()["state"] == "unapproved");
  CHECK_FALSE(fs::exists(place.approved()));
  check_markup(place.out() / "report.html");
  check_markup(place.out() / "junit.xml");

  require_exit(place.approve("--reason 'the closed form\nof flat ground'"), 0);
  const nlohmann::json approval = json_of(place.approved() / "grass" / "approval.json");
  CHECK(approval["reason"] == "the closed form\nof flat ground");
  CHECK(approval["isa"] == "x86-64-v2");
  CHECK(approval["settings"]["seed"] == 0);
  CHECK(bytes_of(place.approved() / "grass" / "bscope" / "00000.png") ==
        bytes_of(place.out() / "rendered" / "grass" / "bscope" / "00000.png"));

  require_exit(place.run(), 0);
  CHECK(place.only_case()["state"] == "passed");
  CHECK(place.only_case()["settings_changed"].empty());
  const auto before = contents(place.out());
  require_exit(place.run(), 0);
  auto after = contents(place.out());
  REQUIRE(after.erase("rendered/grass/timing.json") == 1);
  for (const auto& [name, bytes] : after) {
    INFO(name);
    CHECK(before.at(name) == bytes);
  }
}

TEST_CASE("A picture that differs is told with its figures, the setting that changed, and a map",
          "[regress]") {
  Workplace place;
  place.set_suite("products = [\"bscope\", \"cscope\", \"power\"]");
  require_exit(place.run(), 1);
  require_exit(place.approve(), 0);
  place.set_height("70.0");
  const Result result = place.run("--junit " + quoted(place.path() / "junit" / "here.xml"));
  require_exit(result, 1);
  CHECK(result.output.find("input.trajectory.fixed.above_ground_m: 60.0 -> 70.0") !=
        std::string::npos);
  CHECK(result.output.find("bscope/00000.png: ") != std::string::npos);
  const nlohmann::json one = place.only_case();
  CHECK(one["state"] == "differs");
  REQUIRE(one["settings_changed"].size() == 1);
  const nlohmann::json& layer = picture(one, "bscope/00000.png")["layers"][0];
  CHECK(layer["percent"]["allowed"] == 0.0);
  CHECK(layer["percent"]["within"] == false);
  CHECK(layer["rms"]["value"] > 0.0);
  const fs::path shown = place.out() / "pictures" / "grass";
  for (const char* file : {"bscope/00000.png", "power/00000.exr"})
    for (const char* ending : {".approved.png", ".new.png", ".difference.png"}) {
      INFO(file << ending);
      CHECK(core::read_image(shown / (std::string(file) + ending)).columns > 0);
    }
  const std::string page = bytes_of(place.out() / "report.html");
  for (const char* text : {"pictures/grass/bscope/00000.png.difference.png", "first pictures",
                           "above_ground_m", "every value has to be equal"}) {
    INFO(text);
    CHECK(page.find(text) != std::string::npos);
  }
  check_markup(place.out() / "report.html");
  check_markup(place.path() / "junit" / "here.xml");
  CHECK_FALSE(fs::exists(place.out() / "junit.xml"));
  CHECK(bytes_of(place.path() / "junit" / "here.xml").find("failures=\"1\" errors=\"0\"") !=
        std::string::npos);
}

// The first by the alphabet was shown, whatever differed: black where nothing bounces.
TEST_CASE("The page shows the layer that differs, from its least value to its largest",
          "[regress]") {
  Workplace place;
  place.set_suite("products = [\"layers\"]");
  require_exit(place.run(), 1);
  require_exit(place.approve(), 0);
  place.set_height("70.0");
  require_exit(place.run(), 1);
  const nlohmann::json one = place.only_case();
  std::string differing;
  for (const nlohmann::json& layer : picture(one, "layers/00000.exr")["layers"])
    if (differing.empty() && layer["within"] == false) differing = layer["layer"];
  CHECK(differing == "elevation_deg");
  for (const char* side : {"approved", "new"}) {
    const core::Image shown = core::read_image(place.out() / "pictures/grass/layers" /
                                               (std::string("00000.exr.") + side + ".png"));
    const auto [least, largest] = std::ranges::minmax(shown.layers.at(0).values);
    CHECK(largest - least > 128.0);
    CHECK(bytes_of(place.out() / "report.html").find(side + (": " + differing)) !=
          std::string::npos);
  }
}

TEST_CASE("A tolerance lets pass what it says, with its reason in the report", "[regress]") {
  const std::string loose =
      "[tolerance.bscope]\nrms = 200\nreason = \"loose on purpose\"\n"
      "[tolerance.cscope]\nrms = 200\nreason = \"loose on purpose\"\n";
  Workplace place;
  place.set_suite("", loose);
  require_exit(place.run(), 1);
  require_exit(place.approve(), 0);
  place.set_height("70.0");
  require_exit(place.run(), 0);
  CHECK(picture(place.only_case(), "bscope/00000.png")["tolerance_reason"] == "loose on purpose");
  // A case's own table replaces the suite's.
  place.set_suite("[case.tolerance.bscope]\nrms = 1e-6\nreason = \"tight on purpose\"", loose);
  require_exit(place.run(), 1);
  CHECK(picture(place.only_case(), "bscope/00000.png")["state"] == "differs");
  CHECK(picture(place.only_case(), "cscope/00000.png")["state"] == "same");
  // Without --html the results are the same, and no page is written.
  require_exit(place.run("--no-html"), 1);
  CHECK_FALSE(fs::exists(place.out() / "report.html"));
  CHECK_FALSE(fs::exists(place.out() / "pictures"));
}

TEST_CASE("Another size, a lost picture and a new one are each told plainly", "[regress]") {
  Workplace place;
  place.set_suite();
  require_exit(place.run(), 1);
  require_exit(place.approve(), 0);
  place.write("radar.toml", narrow_sensor(6));
  place.set_suite("products = [\"bscope\", \"ppi\"]");
  const Result result = place.run();
  require_exit(result, 1);
  const nlohmann::json one = place.only_case();
  CHECK(picture(one, "bscope/00000.png")["state"] == "changed");
  CHECK(picture(one, "bscope/00000.png")["note"] == "size 6 x 524, approved 4 x 524");
  CHECK(picture(one, "cscope/00000.png")["state"] == "missing");
  CHECK(picture(one, "ppi/00000.png")["state"] == "unapproved");
  CHECK(result.output.find("cscope/00000.png: approved, but not rendered any more") !=
        std::string::npos);
  // A damaged picture ends nothing either.
  std::ofstream(place.approved() / "grass" / "bscope" / "00000.png") << "no picture";
  require_exit(place.run(), 1);
  CHECK(picture(place.only_case(), "bscope/00000.png")["state"] == "unreadable");
  // Approving takes the lost picture away.
  require_exit(place.approve(), 0);
  CHECK_FALSE(fs::exists(place.approved() / "grass" / "cscope"));
  require_exit(place.run(), 0);
}

TEST_CASE("Names full of markup and of ways out stay text, inside the folders", "[regress]") {
  const std::string name = "../../evil/<script>alert(1)</script> & \"x\"'; \\";
  Workplace place;
  place.set_suite("", "", name);
  const auto outside_before = contents(place.path());
  require_exit(place.run(), 1);
  require_exit(place.approve("--reason '</p><script>alert(2)</script>'"), 0);
  place.set_height("70.0");
  require_exit(place.run(), 1);
  check_markup(place.out() / "report.html");
  check_markup(place.out() / "junit.xml");
  CHECK(place.only_case()["name"] == name);
  for (const auto& [file, bytes] : contents(place.path())) {
    INFO(file);
    CHECK((outside_before.contains(file) || file == "out" || file.starts_with("out/") ||
           file == "approved" || file.starts_with("approved/")));
  }
  for (const auto& entry : fs::directory_iterator(place.approved()))
    CHECK(entry.path().filename().string().starts_with("~2E.~2F"));
  CHECK_FALSE(fs::exists(place.path().parent_path() / "evil"));
}

TEST_CASE("A suite's faults are told all at once, by line, and nothing is rendered", "[regress]") {
  Workplace place;
  place.write("suite.toml",
              "name = \"test\"\n"
              "approved = \"../elsewhere\"\n"
              "aproved = 1\n"
              "[tolerance.bscope]\n"
              "rms = -1\n"
              "[[case]]\n"
              "name = \"one\\u0007\"\n"
              "scene = \"no such scene\"\n"
              "frames = \"0\"\n"
              "products = [\"bscop\"]\n"
              "[[case]]\n"
              "name = \"two\"\n"
              "scene = \"grass\"\n"
              "frames = \"foo\"\n"
              "effects = \"+snoww\"\n"
              "[case.tolerance.power]\n"
              "reason = \" \"\n"
              "[[case]]\n"
              "name = \"two\"\n"
              "scene = \"grass\"\n"
              "isa = \"v9\"\n"
              "sensor = \"hivision-49\"\n");
  const Result result = place.run();
  INFO(result.output);
  CHECK(result.exit_code == 3);
  for (const char* told :
       {"suite.toml:2:1: E-PATH approved", "suite.toml:3:1: E-REF aproved",
        "suite.toml:5:1: E-RANGE tolerance.bscope.rms", "tolerance.bscope.reason = missing",
        "suite.toml:7:1: E-RANGE case[0].name", "suite.toml:8:1: E-REF case[0].scene",
        "suite.toml:10:1: E-REF case[0].products", "suite.toml:14:1: E-PARSE case[1].frames",
        "suite.toml:15:1: E-REF case[1].effects", "case[1].tolerance.power = no limit",
        "suite.toml:17:1: E-RANGE case[1].tolerance.power.reason",
        "case[1].tolerance.power = a tolerance", "suite.toml:19:1: E-REF case[2].name",
        "case[2].frames = missing", "suite.toml:21:1: E-RANGE case[2].isa",
        "suite.toml:22:1: E-REF case[2].sensor = \"hivision-49\" not found"}) {
    INFO(told);
    CHECK(result.output.find(told) != std::string::npos);
  }
  CHECK_FALSE(fs::exists(place.out()));
}

// All before it was rendered first.
TEST_CASE(
    "A folder of data that is not there is told before anything is rendered, unless --data is",
    "[regress]") {
  Workplace place;
  place.set_suite(
      "\n[[case]]\nname = \"other\"\nscene = \"grass\"\nsensor = \"radar.toml\"\n"
      "frames = \"0\"\nrays_per_cell = 1\ndata = \"nowhere\"");
  const Result refused = place.run();
  require_exit(refused, 3);
  CHECK(refused.output.find("E-IO case \"other\" data") != std::string::npos);
  CHECK_FALSE(fs::exists(place.out()));
  require_exit(place.run("--data " + quoted(place.path())), 1);
}

TEST_CASE("A sensor is a file beside the suite, or a shipped one by its name", "[regress]") {
  Workplace place;
  const auto sensor_of = [&](const std::string& name) {
    place.write("suite.toml",
                "name = \"test\"\n[[case]]\nname = \"a\"\nscene = \"grass\"\n"
                "frames = \"0\"\nsensor = \"" +
                    name + "\"\n");
    return fs::path(
        measure::read_valid_suite(place.suite(), FANBEAM_SOURCE_DIR).cases.at(0).render.sensor);
  };
  const fs::path shipped = fs::path(FANBEAM_SOURCE_DIR) / "sensors/hivision-94.toml";
  CHECK(fs::equivalent(sensor_of("radar.toml"), place.path() / "radar.toml"));
  CHECK(fs::equivalent(sensor_of("hivision-94"), shipped));
  place.write("hivision-94", "mine");
  CHECK(fs::equivalent(sensor_of("hivision-94"), place.path() / "hivision-94"));
}

// A picture that went black passed a limit that only layers are held to.
TEST_CASE("A limit that a product's figures do not have is refused", "[regress]") {
  const auto refused = [](const std::string& product, const std::string& limit) {
    Workplace place;
    place.write("suite.toml", "name = \"test\"\n[tolerance." + product + "]\n" + limit +
                                  " = 1\nrms = 1\nreason = \"x\"\n"
                                  "[[case]]\nname = \"a\"\nscene = \"grass\"\nframes = \"0\"\n");
    core::ProblemList problems;
    measure::read_suite(place.suite(), FANBEAM_SOURCE_DIR, problems);
    const std::string told = problems.has_errors() ? to_string(problems.all().front()) : "";
    INFO(told);
    CHECK((told.empty() || told.find("suite.toml:3:1: E-REF tolerance." + product + "." + limit) !=
                               std::string::npos));
    return !told.empty();
  };
  CHECK(refused("bscope", "changed_percent"));
  CHECK(refused("power", "changed_percent"));
  CHECK_FALSE(refused("layers", "changed_percent"));
  CHECK_FALSE(refused("cscope_layers", "changed_percent"));
  CHECK(refused("cscope", "lit_in_one_percent"));
  CHECK(refused("layers", "lit_in_one_percent"));
  CHECK_FALSE(refused("power", "lit_in_one_percent"));
}

// A case of labels alone compared nothing and passed.
TEST_CASE("What holds no picture is no product of a suite", "[regress]") {
  for (const char* product : {"labels", "obstacles", "preview"}) {
    Workplace place;
    place.set_suite(std::string("products = [\"") + product + "\"]");
    const Result result = place.run();
    INFO(result.output);
    CHECK(result.exit_code == 3);
    CHECK(result.output.find("E-REF case[0].products") != std::string::npos);
  }
}

TEST_CASE("Approving wants a reason, a case of the suite, and results of this suite", "[regress]") {
  Workplace place;
  place.set_suite();
  require_exit(place.approve(), 4);  // nothing was run
  require_exit(place.run(), 1);
  require_exit(place.approve("--reason '  '"), 2);
  const Result unknown = place.approve("--reason x --case gras");
  require_exit(unknown, 2);
  CHECK(unknown.output.find("such as grass") != std::string::npos);
  place.set_suite("seed = 1");
  const Result stale = place.approve();
  require_exit(stale, 3);
  CHECK(stale.output.find("run it again") != std::string::npos);
  CHECK_FALSE(fs::exists(place.approved()));
  place.set_suite();
  require_exit(place.approve("--reason x --case grass"), 0);
  require_exit(place.run(), 0);
  CHECK(place.approve("--reason y").output.find("nothing to approve") != std::string::npos);
  CHECK(json_of(place.approved() / "grass" / "approval.json")["reason"] == "x");
}

TEST_CASE("A case that cannot be rendered is an error of its own, and the others are judged",
          "[regress]") {
  Workplace place;
  place.set_suite(
      "[[case]]\nname = \"late\"\nscene = \"grass\"\nsensor = \"radar.toml\"\n"
      "frames = \"7000\"");
  const Result result = place.run();
  require_exit(result, 3);
  CHECK(place.results()["cases"][0]["state"] == "unapproved");
  CHECK(place.results()["cases"][1]["state"] == "failed");
  CHECK(bytes_of(place.out() / "junit.xml").find("failures=\"1\" errors=\"1\"") !=
        std::string::npos);
  check_markup(place.out() / "report.html");
  require_exit(place.approve(), 3);  // not one of them without the other
  CHECK_FALSE(fs::exists(place.approved()));
  require_exit(place.approve("--reason x --case grass"), 0);
  CHECK(fs::exists(place.approved() / "grass"));
}

TEST_CASE("Results never replace a folder of something else", "[regress]") {
  Workplace place;
  place.set_suite();
  place.write("mine.txt", "mine");
  const Result result =
      run_fanbeam("regress run " + quoted(place.suite()) + " -o " + quoted(place.path()));
  require_exit(result, 2);
  CHECK(bytes_of(place.path() / "mine.txt") == "mine");
  CHECK_FALSE(fs::exists(place.path() / "results.json"));
  // Not even where there are results of another program.
  place.write("theirs/results.json", "{\"cases\": []}");
  place.write("theirs/rendered/film.txt", "theirs");
  require_exit(run_fanbeam("regress run " + quoted(place.suite()) + " -o " +
                           quoted(place.path() / "theirs")),
               2);
  CHECK(bytes_of(place.path() / "theirs" / "rendered" / "film.txt") == "theirs");
  require_exit(
      run_fanbeam("regress run " + quoted(place.suite()) + " -o " + quoted(place.approved() / "x")),
      2);
}

TEST_CASE("The level that a suite pins is what its cases run at, unless --isa asks otherwise",
          "[regress]") {
  Workplace place;
  place.set_suite();
  require_exit(place.run(), 1);
  CHECK(place.only_case()["isa"] == "x86-64-v2");
  require_exit(place.approve(), 0);
  if (core::machine_level() >= core::InstructionLevel::v3) {
    place.run("--isa v3");
    CHECK(place.only_case()["isa"] == "x86-64-v3");
    CHECK(place.only_case()["settings_changed"][0]["key"] == "instruction level");
  }
  if (core::machine_level() == core::InstructionLevel::v4) return;
  place.set_suite("isa = \"v4\"");
  const Result result = place.run();
  require_exit(result, 3);
  CHECK(result.output.find("what this machine has") != std::string::npos);
}

TEST_CASE("Any text gets a file name of its own that leads nowhere else", "[regress]") {
  using measure::file_name_of;
  CHECK(file_name_of("flat-grass_2.5km") == "flat-grass_2.5km");
  CHECK(file_name_of("..") == "~2E.");
  CHECK(file_name_of(".") == "~2E");
  CHECK(file_name_of("a/b") == "a~2Fb");
  CHECK(file_name_of("a~2Fb") == "a~7E2Fb");
  CHECK(file_name_of(std::string("\0", 1)) == "~00");
  CHECK(file_name_of("\xC3\xA9") == "~C3~A9");
  CHECK_FALSE(file_name_of("").empty());
}

TEST_CASE("Markup holds any bytes as text", "[regress]") {
  using measure::markup_text;
  const std::string unknown = "\xEF\xBF\xBD";
  CHECK(markup_text("<a href=\"x\">&'") == "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
  CHECK(markup_text("line\n\ttab") == "line\n\ttab");
  CHECK(markup_text(std::string("a\0b\x1B\r", 5)) == "a" + unknown + "b" + unknown + unknown);
  CHECK(markup_text("\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x9B\xA9") ==
        "\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x9B\xA9");
  CHECK(markup_text("\xC3") == unknown);  // cut off
  CHECK(markup_text("\xC0\xBC"
                    "script") == unknown + unknown + "script");       // overlong '<'
  CHECK(markup_text("\xED\xA0\x80") == unknown + unknown + unknown);  // half a surrogate pair
  CHECK(markup_text("\xEF\xBF\xBF") == unknown);                      // U+FFFF
}
