// The line protocol: one put together by hand, a recorded flight's numbers, and lines that are none.
#include "feeds/fg_generic.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/units.h"
#include "tests/shared_data.h"

using namespace fanbeam;
using feeds::PacketFault;

namespace {

const std::string kLine =
    "fanbeam,2,10.25,52.5,-10.25,1000,500,-0.5,1.5,270,100,-200,10,5000.000,0.25,0.5\n";

std::optional<feeds::AircraftState> state_in(const std::string& line, PacketFault& fault) {
  return feeds::decode_fg_generic({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()},
                                  fault);
}

PacketFault refusal_of(const std::string& line) {
  PacketFault fault{};
  CHECK_FALSE(state_in(line, fault).has_value());
  return fault;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::string cell;
  for (std::istringstream stream(line); std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

TEST_CASE("A line's numbers are degrees and feet in the order of the protocol file",
          "[fg_generic]") {
  for (const char* end : {"\n", "\r\n", ""}) {
    PacketFault fault{};
    const auto state = state_in(kLine.substr(0, kLine.size() - 1) + end, fault);
    REQUIRE(state.has_value());
    CHECK(state->clock_s == 10.25);
    CHECK(state->latitude_rad == core::radians(52.5));
    CHECK(state->longitude_rad == core::radians(-10.25));
    CHECK(state->altitude_m == Approx(304.8));
    CHECK(state->height_above_ground_m == Approx(152.4));
    CHECK(state->attitude.roll_rad == core::radians(-0.5));
    CHECK(state->attitude.pitch_rad == core::radians(1.5));
    CHECK(state->attitude.heading_rad == core::radians(270.0));
    CHECK(state->v_N_mps.x == Approx(30.48));
    CHECK(state->v_N_mps.y == Approx(-60.96));
    CHECK(state->v_N_mps.z == Approx(3.048));
    CHECK(state->visibility_m == 5000.0);
    CHECK(state->rain_norm == 0.25);
    CHECK(state->snow_norm == 0.5);
  }
}

TEST_CASE("The first version of the line has no rain and no snow", "[fg_generic]") {
  PacketFault fault{};
  const auto state = state_in("fanbeam,1,1,2,3,4,5,6,7,8,9,10,11,12", fault);
  REQUIRE(state.has_value());
  CHECK(state->visibility_m == 12.0);
  CHECK_FALSE(state->rain_norm.has_value());
  CHECK_FALSE(state->snow_norm.has_value());
}

TEST_CASE("The protocol file that is shipped asks for these nodes in this order", "[fg_generic]") {
  std::ifstream stream(FANBEAM_SOURCE_DIR "/plugins/flightgear/Protocol/fanbeam.xml");
  std::stringstream text;
  text << stream.rdbuf();
  std::size_t at = 0;
  for (const char* wanted :
       {"<var_separator>,<", "fanbeam,2,%.6f", "/sim/time/elapsed-sec", "latitude-deg",
        "longitude-deg", "/position/altitude-ft", "/position/altitude-agl-ft", "roll-deg",
        "pitch-deg", "/orientation/heading-deg", "speed-north-fps", "speed-east-fps",
        "speed-down-fps", "visibility-m", "/environment/rain-norm", "/environment/snow-norm"}) {
    INFO(wanted);
    at = text.str().find(wanted, at);
    REQUIRE(at != std::string::npos);
  }
}

// The simulator wrote these numbers as text, with the same formats; the file has more columns.
TEST_CASE("A recorded flight's rows as lines give the positions of the file", "[fg_generic]") {
  const auto table = tests::shared_data("flightgear/bikf10.csv");
  if (!table) return;
  std::ifstream stream(*table);
  std::string row;
  std::getline(stream, row);
  const std::vector<std::string> names = cells_of(row);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  std::vector<std::size_t> order;
  for (const char* name :
       {"sim_time_s", "lat_deg", "lon_deg", "alt_ft", "agl_ft", "roll_deg", "pitch_deg",
        "heading_true_deg", "v_north_fps", "v_east_fps", "v_down_fps", "visibility_m"}) {
    REQUIRE(column(name) < names.size());
    order.push_back(column(name));
  }
  int lines = 0;
  while (std::getline(stream, row)) {
    const std::vector<std::string> cells = cells_of(row);
    std::string line = "fanbeam,1";
    for (const std::size_t i : order) line += "," + cells.at(i);
    PacketFault fault{};
    const auto state = state_in(line, fault);
    REQUIRE(state.has_value());
    REQUIRE(core::degrees(state->latitude_rad) ==
            Approx(std::stod(cells[column("lat_deg")])).epsilon(1e-15));
    REQUIRE(state->altitude_m ==
            Approx(0.3048 * std::stod(cells[column("alt_ft")])).epsilon(1e-15));
    ++lines;
  }
  CHECK(lines > 7000);
}

TEST_CASE("Lines that are none are refused with their reason", "[fg_generic]") {
  CHECK(refusal_of("") == PacketFault::version);
  CHECK(refusal_of("fanbeam,3,1") == PacketFault::version);
  CHECK(refusal_of(std::string(1025, '1')) == PacketFault::length);
  CHECK(refusal_of("fanbeam,1,1,2,3") == PacketFault::format);
  CHECK(refusal_of(kLine + "1") == PacketFault::format);
  CHECK(refusal_of("fanbeam,1,,,,,,,,,,,") == PacketFault::format);
  CHECK(refusal_of("fanbeam,1,1;2;3;4;5;6;7;8;9;10;11;12") == PacketFault::format);
  CHECK(refusal_of("fanbeam,1,1,2,3,4,5,6,7,8,9,10,11,12,13") == PacketFault::format);
  CHECK(refusal_of("fanbeam,2,1,2,3,4,5,6,7,8,9,10,11,12") == PacketFault::format);
  CHECK(refusal_of("fanbeam,2,1,2,3,4,5,6,7,8,9,10,11,12,1,nan") == PacketFault::nonfinite);
}

TEST_CASE("F14 lines of states that cannot be are refused with their reason", "[fg_generic]") {
  CHECK(refusal_of("fanbeam,1,1,nan,3,4,5,6,7,8,9,10,11,12") == PacketFault::nonfinite);
  CHECK(refusal_of("fanbeam,1,1,2,inf,4,5,6,7,8,9,10,11,12") == PacketFault::nonfinite);
  CHECK(refusal_of("fanbeam,1,1,2,3,1e999,5,6,7,8,9,10,11,12") == PacketFault::nonfinite);
  CHECK(refusal_of("fanbeam,1,1,91,3,4,5,6,7,8,9,10,11,12") == PacketFault::range);
  CHECK(refusal_of("fanbeam,1,1,2,541,4,5,6,7,8,9,10,11,12") == PacketFault::range);
  CHECK(refusal_of("fanbeam,1,0,0,0,0,0,0,0,0,0,0,0,0") == PacketFault::range);
}
