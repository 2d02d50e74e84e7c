// Recorded datagrams: captures put together by hand, one that tcpdump wrote, and files that are none.
#include "feeds/packet_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <limits>
#include <utility>

#include "tests/feeds/packet_bytes.h"
#include "tests/open_descriptor.h"
#include "tests/shared_data.h"

using namespace fanbeam;
using tests::append_raw;
using tests::append_record;
using tests::behind;
using tests::Bytes;
using tests::capture_header;
using tests::ipv4_udp;

namespace {

struct Datagram {
  double time_s = 0.0;
  std::uint16_t port = 0;
  Bytes bytes;
};

struct Reading {
  std::vector<Datagram> datagrams;
  std::string problems;  // "E-PARSE@24" each
};

// `breaks`: after the first datagram the system reads no more of the file.
Reading read(const std::filesystem::path& file, bool breaks = false) {
  Reading reading;
  core::ProblemList problems;
  feeds::read_datagrams(
      file,
      [&](const feeds::RecordedDatagram& datagram) {
        if (std::exchange(breaks, false)) {
          const int folder = ::open("/", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
          ::dup2(folder, tests::open_descriptor(file));  // reading one is an error
          ::close(folder);
        }
        reading.datagrams.push_back(
            {datagram.time_s, datagram.port, {datagram.bytes.begin(), datagram.bytes.end()}});
      },
      problems);
  for (const core::Problem& problem : problems.all())
    reading.problems += (reading.problems.empty() ? "" : " ") + problem.code + "@" +
                        std::to_string(problem.place.byte_offset);
  return reading;
}

Reading read(const Bytes& bytes, bool breaks = false) {
  const auto file =
      std::filesystem::temp_directory_path() / ("fanbeam_packets_" + std::to_string(getpid()));
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  Reading reading = read(file, breaks);
  std::filesystem::remove(file);
  return reading;
}

const Bytes kPayload{1, 2, 3, 4, 5};

}  // namespace

TEST_CASE("A datagram is found behind every link layer", "[packet_file]") {
  const Bytes ip = ipv4_udp(5501, kPayload);
  Bytes six{0x60, 0, 0, 0, 0, 13, 17, 64};  // RFC 8200
  six.resize(40, 0);
  six = behind(six, Bytes(ip.begin() + 24, ip.end()));
  const Bytes macs(12, 0xee);
  const std::pair<std::uint32_t, Bytes> frames[] = {
      {1, behind(behind(macs, {0x08, 0x00}), ip)},
      {1, behind(behind(macs, {0x86, 0xdd}), six)},
      {1, behind(behind(macs, {0x81, 0x00, 0, 7, 0x08, 0x00}), ip)},
      {1, behind(behind(macs, {0x88, 0xa8, 0, 7, 0x81, 0x00, 0, 9, 0x08, 0x00}), ip)},
      {1, behind(behind(behind(macs, {0x08, 0x00}), ip), Bytes(9, 0))},  // padded to the shortest
      {0, behind({2, 0, 0, 0}, ip)},
      {108, behind({0, 0, 0, 2}, ip)},
      {101, ip},
      {101, six},
      {228, ip},
      {229, six},
      {113, behind(Bytes(16, 0), ip)},
      {276, behind(Bytes(20, 0), ip)},
  };
  for (const auto& [link, frame] : frames)
    for (const bool little : {true, false}) {
      INFO("link type " << link << ", " << frame.size() << " bytes, little " << little);
      Bytes capture = capture_header(link, little);
      append_record(capture, 1700000000, 250000, frame, little);
      const Reading reading = read(capture);
      CHECK(reading.problems.empty());
      REQUIRE(reading.datagrams.size() == 1);
      CHECK(reading.datagrams[0].time_s == 1700000000.25);
      CHECK(reading.datagrams[0].port == 5501);
      CHECK(reading.datagrams[0].bytes == kPayload);
    }
}

TEST_CASE("What is no whole datagram is passed over", "[packet_file]") {
  Bytes capture = capture_header(101, true, 0xa1b23c4d);  // of nanoseconds
  Bytes tcp = ipv4_udp(5501, kPayload), no_version = tcp, lying = tcp;
  tcp[9] = 6;
  no_version[0] = 0x16;
  lying[24 + 5] = 200;  // UDP's length beyond the packet
  append_record(capture, 1, 0, tcp);
  append_record(capture, 1, 0, no_version);
  append_record(capture, 1, 0, lying);
  append_record(capture, 1, 0, {});
  append_record(capture, 1, 0, Bytes(27, 0x45));
  append_record(capture, 1, 0, ipv4_udp(5501, kPayload, 0x2000));  // more follow
  append_record(capture, 1, 0, ipv4_udp(5501, kPayload, 0x0010));  // follows
  append_record(capture, 1, 0, ipv4_udp(5501, kPayload), true, 3);
  append_record(capture, 2, 5, ipv4_udp(9, kPayload, 0x4000));  // not to be cut: whole
  const Reading reading = read(capture);
  CHECK(reading.problems.empty());
  REQUIRE(reading.datagrams.size() == 1);
  CHECK(reading.datagrams[0].time_s == Approx(2.000000005).epsilon(1e-12));
}

TEST_CASE("A recording that was killed loses its last record alone", "[packet_file]") {
  Bytes capture = capture_header(101);
  append_record(capture, 1, 0, ipv4_udp(1, kPayload));
  const std::size_t second = capture.size();
  append_record(capture, 2, 0, ipv4_udp(1, kPayload));
  Bytes raw;
  append_raw(raw, 0.0, 7, kPayload);
  append_raw(raw, 0.5, 8, kPayload);
  for (std::size_t size = second + 1; size < capture.size(); ++size) {
    const Reading reading = read(Bytes(capture.begin(), capture.begin() + std::ptrdiff_t(size)));
    CHECK(reading.datagrams.size() == 1);
    CHECK(reading.problems == "W-CUT@" + std::to_string(second));
  }
  for (std::size_t size = 18; size < raw.size(); ++size) {
    const Reading reading = read(Bytes(raw.begin(), raw.begin() + std::ptrdiff_t(size)));
    CHECK(reading.datagrams.size() == 1);
    CHECK(reading.problems == "W-CUT@17");
  }
  const Reading whole = read(raw);
  CHECK(whole.problems.empty());
  REQUIRE(whole.datagrams.size() == 2);
  CHECK(whole.datagrams[1].time_s == 0.5);
  CHECK(whole.datagrams[1].port == 8);
  CHECK(whole.datagrams[1].bytes == kPayload);
}

// It was a shorter flight, or one whose last record was cut off.
TEST_CASE("A file that the system cannot read on is told", "[packet_file]") {
  // A stream reads 8191 bytes ahead: the second record breaks off, or does not begin.
  for (const std::size_t record_bytes : {6000U, 8191U}) {
    Bytes raw;
    for (int i = 0; i < 4; ++i) append_raw(raw, i, 7, Bytes(record_bytes - 12, 1));
    const Reading reading = read(raw, true);
    CHECK(reading.problems == "E-IO@" + std::to_string(record_bytes));
    CHECK(reading.datagrams.size() == 1);
  }
}

TEST_CASE("Other files are refused with what they are", "[packet_file]") {
  CHECK(read(std::filesystem::path("/nowhere/flight.pcap")).problems == "E-IO@-1");
  CHECK(read(std::filesystem::path("/")).problems == "E-IO@-1");
  const auto pipe =
      std::filesystem::temp_directory_path() / ("fanbeam_pipe_" + std::to_string(getpid()));
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(read(pipe).problems == "E-IO@-1");  // opening it would never end
  std::filesystem::remove(pipe);
  CHECK(read(Bytes{}).problems == "E-REF@0");
  CHECK(read(Bytes{0x0a, 0x0d, 0x0d, 0x0a, 28, 0, 0, 0, 0x4d, 0x3c, 0x2b, 0x1a}).problems ==
        "E-REF@0");
  const std::string text = "time_s,latitude_deg,longitude_deg,height_m\n0,52,10,200\n";
  CHECK(read(Bytes(text.begin(), text.end())).problems == "E-REF@0");
  CHECK(read(capture_header(147)).problems == "E-PARSE@0");
  Bytes endless = capture_header(1);
  append_record(endless, 1, 0, {});
  endless[24 + 8 + 2] = 0xff;
  CHECK(read(endless).problems == "E-PARSE@24");
  Bytes never;
  append_raw(never, 0.0, 7, kPayload);
  append_raw(never, std::numeric_limits<double>::quiet_NaN(), 7, kPayload);
  CHECK(read(never).problems == "E-PARSE@17");
}

TEST_CASE("tcpdump's capture holds what the recorder beside it kept", "[packet_file]") {
  const auto folder = tests::shared_data("flightgear");
  if (!folder) return;
  const Reading raw = read(*folder / "bikf10.bin"), capture = read(*folder / "bikf10.pcap");
  CHECK(raw.problems.empty());
  CHECK(capture.problems.empty());
  std::vector<Datagram> of_port;
  for (const Datagram& datagram : capture.datagrams)
    if (datagram.port == 5501) of_port.push_back(datagram);
  // 16 Hz over 118 s, each 408 bytes; the clocks differ by a constant.
  REQUIRE(raw.datagrams.size() > 1800);
  REQUIRE(of_port.size() >= raw.datagrams.size());
  std::size_t first = 0;
  while (first < of_port.size() && of_port[first].bytes != raw.datagrams[0].bytes) ++first;
  REQUIRE(of_port.size() >= first + raw.datagrams.size());
  const double between_s = of_port[first].time_s - raw.datagrams[0].time_s;
  for (std::size_t i = 0; i < raw.datagrams.size(); ++i) {
    REQUIRE(of_port[first + i].bytes == raw.datagrams[i].bytes);
    CHECK(of_port[first + i].time_s - raw.datagrams[i].time_s ==
          Approx(between_s).margin(0.02).epsilon(0.0));
  }
}
