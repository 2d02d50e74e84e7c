#include "scenes/trajectory/trajectory_csv.h"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/errors.h"
#include "core/units.h"
#include "tests/peak_memory.h"
#include "tests/shared_data.h"
#include "tests/terrain/ascii_grid.h"

namespace fanbeam::scenes {
namespace {

namespace fs = std::filesystem;

// A file that disappears with the test.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& bytes)
      : path_(fs::temp_directory_path() / ("fanbeam_track_" + std::to_string(getpid()) + ".csv")) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TemporaryFile() { fs::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

const std::string kHeader = "time_s,latitude_deg,longitude_deg,height_m\n";

struct Reading {
  RawTrack track;
  core::ProblemList problems;
};

Reading read_csv(const std::string& bytes, const TrajectoryColumns& columns = {}) {
  const TemporaryFile file(bytes);
  Reading reading;
  reading.track = read_track_csv(file.path(), columns, reading.problems);
  return reading;
}

// "E-TIME@3" for each problem.
std::string codes_and_lines(const std::string& bytes, const TrajectoryColumns& columns = {}) {
  std::string text;
  const Reading reading = read_csv(bytes, columns);
  for (const core::Problem& problem : reading.problems.all())
    text += (text.empty() ? "" : " ") + problem.code + "@" + std::to_string(problem.place.line);
  return text;
}

TrajectoryColumns adsb_columns() {
  TrajectoryColumns columns;
  columns.time.name = "time_unix_s";
  columns.latitude.name = "lat_deg";
  columns.longitude.name = "lon_deg";
  columns.height.name = "alt_geom_ft";
  return columns;
}

}  // namespace

TEST_CASE("F09: each broken trajectory text has its class and line", "[trajectory_csv]") {
  CHECK(codes_and_lines("") == "E-PARSE@1");
  CHECK(codes_and_lines(kHeader) == "E-PARSE@1");
  CHECK(codes_and_lines(kHeader + "0,47,11,600\n0,47,11,600\n") == "E-TIME@3");
  CHECK(codes_and_lines(kHeader + "0,47,11,600\n2,47,11,600\n1,47,11,600\n") == "E-TIME@4");
  CHECK(codes_and_lines(kHeader + "0,47,5,11,600\n") == "E-PARSE@2");
  CHECK(codes_and_lines(kHeader + "0,\"47,5\",11,600\n") == "E-PARSE@2");
  CHECK(codes_and_lines(kHeader + "0,47,11,600\n1,nan,11,600\n") == "E-NONFINITE@3");
  CHECK(codes_and_lines(kHeader + "0,47,11,inf\n") == "E-NONFINITE@2");
  CHECK(codes_and_lines(kHeader + "0,47,11,1e400\n") == "E-PARSE@2");
  CHECK(codes_and_lines("time_s,latitude_deg,height_m\n0,47,600\n") == "E-PARSE@1");
  CHECK(codes_and_lines(kHeader + "0,47,11\n") == "E-PARSE@2");
  CHECK(codes_and_lines(kHeader + "0,47 11,11,600\n") == "E-PARSE@2");
}

TEST_CASE("F09: a clock reading that is too late is told itself, not the rows that follow",
          "[trajectory_csv]") {
  const std::string text =
      kHeader + "0,47,11,600\n1,47,11,600\n900,47,11,600\n3,47,11,600\n4,47,11,600\n";
  CHECK(codes_and_lines(text) == "E-TIME@4");
  CHECK_THAT(core::to_string(read_csv(text).problems.all().at(0)),
             Catch::Contains("time_s = 900 s: expected earlier than 3 s in line 5"));
  TrajectoryColumns rejecting;
  rejecting.outliers = OutlierPolicy::reject;
  const Reading reading = read_csv(text, rejecting);
  CHECK(reading.problems.all().empty());
  CHECK(reading.track.rows.size() == 4);
  REQUIRE(reading.track.rejected.size() == 1);
  CHECK(reading.track.rejected[0].first_row == 3);
  CHECK(reading.track.rejected[0].first_line == 4);
}

TEST_CASE("F09: one row, CRLF, byte order mark and blank lines are fine", "[trajectory_csv]") {
  const Reading reading =
      read_csv("\xEF\xBB\xBFtime_s,latitude_deg,longitude_deg,height_m\r\n0,47,-11.5,600\r\n\r\n");
  CHECK(reading.problems.all().empty());
  REQUIRE(reading.track.rows.size() == 1);
  CHECK(reading.track.rows[0].position.longitude_rad == core::radians(-11.5));
  CHECK(codes_and_lines("# a note\n" + kHeader + "0,47,11,600\n\n\n") == "");
  CHECK(codes_and_lines(kHeader + "0,47,11,600") == "");
}

TEST_CASE("F09: ten million rows are refused, and a part of them can be read", "[trajectory_csv]") {
  std::string rows = kHeader;
  rows.reserve(140'000'000);
  for (int i = 0; i < 10'000'000; ++i) rows += std::to_string(i) + ",0,0,0\n";
  const TemporaryFile file(rows);
  rows = {};
  core::ProblemList problems;
  const tests::PeakMemory whole_memory;
  read_track_csv(file.path(), {}, problems);
#ifndef __SANITIZE_ADDRESS__  // which keeps freed memory for a while
  // A growing vector has room for the rows and, while they move, half as much again.
  CHECK(whole_memory.rise_MiB() < 1.5 * kMostTrackRows * sizeof(TrackRow) / 1048576.0);
#endif
  REQUIRE(problems.all().size() == 1);
  CHECK(problems.all()[0].code == "E-LIMIT");
  CHECK(problems.all()[0].place.line == 4'000'002);  // the header and one row too many

  TrajectoryColumns part;
  part.from_time_s = 9'000'000.0;
  part.to_time_s = 9'000'009.0;
  core::ProblemList none;
  const tests::PeakMemory part_memory;
  const RawTrack track = read_track_csv(file.path(), part, none);
  CHECK(part_memory.rise_MiB() < 16.0);
  CHECK(none.all().empty());
  CHECK(track.rows.size() == 10);
}

TEST_CASE("A line without an end is refused before it fills memory", "[trajectory_csv]") {
  CHECK(codes_and_lines(kHeader + "0,47,11,600\n" + std::string(1'000'000, '1')) == "E-LIMIT@3");
}

TEST_CASE("All problems of a track are reported together, up to a limit", "[trajectory_csv]") {
  CHECK(codes_and_lines(kHeader + "0,91,11,x\n1,47,541,2e6\nnan,47,11,600\n") ==
        "E-RANGE@2 E-PARSE@2 E-RANGE@3 E-RANGE@3 E-NONFINITE@4");
  std::string many = kHeader;
  for (int i = 0; i < 100'000; ++i) many += "bad,row,of,words\n";
  CHECK(read_csv(many).problems.all().size() <= core::ProblemList::kMost + 1);
  CHECK(codes_and_lines("a,b\n1,2\n") == "E-PARSE@1 E-PARSE@1 E-PARSE@1 E-PARSE@1");
}

TEST_CASE("A missing column is named with what was expected", "[trajectory_csv]") {
  const Reading reading = read_csv("time_s,lat,longitude_deg,height_m\n0,47,11,600\n");
  REQUIRE(reading.problems.all().size() == 1);
  CHECK(reading.problems.all()[0].field == "column \"latitude_deg\"");
  TrajectoryColumns unitless;
  unitless.latitude.name = "lat";
  CHECK_THAT(core::to_string(read_csv("time_s,lat,longitude_deg,height_m\n0,47,11,600\n", unitless)
                                 .problems.all()
                                 .at(0)),
             Catch::Contains("E-PARSE") && Catch::Contains("deg or rad"));
  unitless.latitude.unit = "deg";
  CHECK(codes_and_lines("time_s,lat,longitude_deg,height_m\n0,47,11,600\n", unitless) == "");
  CHECK(codes_and_lines("time_s,time_s,latitude_deg,longitude_deg,height_m\n0,0,47,11,600\n") ==
        "E-PARSE@1");
  TrajectoryColumns wanted;
  wanted.roll.may_be_missing = false;
  CHECK(codes_and_lines(kHeader + "0,47,11,600\n", wanted) == "E-PARSE@1");
}

TEST_CASE("Units follow from the name or are stated", "[trajectory_csv]") {
  TrajectoryColumns columns;
  columns.time = {"clock", "ms", false};
  columns.latitude.name = "lat_rad";
  columns.height.name = "alt_ft";
  columns.height_offset_m = 10.0;
  const Reading reading =
      read_csv("heading_deg,alt_ft,longitude_deg,lat_rad,clock\n-20,1000,11,0.5,2500\n", columns);
  REQUIRE(reading.problems.all().empty());
  const TrackRow& row = reading.track.rows.at(0);
  CHECK(row.time_s == Approx(2.5));
  CHECK(row.position.latitude_rad == 0.5);
  CHECK(row.position.height_m == Approx(314.8));  // 1000 ft = 304.8 m exactly
  CHECK(row.heading_rad == Approx(core::radians(-20.0)));
  CHECK(reading.track.has_heading);
  CHECK_FALSE(reading.track.has_roll);
}

TEST_CASE("Windows by time and by row leave the rest unchecked", "[trajectory_csv]") {
  const std::string text =
      kHeader + "5,47,11,0\n1,47,11,1\n2,47,11,2\n3,47,11,3\n4,,,\n6,x,11,0\n7,47,11,7\n";
  TrajectoryColumns by_row;
  by_row.first_row = 2;
  by_row.last_row = 4;
  CHECK(read_csv(text, by_row).problems.all().empty());
  CHECK(read_csv(text, by_row).track.rows.size() == 3);
  TrajectoryColumns by_time;
  by_time.from_time_s = 1.0;
  by_time.to_time_s = 3.0;
  CHECK(read_csv(text, by_time).problems.all().empty());
  CHECK(read_csv(text, by_time).track.rows.size() == 3);
  by_time.from_time_s = 100.0;
  by_time.to_time_s.reset();
  CHECK_THAT(codes_and_lines(text, by_time), Catch::Contains("E-PARSE"));
}

TEST_CASE("Empty positions are counted, empty angles drop the angle", "[trajectory_csv]") {
  const Reading reading = read_csv(
      "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg\n"
      "0,47,11,600,1,2\n1,,11,600,1,2\n2,47,11,,1,2\n3,47,11,600,,2\n");
  REQUIRE(reading.problems.all().size() == 2);
  CHECK(core::to_string(reading.problems.all()[0]).find("W-EMPTY rows without a position = 2") !=
        std::string::npos);
  CHECK(reading.problems.all()[1].code == "W-GAPS");
  CHECK(reading.problems.all()[1].place.line == 5);
  CHECK(reading.track.rows.size() == 2);
  CHECK(reading.track.has_pitch);
  CHECK_FALSE(reading.track.has_roll);
}

TEST_CASE("A file that cannot be read is E-IO", "[trajectory_csv]") {
  const tests::TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe.csv";  // opening it would never end
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  core::ProblemList problems;
  read_track_csv("/nonexistent/track.csv", {}, problems);
  read_track_csv(fs::temp_directory_path(), {}, problems);
  read_track_csv(pipe, {}, problems);
  read_track_csv("/proc/self/mem", {}, problems);  // opens, and refuses its first byte
  REQUIRE(problems.all().size() == 4);
  for (const core::Problem& problem : problems.all()) {
    CHECK(problem.code == "E-IO");
    CHECK(problem.place.line == 0);  // the system's fault, of no line
  }
}

TEST_CASE("Real flights: the airliner's height is geometric or barometric", "[trajectory_csv]") {
  const auto path = tests::shared_data("trajectories/kden_rwy26_dal1812.csv");
  if (!path) return;
  core::ProblemList problems;
  const RawTrack geometric = read_track_csv(*path, adsb_columns(), problems);
  CHECK(problems.all().empty());
  CHECK(geometric.rows.size() == 161);
  CHECK(geometric.rows[0].position.height_m == Approx(30350 * 0.3048));
  TrajectoryColumns barometric = adsb_columns();
  barometric.height.name = "alt_baro_ft";
  const RawTrack by_pressure = read_track_csv(*path, barometric, problems);
  // Eight rows after landing have no pressure altitude.
  CHECK(by_pressure.rows.size() == 153);
  REQUIRE(problems.all().size() == 1);
  CHECK(problems.all()[0].code == "W-EMPTY");
}

}  // namespace fanbeam::scenes
