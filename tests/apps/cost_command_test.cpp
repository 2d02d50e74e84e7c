// fanbeam cost as a user meets it: what it writes, that its errors fall with finer sampling and do
// not depend on when it ran, what it refuses.
#include <algorithm>
#include <map>
#include <sstream>
#include <vector>

#include "core/text.h"
#include "tests/apps/program.h"

using namespace fanbeam::tests;
namespace core = fanbeam::core;
namespace fs = std::filesystem;

namespace {

using Row = std::map<std::string, std::string>;

// No field of these tables but the last, the reason, holds a comma.
std::vector<Row> rows_of(const fs::path& file) {
  std::istringstream text(bytes_of(file));
  std::vector<std::string> names;
  std::vector<Row> rows;
  for (std::string line; std::getline(text, line);) {
    std::vector<std::string> fields;
    std::size_t from = 0;
    while (names.empty() || fields.size() + 1 < names.size()) {
      const std::size_t comma = line.find(',', from);
      if (comma == std::string::npos) break;
      fields.push_back(line.substr(from, comma - from));
      from = comma + 1;
    }
    fields.push_back(line.substr(from));
    if (names.empty()) {
      names = fields;
      continue;
    }
    INFO(file << ": " << line);
    REQUIRE(fields.size() == names.size());
    Row row;
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = fields[i];
    rows.push_back(row);
  }
  return rows;
}

double number(const Row& row, const std::string& name) {
  INFO(name);
  REQUIRE(row.count(name) == 1);
  const core::ParsedNumber parsed = core::parse_number(row.at(name));
  REQUIRE(parsed.error == core::NumberError::none);
  return parsed.value;
}

// Without what a clock says.
std::vector<Row> timeless(std::vector<Row> rows) {
  for (Row& row : rows)
    for (auto field = row.begin(); field != row.end();)
      field = field->first.ends_with("_ms") ? row.erase(field) : std::next(field);
  return rows;
}

// A shed on a plain in light rain, and a picture of a few columns: references take no time.
void write_scene(const TemporaryFolder& folder, bool stabilised = true,
                 const std::string& more = "") {
  folder.write("few.toml", narrow_sensor(4, stabilised));
  fs::copy_file(FANBEAM_SOURCE_DIR "/scenes/braunschweig-26/truck.gltf",
                folder.path() / "truck.gltf", fs::copy_options::overwrite_existing);
  folder.write(
      "scene.toml",
      "[scene]\nname = \"t\"\norigin = { latitude_deg = 52.0, longitude_deg = 10.0 }\n"
      "vertical_datum = \"scene\"\n[terrain]\nhalf_extent_m = 3000.0\nspacing_m = 50.0\n"
      "[sensor]\nfile = \"few.toml\"\n"
      "[[box]]\nname = \"shed\"\nat = { latitude_deg = 52.006, longitude_deg = 10.0 }\n"
      "length_m = 20.0\nwidth_m = 9.0\nheight_m = 8.0\nheading_deg = 30.0\n"
      "[[model]]\nfile = \"truck.gltf\"\nat = { latitude_deg = 52.004, longitude_deg = 10.0 }\n"
      "default_material = \"metal\"\n[weather]\nrain_rate_mm_per_h = 5.0\n"
      "[trajectory.fixed]\nat = { latitude_deg = 52.0, longitude_deg = 10.0 }\n"
      "above_ground_m = 60.0\n" +
          more);
}

Result cost(const TemporaryFolder& folder, const std::string& out, const std::string& words) {
  return run_fanbeam("cost " + quoted(folder.path()) + " -o " + quoted(folder.path() / out) + " " +
                     words);
}

constexpr const char* kError = "bscope_noise_free_rms_grey";

}  // namespace

TEST_CASE("fanbeam cost writes tables, plots and a page, and its errors fall along the ladder",
          "[cost]") {
  const TemporaryFolder folder;
  write_scene(folder);
  const Result first = cost(folder, "one", "--quick --repetitions 2");
  INFO(first.output);
  REQUIRE(first.exit_code == 0);
  CHECK(first.output.find("t: 1 frame, about ") != std::string::npos);
  CHECK(first.output.find("a quick look") != std::string::npos);
  const fs::path one = folder.path() / "one";
  CHECK(bytes_of(one / "cost.md").find("**A quick look: ") != std::string::npos);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : contents(one)) {
    names.push_back(name);
    INFO(name);
    CHECK(bytes.size() > 100);
  }
  CHECK(names == std::vector<std::string>{
                     "cost.md", "effects.csv", "effects.png", "effects.svg", "equal_error.csv",
                     "ladder-cscope.png", "ladder-cscope.svg", "ladder.csv", "ladder.png",
                     "ladder.svg", "levels.csv", "levels.png", "levels.svg", "numerics.csv"});

  const std::vector<Row> ladder = rows_of(one / "ladder.csv");
  for (const std::string way : {"slices", "rays", "naive_dithered"}) {
    INFO(way);
    std::vector<Row> steps;
    std::copy_if(ladder.begin(), ladder.end(), std::back_inserter(steps),
                 [&](const Row& row) { return row.at("way") == way; });
    REQUIRE(steps.size() == 3);
    for (std::size_t i = 1; i < steps.size(); ++i) {
      CHECK(number(steps[i], "fineness") > number(steps[i - 1], "fineness"));
      CHECK(number(steps[i], kError) < number(steps[i - 1], kError));
    }
    CHECK(number(steps[0], "frame_ms") > 0.0);
    CHECK(number(steps[0], "repetitions") == 2.0);
  }
  // More looks at signal level come closer, and take longer; powers are ahead of both.
  const std::vector<Row> levels = rows_of(one / "levels.csv");
  REQUIRE(levels.size() == 5);
  const auto level_error = [&](std::size_t i) {
    return number(levels[i], "bscope_with_noise_rms_grey");
  };
  CHECK(levels[3].at("level") == "signal");
  CHECK(level_error(4) < 0.7 * level_error(3));
  // Four looks beside one; how much longer they take depends on what else the machine does.
  CHECK(number(levels[4], "frame_ms") > number(levels[3], "frame_ms"));
  CHECK(level_error(2) < level_error(4));
  // Where they go counts: 16 rays per cell that follow the cells beat 36 at uniform angles.
  const auto last_of = [&](const std::string& way) {
    return number(*std::find_if(ladder.rbegin(), ladder.rend(),
                                [&](const Row& row) { return row.at("way") == way; }),
                  kError);
  };
  CHECK(last_of("rays") < last_of("naive_dithered"));
  CHECK(last_of("slices") < last_of("naive_dithered"));
  CHECK(last_of("reference") < last_of("naive_dithered"));

  const Result second = cost(folder, "two", "-q --quick --repetitions 1 --threads 1");
  REQUIRE(second.exit_code == 0);
  CHECK(second.output.empty());
  for (const std::string file : {"ladder.csv", "effects.csv", "levels.csv"}) {
    INFO(file);
    auto a = timeless(rows_of(one / file)), b = timeless(rows_of(folder.path() / "two" / file));
    for (auto* rows : {&a, &b})
      for (Row& row : *rows) row.erase("repetitions");
    CHECK((a == b));
  }
}

