// Through C come the bytes of session::Session.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "bindings/c/fanbeam.h"
#include "sensors/display/display.h"
#include "sensors/display/grey_scale.h"
#include "session/session.h"
#include "tests/bindings/c_session.h"

using namespace fanbeam;
using tests::Buffers;
using tests::CSession;
using tests::sized;
using tests::TemporaryFolder;
using tests::told;

namespace {

// The same as c_opened() opens.
std::unique_ptr<session::Session> opened(const TemporaryFolder& folder,
                                         const session::Setup& other = {}) {
  session::Setup setup = other;
  setup.shipped = FANBEAM_SOURCE_DIR;
  setup.build.read.power = true;
  setup.seed = 7;
  core::ProblemList problems;
  auto session = std::make_unique<session::Session>(folder.path(), setup, problems);
  session->set(session::Samples{2.0});
  return session;
}

}  // namespace

// A program built against version 0.1 hands in these sizes for ever (x86-64).
static_assert(sizeof(fanbeam_setup) == 80 && sizeof(fanbeam_facts) == 88 &&
              sizeof(fanbeam_pose) == 88 && sizeof(fanbeam_weather) == 24 &&
              sizeof(fanbeam_target) == 72 && sizeof(fanbeam_output) == 96 &&
              sizeof(fanbeam_frame) == 96);

TEST_CASE("The library and its header say one version", "[bindings]") {
  CHECK(fanbeam_version_number() == FANBEAM_VERSION_NUMBER);
  CHECK(fanbeam_version_text() == std::to_string(FANBEAM_VERSION_MAJOR) + "." +
                                      std::to_string(FANBEAM_VERSION_MINOR) + "." +
                                      std::to_string(FANBEAM_VERSION_PATCH));
}

TEST_CASE("Facts through C are those of the scene's sensor", "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder);
  const auto session = opened(folder);
  const auto scene = session->scene();
  const sensors::Sensor& sensor = scene->description.sensor;
  const fanbeam_facts facts = tests::facts_of(c);
  CHECK(facts.columns == static_cast<std::uint32_t>(sensor.scan.columns));
  CHECK(facts.bscope_rows == static_cast<std::uint32_t>(sensor.range.cells));
  CHECK(facts.cscope_rows == static_cast<std::uint32_t>(sensor.display.cscope_rows));
  CHECK(facts.frame_count == static_cast<std::uint32_t>(scene->frame_count()));
  CHECK(facts.range_minimum_m == sensor.range.minimum_m);
  CHECK(facts.range_cell_m == sensor.range.cell_m);
  CHECK(facts.field_of_view_rad == sensor.scan.field_of_view_rad);
  CHECK(facts.cscope_top_rad == sensor.display.cscope_top_rad);
  CHECK(facts.cscope_span_rad == sensor.display.cscope_span_rad);
  CHECK(facts.frame_rate_Hz == sensor.scan.frame_rate_Hz);
  CHECK(facts.low_dB == sensor.display.low_dB);
  CHECK(facts.high_dB == sensor.display.high_dB);
}

TEST_CASE("Facts through C tell the seed's own grey window", "[bindings]") {
  const TemporaryFolder folder;
  const CSession c =
      tests::c_opened(folder, tests::kSmallScene + "\n[sensor]\nfile = \"hivision-seed.toml\"\n");
  const auto session = opened(folder);
  const auto scene = session->scene();
  const sensors::GreyScale grey(scene->description.sensor);
  const fanbeam_facts facts = tests::facts_of(c);
  CHECK(facts.low_dB == grey.low_dB());
  CHECK(facts.high_dB == grey.high_dB());
  CHECK(facts.low_dB != scene->description.sensor.display.low_dB);
}

TEST_CASE("Frames through C are those of a session, byte for byte", "[bindings]") {
  const TemporaryFolder folder;
  fanbeam_setup setup = tests::c_setup();
  setup.realisation = GENERATE(0, 1, 2);  // as the scene, expected, sample
  const CSession c = tests::c_opened(folder, tests::kSmallScene, setup);
  session::Setup other;
  if (setup.realisation != FANBEAM_AS_SCENE) other.sample = setup.realisation == FANBEAM_SAMPLE;
  const auto session = opened(folder, other);
  const fanbeam_pose pose = tests::flown(c);
  Buffers buffers(tests::facts_of(c));
  fanbeam_output output = buffers.output();
  REQUIRE(fanbeam_render(c.get(), &pose, 3, &output) == FANBEAM_OK);
  const renderer::Frame frame = session->render(tests::core_pose(pose), 3);
  const auto scene = session->scene();
  const sensors::Sensor& sensor = scene->description.sensor;
  CHECK((buffers.bscope == sensors::bscope_picture(sensor, frame.bscope_grey).pixels));
  CHECK((buffers.cscope == sensors::cscope_picture(sensor, frame.cscope_grey).pixels));
  CHECK((buffers.bscope_W == frame.bscope_W));
  CHECK((buffers.cscope_W_m3 == frame.cscope_W_m3));
  CHECK(output.noise_W == frame.noise_W);
  CHECK(output.truth == nullptr);
}

