// The weather of scene files: layers, levels, rain cells, snow.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/units.h"
#include "renderer/frame.h"
#include "tests/scenes/problem_checks.h"

using namespace fanbeam;
using tests::TemporaryFolder;

namespace {

const std::string kFog = "[weather]\nvisibility_m = 400.0\n";

std::string with_weather(const std::string& weather) {
  return tests::replaced(tests::kSmallScene, kFog, "[weather]\n" + weather);
}

core::EffectDecision decision(const scenes::Scene& scene, core::EffectId effect) {
  for (const core::EffectDecision& found : scene.plan.decisions)
    if (found.effect == effect) return found;
  FAIL("no effect " << effect);
  return {};
}

}  // namespace

TEST_CASE("Layers, levels, snow and cells arrive in SI and local metres", "[weather]") {
  const TemporaryFolder folder;
  const auto scene = tests::good_scene(folder, with_weather(R"(
rain_rate_mm_per_h = 2.0
rain_law = "mie"
rain_echo_law = "mie-fit"
drop_sizes = "joss-drizzle"
melting_height_m = 1500.0
snow_rate_mm_per_h = 1.0
snow_top_m = 4000.0

[[weather.fog_layer]]
liquid_water_g_per_m3 = 0.2
base_m = 100.0
top_m = 250.0

[[weather.level]]
height_m = 0.0
temperature_C = 9.0
humidity = 0.8
pressure_hPa = 1005.0
[[weather.level]]
height_m = 1500.0
temperature_C = 0.0
humidity = 0.6

[[weather.rain_cell]]
at = { runway = "36", behind_threshold_m = 500.0, left_m = 100.0 }
radius_m = 300.0
rain_rate_mm_per_h = 20.0
top_m = 1200.0
[[weather.rain_cell]]
at = { latitude_deg = 52.0, longitude_deg = 10.0 }
length_m = 400.0
width_m = 100.0
heading_deg = 90.0
rain_rate_mm_per_h = 5.0
)"));
  const atmosphere::Weather& weather = scene->description.weather;
  CHECK(weather.rain_law == atmosphere::RainLaw::mie);
  CHECK(weather.rain_echo_law == atmosphere::RainEchoLaw::mie_fit);
  CHECK(weather.drop_sizes == atmosphere::DropSizes::joss_drizzle);
  CHECK(weather.melting_layer);
  CHECK(weather.snow_rate_mm_per_h == 1.0);
  REQUIRE(weather.fog_layers.size() == 1);
  CHECK(weather.fog_layers[0].base_m == 100.0);
  REQUIRE(weather.levels.size() == 2);
  CHECK(weather.levels[0].pressure_hPa == 1005.0);
  REQUIRE(scene->description.rain_cells.size() == 2);
  CHECK(scene->description.rain_cells[1].cell.heading_rad == core::radians(90.0));

  // The first cell covers the runway beyond the threshold: half of a path that ends in its middle.
  REQUIRE(scene->world.rain_cells);
  const double per_km = rain_dB_per_km(weather, 20.0, 35e9);
  const glm::dvec3 middle(-100.0, 500.0, 100.0);
  CHECK(scene->world.rain_cells->one_way_dB(middle, middle + glm::dvec3(0.0, 1000.0, 0.0)) ==
        Approx(0.3 * per_km).epsilon(1e-6));
  CHECK(decision(*scene, core::EffectId::rain).on);
  // The snow begins at 1860 m: nothing in the scene is seen through it.
  CHECK_FALSE(decision(*scene, core::EffectId::snow).on);
  CHECK(decision(*scene, core::EffectId::snow).bound_dB == 0.0);
  CHECK_FALSE(decision(*scene, core::EffectId::snow).reason == "the scene has no snow");
}

TEST_CASE("Only cells make the rain effect possible, and none costs nothing", "[weather]") {
  const TemporaryFolder folder;
  const auto dry = tests::good_scene(folder, tests::kSmallScene);
  CHECK_FALSE(dry->world.rain_cells);
  CHECK(decision(*dry, core::EffectId::rain).reason == "the scene has no rain");
  CHECK(decision(*dry, core::EffectId::snow).reason == "the scene has no snow");
  const std::string cell =
      "[[weather.rain_cell]]\nat = { runway = \"36\", behind_threshold_m = 0.0 }\n"
      "radius_m = 500.0\nrain_rate_mm_per_h = 40.0\n";
  const auto shower = tests::good_scene(folder, with_weather(cell));
  REQUIRE(decision(*shower, core::EffectId::rain).on);
  REQUIRE(shower->world.rain_cells);
  // The bound holds for the worst path of all.
  CHECK(2.0 * shower->world.rain_cells->one_way_dB({0.0, -3000.0, 100.0}, {0.0, 3000.0, 0.0}) <=
        decision(*shower, core::EffectId::rain).bound_dB);
}

TEST_CASE("Snow costs what its bound allows, and nothing when there is none", "[weather]") {
  const auto frame_of = [](const std::string& weather, const std::string& effects) {
    const TemporaryFolder folder;
    folder.write("scene.toml", with_weather("temperature_C = -5.0\n" + weather));
    core::ProblemList problems;
    const scenes::SceneDescription description =
        scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
    scenes::BuildOptions options;
    options.wishes = renderer::parse_effect_wishes(effects);
    const auto scene = scenes::build_scene(description, options, problems);
    return std::pair(renderer::render_frame(scene->world, {}, {}, {}, scene->frame_pose(0)),
                     decision(*scene, core::EffectId::snow));
  };
  const auto [without, none] = frame_of("", "-snow");
  CHECK(frame_of("snow_rate_mm_per_h = 0.0\n", "+snow").first.bscope_W == without.bscope_W);

  const auto [with, snow] = frame_of("snow_rate_mm_per_h = 10.0\n", "+snow");
  CHECK(snow.on);
  double largest_dB = 0.0;
  for (std::size_t i = 0; i < with.bscope_W.size(); ++i)
    if (without.bscope_W[i] > 0.0)
      largest_dB = std::max(largest_dB, 10.0 * std::log10(without.bscope_W[i] / with.bscope_W[i]));
  // 0.284 dB/km there and back: 2.1 dB at the farthest range of 3.7 km and two cells on, from where
  // rays still feed the last cell.
  CHECK(snow.bound_dB == Approx(2.0 * 0.2843 * (3.69508 + 2.0 * 0.00667)).epsilon(1e-3));
  CHECK(largest_dB <= snow.bound_dB);
  CHECK(largest_dB > 0.5 * snow.bound_dB);

  // So little that the plan leaves it out: less than half of the asked half grey level.
  const auto [pruned, little] = frame_of("snow_rate_mm_per_h = 0.2\n", "-rain");
  CHECK_FALSE(little.on);
  CHECK(little.bound_grey < 0.25);
  const auto [forced, same] = frame_of("snow_rate_mm_per_h = 0.2\n", "+snow");
  double largest_grey = 0.0;
  for (std::size_t i = 0; i < forced.bscope_grey.size(); ++i)
    largest_grey = std::max(largest_grey, std::abs(forced.bscope_grey[i] - pruned.bscope_grey[i]));
  CHECK(largest_grey > 0.0);
  CHECK(largest_grey <= little.bound_grey);
}

TEST_CASE("Everything wrong with the weather is told with its line", "[weather]") {
  const TemporaryFolder folder;
  tests::check_problems(
      folder, with_weather(R"(snow_rate_mm_per_h = 60.0
drop_sizes = "gamma"
rain_top_m = 100.0
melting_height_m = 900.0
[[weather.fog_layer]]
top_m = 50.0
[[weather.fog_layer]]
visibility_m = 100.0
base_m = 90.0
top_m = 50.0
[[weather.level]]
height_m = 100.0
temperature_C = 5.0
humidity = 0.5
[[weather.level]]
height_m = 50.0
temperature_C = 5.0
humidity = 0.5
[[weather.rain_cell]]
at = { runway = "36", behind_threshold_m = 0.0 }
rain_rate_mm_per_h = 5.0
radius = 3.0
)"),
      {"@/scene.toml:23:1: E-RANGE weather.snow_rate_mm_per_h = 60: expected 0 to 50",
       "@/scene.toml:24:1: E-REF weather.drop_sizes = gamma: expected one of "
       "marshall-palmer, joss-drizzle, joss-thunderstorm",
       "@/scene.toml:25:1: E-RANGE weather.rain_top_m = given beside a melting "
       "layer: expected one of them: the rain ends where the melting layer begins",
       "@/scene.toml:27:1: E-REF weather.fog_layer[0].visibility_m = missing: "
       "expected visibility_m or liquid_water_g_per_m3",
       "@/scene.toml:32:1: E-RANGE weather.fog_layer[1].top_m = 50: expected above "
       "base_m = 90",
       "@/scene.toml:38:1: E-RANGE weather.level[1].height_m = 50: expected above "
       "the level before",
       "@/scene.toml:41:1: E-REF weather.rain_cell[0].radius_m = missing: "
       "expected 1 to 100000",
       "@/scene.toml:44:1: E-REF weather.rain_cell[0].radius = unknown key: "
       "expected a key of this table, perhaps \"radius_m\""});
}

TEST_CASE("Keys about fog, rain and snow of which the file tells no amount are told", "[weather]") {
  const TemporaryFolder folder;
  const auto unused = [&](const std::string& weather) {
    std::string keys;
    for (const core::Problem& problem : tests::build_text(folder, with_weather(weather)).problems)
      if (problem.code == "W-UNUSED") keys += problem.field.substr(8) + " ";
    return keys;
  };
  CHECK(unused("fog_top_m = 50.0\nfog_type = \"kunkel\"\nrain_top_m = 900.0\nrain_law = \"mie\"\n"
               "snow_top_m = 900.0\n") == "fog_type fog_top_m rain_top_m rain_law snow_top_m ");
  CHECK(unused("melting_height_m = 900.0\n") == "melting_height_m ");
  CHECK(unused("liquid_water_g_per_m3 = 0.1\nfog_type = \"kunkel\"\nfog_top_m = 50.0\n") ==
        "fog_type ");
  // None of it is an amount too: the rest is for conditions that change.
  CHECK(unused("rain_rate_mm_per_h = 0.0\nrain_top_m = 900.0\nsnow_rate_mm_per_h = 0.0\n"
               "snow_top_m = 900.0\nvisibility_m = 900.0\nfog_top_m = 50.0\n")
            .empty());
}

// A thousand took ten seconds a frame, 10 000 eight seconds before the first.
TEST_CASE("Rain cells beyond what a frame can ask are E-LIMIT", "[weather]") {
  std::string many;
  for (int i = 0; i < 257; ++i) many += "[[weather.rain_cell]]\nrain_rate_mm_per_h = 0.0\n";
  tests::check_problems(kFog, "[weather]\n" + many,
                        "23:11: E-LIMIT weather.rain_cell = an array of 257: expected at most 256 "
                        "tables");
}

TEST_CASE("A rain cell off the terrain is told where it stands", "[weather]") {
  tests::check_problems(
      kFog,
      "[weather]\n[[weather.rain_cell]]\nat = { runway = \"36\", behind_threshold_m = 9000.0 }\n"
      "radius_m = 300.0\nrain_rate_mm_per_h = 5.0\n",
      "24:1: E-RANGE weather.rain_cell[0].at = 0 m east, 9000 m north of the origin: expected a "
      "place on the scene's terrain");
}

TEST_CASE("A law that the sensor's frequency does not suit is told in GHz, as sensors are written",
          "[weather]") {
  const TemporaryFolder folder;
  tests::check_problems(
      folder, with_weather("visibility_m = 400.0\nfog_law = \"centimetre\"\n"),
      {"@/scene.toml:22:1: E-RANGE frequency of the sensor = 35 GHz: expected 3 to 15 GHz for the "
       "fog law centimetre"});
}
