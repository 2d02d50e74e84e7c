// Recorded flights in anybody's own table: columns by their names, units and datums by the landing.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <string>

#include "core/units.h"
#include "scenes/new_scene/approach_rows.h"
#include "scenes/new_scene/track_columns.h"
#include "scenes/new_scene/track_guess.h"
#include "tests/scenes/problem_text.h"
#include "tests/shared_data.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
using namespace fanbeam::scenes;
using Catch::Contains;
using core::VerticalDatum;
using tests::all_of;

namespace {

constexpr double kGeoid_m = 45.0;
constexpr double kMetresOfDegree = 111'260.0;  // of latitude at 52 N

// Landing to the north at 52 N 10 E, 80 m above mean sea level, on a plain.
TrackReference reference() {
  TrackReference landing;
  landing.threshold = {core::radians(52.0), core::radians(10.0), 80.0};
  landing.runway_length_m = 2000.0;
  landing.geoid_m = kGeoid_m;
  landing.ground_m = [](const core::Geodetic& at) -> std::optional<double> {
    if (std::abs(at.latitude_rad - core::radians(52.0)) > core::radians(0.1)) return std::nullopt;
    return 80.0;
  };
  return landing;
}

// A 3 deg approach from 8 km on at 70 m/s, a row a second, rolling out on the runway. `row` gets the
// second, latitude and longitude in degrees, and height above mean sea level.
std::string table(const std::string& header,
                  const std::function<std::string(int, double, double, double)>& row) {
  std::string text = header + "\n";
  for (int second = 0; second < 130; ++second) {
    const double before_m = 8000.0 - 70.0 * second;
    const double height_m = 80.0 + std::max(0.0, 15.0 + before_m * std::tan(core::radians(3.0)));
    text += row(second, 52.0 - before_m / kMetresOfDegree, 10.0, height_m) + "\n";
  }
  return text;
}

std::string joined(double a, double b, double c, double d) {
  char text[200];
  std::snprintf(text, sizeof text, "%.9g,%.9f,%.9f,%.4f", a, b, c, d);
  return text;
}

struct Guessed {
  TrackGuess guess;
  std::string notes;
};

Guessed guessed(const std::string& text) {
  const tests::TemporaryFolder folder;
  core::ProblemList problems;
  Notes notes;
  const auto guess = guess_track(folder.write("flight.csv", text), reference(), notes, problems);
  INFO(all_of(problems));
  REQUIRE(guess.has_value());
  Guessed result{*guess, ""};
  for (const Note& note : notes) result.notes += note.label + ": " + note.text + "\n";
  return result;
}

std::string refused(const std::string& text) {
  const tests::TemporaryFolder folder;
  core::ProblemList problems;
  Notes notes;
  CHECK_FALSE(guess_track(folder.write("flight.csv", text), reference(), notes, problems));
  return all_of(problems);
}

}  // namespace

TEST_CASE("Columns are recognised by the words in their names", "[new-track]") {
  struct Form {
    std::vector<std::string_view> header;
    const char *time, *latitude, *longitude, *height, *unit;
    HeightKind kind;
  };
  const Form forms[] = {
      {{"time_s", "latitude_deg", "longitude_deg", "height_m"},
       "time_s",
       "latitude_deg",
       "longitude_deg",
       "height_m",
       "m",
       HeightKind::unsaid},
      // OpenSky's state vectors: the geometric altitude before the barometric.
      {{"time", "icao24", "lat", "lon", "velocity", "heading", "vertrate", "callsign", "onground",
        "baroaltitude", "geoaltitude", "lastposupdate"},
       "time",
       "lat",
       "lon",
       "geoaltitude",
       "",
       HeightKind::ellipsoid},
      {{"Timestamp", "UTC", "Callsign", "Latitude", "Longitude", "Altitude", "Speed", "Direction"},
       "Timestamp",
       "Latitude",
       "Longitude",
       "Altitude",
       "",
       HeightKind::unsaid},
      {{"UTC Time", "Latitude (deg)", "Longitude (deg)", "AltMSL [ft]", "AltAGL [ft]"},
       "UTC Time",
       "Latitude (deg)",
       "Longitude (deg)",
       "AltMSL [ft]",
       "ft",
       HeightKind::sea_level},
      {{"time_unix_s", "lat_deg", "lon_deg", "alt_baro_ft", "alt_geom_ft", "vertical_rate_fpm"},
       "time_unix_s",
       "lat_deg",
       "lon_deg",
       "alt_geom_ft",
       "ft",
       HeightKind::ellipsoid},
      {{"t", "selectedAltitude", "ground_elevation_m", "lat", "lng", "pressureAltitude"},
       "t",
       "lat",
       "lng",
       "pressureAltitude",
       "",
       HeightKind::pressure},
  };
  for (const Form& form : forms) {
    const NamedColumns columns = recognise_columns(form.header);
    INFO(form.height);
    REQUIRE(columns.time.has_value());
    CHECK(columns.time->name == form.time);
    REQUIRE(columns.latitude.has_value());
    CHECK(columns.latitude->name == form.latitude);
    REQUIRE(columns.longitude.has_value());
    CHECK(columns.longitude->name == form.longitude);
    REQUIRE_FALSE(columns.heights.empty());
    CHECK(columns.heights[0].name == form.height);
    CHECK(columns.heights[0].unit == form.unit);
    CHECK(columns.heights[0].kind == form.kind);
  }
  const std::vector<std::string_view> attitude = {"roll_rate_degps", "rollDeg", "Pitch (deg)",
                                                  "mag_heading", "heading_true_deg"};
  const NamedColumns columns = recognise_columns(attitude);
  CHECK(columns.roll->name == "rollDeg");
  CHECK(columns.roll->unit == "deg");
  CHECK(columns.pitch->name == "Pitch (deg)");
  CHECK(columns.heading->name == "heading_true_deg");
}

