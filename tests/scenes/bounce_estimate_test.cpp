// Whether frames tell the error that bounces leave: walls on smooth ground, where they lead it.
#include <catch2/catch.hpp>
#include <cmath>

#include "renderer/accuracy/grey_error.h"
#include "renderer/frame.h"
#include "tests/scenes/built_scene.h"

using namespace fanbeam;

namespace {

// Six buildings between 700 m and 2 km, turned every way.
std::string walls_on_concrete() {
  std::string text = R"([scene]
name = "walls"
origin = { latitude_deg = 52.0, longitude_deg = 10.0 }
vertical_datum = "scene"
earth = "plane"
[terrain]
half_extent_m = 4500.0
spacing_m = 50.0
material = "concrete"
)";
  for (const char* box :
       {"52.0062927, longitude_deg = 9.9998834 }\nlength_m = 20\nwidth_m = 9\nheight_m = 8\n"
        "heading_deg = 30\n",
        "52.0080906, longitude_deg = 10.0001749 }\nlength_m = 25\nwidth_m = 12\nheight_m = 12\n"
        "heading_deg = 75\n",
        "52.0103380, longitude_deg = 9.9997085 }\nlength_m = 30\nwidth_m = 12\nheight_m = 10\n"
        "heading_deg = 120\n",
        "52.0116864, longitude_deg = 10.0003644 }\nlength_m = 18\nwidth_m = 10\nheight_m = 15\n"
        "heading_deg = 10\n",
        "52.0143833, longitude_deg = 9.9999271 }\nlength_m = 40\nwidth_m = 15\nheight_m = 9\n"
        "heading_deg = 50\n",
        "52.0179791, longitude_deg = 10.0005831 }\nlength_m = 30\nwidth_m = 14\nheight_m = 12\n"
        "heading_deg = 80\n"})
    text += std::string("[[box]]\nat = { latitude_deg = ") + box;
  return text + tests::kFixed;
}

// Sixteen columns of the shipped sensor.
std::unique_ptr<scenes::Scene> narrow_scene() {
  const tests::TemporaryFolder folder;
  folder.write("scene.toml", walls_on_concrete());
  core::ProblemList problems;
  scenes::SceneDescription description =
      scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  problems.throw_if_errors();
  sensors::Scan& scan = description.sensor.scan;
  scan.field_of_view_rad *= 16.0 / scan.columns;
  scan.columns = 16;
  return scenes::build_scene(description, {}, problems);
}

// With noise, without what a second reference says of the first.
double true_grey(const renderer::PictureError& error, const renderer::PictureError& of_references) {
  const double apart = error.with_noise.rms, own = of_references.with_noise.rms / std::sqrt(2.0);
  return std::sqrt(std::max(apart * apart - own * own, 0.0));
}

}  // namespace

// By an estimate of surfaces alone the true errors were 3.8 (B-scope) and 26 times (C-scope) what slices
// told, and 1.2 and 2.4 times what rays did; they are 1.3 and 1.1, and 1.0 and 1.0.
TEST_CASE("Errors of walls on smooth ground are told with their bounces", "[refinement][bounce]") {
  const auto scene = narrow_scene();
  REQUIRE(scene->plan.runs(core::EffectId::double_bounce));
  const auto render = [&](const renderer::Sampling& sampling) {
    return renderer::render_frame(scene->world, sampling, {true, true},
                                  renderer::effects_of(scene->plan, 0), scene->frame_pose(0));
  };
  const auto power = [](renderer::Frame frame) {
    return renderer::FramePower{std::move(frame.bscope_W), std::move(frame.cscope_W_m3)};
  };
  constexpr int kPasses = 4;
  const renderer::GreyReference reference(scene->world.sensor,
                                          power(render(renderer::reference_sampling(1, kPasses))));
  const renderer::FrameError own =
      reference.error_of(power(render(renderer::reference_sampling(2, kPasses))));
  for (const renderer::CasterKind caster :
       {renderer::CasterKind::profile, renderer::CasterKind::rays}) {
    renderer::Sampling sampling = renderer::default_sampling(caster);
    sampling.estimate_error = true;
    renderer::Frame frame = render(sampling);
    REQUIRE(frame.error.has_value());
    const renderer::ErrorEstimate told = *frame.error;
    const renderer::FrameError error = reference.error_of(power(std::move(frame)));
    const double bscope_grey = true_grey(error.bscope, own.bscope);
    const double cscope_grey = true_grey(error.cscope, own.cscope);
    INFO(renderer::name_of(caster)
         << ": B-scope " << told.rms_grey << " told, " << bscope_grey << " true; C-scope "
         << told.cscope_rms_grey << " told, " << cscope_grey << " true");
    CHECK(bscope_grey < 2.0 * told.rms_grey);
    CHECK(bscope_grey > 0.5 * told.rms_grey);
    CHECK(cscope_grey < 2.0 * told.cscope_rms_grey);
    CHECK(cscope_grey > 0.5 * told.cscope_rms_grey);
  }
}
