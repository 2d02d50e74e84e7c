// Which things of a scene are one labelled object, how high point targets stand, and what weather labels
// tell.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "session/labels/frame_labels.h"
#include "session/labels/labels_json.h"
#include "session/labels/run_labels.h"
#include "session/products/products.h"
#include "session/session.h"
#include "tests/scenes/doctor_scene.h"

using namespace fanbeam;
using session::ObjectGroup;
using session::ObjectLabel;

namespace {

std::string on_runway(const std::string& table, double behind_m, const std::string& keys) {
  return "\n[[" + table +
         "]]\nat = { runway = \"36\", behind_threshold_m = " + core::number_text(behind_m) +
         " }\n" + keys + "\n";
}

std::string unnamed_target(double behind_m, const std::string& keys = "") {
  return on_runway(
      "target", behind_m,
      "above_ground_m = 2.0\nrcs = { shape = \"constant\", rcs_dBsm = 10.0 }\n" + keys);
}

// The small scene with a runway to the east, its middle at a longitude.
std::string eastward(double longitude_deg) {
  const auto longitude = [&](double aside_deg) {
    return "longitude_deg = " + core::number_text(std::remainder(longitude_deg + aside_deg, 360.0));
  };
  std::string text = tests::replaced(tests::kSmallScene, "longitude_deg = 10.0, height_m",
                                     longitude(0.0) + ", height_m");
  text = tests::replaced(text, "\"36\", latitude_deg = 52.0, longitude_deg = 10.0",
                         "\"09\", latitude_deg = 52.0, " + longitude(-0.007));
  text = tests::replaced(text, "\"18\", latitude_deg = 52.009, longitude_deg = 10.0",
                         "\"27\", latitude_deg = 52.0, " + longitude(0.007));
  text = tests::replaced(text, "runway = \"36\", behind", "runway = \"09\", behind");
  return tests::replaced(text, "runway = \"36\"\n", "runway = \"09\"\n");
}

// Of a frame of the small scene's approach, with more tables.
class Labelled {
 public:
  Labelled(const tests::TemporaryFolder& folder, const std::string& text,
           const session::ProductSet& products = {"labels"}) {
    folder.write("scene.toml", text);
    core::ProblemList problems;
    session::Setup setup;
    setup.shipped = FANBEAM_SOURCE_DIR;
    session::plan_for(products, setup.build);
    session::Session session(folder.path(), setup, problems);
    session.set(session::Samples{2.0});
    scene = session.scene();
    pose = scene->trajectory->at(scene->trajectory->frame_time_s(20, 16.0));
    const renderer::Frame frame = session.render(pose, 20, {.layers = true, .cscope_layers = true});
    labels = session::Labeller(*scene).labels(*scene, pose, frame);
  }

  std::vector<ObjectLabel> of(ObjectGroup group) const {
    std::vector<ObjectLabel> objects;
    for (const ObjectLabel& object : labels.objects)
      if (object.group == group) objects.push_back(object);
    return objects;
  }
  std::string json() const { return session::labels_json(labels, *scene, 20, pose, {}); }
  std::string lard() const {
    session::RunLabels run;
    run.add("", {"bscope/00020.png", "labels/00020.json"}, 1,
            [&](const std::string&) { return json(); });
    return run.lard();
  }

  std::shared_ptr<const scenes::Scene> scene;
  core::Pose pose;
  session::FrameLabels labels;
};

}  // namespace

TEST_CASE("Each model of a scene is one labelled object, whatever it is called", "[labels]") {
  const tests::TemporaryFolder folder;
  // A level plate that faces up and down.
  folder.write("plate.gltf", tests::gltf({-10, 3, -10, 10, 3, -10, 0, 3, 10}, {0, 1, 2, 0, 2, 1}));
  const std::string file = "file = \"plate.gltf\"";
  const Labelled labelled(folder, tests::kSmallScene + on_runway("model", 200.0, file) +
                                      on_runway("model", 500.0, file) +
                                      on_runway("model", 700.0, file + "\nname = \"hangar: A\"") +
                                      on_runway("model", 900.0, file + "\nname = \"hangar: B\""));
  const std::vector<ObjectLabel> models = labelled.of(ObjectGroup::model);
  REQUIRE(models.size() == 4);
  const char* names[] = {"plate", "plate", "hangar: A", "hangar: B"};
  std::set<std::uint32_t> ids;
  for (std::size_t i = 0; i < models.size(); ++i) {
    CHECK(models[i].name == names[i]);
    ids.insert(models[i].ids.begin(), models[i].ids.end());
    if (i > 0) CHECK(models[i].middle.range_m > models[i - 1].middle.range_m + 100.0);
  }
  CHECK(ids.size() == 4);
}

