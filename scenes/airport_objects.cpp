#include "scenes/airport_objects.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "scenes/airport/airport_reader.h"
#include "scenes/target_reader.h"
#include "terrain/geoid.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

using core::ConfigTable;

// ICAO Annex 14 Vol. I (8th edition), 5.3.18: at most 60 m apart on straight edges, closer on curves.
constexpr double kTaxiwayLightSpacing_m = 40.0;
constexpr double kTaxiwayLightHeight_m = 0.3;
// 5.3.5: four units in a bar, 9 m apart.
constexpr int kPapiUnits = 4;
constexpr double kPapiSpacing_m = 9.0, kPapiHeight_m = 0.6;
// Where the file does not say how wide a runway is.
constexpr double kAssumedWidth_m = 45.0;

class AirportTable {
 public:
  AirportTable(ConfigTable& table, ObjectNames& objects, SceneDescription& scene)
      : table_(table), objects_(objects), scene_(scene), place_(table.place("")) {}

  // Nothing where the file could not be read: then the table's own keys are still looked at.
  void add(const std::optional<Airport>& airport) {
    const double light_rcs_m2 = rcs_m2_from(table_, "light_rcs_dBsm", -10.0);
    const std::vector<std::string> wanted = table_.texts("runways");
    const bool taxiways = table_.boolean("taxiways", true), papi = table_.boolean("papi", true);
    if (!airport) return;
    for (const std::string& name : wanted) check_name(name, *airport);
    if (level_is_unknown() && scene_.terrain.elevation.empty())
      table_.error(
          core::ErrorClass::range, "file", "elevations above mean sea level",
          "vertical_datum = \"ellipsoid\" or \"egm96\", or [terrain] elevation for runways to "
          "lie on: the scene's heights count from an unknown level");
    for (const AirportRunway& runway : airport->runways)
      if (!runway.surface.water && is_wanted(runway, wanted))
        add_runway(*airport, runway, light_rcs_m2);
    if (taxiways) add_taxiways(*airport, light_rcs_m2);
    if (papi) add_papis(*airport);
  }

 private:
  // Then nothing says how high above the file's sea level the scene's heights begin.
  bool level_is_unknown() const { return scene_.datum == core::VerticalDatum::scene; }

  static bool is_wanted(const AirportRunway& runway, const std::vector<std::string>& wanted) {
    if (wanted.empty()) return true;
    return std::any_of(wanted.begin(), wanted.end(), [&](const std::string& name) {
      return is_same_runway(runway.ends[0].name, name) || is_same_runway(runway.ends[1].name, name);
    });
  }

  void check_name(const std::string& name, const Airport& airport) {
    std::string known;
    for (const AirportRunway& runway : airport.runways) {
      if (is_wanted(runway, {name})) return;
      known += (known.empty() ? "" : ", ") + runway.ends[0].name + "/" + runway.ends[1].name;
    }
    table_.error(core::ErrorClass::ref, "runways", "\"" + name + "\"",
                 "ends of " + airport.ident + "'s runways, " + known);
  }

  void add_runway(const Airport& airport, const AirportRunway& from, double light_rcs_m2) {
    RunwayDescription runway;
    runway.place = place_;
    runway.from_airport = true;
    for (const int end : {0, 1}) {
      runway.ends[end].name = from.ends[end].name;
      runway.ends[end].displaced_m = from.ends[end].displaced_m;
      runway.ends[end].displaced_place = from.place;
      place_end(airport, from.ends[end], runway.ends[end]);
      if (from.ends[end].approach_lights.value_or(false))
        runway.approach_lights.push_back(from.ends[end].name);
    }
    runway.width_m = from.width_m > 0.0 ? from.width_m : kAssumedWidth_m;
    runway.surface = from.surface.material;
    runway.shoulder_material = from.surface.material;
    runway.shoulder_m = from.shoulders.value_or(false) ? runway.shoulder_m : 0.0;
    runway.markings = from.markings.value_or(from.surface.paved);
    runway.edge_lights = from.edge_lights.value_or(from.surface.paved);
    runway.light_rcs_m2 = light_rcs_m2;
    scene_.runways.push_back(std::move(runway));
  }

