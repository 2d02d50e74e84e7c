// Recorded packets as flights of a scene: a real one against the simulator's own table, and what is
// wrong with others.
#include "scenes/trajectory/trajectory_packets.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "core/units.h"
#include "tests/feeds/packet_bytes.h"
#include "tests/scenes/scene_folder.h"
#include "tests/shared_data.h"

using namespace fanbeam;
using scenes::RawTrack;
using tests::append_raw;
using tests::Bytes;

namespace {

// At 52 N 10 E, 200 ft, heading north at 100 ft/s; the simulator's clock at `clock_s`.
Bytes line(double clock_s) {
  std::ostringstream text;
  text.precision(15);
  text << "fanbeam,1," << clock_s << ',' << 52.0 + clock_s * core::kFoot_m * 100.0 / 111.25e3
       << ",10,656,492,1,-2,370,100,0,0,5000\n";
  const std::string bytes = text.str();
  return {bytes.begin(), bytes.end()};
}

struct PacketReading {
  RawTrack track;
  core::ProblemList problems;
  std::string text;
};

PacketReading read_packets(const tests::TemporaryFolder& folder, const Bytes& bytes,
                           std::optional<std::uint16_t> port = {},
                           const scenes::TrajectoryColumns& window = {}) {
  folder.write("flight.bin", std::string(bytes.begin(), bytes.end()));
  PacketReading reading;
  reading.track = scenes::read_track_packets(
      folder.path() / "flight.bin", {&feeds::kProtocols[1], port}, window, reading.problems);
  for (const core::Problem& problem : reading.problems.all())
    reading.text += core::to_string(problem) + "\n";
  return reading;
}

}  // namespace

TEST_CASE("Rows of packets have the simulator's clock and attitude", "[trajectory]") {
  const tests::TemporaryFolder folder;
  Bytes recording;
  for (const double clock_s : {100.0, 100.5, 100.25, 100.5, 101.0}) {  // one late, one twice
    append_raw(recording, 7.0, 9, line(clock_s));
    append_raw(recording, 7.0, 10, Bytes{1, 2, 3});
  }
  append_raw(recording, 7.0, 9, Bytes{'x'});
  scenes::TrajectoryColumns window;
  window.height_offset_m = 3.0;
  const PacketReading reading = read_packets(folder, recording, 9, window);
  INFO(reading.text);
  CHECK_FALSE(reading.problems.has_errors());
  CHECK(reading.problems.all().size() == 2);
  CHECK(reading.text.find("another version = 1: ") != std::string::npos);
  CHECK(reading.text.find("late, or come twice = 2: ") != std::string::npos);
  REQUIRE(reading.track.rows.size() == 3);
  CHECK(reading.track.fully_recorded());
  CHECK(reading.track.rows[1].time_s == 0.5);
  CHECK(reading.track.rows[2].time_s == 1.0);
  CHECK(reading.track.rows[2].row == 5);
  CHECK(reading.track.rows[2].position.height_m == Approx(656.0 * core::kFoot_m + 3.0));
  CHECK(core::degrees(reading.track.rows[2].heading_rad) == Approx(10.0));
  CHECK(core::degrees(reading.track.rows[2].pitch_rad) == Approx(-2.0));
  CHECK(core::degrees(reading.track.rows[2].roll_rad) == Approx(1.0));

  window.from_time_s = 0.5;
  window.last_row = 4;
  CHECK(read_packets(folder, recording, 9, window).track.rows.size() == 1);
}

TEST_CASE("The port of a flight must be clear, and its clock go on", "[trajectory]") {
  const tests::TemporaryFolder folder;
  Bytes recording;
  append_raw(recording, 0.0, 9, line(1.0));
  append_raw(recording, 0.1, 10, line(1.25));
  append_raw(recording, 0.2, 10, line(1.5));
  const PacketReading two = read_packets(folder, recording);
  CHECK(two.text.find("E-REF port = missing: expected one of 9 (1 packets), 10 (2 packets)") !=
        std::string::npos);
  CHECK(read_packets(folder, recording, 10).track.rows.size() == 2);
  const PacketReading none = read_packets(folder, recording, 11);
  CHECK(none.text.find("E-REF packets = none of fg-generic to port 11") != std::string::npos);

  append_raw(recording, 0.3, 10, line(0.25));
  const PacketReading reset = read_packets(folder, recording, 10);
  CHECK(reset.text.find("E-TIME clock of packets = goes back by 1.25 s at packet 3") !=
        std::string::npos);
}