TEST_CASE("An unnamed height is read as the one of four ways that lands", "[new-track]") {
  for (const double metres : {1.0, core::kFoot_m})
    for (const double geoid_m : {0.0, kGeoid_m}) {
      INFO(metres << " m, geoid " << geoid_m);
      const Guessed result =
          guessed(table("t,lat,lon,alt", [&](int t, double a, double b, double h) {
            return joined(t, a, b, (h + geoid_m) / metres);
          }));
      CHECK(result.guess.columns.height.unit == (metres == 1.0 ? "m" : "ft"));
      CHECK(result.guess.datum ==
            (geoid_m == 0.0 ? VerticalDatum::egm96 : VerticalDatum::ellipsoid));
      CHECK_THAT(result.notes, Contains("crosses the threshold at 15 m"));
    }
}

TEST_CASE("A single wrong height does not bend the guess", "[new-track]") {
  const Guessed result = guessed(table("t,lat,lon,alt", [](int t, double a, double b, double h) {
    return joined(t, a, b, t == 100 ? 35925.0 : h + kGeoid_m);
  }));
  CHECK(result.guess.columns.height.unit == "m");
  CHECK(result.guess.datum == VerticalDatum::ellipsoid);
}

TEST_CASE("Names are believed, and pressure heights are brought to the threshold", "[new-track]") {
  const auto with = [](const std::string& name, double added_ft) {
    return guessed(table("t,lat,lon," + name, [&](int t, double a, double b, double h) {
      return joined(t, a, b, h / core::kFoot_m + added_ft);
    }));
  };
  const Guessed baro = with("alt_baro_ft", 300.0);  // 11 hPa below standard
  CHECK(baro.guess.datum == VerticalDatum::egm96);
  CHECK(baro.guess.columns.height_offset_m ==
        Approx(-300.0 * core::kFoot_m).epsilon(0.0).margin(1.0));
  const Guessed geometric = with("alt_geom_ft", 0.0);  // by mistake above mean sea level
  CHECK(geometric.guess.datum == VerticalDatum::ellipsoid);
  CHECK(geometric.guess.columns.height_offset_m == 0.0);
}

TEST_CASE("Times are told apart by form and size", "[new-track]") {
  const auto unit_of = [](const std::string& name, const std::function<std::string(int)>& time) {
    const Guessed result =
        guessed(table(name + ",lat,lon,alt_msl_m", [&](int t, double a, double b, double h) {
          const std::string row = joined(0, a, b, h);
          return time(t) + row.substr(row.find(','));
        }));
    return result.guess.columns;
  };
  CHECK(unit_of("t", [](int t) { return std::to_string(t); }).time.unit == "s");
  const auto epoch_ms =
      unit_of("timestamp", [](int t) { return std::to_string(1551740145000 + 1000LL * t); });
  CHECK(epoch_ms.time.unit == "ms");
  CHECK(*epoch_ms.from_time_s ==
        Approx(1551740145.0 + 43.0).epsilon(0.0).margin(1.0));  // 5 km of 8 km left
  CHECK(unit_of("time", [](int t) { return std::to_string(1551740145 + t); }).time.unit == "s");
  CHECK(unit_of("time_ms", [](int t) { return std::to_string(1000 * t); }).time.unit == "ms");
  const auto iso = unit_of("UTC", [](int t) {
    char text[40];
    std::snprintf(text, sizeof text, "2009-02-13T23:%02d:%02dZ", 30 + t / 60, t % 60);
    return std::string(text);
  });
  CHECK(iso.time.unit == "iso8601");
  CHECK(*iso.from_time_s == Approx(1234567800.0 + 43.0).epsilon(0.0).margin(1.0));
}

