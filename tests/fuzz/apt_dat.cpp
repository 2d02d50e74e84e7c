// Airports: X-Plane's apt.dat and tables of runways, and the choice of an end to land on.
#include <cmath>

#include "scenes/airport/apt_dat_reader.h"
#include "scenes/airport/runway_csv_reader.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

namespace {

void must_be_sound(const scenes::Airport& airport, core::ProblemList& problems) {
  fuzz::must(!airport.runways.empty(), "an airport has a runway");
  fuzz::must(airport.runways.size() <= scenes::kMostAirportRunways, "a bounded number of runways");
  for (const scenes::AirportRunway& runway : airport.runways) {
    for (const scenes::AirportRunwayEnd& end : runway.ends) {
      fuzz::must(std::abs(end.pavement_end.latitude_rad) <= 1.5708 &&
                     std::abs(end.pavement_end.longitude_rad) <= 3.1416,
                 "ends on the Earth");
      fuzz::must(end.displaced_m >= 0.0 && end.displaced_m <= 3000.0, "thresholds in range");
      const auto landing = scenes::choose_landing(airport, end.name, problems);
      fuzz::must(!landing || std::isfinite(landing->length_m + landing->bearing_rad),
                 "finite landings");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = fuzz::scratch_file("airport", fuzz::text_of(data, size));
  fuzz::expect_answer([&](core::ProblemList& problems) {
    const auto airport = scenes::read_apt_dat(file, "ZZZZ", problems);
    fuzz::must(airport || problems.has_errors(), "an airport or an error");
    if (airport) must_be_sound(*airport, problems);
  });
  fuzz::expect_answer([&](core::ProblemList& problems) {
    const auto airport = scenes::read_runway_csv(file, "ZZZZ", problems);
    fuzz::must(airport || problems.has_errors(), "an airport or an error");
    if (airport) must_be_sound(*airport, problems);
  });
  return 0;
}
