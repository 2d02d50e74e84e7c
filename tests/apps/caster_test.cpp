// --caster as a user meets it: what it changes, what it refuses, what it writes down.
#include <algorithm>

#include "core/image.h"
#include "tests/apps/program.h"
#include "tests/shared_data.h"

using namespace fanbeam::tests;
namespace core = fanbeam::core;
namespace fs = std::filesystem;

namespace {

std::string note(const fs::path& picture, const std::string& name) {
  for (const auto& [key, value] : core::read_metadata(picture))
    if (key == name) return value;
  return "missing";
}

// A truck on a plain under an antenna that is not stabilised, so that slices cannot show it; a few
// columns, so that even a reference is quick.
void write_tilted_scene(const TemporaryFolder& folder, const std::string& accuracy) {
  folder.write("few.toml", narrow_sensor(2, false));
  fs::copy_file(FANBEAM_SOURCE_DIR "/scenes/braunschweig-26/truck.gltf",
                folder.path() / "truck.gltf", fs::copy_options::overwrite_existing);
  folder.write("scene.toml",
               "[scene]\nname = \"t\"\norigin = { latitude_deg = 52.0, longitude_deg = 10.0 }\n"
               "vertical_datum = \"scene\"\n[terrain]\nhalf_extent_m = 1000.0\nspacing_m = 100.0\n"
               "[sensor]\nfile = \"few.toml\"\n" +
                   accuracy +
                   "[[model]]\nfile = \"truck.gltf\"\nat = { latitude_deg = 52.004, "
                   "longitude_deg = 10.0 }\ndefault_material = \"metal\"\n"
                   "[trajectory.fixed]\nat = { latitude_deg = 52.0, longitude_deg = 10.0 }\n"
                   "above_ground_m = 60.0\nroll_deg = 10.0\npitch_deg = -5.0\n");
}

}  // namespace

TEST_CASE(
    "The default gives the picture of what it chooses: rays over grass, slices over buildings",
    "[caster]") {
  const TemporaryFolder folder;
  for (const auto& [scene, caster] : std::vector<std::pair<std::string, std::string>>{
           {"flat-grass", "rays"}, {"obstacle-field", "profile"}}) {
    const std::string words = "-q --products bscope,cscope,power --frames 0";
    render(scene, folder.path() / (scene + "-default"), words);
    render(scene, folder.path() / (scene + "-chosen"), words + " --caster " + caster);
    for (const char* name : {"bscope/00000.png", "cscope/00000.png", "power/00000.exr"}) {
      INFO(scene << " " << name);
      CHECK((core::read_image(folder.path() / (scene + "-chosen") / name).layers.at(0).values ==
             core::read_image(folder.path() / (scene + "-default") / name).layers.at(0).values));
    }
  }
}

TEST_CASE("Slices give the same bytes for any number of threads and any order of frames",
          "[caster]") {
  const TemporaryFolder folder;
  const std::string words = "-q --rays-per-cell 2 --caster profile --products bscope,cscope,power ";
  render("obstacle-field", folder.path() / "one", words + kThreeFrames + "--threads 1");
  const auto one = results(folder.path() / "one");
  CHECK(one.size() >= 9);
  for (const char* threads : {"2", "3"}) {
    INFO(threads << " threads");
    render("obstacle-field", folder.path() / threads,
           words + kThreeFrames + "--threads " + threads);
    CHECK((results(folder.path() / threads) == one));
  }
  for (const std::string frame : {"140", "100", "120"}) {
    INFO("frame " << frame);
    render("obstacle-field", folder.path() / frame, words + "--threads 2 --frames " + frame);
    for (const std::string& name :
         {"bscope/00" + frame + ".png", "cscope/00" + frame + ".png", "power/00" + frame + ".exr"})
      CHECK((bytes_of(folder.path() / frame / name) == bytes_of(folder.path() / "one" / name)));
  }
}