TEST_CASE("Targets without a name are objects of their own, those of one name are one",
          "[labels]") {
  const tests::TemporaryFolder folder;
  const Labelled labelled(folder,
                          tests::kSmallScene + unnamed_target(100.0) +
                              unnamed_target(300.0, "name = \"pair\"") + unnamed_target(500.0) +
                              unnamed_target(700.0, "name = \"pair\"") + unnamed_target(900.0));
  std::vector<std::pair<std::string, std::size_t>> named;
  for (const ObjectLabel& target : labelled.of(ObjectGroup::target))
    named.emplace_back(target.name, target.ids.size());
  CHECK(named == std::vector<std::pair<std::string, std::size_t>>{
                     {"target", 1}, {"pair", 2}, {"target 2", 1}, {"target 3", 1}});
}

TEST_CASE("Points on a slope are as high as each stands over its own ground", "[labels]") {
  const tests::TemporaryFolder folder;
  // The runway rises 10 m from end to end.
  const Labelled labelled(folder, tests::kSmallScene + unnamed_target(100.0, "name = \"posts\"") +
                                      unnamed_target(900.0, "name = \"posts\""));
  const std::vector<ObjectLabel> posts = labelled.of(ObjectGroup::target);
  REQUIRE(posts.size() == 1);
  CHECK(posts[0].height_m == Approx(2.0).epsilon(0.0).margin(0.1));
}

// Its middle lies 400 m beside the sector, one of its corners 200 m inside, with nothing before it.
TEST_CASE("What has cells in a picture is in sight, and cut where no triangle's middle is in view",
          "[labels]") {
  const tests::TemporaryFolder folder;
  // A level triangle from that corner to the right; X of glTF is left.
  folder.write("plate.gltf", tests::gltf({0, 3, 0, -900, 3, -400, -900, 3, 400}, {0, 1, 2}));
  const Labelled labelled(
      folder, tests::kSmallScene +
                  "\n[[model]]\nfile = \"plate.gltf\"\ndefault_material = \"short_grass\"\n"
                  "at = { runway = \"36\", behind_threshold_m = 500.0, left_m = -500.0 }\n");
  const std::vector<ObjectLabel> plates = labelled.of(ObjectGroup::model);
  REQUIRE(plates.size() == 1);
  REQUIRE_FALSE(plates[0].bscope.cells.empty());
  CHECK(plates[0].in_view_share == 0.0);
  CHECK(plates[0].in_sight_share == 1.0);
  CHECK(plates[0].middle.in_sight);
  const auto objects = nlohmann::json::parse(labelled.json())["objects"];
  const auto plate = std::find_if(objects.begin(), objects.end(),
                                  [](const auto& object) { return object["group"] == "model"; });
  REQUIRE(plate != objects.end());
  CHECK((*plate)["view"] == "cut");
}

// Noise that the display hides was left out of it unless `power` was asked for beside the labels.
TEST_CASE("Signal to clutter counts the noise that a display hides", "[labels]") {
  const tests::TemporaryFolder folder;
  const std::string text =
      tests::kSmallScene +
      on_runway("target", 300.0,
                "above_ground_m = 2.0\nrcs = { shape = \"constant\", rcs_dBsm = 30.0 }\n") +
      "\n[display]\nmapping = \"log\"\nlow_dB = -90.0\nhigh_dB = -40.0\n";
  const auto of_target_dB = [&](const session::ProductSet& products) {
    const std::vector<ObjectLabel> targets =
        Labelled(folder, text, products).of(ObjectGroup::target);
    REQUIRE(targets.size() == 1);
    REQUIRE(targets[0].signal_to_clutter_dB);
    return *targets[0].signal_to_clutter_dB;
  };
  const double labelled_dB = of_target_dB({"labels"});
  CHECK(of_target_dB({"labels", "power"}) == labelled_dB);
  // Where nobody reads it, it is not there.
  CHECK(of_target_dB({"cscope"}) > labelled_dB + 1e-3);
}

