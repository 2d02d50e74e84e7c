// What a scene's materials mirror, and when the effects of it run.
#include <catch2/catch.hpp>
#include <filesystem>

#include "renderer/plan/effect_catalogue.h"
#include "scenes/scene.h"
#include "scenes/scene_reader.h"

namespace {

using namespace fanbeam;

std::unique_ptr<scenes::Scene> shipped(const std::string& name) {
  core::ProblemList problems;
  const std::filesystem::path source = FANBEAM_SOURCE_DIR;
  const scenes::SceneDescription description =
      scenes::read_scene(source / "scenes" / name, {source, {}, {}}, problems);
  return scenes::build_scene(description, {}, problems);
}

const std::optional<materials::SpecularSurface>& mirror_of(const scenes::Scene& scene,
                                                           const std::string& material) {
  const std::vector<std::string>& names = scene.world.material_names;
  const auto at = std::find(names.begin(), names.end(), material);
  REQUIRE(at != names.end());
  return scene.world.specular.at(static_cast<std::size_t>(at - names.begin()));
}

}  // namespace

TEST_CASE("Materials mirror as their rows say; canopies do not", "[mirrors]") {
  const auto scene = shipped("obstacle-field");
  const auto& concrete = mirror_of(*scene, "concrete");
  REQUIRE(concrete);
  CHECK(concrete->rms_height_m == Approx(0.2e-3));
  CHECK(concrete->permittivity.real == Approx(5.24));  // ITU-R P.2040-3, no frequency in it
  CHECK_FALSE(mirror_of(*scene, "forest").has_value());
}

TEST_CASE("Walls, targets and mirrors decide which reflections run", "[mirrors]") {
  const auto field = shipped("obstacle-field");
  CHECK(field->plan.runs(renderer::kDoubleBounce));
  CHECK(field->plan.runs(renderer::kMultipath));
  const auto grass = shipped("flat-grass");
  CHECK_FALSE(grass->plan.runs(renderer::kDoubleBounce));
  CHECK_FALSE(grass->plan.runs(renderer::kMultipath));
}