TEST_CASE("run.json, pictures and the summary tell how the scene was cast", "[caster]") {
  const TemporaryFolder folder;
  const Result slices =
      render("flat-grass", folder.path() / "auto", "--caster profile --rays-per-cell 4");
  const nlohmann::json run = json_of(folder.path() / "auto/run.json");
  CHECK(run["caster"] == nlohmann::json({{"chosen", "profile"},
                                         {"wish", "profile"},
                                         {"reason", "asked for"},
                                         {"slices_per_column", 4},
                                         {"objects_left_to_rays", 0}}));
  CHECK(run["sampling"] == nlohmann::json({{"sub_columns", 4}, {"slices_per_sub_column", 1}}));
  CHECK(run["frames"][0]["rays"] == 0);
  CHECK(run["frames"][0]["slices"] >= 4 * 164);
  const nlohmann::json summary = json_of(folder.path() / "auto/timing.json")["summary"];
  CHECK(summary["rays_per_s"] == 0.0);
  CHECK(summary["slices_per_s"] > 0.0);
  const fs::path picture = folder.path() / "auto/bscope/00000.png";
  CHECK(note(picture, "fanbeam:caster") == "profile, 4 slices per column");
  CHECK(note(picture, "fanbeam:slices") == run["frames"][0]["slices"].dump());
  CHECK(slices.output.find("cast by profile, 4 slices per column: asked for") != std::string::npos);

  const Result rays = render("flat-grass", folder.path() / "rays", "");
  CHECK(json_of(folder.path() / "rays/run.json")["caster"] ==
        nlohmann::json({{"chosen", "rays"},
                        {"wish", "auto"},
                        {"reason",
                         "no building stands in the scene and no double bounce runs, so that rays "
                         "come as close in the same time"},
                        {"rays_per_cell_and_column", 4.0}}));
  const nlohmann::json by_rays = json_of(folder.path() / "rays/run.json")["sampling"];
  CHECK(by_rays["rays_per_cell_and_sub_column"] == 1.0);
  CHECK(by_rays["deposit"] == "intervals");
  CHECK_FALSE(by_rays.contains("slices_per_sub_column"));
  CHECK(json_of(folder.path() / "rays/run.json")["frames"][0]["slices"] == 0);
  CHECK(note(folder.path() / "rays/bscope/00000.png", "fanbeam:caster") ==
        "rays, 4 per range cell and column");
  CHECK(rays.output.find("cast by rays, 4 per range cell and column: no building stands") !=
        std::string::npos);

  // The truck's azimuths are cast by rays, which have settings of their own.
  render("braunschweig-26", folder.path() / "truck",
         "-q --caster profile --rays-per-cell 2 --frames 600 --products bscope");
  const nlohmann::json truck = json_of(folder.path() / "truck/run.json")["sampling"];
  CHECK(truck["slices_per_sub_column"] == 1);
  CHECK(truck["azimuths_left_to_rays"]["rays_per_cell_and_sub_column"] == 1.0);
  CHECK_FALSE(truck.contains("rays_per_cell_and_sub_column"));

  // Without a number of its own, 4; above 8, what at most 8 sub-columns make.
  for (const auto& [asked, used] :
       std::vector<std::pair<std::string, int>>{{"", 4},
                                                {"--rays-per-cell 0.3", 1},
                                                {"--rays-per-cell 9", 10},
                                                {"--rays-per-cell 12", 12}}) {
    INFO(asked);
    render("flat-grass", folder.path() / "asked", "-q --caster profile " + asked);
    const nlohmann::json caster = json_of(folder.path() / "asked/run.json")["caster"];
    CHECK(caster["slices_per_column"] == used);
    CHECK(caster["reason"] == "asked for");
  }
}

TEST_CASE("Of a fraction of slices there is the next whole number, with fewer rays for bounces",
          "[caster]") {
  const TemporaryFolder folder;
  const auto run_of = [&](const std::string& samples) {
    render("obstacle-field", folder.path() / samples,
           "-q --caster profile --frames 500 --products bscope --rays-per-cell " + samples);
    return json_of(folder.path() / samples / "run.json");
  };
  const nlohmann::json half = run_of("0.5"), one = run_of("1");
  CHECK(half["sampling"]["bounce_share"] == 0.5);
  CHECK_FALSE(one["sampling"].contains("bounce_share"));
  CHECK(half["frames"][0]["slices"] == one["frames"][0]["slices"]);
  CHECK(half["frames"][0]["rays"] < one["frames"][0]["rays"]);
  CHECK(note(folder.path() / "0.5/bscope/00500.png", "fanbeam:caster") ==
        "profile, 1 slice per column, 0.5 of its bounces");
  const nlohmann::json more = run_of("1.5"), two = run_of("2");
  CHECK(more["sampling"]["bounce_share"] == 0.75);
  CHECK(more["frames"][0]["slices"] == two["frames"][0]["slices"]);
  CHECK(more["frames"][0]["rays"] < two["frames"][0]["rays"]);
  CHECK(more["frames"][0]["rays"] > one["frames"][0]["rays"]);
}

