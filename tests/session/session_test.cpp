// A session gives the bytes that a scene built from a file under the same conditions gives, whoever
// asks, and whatever was set before.
#include "session/session.h"

#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <thread>

#include "core/units.h"
#include "session/products/products.h"
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;
using session::Session;
using tests::TemporaryFolder;

namespace {

const std::string kMast = R"(
[[target]]
name = "mast"
at = { latitude_deg = 52.004, longitude_deg = 10.0 }
rcs = { shape = "constant", rcs_dBsm = 30 }
above_ground_m = 20.0
)";

std::filesystem::path written(const TemporaryFolder& folder, const std::string& text) {
  folder.write("scene.toml", text);
  return folder.path();
}

// Two slices a column: enough to differ, quick.
std::unique_ptr<Session> opened(const std::filesystem::path& scene, session::Setup setup = {}) {
  core::ProblemList problems;
  setup.shipped = FANBEAM_SOURCE_DIR;
  auto session = std::make_unique<Session>(scene, setup, problems);
  session->set(session::Samples{2.0});
  return session;
}

std::unique_ptr<Session> opened_text(const TemporaryFolder& folder, const std::string& text,
                                     const session::Setup& setup = {}) {
  return opened(written(folder, text), setup);
}

core::Pose frame_pose(const Session& session, int frame) {
  const auto scene = session.scene();
  return scene->trajectory->at(
      scene->trajectory->frame_time_s(frame, scene->description.sensor.scan.frame_rate_Hz));
}

renderer::Frame rendered(const Session& session, int frame = 40) {
  return session.render(frame_pose(session, frame), static_cast<std::uint64_t>(frame));
}

bool same(const renderer::Frame& a, const renderer::Frame& b) {
  return a.bscope_W == b.bscope_W && a.cscope_W_m3 == b.cscope_W_m3 &&
         a.bscope_grey == b.bscope_grey && a.cscope_grey == b.cscope_grey && a.events == b.events;
}

atmosphere::Weather rain(const Session& session, double rate_mm_per_h) {
  atmosphere::Weather weather = session.scene()->weather;
  weather.rain_rate_mm_per_h = rate_mm_per_h;
  return weather;
}

}  // namespace

TEST_CASE("A session's frames are those of the scene built for them", "[session]") {
  const TemporaryFolder folder;
  const auto session = opened_text(folder, tests::kSmallScene + kMast);
  const auto scene = tests::good_scene(folder, tests::kSmallScene + kMast);
  CHECK(same(rendered(*session),
             renderer::render_frame(scene->world, session->sampling(), {},
                                    renderer::effects_of(scene->plan, 0), scene->frame_pose(40))));
}

TEST_CASE("Weather set is weather of the file, and the one before comes back", "[session]") {
  const TemporaryFolder fog, rainy;
  const auto session = opened_text(fog, tests::kSmallScene);
  const std::string text = tests::replaced(tests::kSmallScene, "visibility_m = 400.0",
                                           "visibility_m = 400.0\nrain_rate_mm_per_h = 20.0");
  const auto from_file = opened_text(rainy, text);
  const renderer::Frame dry = rendered(*session);
  const atmosphere::Weather before = session->scene()->weather;
  session->set(rain(*session, 20.0));
  CHECK_FALSE(same(rendered(*session), dry));
  CHECK(same(rendered(*session), rendered(*from_file)));
  CHECK(session->scene()->plan.runs(core::EffectId::rain));
  session->set(before);
  CHECK(same(rendered(*session), dry));
}

TEST_CASE("Wet ground set is wet ground of the file", "[session]") {
  const TemporaryFolder dry, wet;
  const auto session = opened_text(dry, tests::kSmallScene);
  const auto from_file = opened_text(
      wet, tests::replaced(tests::kSmallScene, "[weather]", "[weather]\nsurface = \"wet\""));
  const renderer::Frame before = rendered(*session);
  session->set(materials::SurfaceState::wet);
  CHECK_FALSE(same(rendered(*session), before));
  CHECK(same(rendered(*session), rendered(*from_file)));
}