TEST_CASE("Watts through C hold the noise that a display hides", "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(
      folder,
      tests::kSmallScene + "\n[display]\nmapping = \"log\"\nlow_dB = -90.0\nhigh_dB = -40.0\n");
  const fanbeam_pose pose = tests::flown(c);
  Buffers buffers(tests::facts_of(c));
  fanbeam_output output = buffers.output();
  REQUIRE(fanbeam_render(c.get(), &pose, 3, &output) == FANBEAM_OK);
  CHECK(output.noise_W > 0.0);
}

// A trace of snow may raise a whole obstacle in a C-scope of mode shadow: only there it is simulated.
TEST_CASE("A session of B-scopes alone is planned for them, and refuses C-scopes", "[bindings]") {
  const TemporaryFolder folder;
  const std::string text =
      tests::replaced(tests::kSmallScene, "[weather]", "[weather]\nsnow_rate_mm_per_h = 0.0001") +
      "\n[display]\ncscope_mode = \"shadow\"\n";
  fanbeam_setup setup = tests::c_setup();
  setup.bscope_alone = 1;
  const CSession c = tests::c_opened(folder, text, setup);
  const CSession both = tests::c_opened(folder, text);
  const fanbeam_pose pose = tests::flown(c);
  const Buffers untouched(tests::facts_of(c));
  const auto bscope_of = [&](const CSession& from) {
    Buffers buffers = untouched;
    fanbeam_output output = buffers.output();
    output.cscope = nullptr;
    output.cscope_W_m3 = nullptr;
    REQUIRE(fanbeam_render(from.get(), &pose, 1, &output) == FANBEAM_OK);
    return buffers;
  };
  session::Setup same;
  same.build.heights_shown = false;
  const renderer::Frame frame =
      opened(folder, same)->render(tests::core_pose(pose), 1, {.cscope = false});
  const Buffers alone = bscope_of(c);
  CHECK((alone.bscope_W == frame.bscope_W));
  CHECK_FALSE((alone.bscope_W == bscope_of(both).bscope_W));

  Buffers buffers = untouched;
  fanbeam_output output = buffers.output();
  output.layers = FANBEAM_BSCOPE | FANBEAM_CSCOPE;
  CHECK(fanbeam_render(c.get(), &pose, 1, &output) == FANBEAM_BAD_INPUT);
  CHECK(tests::problems_told() == 3);
  for (const char* asked : {"output.cscope = ", "output.cscope_W_m3 = ", "output.layers = "})
    CHECK(told(std::string("E-REF ") + asked + "a C-scope: expected none"));
  fanbeam_frame newest = sized<fanbeam_frame>();
  CHECK(tests::awaited(c.get(), newest, buffers) == FANBEAM_BAD_INPUT);
  CHECK((buffers == untouched));
  REQUIRE(fanbeam_submit_pose(c.get(), &pose) == FANBEAM_OK);
  buffers.cscope = decltype(buffers.cscope)();  // NULL from here on
  CHECK(tests::awaited(c.get(), newest, buffers) == FANBEAM_OK);
  CHECK((buffers.bscope == alone.bscope));
}

TEST_CASE("The scene's own flight comes out in degrees of freedom that lead back to it",
          "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder);
  const auto session = opened(folder);
  const auto scene = session->scene();
  const core::Pose pose = tests::core_pose(tests::flown(c, 40));
  const core::Pose expected = scene->trajectory->at(
      scene->trajectory->frame_time_s(40, scene->description.sensor.scan.frame_rate_Hz));
  CHECK(pose.time_s == expected.time_s);
  CHECK(pose.position.latitude_rad == expected.position.latitude_rad);
  CHECK(pose.position.longitude_rad == expected.position.longitude_rad);
  CHECK(pose.position.height_m == expected.position.height_m);
  CHECK((pose.v_N_mps == expected.v_N_mps));
  CHECK(pose.v_N_mps.x > 30.0);  // to the north, and down
  CHECK(pose.v_N_mps.z > 1.0);
  // Through angles and back: a few rounding errors; q and -q are one attitude.
  CHECK(std::abs(glm::dot(pose.q_NB, expected.q_NB)) == Approx(1.0).epsilon(1e-14));

  fanbeam_pose none = sized<fanbeam_pose>();
  CHECK(fanbeam_flown_pose(c.get(), tests::facts_of(c).frame_count, &none) == FANBEAM_BAD_INPUT);
  CHECK(none.time_s == 0.0);
}

namespace {

using Truth = std::unique_ptr<fanbeam_layers, decltype(&fanbeam_free_layers)>;

Truth truth_of(const CSession& session, const fanbeam_pose& pose) {
  fanbeam_output output = sized<fanbeam_output>();
  output.layers = FANBEAM_BSCOPE | FANBEAM_CSCOPE;
  REQUIRE(fanbeam_render(session.get(), &pose, 0, &output) == FANBEAM_OK);
  REQUIRE(output.truth != nullptr);
  return {output.truth, &fanbeam_free_layers};
}

renderer::FrameLayers layers_of(const session::Session& session, const fanbeam_pose& pose) {
  return *session
              .render(tests::core_pose(pose), 0,
                      {.bscope = false, .cscope = false, .layers = true, .cscope_layers = true})
              .layers;
}

}  // namespace