TEST_CASE("--resume takes slices up again, but no frame of the other caster", "[caster]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const std::string words = kThreeFrames + "--rays-per-cell 2 --resume --caster ";
  render("obstacle-field", out, words + "profile");
  const auto first = results(out);
  CHECK(render("obstacle-field", out, words + "profile").output.find("(3 already there)") !=
        std::string::npos);
  CHECK((results(out) == first));
  CHECK(render("obstacle-field", out, words + "rays").output.find("already there") ==
        std::string::npos);
  CHECK_FALSE((results(out) == first));
}

TEST_CASE("A reference is made of rays: slices beside it are a usage error", "[caster]") {
  const TemporaryFolder folder;
  const Result refused = run_fanbeam("render flat-grass --reference --caster profile -o " +
                                     quoted(folder.path() / "out"));
  CHECK(refused.exit_code == 2);
  CHECK(refused.output.find("--caster profile: --reference is what all errors are stated against, "
                            "and always made of rays; leave out one of the two") !=
        std::string::npos);
  CHECK_FALSE(fs::exists(folder.path() / "out"));
  write_tilted_scene(folder, "[accuracy]\ncaster = \"profile\"\n");
  for (const std::string caster : {"", "--caster auto", "--caster rays"}) {
    INFO(caster);
    render(quoted(folder.path()), folder.path() / "out", "-q --reference " + caster);
    const nlohmann::json run = json_of(folder.path() / "out/run.json")["caster"];
    CHECK(run["chosen"] == "rays");
    CHECK(run["rays_per_cell_and_column"] == 256 * 8);
  }
}

TEST_CASE("Slices that cannot show the scene are refused with exit code 3 and a way out",
          "[caster]") {
  const TemporaryFolder folder;
  const std::string refused =
      "E-UNSUPPORTED caster = \"profile\": expected \"rays\" or \"auto\": slices cannot show the "
      "model or building part over open air because the antenna is not stabilised\n1 error\n";
  const std::string words =
      "render " + quoted(folder.path()) + " --rays-per-cell 1 -o " + quoted(folder.path() / "out");
  write_tilted_scene(folder, "");
  const Result forced = run_fanbeam(words + " --caster profile");
  CHECK(forced.exit_code == 3);
  CHECK(forced.output == refused);
  CHECK_FALSE(fs::exists(folder.path() / "out"));

  write_tilted_scene(folder, "[accuracy]\ncaster = \"profile\"\n");
  const std::string at_line = (folder.path() / "scene.toml").string() + ":11:1: " + refused;
  for (const std::string& command : {words, "validate " + quoted(folder.path())}) {
    const Result by_scene = run_fanbeam(command);
    CHECK(by_scene.exit_code == 3);
    CHECK(by_scene.output == at_line);
  }
  const Result open = run_fanbeam(words + " --caster auto");
  CHECK(open.exit_code == 0);
  CHECK(open.output.find("cast by rays, 1 per range cell and column: slices cannot show the model "
                         "or building part over open air because the antenna is not stabilised") !=
        std::string::npos);
}

TEST_CASE("validate says how a scene will be cast", "[caster]") {
  CHECK(run_fanbeam("validate flat-grass")
            .output.find(
                "  caster      rays: no building stands in the scene and no double bounce runs") !=
        std::string::npos);
  CHECK(run_fanbeam("validate flat-grass").output.find("open air") == std::string::npos);
}

TEST_CASE("validate counts the building parts that no slice can show", "[caster][data]") {
  if (!shared_data("lowi-innsbruck")) return;
  CHECK(run_fanbeam("validate innsbruck-26")
            .output.find("  buildings   33 of 55 raised parts hang over open air and are left to "
                         "rays\n") != std::string::npos);
}