TEST_CASE("The approach begins at the start distance and ends above the runway", "[new-track]") {
  const Guessed result = guessed(table("t,lat,lon,alt_msl_m", joined));
  const TrajectoryColumns& columns = result.guess.columns;
  CHECK(*columns.from_time_s == Approx(43.0));  // 8000 - 70 x 43 = 4990 m before it
  // 15 m over the threshold at 114.3 s; 3 m are left 229 m behind it, at 117.5 s.
  CHECK(*columns.to_time_s == Approx(117.0));
  CHECK(result.guess.path.size() == 75);
}

TEST_CASE("A flight is what lies in the air, whatever single heights say and wherever it began",
          "[new-track]") {
  // The flight ended at the first row near the ground.
  const Guessed wrong =
      guessed(table("t,lat,lon,alt_msl_m", [](int t, double a, double b, double h) {
        return joined(t, a, b, t == 50 ? 0.0 : h);
      }));
  CHECK(wrong.guess.path.size() == 75);
  CHECK(*wrong.guess.columns.to_time_s == Approx(117.0));
  // On the ground from 118 s on, then up again over the same runway.
  const Guessed again =
      guessed(table("t,lat,lon,alt_msl_m", [](int t, double a, double b, double h) {
        return joined(t, a, b, t < 124 ? h : 80.0 + 10.0 * (t - 123));
      }));
  CHECK(*again.guess.columns.to_time_s == Approx(117.0));
  // Taking off to the west at the threshold: 20 s on the runway.
  std::string departure = "t,lat,lon,alt_msl_m\n";
  for (int t = 0; t < 60; ++t)
    departure += joined(t, 52.0, 10.0 - 0.0008 * t, 80.5 + 5.0 * std::max(0, t - 20)) + "\n";
  const Guessed up = guessed(departure);
  CHECK(*up.guess.columns.from_time_s == Approx(21.0));
  CHECK(*up.guess.columns.to_time_s == Approx(59.0));
  CHECK_THAT(refused(table("t,lat,lon,alt_msl_m", [](int t, double a, double b,
                                                     double) { return joined(t, a, b, 81.0); })),
             Contains("E-RANGE flight = never 3 m above the ground in two rows"));
}

TEST_CASE("Of several approaches the first is taken, and that is told", "[new-track]") {
  std::string text = "t,lat,lon,alt_msl_m\n";
  for (int lap = 0; lap < 3; ++lap)
    for (int second = 0; second < 100; ++second) {
      const double before_m = 6000.0 - 70.0 * second;
      text += joined(1000 * lap + second, 52.0 - before_m / kMetresOfDegree, 10.0,
                     95.0 + 0.0524 * std::max(0.0, before_m)) +
              "\n";
    }
  const Guessed result = guessed(text);
  CHECK_THAT(result.notes, Contains("the first of 3 approaches"));
  CHECK(*result.guess.columns.to_time_s < 1000.0);
}

TEST_CASE("A flight that does not land here is taken while it is near, if it comes near",
          "[new-track]") {
  const Guessed result = guessed([] {
    std::string text = "t,lat,lon,alt_msl_m\n";
    for (int t = 0; t < 200; ++t)  // across the centre line, from west to east
      text += joined(t, 51.98, 9.9 + 0.001 * t, 400.0) + "\n";
    return text;
  }());
  CHECK_THAT(result.notes, Contains("no approach to this runway"));
  CHECK(result.guess.path.size() > 100);
  CHECK_THAT(
      refused(table("t,lat,lon,alt_msl_m",
                    [](int t, double a, double b, double h) { return joined(t, a - 2.0, b, h); })),
      Contains("E-RANGE flight = comes no nearer than") && Contains("transplant"));
}

// The last row alone was an approach, "never 3 m above the ground in two rows".
TEST_CASE("A flight away from the runway that ends before the threshold is no approach",
          "[new-track]") {
  // South to 2.7 km before the threshold, 300 m above the ground; faster and slower than positions wander.
  for (const double speed_mps : {70.0, 20.0}) {
    INFO(speed_mps);
    std::string text = "t,lat,lon,alt_msl_m\n";
    for (int t = 0; t <= 80; ++t)
      text +=
          joined(t, 52.0 - (2700.0 - speed_mps * (80 - t)) / kMetresOfDegree, 10.0, 380.0) + "\n";
    const Guessed away = guessed(text);
    CHECK_THAT(away.notes, Contains("no approach to this runway"));
    CHECK(away.guess.path.size() == 81);
  }
}