TEST_CASE("A target that moved stands where a file puts it", "[session]") {
  const TemporaryFolder here, there;
  const auto session = opened_text(here, tests::kSmallScene + kMast);
  const auto from_file =
      opened_text(there, tests::kSmallScene + tests::replaced(kMast, "52.004", "52.002"));
  const auto place = [&](const Session& of) {
    const auto scene = of.scene();
    for (const renderer::PointTarget& target : scene->world.targets)
      if (target.name == "mast") return scene->frame.to_geodetic(target.path.front().position_m);
    FAIL("no mast");
    return core::Geodetic{};
  };
  const renderer::Frame before = rendered(*session);
  const session::TargetState moved{.name = "mast", .position = place(*from_file)};
  session->set(std::span(&moved, 1));
  const renderer::Frame after = rendered(*session);
  const renderer::Frame expected = rendered(*from_file);
  REQUIRE(after.bscope_W.size() == expected.bscope_W.size());
  CHECK_FALSE(same(after, before));
  // The way through latitude and longitude and back costs nanometres.
  for (std::size_t i = 0; i < after.bscope_W.size(); ++i)
    REQUIRE(after.bscope_W[i] == Approx(expected.bscope_W[i]).epsilon(1e-6));

  // Another one of a name that the scene has not; the mast goes back to its place.
  const session::TargetState truck{
      .name = "truck", .position = place(*from_file), .rcs = materials::ConstantRcs{100.0}};
  session->set(std::span(&truck, 1));
  CHECK(session->scene()->world.targets.size() == from_file->scene()->world.targets.size() + 1);
  session->set(std::span<const session::TargetState>());
  CHECK(same(rendered(*session), before));
}

TEST_CASE("A tilted antenna and another window are those of a sensor file", "[session]") {
  const TemporaryFolder plain, tilted;
  const auto session = opened_text(plain, tests::kSmallScene);
  const auto from_file = opened_text(tilted, tests::kSmallScene +
                                                 "\n[display]\nlow_dB = -50.0\nhigh_dB = 0.0\n"
                                                 "[sensor]\nstabilised = false\n");
  const renderer::Frame before = rendered(*session);
  session->set(session::SensorSettings{.stabilised = false, .low_dB = -50.0, .high_dB = 0.0});
  CHECK(same(rendered(*session), rendered(*from_file)));
  session->set(session::SensorSettings{.boresight_elevation_rad = core::radians(-1.0)});
  const auto scene = session->scene();
  CHECK(scene->description.sensor.antenna.boresight_elevation_rad == core::radians(-1.0));
  CHECK(scene->description.sensor.display.low_dB == -55.0);  // back to the scene's own
  // The C-scope's window goes along: the same rows below and above the boresight.
  const auto opened_scene = from_file->scene();
  const sensors::Sensor& own = opened_scene->description.sensor;
  CHECK(scene->description.sensor.display.cscope_top_rad - core::radians(-1.0) ==
        Approx(own.display.cscope_top_rad - own.antenna.boresight_elevation_rad));
  session->set(session::SensorSettings{});
  CHECK(same(rendered(*session), before));
}