TEST_CASE("Ground truth through C is that of a frame's layers", "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder);
  const fanbeam_pose pose = tests::flown(c);
  const Truth truth = truth_of(c, pose);
  const auto [bscope, cscope] = layers_of(*opened(folder), pose);
  const auto copied = [&](std::uint32_t scope, const char* name, std::vector<float>& values) {
    return fanbeam_layer_values(truth.get(), scope, name, values.data(), values.size());
  };
  struct Layer {
    const char* name;
    std::vector<float> renderer::LayerSet::*values;
    bool of_bscope, of_cscope;
  };
  using renderer::LayerSet;
  for (const Layer& layer : {Layer{"visibility", &LayerSet::visibility, true, true},
                             Layer{"range_m", &LayerSet::range_m, false, true},
                             Layer{"grazing_rad", &LayerSet::grazing_rad, true, true},
                             Layer{"nrcs", &LayerSet::nrcs, true, true},
                             Layer{"elevation_rad", &LayerSet::elevation_rad, true, false},
                             Layer{"double_bounce", &LayerSet::double_bounce, true, true}})
    for (const std::uint32_t scope : {FANBEAM_BSCOPE, FANBEAM_CSCOPE}) {
      INFO(layer.name << " of scope " << scope);
      const LayerSet& set = scope == FANBEAM_BSCOPE ? bscope : cscope;
      std::vector<float> values(set.nrcs.size(), -7.0F);
      if (!(scope == FANBEAM_BSCOPE ? layer.of_bscope : layer.of_cscope)) {
        CHECK(copied(scope, layer.name, values) == FANBEAM_BAD_INPUT);
        continue;
      }
      REQUIRE(copied(scope, layer.name, values) == FANBEAM_OK);
      CHECK((values == set.*layer.values));
    }
  std::vector<float> values(bscope.nrcs.size());
  CHECK(copied(FANBEAM_BSCOPE, "range_m", values) == FANBEAM_BAD_INPUT);
  CHECK(told("visibility, grazing_rad, nrcs"));
  CHECK(copied(3, "nrcs", values) == FANBEAM_BAD_INPUT);
  CHECK(fanbeam_layer_values(truth.get(), FANBEAM_BSCOPE, "nrcs", values.data(), 10) ==
        FANBEAM_SHORT_BUFFER);
}

TEST_CASE("Materials and objects of ground truth through C have the scene's names, targets last",
          "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder, tests::kSmallScene +
                                                 "\n[[target]]\nname = \"drone\"\n"
                                                 "at = { runway = \"36\", behind_threshold_m = "
                                                 "100.0 }\nrcs = { rcs_dBsm = 10.0 }\n");
  const fanbeam_pose pose = tests::flown(c);
  const Truth truth = truth_of(c, pose);
  const auto session = opened(folder);
  const auto [bscope, cscope] = layers_of(*session, pose);
  for (const std::uint32_t scope : {FANBEAM_BSCOPE, FANBEAM_CSCOPE}) {
    const renderer::LayerSet& set = scope == FANBEAM_BSCOPE ? bscope : cscope;
    std::vector<std::uint32_t> ids(set.object.size());
    const auto copied = [&](const char* name) {
      return fanbeam_layer_ids(truth.get(), scope, name, ids.data(), ids.size());
    };
    REQUIRE(copied("object") == FANBEAM_OK);
    CHECK(std::equal(ids.begin(), ids.end(), set.object.begin(), set.object.end()));
    REQUIRE(copied("material") == FANBEAM_OK);
    CHECK(std::equal(ids.begin(), ids.end(), set.material.begin(), set.material.end()));
  }
  const auto name_of = [&](const char* layer, std::size_t id) {
    const char* name = fanbeam_layer_id_name(truth.get(), layer, static_cast<std::uint32_t>(id));
    return std::string(name != nullptr ? name : "none");
  };
  const auto& geometry = *session->scene()->world.geometry;
  for (std::size_t id = 0; id < geometry.material_names.size(); ++id)
    CHECK(name_of("material", id) == geometry.material_names[id]);
  CHECK(name_of("material", geometry.material_names.size()) == "none");
  CHECK(name_of("material", FANBEAM_NO_MATERIAL) == "none");
  const std::size_t objects = geometry.object_names.size();
  REQUIRE(objects > 2);  // terrain, runway, hangar
  for (std::size_t id = 0; id < objects; ++id)
    CHECK(name_of("object", id) == geometry.object_names[id]);
  CHECK(std::count(geometry.object_names.begin(), geometry.object_names.end(), "hangar") == 1);
  const auto& targets = session->scene()->world.targets;  // the runway's lights too
  for (std::size_t target = 0; target < targets.size(); ++target)
    CHECK(name_of("object", objects + target) == targets[target].name);
  CHECK(std::any_of(targets.begin(), targets.end(),
                    [](const auto& target) { return target.name == "drone"; }));
  CHECK(name_of("object", objects + targets.size()) == "none");
  CHECK(name_of("frogs", 0) == "none");
}
