#include "atmosphere/precipitation/drop_sizes.h"

#include <cmath>

#include "atmosphere/input_check.h"

namespace fanbeam::atmosphere {
namespace {

constexpr NameTable<DropSizes, 3> kDropSizesNames = {
    {{"marshall-palmer", DropSizes::marshall_palmer},
     {"joss-drizzle", DropSizes::joss_drizzle},
     {"joss-thunderstorm", DropSizes::joss_thunderstorm}}};

}  // namespace

DropSizes drop_sizes_named(std::string_view name) {
  return choice_named(kDropSizesNames, "drop_sizes", name);
}

std::string_view name_of(DropSizes sizes) { return name_in(kDropSizesNames, sizes); }

double drops_per_m3_mm(DropSizes sizes, double rain_rate_mm_per_h, double diameter_mm) {
  if (rain_rate_mm_per_h == 0.0) return 0.0;
  const double slope = std::pow(rain_rate_mm_per_h, -0.21) * diameter_mm;
  switch (sizes) {
    case DropSizes::marshall_palmer:
      return 8000.0 * std::exp(-4.1 * slope);
    case DropSizes::joss_drizzle:
      return 30000.0 * std::exp(-5.7 * slope);
    case DropSizes::joss_thunderstorm:
      return 1400.0 * std::exp(-3.0 * slope);
  }
  throw core::InternalError("unknown drop sizes");
}

}  // namespace fanbeam::atmosphere