TEST_CASE("What is wrong is told at once and changes nothing", "[session]") {
  const TemporaryFolder folder;
  const auto session = opened_text(folder, tests::kSmallScene + kMast);
  const renderer::Frame before = rendered(*session);
  const std::array<session::TargetState, 2> targets{
      session::TargetState{.name = "mats", .position = {core::radians(52.0), 0.17, 50.0}},
      session::TargetState{.name = "mast", .position = {9.0, 0.17, 50.0}}};
  const auto problems_of = [](const auto& act) {
    try {
      act();
    } catch (const core::InputError& error) {
      return error.problems().size();
    }
    return std::size_t{0};
  };
  CHECK(problems_of([&] { session->set(targets); }) == 2);
  atmosphere::Weather weather = rain(*session, -1.0);
  weather.rain_top_m = 1e9;
  CHECK(problems_of([&] { session->set(weather); }) == 2);
  // The plan decides which losses run; these were switched on again in silence.
  weather = rain(*session, 5.0);
  weather.simulate_gas = weather.simulate_rain = false;
  CHECK(problems_of([&] { session->set(weather); }) == 2);
  CHECK(problems_of([&] {
          session->set(session::SensorSettings{.boresight_elevation_rad = 4.0, .low_dB = 50.0});
        }) == 2);
  for (const double level_dB : {std::nan(""), -500.0, std::numeric_limits<double>::infinity()}) {
    INFO(level_dB);
    CHECK_THROWS_WITH(
        session->set(session::SensorSettings{.low_dB = level_dB}),
        Catch::Contains(std::isfinite(level_dB) ? "E-RANGE low_dB" : "E-NONFINITE low_dB"));
    CHECK(problems_of([&] {
            session->set(session::SensorSettings{.low_dB = level_dB, .high_dB = level_dB});
          }) == 2);
  }
  CHECK(problems_of([&] { session->set(session::Accuracy{0.0}); }) == 1);
  CHECK(problems_of([&] { session->set(session::Samples{0.01}); }) == 1);
  CHECK(problems_of([&] { session->set(session::TimeBudget{0.0}); }) == 1);
  renderer::Sampling sampling = renderer::sampling_for(4.0);
  sampling.sub_columns = 0;
  sampling.rays_per_cell = std::nan("");
  CHECK(problems_of([&] { session->set(sampling); }) == 2);
  // Cells so far away get nothing of a ray by the plan's bounds.
  sampling = renderer::sampling_for(renderer::kFewestRaysPerCell);
  sampling.gap_cells *= 1.01;
  CHECK(problems_of([&] { session->set(sampling); }) == 1);
  const session::TargetState bright{.name = "mast",
                                    .position = {core::radians(52.0), 0.17, 50.0},
                                    .rcs = materials::ConstantRcs{std::nan("")}};
  CHECK(problems_of([&] { session->set(std::span(&bright, 1)); }) == 1);
  CHECK(problems_of([&] {
          core::Pose pose = frame_pose(*session, 0);
          pose.position.height_m = std::nan("");
          session->render(pose, 0);
        }) == 1);
  CHECK(same(rendered(*session), before));
}

TEST_CASE("A target's name is one that can be shown, and those there are told once each",
          "[session]") {
  const TemporaryFolder folder;
  const auto session = opened_text(folder, tests::kSmallScene + kMast + kMast);
  const auto problem_of = [&](const std::string& name, bool bright) {
    session::TargetState state{.name = name, .position = {core::radians(52.0), 0.17, 50.0}};
    if (bright) state.rcs = materials::ConstantRcs{10.0};
    try {
      session->set(std::span(&state, 1));
    } catch (const core::InputError& error) {
      REQUIRE(error.problems().size() == 1);
      return error.problems()[0];
    }
    return core::Problem{};
  };
  for (const char* name : {"", "a\nb", "\x1b[2J"}) {
    CHECK(problem_of(name, true).code == "E-RANGE");
    CHECK(problem_of(name, true).field == "target[0].name");
  }
  const std::string expected = problem_of("lamp", false).expected;
  CHECK(expected.find("mast") != std::string::npos);
  CHECK(expected.find("mast") == expected.rfind("mast"));
  CHECK(problem_of("new", true).code.empty());
}

