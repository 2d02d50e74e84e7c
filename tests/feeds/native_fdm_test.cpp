// native-fdm: a packet put together by hand, a flight that FlightGear recorded, and bytes that are
// none.
#include "feeds/native_fdm.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "core/units.h"
#include "tests/feeds/native_fdm_bytes.h"
#include "tests/shared_data.h"

using namespace fanbeam;
using feeds::PacketFault;

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr double kFloatRadian = static_cast<double>(0.01745329238474369F);

std::optional<feeds::AircraftState> decoded_fdm(const Bytes& bytes) {
  PacketFault fault{};
  return feeds::decode_native_fdm(bytes, fault);
}

PacketFault fdm_fault_of(const Bytes& bytes) {
  PacketFault fault{};
  CHECK_FALSE(feeds::decode_native_fdm(bytes, fault).has_value());
  return fault;
}

// Datagrams of one port in the recording: f64 time, u16 port, u16 length, payload, little-endian.
std::vector<Bytes> datagrams(const std::filesystem::path& file, std::uint16_t wanted) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<Bytes> found;
  char head[12];
  while (stream.read(head, sizeof head)) {
    std::uint16_t port = 0, length = 0;
    std::memcpy(&port, head + 8, 2);
    std::memcpy(&length, head + 10, 2);
    Bytes payload(length);
    stream.read(reinterpret_cast<char*>(payload.data()), length);
    if (port == wanted) found.push_back(std::move(payload));
  }
  return found;
}

using Row = std::map<std::string, double>;

// Rows by latitude and longitude in units of 1e-10 deg.
std::map<std::pair<long long, long long>, Row> rows_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line, cell;
  std::getline(stream, line);
  std::vector<std::string> names;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
  std::map<std::pair<long long, long long>, Row> rows;
  while (std::getline(stream, line)) {
    Row row;
    std::size_t i = 0;
    for (std::istringstream cells(line); std::getline(cells, cell, ',');)
      row[names[i++]] = std::stod(cell);
    rows.emplace(
        std::pair(std::llround(row["lat_deg"] * 1e10), std::llround(row["lon_deg"] * 1e10)), row);
  }
  return rows;
}

// Rounding may put a number on either side.
const Row* row_at(const std::map<std::pair<long long, long long>, Row>& rows, double latitude,
                  double longitude) {
  for (const double up : {0.0, -0.01, 0.01})
    for (const double right : {0.0, -0.01, 0.01}) {
      const auto found = rows.find({std::llround(latitude + up), std::llround(longitude + right)});
      if (found != rows.end()) return &found->second;
    }
  return nullptr;
}

}  // namespace

TEST_CASE("A packet's fields stand where FlightGear's layout has them", "[native_fdm]") {
  const auto packet =
      decoded_fdm(tests::native_fdm_bytes(52.0 * kFloatRadian, 10.0 * kFloatRadian));
  REQUIRE(packet.has_value());
  // The simulator's single-precision pi/180 is taken out again.
  CHECK(core::degrees(packet->latitude_rad) == Approx(52.0).epsilon(0.0).margin(5e-13));
  CHECK(core::degrees(packet->longitude_rad) == Approx(10.0).epsilon(0.0).margin(5e-13));
  CHECK(packet->altitude_m == 200.0);
  CHECK(packet->height_above_ground_m == 150.0);
  CHECK(packet->attitude.roll_rad == static_cast<double>(0.1F));
  CHECK(packet->attitude.pitch_rad == static_cast<double>(-0.05F));
  CHECK(packet->attitude.heading_rad == 1.5);
  CHECK(packet->v_N_mps == glm::dvec3(0.0, 30.48, 1.524));
  CHECK(packet->visibility_m == 5000.0);
  CHECK(packet->clock_s == 1.7e9);
  const core::Pose pose = feeds::pose_of(*packet);
  const core::Attitude attitude = core::attitude_from(pose.q_NB);
  CHECK(attitude.heading_rad == Approx(1.5));
  CHECK(attitude.roll_rad == Approx(0.1));
  CHECK(pose.position.height_m == 200.0);
}

TEST_CASE("Every datagram of the recorded flight is the simulator's own row", "[native_fdm]") {
  const auto recording = tests::shared_data("flightgear/bikf10.bin");
  const auto table = tests::shared_data("flightgear/bikf10.csv");
  if (!recording || !table) return;
  const auto rows = rows_of(*table);
  const std::vector<Bytes> packets = datagrams(*recording, 5501);
  REQUIRE(packets.size() > 1800);
  for (const Bytes& bytes : packets) {
    const auto packet = decoded_fdm(bytes);
    REQUIRE(packet.has_value());
    const double latitude_deg = core::degrees(packet->latitude_rad);
    const double longitude_deg = core::degrees(packet->longitude_rad);
    const Row* row = row_at(rows, latitude_deg * 1e10, longitude_deg * 1e10);
    REQUIRE(row != nullptr);
    const auto near = [&](double value, const char* name, double unit, double within) {
      INFO(name);
      CHECK(value == Approx(row->at(name) * unit).epsilon(0.0).margin(within));
    };
    near(latitude_deg, "lat_deg", 1.0, 6e-13);
    near(longitude_deg, "lon_deg", 1.0, 6e-13);
    near(packet->altitude_m, "alt_ft", core::kFoot_m, 1e-6);
    near(packet->height_above_ground_m, "agl_ft", core::kFoot_m, 2e-5);
    near(packet->attitude.roll_rad, "roll_deg", core::kPi / 180.0, 1e-7);
    near(packet->attitude.pitch_rad, "pitch_deg", core::kPi / 180.0, 1e-7);
    near(packet->attitude.heading_rad, "heading_true_deg", core::kPi / 180.0, 1e-6);
    near(packet->v_N_mps.x, "v_north_fps", core::kFoot_m, 1e-5);
    near(packet->v_N_mps.y, "v_east_fps", core::kFoot_m, 1e-5);
    near(packet->v_N_mps.z, "v_down_fps", core::kFoot_m, 1e-5);
    near(packet->visibility_m.value_or(0.0), "visibility_m", 1.0, 1e-3);
  }
}

