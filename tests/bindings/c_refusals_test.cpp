// What the C interface refuses: all of it told, nothing changed.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "bindings/c/fanbeam.h"
#include "tests/bindings/c_session.h"

using namespace fanbeam;
using tests::Buffers;
using tests::CSession;
using tests::sized;
using tests::TemporaryFolder;
using tests::told;

TEST_CASE("What fanbeam_render refuses leaves buffers and output alone", "[bindings]") {
  struct Refused {
    const char* what;
    fanbeam_status status;
    std::function<void(fanbeam_pose&, fanbeam_output&)> spoil;
    const char* told;
  };
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Refused> cases = {
      {"size of a pose", FANBEAM_BAD_SIZE, [](auto& pose, auto&) { pose.size = 80; }, "pose.size"},
      {"no size", FANBEAM_BAD_SIZE, [](auto&, auto& output) { output.size = 0; }, "output.size"},
      {"a larger size", FANBEAM_BAD_SIZE, [](auto&, auto& output) { output.size += 8; },
       "output.size"},
      {"reserved", FANBEAM_BAD_INPUT, [](auto& pose, auto&) { pose.reserved = 1; },
       "pose.reserved"},
      {"NaN", FANBEAM_BAD_INPUT, [=](auto& pose, auto&) { pose.roll_rad = no_number; },
       "E-NONFINITE pose.roll_rad"},
      {"no latitude", FANBEAM_BAD_INPUT, [](auto& pose, auto&) { pose.latitude_rad = 52.0; },
       "E-RANGE pose.latitude_rad"},
      {"far away", FANBEAM_BAD_INPUT, [](auto& pose, auto&) { pose.latitude_rad = 0.0; },
       "1000 km"},
      {"short buffer", FANBEAM_SHORT_BUFFER, [](auto&, auto& output) { --output.cscope_count; },
       "output.cscope"},
      {"unknown layers", FANBEAM_BAD_INPUT, [](auto&, auto& output) { output.layers = 8; },
       "output.layers"},
      {"nothing wanted", FANBEAM_BAD_INPUT,
       [](auto&, auto& output) { output = sized<fanbeam_output>(); }, "a buffer, or layers"},
  };
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder);
  const fanbeam_pose good = tests::flown(c);
  const Buffers before = tests::c_rendered(c, good);
  const Buffers untouched(tests::facts_of(c));
  for (const Refused& refused : cases) {
    INFO(refused.what);
    Buffers buffers = untouched;
    fanbeam_pose pose = good;
    fanbeam_output output = buffers.output();
    output.noise_W = -1.0;
    refused.spoil(pose, output);
    const double noise_W = output.noise_W;
    CHECK(fanbeam_render(c.get(), &pose, 0, &output) == refused.status);
    INFO(fanbeam_last_error());
    CHECK(told(refused.told));
    CHECK((buffers == untouched));
    CHECK(output.noise_W == noise_W);
    CHECK(output.truth == nullptr);
  }
  // All of it together, by the first reason.
  fanbeam_pose pose = good;
  pose.heading_rad = pose.height_m = no_number;
  Buffers buffers = untouched;
  fanbeam_output output = buffers.output();
  output.bscope_count = output.bscope_W_count = 1;
  CHECK(fanbeam_render(c.get(), &pose, 0, &output) == FANBEAM_BAD_INPUT);
  CHECK(tests::problems_told() == 4);
  // And the session goes on as before.
  CHECK((tests::c_rendered(c, good) == before));
  CHECK(*fanbeam_last_error() == '\0');
}

TEST_CASE("NULL is refused by every function that does not say what it means", "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder);
  fanbeam_session* const s = c.get();
  const fanbeam_setup setup = tests::c_setup();
  fanbeam_session* other = s;
  const fanbeam_pose pose = tests::flown(c);
  fanbeam_facts facts = sized<fanbeam_facts>();
  fanbeam_weather weather = sized<fanbeam_weather>();
  fanbeam_frame frame = sized<fanbeam_frame>();
  fanbeam_output output = sized<fanbeam_output>();
  output.layers = FANBEAM_BSCOPE;
  float value = 0.0F;
  std::uint32_t id = 0;
  fanbeam_pose to = sized<fanbeam_pose>();
  fanbeam_target target = sized<fanbeam_target>();
  const std::array statuses = {
      fanbeam_open(nullptr, &setup, &other),
      fanbeam_open(folder.path().c_str(), nullptr, &other),
      fanbeam_open(folder.path().c_str(), &setup, nullptr),
      fanbeam_stop(nullptr),
      fanbeam_get_facts(nullptr, &facts),
      fanbeam_get_facts(s, nullptr),
      fanbeam_flown_pose(nullptr, 0, &to),
      fanbeam_flown_pose(s, 0, nullptr),
      fanbeam_set_weather(nullptr, &weather),
      fanbeam_set_weather(s, nullptr),
      fanbeam_set_target(nullptr, &target),
      fanbeam_set_target(s, nullptr),
      fanbeam_set_target(s, &target),  // its name
      fanbeam_set_targets(nullptr, nullptr, 0),
      fanbeam_set_targets(s, nullptr, 1),
      fanbeam_set_samples(nullptr, 1.0),
      fanbeam_render(nullptr, &pose, 0, &output),
      fanbeam_render(s, nullptr, 0, &output),
      fanbeam_render(s, &pose, 0, nullptr),
      fanbeam_layer_values(nullptr, FANBEAM_BSCOPE, "nrcs", &value, 1),
      fanbeam_layer_ids(nullptr, FANBEAM_BSCOPE, "object", &id, 1),
      fanbeam_submit_pose(nullptr, &pose),
      fanbeam_submit_pose(s, nullptr),
      fanbeam_latest_frame(nullptr, &frame, nullptr, 0, nullptr, 0),
      fanbeam_latest_frame(s, nullptr, nullptr, 0, nullptr, 0),
  };
  for (std::size_t i = 0; i < statuses.size(); ++i) {
    INFO("call " << i);
    CHECK(statuses[i] == FANBEAM_BAD_INPUT);
  }
  CHECK(told("NULL"));
  CHECK(other == nullptr);
  CHECK(fanbeam_layer_id_name(nullptr, "object", 0) == nullptr);
  fanbeam_close(nullptr);
  fanbeam_free_layers(nullptr);
}

