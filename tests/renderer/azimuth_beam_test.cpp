// What the antenna makes of a fan, against the sum written down.
#include "renderer/stages/azimuth_beam.h"

#include <catch2/catch.hpp>

#include "core/machine.h"
#include "renderer/casting/fan_layout.h"
#include "sensors/antenna/beam_pattern.h"
#include "tests/renderer/profile_closed_form.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;
using core::InstructionLevel;

namespace {

constexpr int kSubsOfColumn = 3;  // of a column

std::vector<double> summed(const std::vector<double>& sums, int bins, double step_rad,
                           const sensors::Sensor& sensor) {
  const int columns = sensor.scan.columns,
            margin = renderer::margin_sub_columns(sensor, kSubsOfColumn);
  std::vector<double> image;
  for (int bin = 0; bin < bins; ++bin)
    for (int column = 0; column < columns; ++column) {
      double sum = 0.0;
      for (int s = 0; s < 2 * margin + kSubsOfColumn; ++s) {
        const double from_rad = (s - margin - kSubsOfColumn / 2.0) * step_rad;
        const auto at = static_cast<std::size_t>((column * kSubsOfColumn + s) * bins + bin);
        sum += sensors::two_way_integral(sensor.antenna.azimuth, from_rad, from_rad + step_rad) *
               sums[at];
      }
      image.push_back(sum);
    }
  return image;
}

}  // namespace

TEST_CASE("The azimuth beam is the weighted sum to the last bit for any size at any level",
          "[azimuth_beam]") {
  struct Unlimited {
    ~Unlimited() { core::limit_instructions(std::nullopt, ""); }
  } const afterwards;
  for (const InstructionLevel level :
       {InstructionLevel::v2, InstructionLevel::v3, InstructionLevel::v4}) {
    if (level > core::machine_level()) continue;
    core::limit_instructions(level, "level");
    for (const int columns : {1, 3, 4, 5, 8, 41}) {
      const sensors::Sensor sensor = tests::hivision(columns);
      renderer::FanSums fan;
      fan.step_rad = sensor.scan.column_width_rad() / kSubsOfColumn;
      fan.sub_columns =
          kSubsOfColumn * columns + 2 * renderer::margin_sub_columns(sensor, kSubsOfColumn);
      for (const int bins : {1, 15, 16, 17, 40}) {
        INFO("level v" << static_cast<int>(level) + 1 << ": " << columns << " columns x " << bins);
        std::vector<double> sums;
        for (int i = 0; i < fan.sub_columns * bins; ++i)
          sums.push_back(tests::uniform(7, static_cast<std::uint64_t>(i)));
        CHECK(renderer::apply_azimuth_beam(sums, bins, fan, sensor, kSubsOfColumn) ==
              summed(sums, bins, fan.step_rad, sensor));
      }
    }
  }
}