TEST_CASE("A scene says whose packets its file holds", "[trajectory][scene]") {
  const tests::TemporaryFolder folder;
  Bytes recording;
  for (int i = 0; i < 40; ++i) append_raw(recording, i / 16.0, 9, line(i / 16.0));
  const std::string bytes(recording.begin(), recording.end());
  folder.write("flight.bin", bytes);
  folder.write("flight.pcap", bytes);
  const auto scene_with = [](const std::string& keys) {
    return tests::replaced(tests::kSmallScene,
                           "[trajectory.ils]\nrunway = \"36\"\nstart_distance_m = 1500.0\n",
                           "[trajectory]\nvertical_datum = \"scene\"\n" + keys);
  };
  const auto scene = tests::good_scene(
      folder, scene_with("file = \"flight.bin\"\nprotocol = \"fg-generic\"\nport = 9\n"));
  REQUIRE(scene->trajectory.has_value());
  CHECK(scene->trajectory->end_s() == Approx(39.0 / 16.0));

  const auto refused = [&](const std::string& keys) {
    std::string all;
    for (const std::string& text :
         tests::messages(folder, tests::build_text(folder, scene_with(keys)).problems))
      all += text + "\n";
    return all;
  };
  CHECK(refused("file = \"flight.pcap\"\n").find("trajectory.protocol = missing") !=
        std::string::npos);
  CHECK(refused("file = \"flight.bin\"\nport = 9\n").find("trajectory.port = without a protocol") !=
        std::string::npos);
  CHECK(refused("file = \"flight.bin\"\nprotocol = \"cigi\"\n").find("E-RANGE") !=
        std::string::npos);
  CHECK(refused("file = \"flight.bin\"\nprotocol = \"fg-generic\"\ncolumns = { time = \"t\" }\n")
            .find("trajectory.columns = beside protocol") != std::string::npos);
}

TEST_CASE("A recorded flight is that of the simulator's own table", "[trajectory]") {
  const auto data = tests::shared_data("flightgear");
  if (!data) return;
  struct Own {
    double altitude_m = 0.0, heading_deg = 0.0, roll_deg = 0.0, pitch_deg = 0.0;
  };
  std::map<std::pair<long long, long long>, Own> table;
  std::ifstream stream(*data / "bikf10.csv");
  std::string text, cell;
  std::getline(stream, text);
  while (std::getline(stream, text)) {
    std::vector<double> cells;
    for (std::istringstream row(text); std::getline(row, cell, ',');)
      cells.push_back(std::stod(cell));
    table[{std::llround(cells[1] * 1e8), std::llround(cells[2] * 1e8)}] = {
        core::kFoot_m * cells[3], cells[8], cells[6], cells[7]};
  }
  core::ProblemList problems;
  const RawTrack track = scenes::read_track_packets(
      *data / "bikf10.pcap", {&feeds::kProtocols[0], std::uint16_t{5501}}, {}, problems);
  CHECK(problems.all().empty());
  REQUIRE(track.rows.size() > 1800);
  std::size_t found = 0;
  for (const scenes::TrackRow& row : track.rows) {
    const auto own = table.find({std::llround(core::degrees(row.position.latitude_rad) * 1e8),
                                 std::llround(core::degrees(row.position.longitude_rad) * 1e8)});
    if (own == table.end()) continue;  // rounded to the other side, or beyond the table's window
    ++found;
    CHECK(row.position.height_m == Approx(own->second.altitude_m).margin(1e-3).epsilon(0.0));
    CHECK(std::remainder(core::degrees(row.heading_rad) - own->second.heading_deg, 360.0) ==
          Approx(0.0).epsilon(0.0).margin(1e-4));
    CHECK(core::degrees(row.roll_rad) == Approx(own->second.roll_deg).epsilon(0.0).margin(1e-4));
    CHECK(core::degrees(row.pitch_rad) == Approx(own->second.pitch_deg).epsilon(0.0).margin(1e-4));
  }
  CHECK(found > 1700);
}