  void place_end(const Airport& airport, const AirportRunwayEnd& from, RunwayEndDescription& end) {
    end.pavement_end = from.pavement_end;
    end.on_ground = (!from.elevation_m || level_is_unknown()) && !scene_.terrain.elevation.empty();
    if (end.on_ground) return;
    const std::optional<double> elevation_m =
        from.elevation_m ? from.elevation_m : airport.elevation_m;
    if (!elevation_m) {
      table_.error(core::ErrorClass::ref, "file", "no elevation of " + from.name,
                   "a file that has it, or [terrain] elevation");
      return;
    }
    end.pavement_end.height_m = *elevation_m;
    if (scene_.datum == core::VerticalDatum::ellipsoid)
      end.pavement_end.height_m =
          terrain::ellipsoidal_height_m(end.pavement_end, core::VerticalDatum::egm96);
  }

  void add_taxiways(const Airport& airport, double light_rcs_m2) {
    for (const AirportPavement& pavement : airport.pavements)
      scene_.pavements.push_back(
          {pavement.surface.material, pavement.rings, place_, pavement.place});
    LightRowDescription lights{"taxiway light", {}, kTaxiwayLightHeight_m, light_rcs_m2, place_};
    for (const AirportLine& line : airport.taxiway_lights) add_lights(line, lights.at);
    if (!lights.at.empty()) scene_.light_rows.push_back(std::move(lights));
  }

  // Evenly from the first point on.
  static void add_lights(const AirportLine& line, std::vector<core::Geodetic>& at) {
    double to_next_m = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const terrain::GeodesicLine leg = terrain::geodesic_between(line[i], line[i + 1]);
      for (; to_next_m < leg.length_m; to_next_m += kTaxiwayLightSpacing_m)
        at.push_back(terrain::geodesic_point(line[i], leg.azimuth_rad, to_next_m));
      to_next_m -= leg.length_m;
    }
  }

  void add_papis(const Airport& airport) {
    if (airport.other_aids > 0)
      table_.problems().warning("SKIPPED", place_, "visual aids of " + airport.ident,
                                std::to_string(airport.other_aids), "left out: no PAPI");
    if (airport.papis.empty()) return;
    const materials::TypicalObject* unit = objects_.named("papi_unit", place_, table_.problems());
    if (unit == nullptr) return;
    for (const AirportPapi& papi : airport.papis)
      for (int i = 0; i < kPapiUnits; ++i) {
        const core::Geodetic at =
            terrain::geodesic_point(papi.at, papi.heading_rad + core::kPi / 2.0,
                                    kPapiSpacing_m * (i - (kPapiUnits - 1) / 2.0));
        TargetDescription target;
        target.name = "PAPI";
        target.from_airport = true;
        target.rcs = unit->rcs();
        target.swerling = unit->fluctuation;
        target.heading_rad = papi.heading_rad + core::kPi;  // looks at who lands
        Spot spot;
        spot.latitude_rad = at.latitude_rad;
        spot.longitude_rad = at.longitude_rad;
        spot.field = table_.path("file");
        spot.place = place_;
        target.path.push_back({0.0, spot, kPapiHeight_m});
        target.place = place_;
        scene_.targets.push_back(std::move(target));
      }
  }

  ConfigTable& table_;
  ObjectNames& objects_;
  SceneDescription& scene_;
  core::Place place_;
};

}  // namespace

void read_airport_table(ConfigTable& table, const DataSearch& search, ObjectNames& objects,
                        SceneDescription& scene) {
  const std::filesystem::path file = search.find(table, "file");
  const std::string ident = table.required_text("ident");
  std::optional<Airport> airport;
  if (!file.empty() && !ident.empty()) {
    airport = read_airport(file, ident, table.problems());
    scene.files.push_back(file);
  }
  AirportTable(table, objects, scene).add(airport);
}

}  // namespace fanbeam::scenes
