// Dates and times of tables, against instants whose Unix time is published or counted by hand.
#include "scenes/trajectory/iso_time.h"

#include <catch2/catch.hpp>

#include "scenes/trajectory/trajectory_csv.h"
#include "tests/terrain/ascii_grid.h"

using fanbeam::scenes::unix_time_s;

TEST_CASE("Dates and times become Unix time in every written form", "[iso-time]") {
  CHECK(unix_time_s("1970-01-01T00:00:00Z") == 0.0);
  // POSIX.1-2017, A.4.16: 1234567890 is 2009-02-13 23:31:30 UTC.
  for (const char* text :
       {"2009-02-13T23:31:30Z", "2009-02-13 23:31:30", "2009-02-13T23:31:30.000Z",
        "2009-02-14T01:31:30+02:00", "2009-02-13T18:01:30-0530", "2009-02-14T00:31:30+01",
        "2009-02-13 23:31:30 UTC", " 2009-02-13t23:31:30z "}) {
    INFO(text);
    CHECK(unix_time_s(text) == 1234567890.0);
  }
  CHECK(unix_time_s("2024-02-29T12:00Z") == 1709208000.0);  // a leap day, no seconds
  CHECK(*unix_time_s("2009-02-13T23:31:30.25Z") - 1234567890.0 == Approx(0.25));
  CHECK(*unix_time_s("2009-02-13T23:31:30.1234567891234Z") - 1234567890.0 ==
        Approx(0.123456789).epsilon(0.0).margin(3e-7));  // a double's step there is 2.4e-7
}

TEST_CASE("What is no date and time is none", "[iso-time]") {
  for (const char* text :
       {"", "2009", "1234567890", "2009-02-13", "2009-13-01T00:00:00Z", "2009-02-30T00:00:00Z",
        "2009-02-13T24:00:00Z", "2009-02-13T23:60:00Z", "2009-02-13T23:31:30X", "2009-02-13T23",
        "2009-02-13T23:31:30+25:00", "2009-02-13T23:31:30.Z", "13.02.2009 23:31:30",
        "2009-02-13T23:31:30Z ago", "-2009-02-13T23:31:30Z"}) {
    INFO(text);
    CHECK_FALSE(unix_time_s(text).has_value());
  }
}

TEST_CASE("A flight's time column may hold dates, row by row", "[iso-time]") {
  const fanbeam::tests::TemporaryFolder folder;
  const auto file = folder.write("flight.csv",
                                 "UTC,latitude_deg,longitude_deg,height_m\n"
                                 "2009-02-13T23:31:30Z,52.0,10.0,500\n"
                                 "2009-02-13T23:31:30.5Z,52.0,10.001,500\n");
  fanbeam::scenes::TrajectoryColumns columns;
  columns.time = {"UTC", "iso8601", false};
  fanbeam::core::ProblemList problems;
  const auto track = fanbeam::scenes::read_track_csv(file, columns, problems);
  REQUIRE_FALSE(problems.has_errors());
  REQUIRE(track.rows.size() == 2);
  CHECK(track.rows[0].time_s == 1234567890.0);
  CHECK(track.rows[1].time_s == 1234567890.5);

  const auto broken = folder.write("broken.csv",
                                   "UTC,latitude_deg,longitude_deg,height_m\n"
                                   "yesterday,52.0,10.0,500\n");
  fanbeam::scenes::read_track_csv(broken, columns, problems);
  REQUIRE(problems.all().size() == 1);
  CHECK(problems.all()[0].code == "E-PARSE");
  CHECK(problems.all()[0].place.line == 2);
  CHECK(problems.all()[0].value == "\"yesterday\"");
}