TEST_CASE("fanbeam cost forces on what the plan leaves out and leaves out what it runs", "[cost]") {
  const TemporaryFolder folder;
  write_scene(folder);
  const Result result =
      cost(folder, "out", "-q --quick --repetitions 1 --parts effects,numerics --caster profile");
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  CHECK_FALSE(fs::exists(folder.path() / "out/ladder.csv"));
  bool rain = false, impossible = false;
  for (const Row& row : rows_of(folder.path() / "out/effects.csv")) {
    INFO(row.at("effect"));
    if (row.at("possible") == "0") {
      impossible = true;
      CHECK(row.at("with_ms").empty());
      CHECK(row.at("bscope_rms_dB").empty());
      CHECK(row.at("planned") == "0");
      continue;
    }
    CHECK(number(row, "with_ms") > 0.0);
    CHECK(number(row, "bscope_rms_grey") <= number(row, "bscope_largest_grey"));
    CHECK(number(row, "bscope_largest_dB") ==
          Approx(60.0 / 255.0 * number(row, "bscope_largest_grey")));
    // What is measured keeps the bound that was promised.
    CHECK(number(row, "bscope_largest_grey") <= std::min(255.0, number(row, "bound_grey")) + 1e-6);
    rain = rain || (row.at("effect") == "rain" && row.at("planned") == "1" &&
                    number(row, "bscope_largest_grey") > 1.0);
  }
  CHECK(rain);
  CHECK(impossible);

  std::map<std::string, int> comparisons;
  for (const Row& row : rows_of(folder.path() / "out/numerics.csv")) {
    ++comparisons[row.at("comparison")];
    if (row.at("comparison") == "range_of_rays_alone" && row.at("variant") == "float") {
      CHECK(number(row, "rays") > 1000.0);
      // terrain/ray_scene.h: 25 mm worst case.
      CHECK(number(row, "range_largest_m") < 0.025);
      CHECK(number(row, "range_median_m") > 0.0);
    }
  }
  CHECK(comparisons == std::map<std::string, int>{{"range_of_rays_alone", 2},
                                                  {"robust_flag", 2},
                                                  {"robust_flag_hits", 1},
                                                  {"sub_columns_rays", 4},
                                                  {"sub_columns_slices", 4}});
}

TEST_CASE("fanbeam cost --caster goes before the scene's own caster, auto too", "[cost]") {
  const TemporaryFolder folder;
  write_scene(folder, true, "[accuracy]\ncaster = \"rays\"\n");
  const auto cast_by = [&](const std::string& words) {
    const Result result =
        cost(folder, "out", "-q --quick --repetitions 1 --parts effects " + words);
    INFO(result.output);
    REQUIRE(result.exit_code == 0);
    const std::string page = bytes_of(folder.path() / "out/cost.md");
    const std::string before = "frames cast by ";
    const std::size_t at = page.find(before);
    REQUIRE(at != std::string::npos);
    return page.substr(at + before.size(), page.find('.', at) - at - before.size());
  };
  CHECK(cast_by("") == "rays");
  CHECK(cast_by("--caster auto") == "profile");
}

TEST_CASE("fanbeam cost refuses bad input before it measures", "[cost]") {
  const TemporaryFolder folder;
  write_scene(folder, false);
  CHECK(cost(folder, "out", "--parts everything").exit_code == 2);
  CHECK(cost(folder, "out", "--repetitions 0").exit_code == 2);
  CHECK(cost(folder, "out", "--frames 1").exit_code == 2);
  CHECK(cost(folder, "out", "--frames a:b").exit_code == 2);
  const Result slices = cost(folder, "out", "--quick --caster profile");
  CHECK(slices.exit_code == 3);
  CHECK(slices.output.find("the antenna is not stabilised") != std::string::npos);
  CHECK_FALSE(fs::exists(folder.path() / "out"));
  CHECK(run_fanbeam("cost no-such-scene -o " + quoted(folder.path() / "out")).exit_code == 4);
  folder.write("file", "not a folder");
  CHECK(cost(folder, "file/out", "--quick").exit_code == 4);
  CHECK(run_fanbeam("cost --help").output.find("--repetitions") != std::string::npos);
}