TEST_CASE("Labels of a scene whose only rain is a rain cell tell of rain", "[labels]") {
  for (const bool cell : {false, true}) {
    INFO(cell);
    const tests::TemporaryFolder folder;
    const std::string rain_cell =
        "[[weather.rain_cell]]\nat = { runway = \"36\", behind_threshold_m = 500.0 }\n"
        "radius_m = 400.0\nrain_rate_mm_per_h = 5.0\n\n[trajectory.ils]";
    const Labelled labelled(
        folder, cell ? tests::replaced(tests::kSmallScene, "[trajectory.ils]", rain_cell)
                     : tests::kSmallScene);
    const auto weather = nlohmann::json::parse(labelled.json())["weather"];
    CHECK(weather["rain"] == cell);
    CHECK(weather["rain_rate_mm_per_h"] == 0.0);
    CHECK(labelled.lard().find(cell ? ";rain;" : ";fog;") != std::string::npos);
  }
}

// A C-scope held whatever its angles allowed, and runways in the dark were annotated with no cell.
TEST_CASE("A place is inside a C-scope only where it is inside the range gate", "[labels]") {
  const tests::TemporaryFolder folder;
  const Labelled labelled(folder, tests::kSmallScene);
  const session::Eye eye(*labelled.scene, labelled.pose);
  const sensors::RangeGate& gate = labelled.scene->description.sensor.range;
  const double farthest_m = gate.minimum_m + gate.cells * gate.cell_m;
  const glm::dvec3 towards =
      glm::normalize(labelled.scene->runways.at(0).ends[0].threshold_m - eye.at_m());
  for (const auto& [range_m, inside] : {std::pair{gate.minimum_m - 1.0, false},
                                        {gate.minimum_m + 1.0, true},
                                        {farthest_m - 1.0, true},
                                        {farthest_m + 1.0, false}}) {
    INFO(range_m);
    const glm::dvec3 at_m = eye.at_m() + range_m * towards;
    CHECK(eye.look_at(at_m).cscope->inside == inside);
  }
}

TEST_CASE("Pictures that hold corners of a runway but no cell of it have no annotation",
          "[labels]") {
  const tests::TemporaryFolder folder;
  auto frame = nlohmann::json::parse(Labelled(folder, tests::kSmallScene).json());
  const auto runways_annotated = [&] {
    session::RunLabels run;
    run.add("", {"bscope/00020.png", "cscope/00020.png", "labels/00020.json"}, 1,
            [&](const std::string&) { return frame.dump(); });
    const auto notes = nlohmann::json::parse(run.coco())["annotations"];
    return std::count_if(notes.begin(), notes.end(),
                         [](const auto& note) { return note["category_id"] == 1; });
  };
  auto& runway = frame["runways"][0];
  CHECK(runways_annotated() == 2);
  for (const char* scope : {"bscope", "cscope"}) {
    CHECK(runway["corners"]["near_left"][scope]["inside"] == true);
    runway[scope]["cells"] = 0;
  }
  CHECK(runways_annotated() == 0);
}

// Over the date line a runway was taken to point round the Earth, and nobody to approach it.
TEST_CASE("The time to landing is the same on a runway across the date line", "[labels]") {
  const tests::TemporaryFolder folder;
  const auto seconds = [&](double longitude_deg) {
    const std::string table = Labelled(folder, eastward(longitude_deg)).lard();
    std::istringstream row(table.substr(table.find('\n') + 1));
    std::string field;
    for (int i = 0; i < 9; ++i) std::getline(row, field, ';');  // time_to_landing
    return field;
  };
  const std::string at_10_E = seconds(10.0);
  CHECK(std::stod(at_10_E) == Approx(20.15).epsilon(0.0).margin(0.05));
  CHECK(seconds(180.0) == at_10_E);
}
