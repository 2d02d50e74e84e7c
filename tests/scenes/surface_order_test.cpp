// What pilots rely on: grass brighter than asphalt, asphalt than concrete, concrete than calm water
// at approach angles, in rendered pictures of the shipped materials.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>

#include "core/units.h"
#include "materials/library/material_library.h"
#include "renderer/frame.h"
#include "sensors/cells.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

namespace {

constexpr double kSensorHeight_m = 80.0;

// Grey of the middle column over flat ground of one material, in the cells seen under 2 to 5 deg.
std::map<int, double> grey_of(const materials::MaterialLibrary& library, const std::string& name,
                              bool noise) {
  const sensors::Sensor sensor = tests::hivision(8);
  const std::vector<materials::NrcsCurve> curves = library.curves(
      materials::SurfaceState::dry, sensor.waveform.polarisation, sensor.waveform.frequency_Hz);
  const renderer::World world =
      tests::world(sensor, tests::ground(4000.0, 20.0, [](double, double) { return 0.0; }),
                   {curves[*library.index_of(name)]});
  const renderer::Frame frame =
      renderer::render_frame(world, renderer::sampling_for(4.0), {true, false},
                             {core::EffectSet{}.with(core::EffectId::thermal_noise, noise)},
                             tests::level_pose(kSensorHeight_m));
  std::map<int, double> grey;
  for (int row = 0; row < sensor.range.cells; ++row) {
    const double grazing_deg =
        core::degrees(std::asin(kSensorHeight_m / sensors::range_middle_m(sensor.range, row)));
    if (grazing_deg >= 2.0 && grazing_deg <= 5.0)
      grey[row] = frame.bscope_grey[static_cast<std::size_t>(row * sensor.scan.columns + 4)];
  }
  return grey;
}

}  // namespace

TEST_CASE("Grass, asphalt, concrete and calm water keep their order from 2 to 5 degrees",
          "[surface_order]") {
  core::ProblemList problems;
  const materials::MaterialLibrary library = materials::MaterialLibrary::from_file(
      std::string(FANBEAM_SOURCE_DIR) + "/materials/library.toml", problems);
  problems.throw_if_errors();
  // The received power of the darkest of them comes near that of the noise, which closes the gaps.
  for (const bool noise : {false, true}) {
    const double gap = noise ? 0.0 : 4.0;  // grey levels of 0.235 dB
    const auto grass = grey_of(library, "short_grass", noise);
    const auto asphalt = grey_of(library, "asphalt_worn", noise);
    const auto smooth = grey_of(library, "asphalt_smooth", noise);
    const auto concrete = grey_of(library, "concrete", noise);
    const auto water = grey_of(library, "water_calm", noise);
    REQUIRE(grass.size() > 150);
    for (const auto& [row, grey] : grass) {
      INFO("row " << row << ", noise " << noise);
      CHECK(grey > asphalt.at(row) + gap);
      CHECK(asphalt.at(row) > smooth.at(row) + gap);
      CHECK(smooth.at(row) > concrete.at(row) + gap);
      CHECK(concrete.at(row) > water.at(row) + gap);
    }
  }
}