TEST_CASE("A sensor whose ranges own-ship Doppler shifts has no pictures, but a scene",
          "[session]") {
  const TemporaryFolder folder;
  core::ProblemList problems;
  scenes::SceneDescription description = scenes::read_scene(written(folder, tests::kSmallScene),
                                                            {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  description.sensor.waveform.doppler_compensated = false;
  description.sensor.waveform.doppler_place = {"left_in.toml", 7, 1};
  CHECK_THROWS_WITH(
      Session(description, {}, problems),
      Catch::Contains("left_in.toml:7:1: E-UNSUPPORTED waveform.doppler_compensated = false") &&
          Catch::Contains("fanbeam fmcw --products bscope"));
  core::ProblemList others;
  const Session for_signals(description, {.pictures = false}, others);
  CHECK_FALSE(for_signals.scene()->world.sensor.waveform.doppler_compensated);
  // All that is wrong is told at once.
  core::ProblemList both;
  session::Setup mean{.sample = false};
  mean.build.wishes = renderer::parse_effect_wishes("+speckle");
  CHECK_THROWS_WITH(Session(description, mean, both),
                    Catch::Contains("waveform.doppler_compensated") &&
                        Catch::Contains("E-UNSUPPORTED --effects = \"+speckle\""));
}

TEST_CASE("Jittered rays, which tell no error, are refused where one is asked for", "[session]") {
  const TemporaryFolder folder;
  const auto session = opened_text(folder, tests::kSmallScene);
  const renderer::Sampling reference = renderer::reference_sampling(1);
  CHECK_NOTHROW(session->set(reference));
  renderer::Sampling estimated = reference, refined = reference;
  estimated.estimate_error = true;
  refined.target_grey = 0.5;
  for (const renderer::Sampling& sampling : {estimated, refined}) {
    try {
      session->set(sampling);
      FAIL("taken");
    } catch (const core::InputError& error) {
      REQUIRE(error.problems().size() == 1);
      CHECK(error.problems()[0].code == "E-UNSUPPORTED");
      CHECK(error.problems()[0].field == "sampling.jittered_passes");
    }
  }
}

TEST_CASE("Frames keep the conditions that they began with, from any number of threads",
          "[session][threads]") {
  const TemporaryFolder folder;
  const auto session = opened_text(folder, tests::kSmallScene + kMast, {.threads = 2});
  const atmosphere::Weather fog = session->scene()->weather, shower = rain(*session, 50.0);
  constexpr int kPoses = 4;
  std::vector<renderer::Frame> in_fog, in_rain;
  for (int i = 0; i < kPoses; ++i) in_fog.push_back(rendered(*session, 10 * i));
  session->set(shower);
  for (int i = 0; i < kPoses; ++i) in_rain.push_back(rendered(*session, 10 * i));

  std::atomic<bool> done{false};
  std::atomic<int> wrong{0}, foggy{0}, rainy{0};
  std::vector<std::thread> callers;
  for (int first = 0; first < 3; ++first)
    callers.emplace_back([&, first] {
      for (int i = first; !done || i < first + 2 * kPoses; ++i) {
        const auto k = static_cast<std::size_t>(i % kPoses);
        const renderer::Frame frame = rendered(*session, 10 * (i % kPoses));
        if (same(frame, in_fog[k]))
          ++foggy;
        else if (same(frame, in_rain[k]))
          ++rainy;
        else
          ++wrong;
      }
    });
  for (int turn = 0; turn < 6; ++turn) session->set(turn % 2 == 0 ? fog : shower);
  done = true;
  for (std::thread& caller : callers) caller.join();
  CHECK(wrong == 0);
  CHECK(foggy + rainy >= 3 * 2 * kPoses);
}

TEST_CASE("A stop ends the frame that it is for, and no other", "[session]") {
  const TemporaryFolder folder;
  const auto session = opened_text(folder, tests::kSmallScene);
  core::StopSource stop;
  stop.request();
  CHECK_THROWS_AS(session->render(frame_pose(*session, 0), 0, {}, stop.token()), core::Stopped);
  CHECK_NOTHROW(rendered(*session));
}

TEST_CASE("A time budget chooses a sampling of the ladder, and frames by it repeat its bytes",
          "[session]") {
  const TemporaryFolder folder;
  const auto session = opened_text(folder, tests::kSmallScene);
  const renderer::CasterKind caster = session->scene()->caster.chosen;
  const double coarsest_samples = caster == renderer::CasterKind::profile ? 0.3 : 0.5;
  const auto alike = [](const renderer::Sampling& a, const renderer::Sampling& b) {
    return a.slices_per_sub_column == b.slices_per_sub_column && a.sub_columns == b.sub_columns &&
           a.rays_per_cell == b.rays_per_cell;
  };
  session->set(session::TimeBudget{0.1});
  CHECK(alike(session->sampling(), renderer::sampling_for(caster, coarsest_samples)));  // none fits
  const renderer::Frame coarsest = rendered(*session);
  session->set(session::TimeBudget{1e7});
  CHECK(alike(session->sampling(), renderer::sampling_for(caster, 64.0)));
  session->set(session::Samples{coarsest_samples});
  CHECK(same(rendered(*session), coarsest));
  const TemporaryFolder parked;
  std::string text = tests::kSmallScene;
  text.erase(text.find("[trajectory.ils]"));
  const auto standing = opened_text(parked, text);
  CHECK_THROWS_AS(standing->set(session::TimeBudget{10.0}), core::InputError);
}

// It was ignored in silence.
TEST_CASE("A scene's own time budget holds for who asks to have it kept", "[session]") {
  const TemporaryFolder folder;
  const std::string text = std::string(tests::kSmallScene) + "\n[accuracy]\ntime_budget_ms = 0.1\n";
  core::ProblemList problems;
  const auto session_of = [&](const std::string& scene, bool keeps) {
    const session::Setup setup{.shipped = FANBEAM_SOURCE_DIR, .keeps_time_budget = keeps};
    return std::make_unique<Session>(written(folder, scene), setup, problems);
  };
  const double usual = session_of(text, false)->samples();
  CHECK(usual == 4.0);
  const auto kept = session_of(text, true);
  CHECK(kept->samples() < 1.0);  // none fits: the coarsest
  kept->set(session::Accuracy{1.0});
  CHECK(kept->samples() == 0.0);  // frame by frame
  // Nothing to measure it at.
  std::string parked = text;
  parked.erase(parked.find("[trajectory.ils]"),
               parked.find("[accuracy]") - parked.find("[trajectory.ils]"));
  CHECK(session_of(parked, true)->samples() == usual);
  CHECK(std::any_of(problems.all().begin(), problems.all().end(), [](const core::Problem& one) {
    return one.field == "accuracy.time_budget_ms";
  }));
}

// The first was ignored where the second stood beside it.
TEST_CASE("A time budget and grey levels of a scene hold together", "[session]") {
  const TemporaryFolder folder;
  const auto session_of = [&](double grey_levels, double budget_ms, core::ProblemList& problems) {
    const std::string text = std::string(tests::kSmallScene) +
                             "\n[accuracy]\ngrey_levels = " + std::to_string(grey_levels) +
                             "\ntime_budget_ms = " + std::to_string(budget_ms) + "\n";
    const session::Setup setup{.shipped = FANBEAM_SOURCE_DIR, .keeps_time_budget = true};
    return std::make_unique<Session>(written(folder, text), setup, problems);
  };
  const auto warned = [](const core::ProblemList& problems) {
    return std::any_of(problems.all().begin(), problems.all().end(), [](const core::Problem& one) {
      return one.code == "W-BUDGET" && one.expected.find("coarsest") != std::string::npos;
    });
  };
  core::ProblemList kept, missed;
  const auto coarse = session_of(50.0, 1e6, kept), fine = session_of(1.0, 1e6, kept);
  CHECK(coarse->samples() < 1.0);  // no finer than that many grey levels ask for
  CHECK(fine->samples() > coarse->samples());
  CHECK(fine->samples() < 64.0);
  CHECK_FALSE(warned(kept));
  CHECK(session_of(1.0, 0.1, missed)->samples() == coarse->samples());
  CHECK(warned(missed));
  CHECK(warned(coarse->set(session::TimeBudget{0.1})));
  CHECK_FALSE(warned(coarse->set(session::TimeBudget{1e6})));
}

TEST_CASE("What a time budget chose goes along when the caster changes", "[session]") {
  const TemporaryFolder folder;
  std::filesystem::copy_file(FANBEAM_SOURCE_DIR "/scenes/braunschweig-26/truck.gltf",
                             folder.path() / "truck.gltf");
  const auto session = opened_text(
      folder,
      tests::replaced(tests::kSmallScene, "[weather]",
                      "[[model]]\nfile = \"truck.gltf\"\nat = { runway = \"36\", "
                      "behind_threshold_m = 300.0 }\ndefault_material = \"metal\"\n[weather]"));
  session->set(session::TimeBudget{0.1});
  const double samples = session->samples();
  for (const bool stabilised : {true, false, true}) {
    session->set(session::SensorSettings{.stabilised = stabilised});
    const renderer::CasterKind caster = session->scene()->caster.chosen;
    CHECK(caster == (stabilised ? renderer::CasterKind::profile : renderer::CasterKind::rays));
    CHECK(session->sampling().caster == caster);
    if (stabilised) CHECK(session->samples() == samples);
    const renderer::Frame frame = rendered(*session);
    CHECK((frame.slices > 0) == stabilised);
  }
}

TEST_CASE("The frame number moves speckle, and nothing else", "[session]") {
  const TemporaryFolder folder;
  const auto session = opened_text(folder, tests::kSmallScene, {.sample = true, .seed = 7});
  const core::Pose pose = frame_pose(*session, 40);
  const renderer::Frame one = session->render(pose, 1), again = session->render(pose, 1),
                        two = session->render(pose, 2);
  CHECK(same(one, again));
  CHECK_FALSE(same(one, two));
  // In the mean there is no speckle.
  const auto mean = opened_text(folder, tests::kSmallScene, {.sample = false, .seed = 7});
  CHECK(same(mean->render(pose, 1), mean->render(pose, 2)));
}

TEST_CASE("Where nobody asks for heights, no C-scope costs a plan anything", "[session]") {
  const TemporaryFolder folder;
  const auto bound_grey = [&](const char* mode, core::EffectId effect, bool heights_shown) {
    const std::string text =
        tests::replaced(tests::kSmallScene, "[weather]", "[weather]\nrain_rate_mm_per_h = 10.0") +
        "\n[display]\ncscope_mode = \"" + mode + "\"\n";
    session::Setup setup;
    setup.build.heights_shown = heights_shown;
    const auto scene = opened_text(folder, text, setup)->scene();
    for (const core::EffectDecision& decision : scene->plan.decisions)
      if (decision.effect == effect) return decision.bound_grey;
    FAIL("no " << effect);
    return 0.0;
  };
  // A little loss may raise or hide a whole obstacle.
  CHECK(bound_grey("shadow", core::EffectId::gas, true) == 255.0);
  CHECK(bound_grey("shadow", core::EffectId::gas, false) > 0.0);
  CHECK(bound_grey("shadow", core::EffectId::gas, false) < 20.0);
  // A row near the ground holds the echoes of all cells. In the B-scope rain is brightest over the
  // larger of black and noise where the two meet: eta, Omega and the window of hivision.toml make
  // 42.6 of its 60 dB, and 58.5 over noise in the nearest cell.
  CHECK(bound_grey("flat_earth", core::EffectId::rain_echo, true) > 215.0);
  CHECK(bound_grey("flat_earth", core::EffectId::rain_echo, false) < 200.0);
  CHECK(bound_grey("shadow", core::EffectId::rain_echo, false) < 200.0);
  // So with products of the B-scope alone.
  CHECK_FALSE(
      session::show_heights(session::wanted_of({"bscope", "layers", "masks", "detections"})));
  for (const char* product :
       {"cscope", "figure", "preview", "obstacles", "cscope_layers", "labels"})
    CHECK(session::show_heights(session::wanted_of({"bscope", product})));
}

TEST_CASE("A plan is told which products read more than pictures", "[session]") {
  const auto read_by = [](const session::ProductSet& products) {
    scenes::BuildOptions build;
    session::plan_for(products, build);
    return build;
  };
  CHECK_FALSE(read_by({"bscope"}).heights_shown);
  CHECK(read_by({"bscope", "power"}).read.power);
  CHECK(read_by({"labels"}).read.labels);
  CHECK(read_by({"detections"}).read.detections);
  CHECK(read_by({"obstacles"}).read.obstacles);
  const renderer::Readings none = read_by({"bscope", "cscope", "figure"}).read;
  CHECK_FALSE((none.power || none.labels || none.detections || none.obstacles));
}

TEST_CASE("A scene that is opened with a loss switched off says what chooses effects",
          "[session]") {
  const TemporaryFolder folder;
  core::ProblemList problems;
  scenes::SceneDescription description = scenes::read_scene(written(folder, tests::kSmallScene),
                                                            {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  description.weather.simulate_fog = false;
  try {
    Session(description, {}, problems);
    FAIL("taken");
  } catch (const core::InputError& error) {
    REQUIRE(error.problems().size() == 1);
    CHECK(error.problems()[0].code == "E-UNSUPPORTED");
    CHECK(error.problems()[0].field == "simulate_fog");
    CHECK(error.problems()[0].expected == "true: effects are chosen by BuildOptions::wishes");
  }
}

// They came from a plan that had left out what tips thresholds.
TEST_CASE("Detections and obstacles are refused where the plan was not told of them", "[session]") {
  const TemporaryFolder folder;
  const auto refused = [&](const renderer::Readings& told, const renderer::Products& wanted) {
    session::Setup setup;
    setup.build.read = told;
    const auto session = opened_text(folder, tests::kSmallScene, setup);
    try {
      session->render(frame_pose(*session, 40), 40, wanted);
    } catch (const core::InputError& error) {
      REQUIRE(error.problems().size() == 1);
      CHECK(error.problems()[0].code == "E-REF");
      return error.problems()[0].value;
    }
    return std::string();
  };
  CHECK(refused({}, {.detections = true}) == "detections");
  CHECK(refused({}, {.obstacles = true}) == "obstacles");
  CHECK(refused({.obstacles = true}, {.detections = true}) == "detections");
  CHECK(refused({.detections = true}, {.detections = true}).empty());
  CHECK(refused({.obstacles = true}, {.obstacles = true}).empty());
}