TEST_CASE("Bytes that are no packet are refused with their reason", "[native_fdm]") {
  const Bytes good = tests::native_fdm_bytes(0.9, 0.2);
  for (const std::size_t size : {0UL, 1UL, 4UL, 407UL, 409UL, 65507UL}) {
    Bytes other = good;
    other.resize(size);
    CHECK(fdm_fault_of(other) == PacketFault::length);
  }
  Bytes other = good;
  tests::put(other, 0, 25, 4);
  CHECK(fdm_fault_of(other) == PacketFault::version);
  for (const std::size_t at : {8UL, 16UL, 24UL}) {
    other = good;
    tests::put(other, at, std::numeric_limits<double>::quiet_NaN());
    CHECK(fdm_fault_of(other) == PacketFault::nonfinite);
    tests::put(other, at, 1e9);
    CHECK(fdm_fault_of(other) == PacketFault::range);
  }
  for (const std::size_t at : {32UL, 36UL, 40UL, 44UL, 76UL, 80UL, 84UL, 364UL}) {
    other = good;
    tests::put(other, at, std::numeric_limits<float>::infinity());
    CHECK(fdm_fault_of(other) == PacketFault::nonfinite);
  }
  for (const std::size_t at : {36UL, 76UL}) {
    other = good;
    tests::put(other, at, 1e9F);
    CHECK(fdm_fault_of(other) == PacketFault::range);
  }
}

TEST_CASE("F14 states that cannot be are refused with their reason", "[native_fdm]") {
  const Bytes good = tests::native_fdm_bytes(0.9, 0.2);
  Bytes other = good;
  tests::put(other, 36, std::numeric_limits<float>::quiet_NaN());  // roll
  CHECK(fdm_fault_of(other) == PacketFault::nonfinite);
  CHECK(fdm_fault_of(tests::native_fdm_bytes(core::radians(91.0), 0.2)) == PacketFault::range);
  other = good;
  tests::put(other, 24, 1e9);
  CHECK(fdm_fault_of(other) == PacketFault::range);
  other.assign(408, 0);
  CHECK(fdm_fault_of(other) == PacketFault::version);
  tests::put(other, 0, 24, 4);  // as before the simulator has started
  CHECK(fdm_fault_of(other) == PacketFault::range);
  // The poles and the equator are places.
  for (const double latitude_rad : {-core::kPi / 2, 0.0, core::kPi / 2}) {
    const auto packet = decoded_fdm(tests::native_fdm_bytes(latitude_rad, 0.0));
    REQUIRE(packet.has_value());
    CHECK(feeds::pose_of(*packet).position.latitude_rad ==
          Approx(latitude_rad).epsilon(0.0).margin(1e-7));
    CHECK(std::abs(feeds::pose_of(*packet).position.latitude_rad) <= core::kPi / 2);
  }
}

TEST_CASE("Packets with four bytes changed: what is taken is finite and possible", "[native_fdm]") {
  const Bytes good = tests::native_fdm_bytes(0.9, 0.2);
  int taken = 0;
  std::uint64_t state = 1;
  const auto next = [&state] {  // splitmix64
    std::uint64_t z = state += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  };
  for (int i = 0; i < 100'000; ++i) {
    Bytes bytes = good;
    for (int k = 0; k < 4; ++k) bytes[4 + next() % 404] = static_cast<std::uint8_t>(next());
    if (i % 8 == 0) bytes.resize(next() % 600);
    const auto packet = decoded_fdm(bytes);
    if (!packet) continue;
    ++taken;
    const core::Pose pose = feeds::pose_of(*packet);
    REQUIRE(std::abs(pose.position.latitude_rad) <= core::kPi / 2);
    REQUIRE(std::isfinite(pose.position.longitude_rad));
    REQUIRE(std::isfinite(pose.position.height_m));
    REQUIRE(std::isfinite(pose.q_NB.w + pose.q_NB.x + pose.q_NB.y + pose.q_NB.z));
    REQUIRE(std::isfinite(pose.v_N_mps.x + pose.v_N_mps.y + pose.v_N_mps.z));
  }
  CHECK(taken > 50'000);
}