// Nothing was written of them: a frame between the two pieces would have been in the ground.
TEST_CASE("Of a flight that touches the ground elsewhere the longest piece in the air is taken",
          "[new-track]") {
  // From 4 km before the threshold to 4 km behind it, landing the other way: in the air but for `low`.
  const auto touching = [](const std::function<bool(int)>& low) {
    std::string text = "t,lat,lon,alt_msl_m\n";
    for (int t = 0; t <= 100; ++t)
      text += joined(t, 52.0 + (4000.0 - 80.0 * t) / kMetresOfDegree, 10.0,
                     low(t) ? 80.0 : 100.0 + 2.0 * std::abs(t - 40)) +
              "\n";
    return text;
  };
  const Guessed stop = guessed(touching([](int t) { return t >= 38 && t <= 42; }));
  CHECK(*stop.guess.columns.from_time_s == Approx(43.0));
  CHECK(*stop.guess.columns.to_time_s == Approx(100.0));
  CHECK_THAT(stop.notes, Contains("no approach to this runway") &&
                             Contains("the longest of 2 pieces in the air is taken"));
  // Before the stop and behind the last one there may be nothing; two low rows are wrong heights.
  const Guessed twice =
      guessed(touching([](int t) { return t < 5 || (t > 60 && t < 64) || t > 90; }));
  CHECK(*twice.guess.columns.from_time_s == Approx(5.0));
  CHECK(*twice.guess.columns.to_time_s == Approx(60.0));
  const Guessed wrong = guessed(touching([](int t) { return t == 38 || t == 39; }));
  CHECK(wrong.guess.path.size() == 101);
  CHECK_THAT(wrong.notes, !Contains("pieces"));
}

TEST_CASE("Latitude and longitude exchanged, radians, and tables of another kind", "[new-track]") {
  CHECK_THAT(refused(table("t,lat,lon,alt",
                           [](int t, double a, double b, double h) { return joined(t, b, a, h); })),
             Contains("E-RANGE lat, lon = exchanged"));
  const Guessed radians =
      guessed(table("t,lat,lon,alt_msl_m", [](int t, double a, double b, double h) {
        return joined(t, core::radians(a), core::radians(b), h);
      }));
  CHECK(radians.guess.columns.latitude.unit == "rad");
  CHECK_THAT(refused("t;lat;lon;alt\n1;52;10;80\n"), Contains("separated by ';'"));
  CHECK_THAT(refused("time,x,y\n1,2,3\n"),
             Contains("E-PARSE latitude = no column among time, x, y") &&
                 Contains("E-PARSE longitude") && Contains("E-PARSE height"));
  CHECK_THAT(refused("t,lat,lon,alt\nnoon,52,10,80\n"), Contains(":2: E-PARSE t = \"noon\""));
  CHECK_THAT(refused("t,lat,lon,alt\n"), Contains("none with a time and a position"));
  CHECK_THAT(refused(""), Contains("E-PARSE header"));
}

TEST_CASE("The recorded flight to Denver is read as its description says", "[new-track]") {
  const auto file = tests::shared_data("trajectories/kden_rwy26_dal1812.csv");
  if (!file) return;
  TrackReference denver;
  // scenes/innsbruck-26-airliner: threshold, elevation above mean sea level, geoid, bearing.
  denver.threshold = {core::radians(39.8772011), core::radians(-104.6190033), 1612.7};
  denver.bearing_rad = core::radians(270.69);
  denver.runway_length_m = 3658.0;
  denver.geoid_m = -18.45;
  denver.start_distance_m = 5000.0;
  denver.ground_m = [](const core::Geodetic&) { return std::optional(1612.7); };
  core::ProblemList problems;
  Notes notes;
  const auto guess = guess_track(*file, denver, notes, problems);
  INFO(all_of(problems));
  REQUIRE(guess.has_value());
  CHECK(guess->columns.height.name == "alt_geom_ft");
  CHECK(guess->columns.height.unit == "ft");
  CHECK(guess->datum == VerticalDatum::ellipsoid);
  CHECK(guess->columns.time.unit == "s");
  CHECK(guess->columns.heading.name == "true_heading_deg");
  CHECK(*guess->columns.from_time_s > 1738785100.0);
  // Altitudes in steps of 25 ft: the roll-out seems to lie 6 m above the threshold.
  CHECK(*guess->columns.to_time_s < 1738785280.0);
}