TEST_CASE("Opening tells every problem of the setup, or of the scene, at once", "[bindings]") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const fanbeam_setup& setup) {
    folder.write("scene.toml", text);
    fanbeam_session* session = nullptr;
    const fanbeam_status status = fanbeam_open(folder.path().c_str(), &setup, &session);
    CHECK(session == nullptr);
    return status;
  };
  fanbeam_setup setup = tests::c_setup();
  setup.shipped_folder = nullptr;
  setup.data_folder_count = 2;
  setup.caster = "beams";
  setup.effects = "+frogs";
  setup.threads = -1;
  setup.samples_per_cell = std::nan("");
  setup.realisation = 9;
  setup.bscope_alone = 2;
  CHECK(refused(tests::kSmallScene, setup) == FANBEAM_BAD_INPUT);
  INFO(fanbeam_last_error());
  CHECK(tests::problems_told() == 8);
  for (const char* field :
       {"shipped_folder", "data_folders", "caster = \"beams\"", "effects = \"+frogs\"",
        "threads = -1", "samples_per_cell = nan", "realisation = 9", "bscope_alone = 2"})
    CHECK(told(std::string("setup.") + field));
  // What is no realisation forbids no draws.
  setup = tests::c_setup();
  setup.effects = "+speckle";
  setup.realisation = 9;
  CHECK(refused(tests::kSmallScene, setup) == FANBEAM_BAD_INPUT);
  CHECK(tests::problems_told() == 1);
  CHECK(told("setup.realisation = 9"));
  setup = tests::c_setup();
  const std::array folders = {folder.path().c_str(), "/nowhere/data"};
  setup.data_folders = folders.data();
  setup.data_folder_count = folders.size();
  setup.sensor_file = "hivision";
  setup.effects = "+speckle";
  setup.realisation = FANBEAM_EXPECTED;
  CHECK(refused(tests::kSmallScene, setup) == FANBEAM_BAD_INPUT);
  INFO(fanbeam_last_error());
  CHECK(tests::problems_told() == 3);
  CHECK(told("E-IO setup.data_folders[1] = \"/nowhere/data\""));
  CHECK(told("E-IO setup.sensor_file = \"hivision\" not found"));
  CHECK(told("E-UNSUPPORTED setup.effects = \"+speckle\""));
  setup = tests::c_setup();
  fanbeam_session* session = nullptr;
  CHECK(fanbeam_open("", &setup, &session) == FANBEAM_BAD_INPUT);
  CHECK(told("E-IO scene = \"\""));
  const std::string too_long(300, 'x');  // for a name of a file
  CHECK(fanbeam_open(too_long.c_str(), &setup, &session) == FANBEAM_BAD_INPUT);
  INFO(fanbeam_last_error());
  CHECK(told("E-IO"));
  CHECK(told("File name too long"));
  setup.size = 72;
  CHECK(refused(tests::kSmallScene, setup) == FANBEAM_BAD_SIZE);

  std::string text =
      tests::replaced(tests::kSmallScene, "visibility_m = 400.0", "visibility_m = -3.0");
  text = tests::replaced(text, "width_m = 30.0", "width_m = -30.0");
  CHECK(refused(text, tests::c_setup()) == FANBEAM_BAD_INPUT);
  INFO(fanbeam_last_error());
  CHECK(told("scene.toml:"));
  CHECK(told("visibility_m"));
  CHECK(told("width_m"));
}

TEST_CASE("A stop is for good", "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder);
  const fanbeam_pose pose = tests::flown(c);
  Buffers buffers(tests::facts_of(c));
  fanbeam_output output = buffers.output();
  REQUIRE(fanbeam_stop(c.get()) == FANBEAM_OK);
  CHECK(fanbeam_render(c.get(), &pose, 0, &output) == FANBEAM_STOPPED);
  CHECK(fanbeam_submit_pose(c.get(), &pose) == FANBEAM_STOPPED);
  CHECK((buffers == Buffers(tests::facts_of(c))));
}
