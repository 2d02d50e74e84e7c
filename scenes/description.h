// A scene as its file says it: checked values in SI, nothing loaded or built yet. One struct per
// table of scene.toml. docs/scene-format.md documents every key.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "atmosphere/weather.h"
#include "core/config_table.h"
#include "core/geodetic.h"
#include "core/swerling.h"
#include "materials/library/surface_state.h"
#include "materials/rcs/rcs.h"
#include "renderer/plan/caster_choice.h"
#include "scenes/trajectory/ils_approach.h"
#include "scenes/trajectory/trajectory_attitude.h"
#include "scenes/trajectory/trajectory_csv.h"
#include "scenes/trajectory/trajectory_packets.h"
#include "sensors/sensor.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {

// A horizontal place: geodetic, or relative to the named end of one of the scene's runways.
struct Spot {
  bool on_runway = false;
  double latitude_rad = 0.0, longitude_rad = 0.0;
  // Seen on landing on the named threshold: metres behind it and metres left of the centre line.
  std::string runway_end;
  double behind_threshold_m = 0.0, left_m = 0.0;
  std::string field;  // "box[2].at"
  core::Place place;
};

struct TerrainDescription {
  enum class Source { plane, rolling, raster };
  Source source = Source::plane;
  double west_m = -5000.0, south_m = -5000.0, east_m = 5000.0, north_m = 5000.0;
  double spacing_m = 10.0;
  std::string material = "short_grass";  // where no land cover says otherwise
  // rolling
  double relief_m = 8.0, field_size_m = 260.0, wood_share = 0.15, canopy_m = 14.0;
  std::uint64_t seed = 1;
  std::vector<std::string> fields;
  std::string wood_material = "forest", airfield_material = "short_grass";
  double airfield_beyond_m = 250.0;  // kept grass on all sides of the runway strip
  // raster
  std::filesystem::path elevation;
  bool fill_voids = false;
  double quantisation_step_m = 0.0;  // see elevation_raster.h
  std::filesystem::path land_cover;
  std::map<int, std::string> classes;
  core::Place place, elevation_place, land_cover_place;
};

struct RunwayEndDescription {
  std::string name;  // "26": the designator of a landing on this end's threshold
  core::Geodetic pavement_end;
  bool on_ground = false;  // as high as the elevation data say, not as pavement_end
  double displaced_m = 0.0;
  core::Place displaced_place;
};

struct RunwayDescription {
  RunwayEndDescription ends[2];
  double width_m = 45.0, shoulder_m = 7.5, strip_half_width_m = 75.0, blend_m = 100.0;
  bool markings = true, edge_lights = true;
  bool from_airport = false;                 // of [[airport]], which has no key for the strip
  std::vector<std::string> approach_lights;  // names of ends
  double approach_light_slope = 0.0;
  double light_rcs_m2 = 0.0;
  std::string surface = "asphalt_worn", shoulder_material = "asphalt_worn",
              marking_material = "paint";
  double fence_beyond_m = 0.0;  // 0 for no fence
  double fence_height_m = 2.4, fence_spacing_m = 3.0, fence_post_rcs_m2 = 0.0;
  core::Place place;
};

// A rectangle in runway coordinates painted on the ground: aprons, taxiways.
struct SurfaceDescription {
  std::string runway_end, material;
  double from_behind_m = 0.0, to_behind_m = 0.0, from_left_m = 0.0, to_left_m = 0.0;
  core::Place place;
};

// A taxiway or apron of an airport's file: the outline, then holes.
struct PavementDescription {
  std::string material;
  std::vector<std::vector<core::Geodetic>> rings;
  core::Place place;  // of the scene's [[airport]]
  core::Place row;    // of the airport's file
};

struct LightRowDescription {
  std::string name;
  std::vector<core::Geodetic> at;
  double above_ground_m = 0.0, rcs_m2 = 0.0;
  core::Place place;
};

struct ModelDescription {
  std::string name;
  std::filesystem::path file;
  std::filesystem::path root;  // the folder its buffers must lie in
  Spot at;
  double above_ground_m = 0.0, heading_rad = 0.0;
  std::optional<double> height_m;  // in the scene's datum, instead of above the ground
  std::map<std::string, std::string> materials;  // glTF material name to ours
  std::string default_material = "metal";
  std::filesystem::path open_material;       // .xoma or .xomm, empty for none
  std::filesystem::path open_material_root;  // the folder that all files it names must lie in
  core::Place place;
};

struct BoxDescription {
  std::string name;
  Spot at;
  double length_m = 0.0, width_m = 0.0, height_m = 0.0,
         heading_rad = 0.0;  // length along the heading
  std::string wall_material = "wall", roof_material = "roof";
  core::Place place;
};

struct BuildingsDescription {
  std::filesystem::path file;
  std::string height_property = "render_height", min_height_property = "render_min_height";
  bool base_is_mean = false;
  std::string wall_material = "wall", roof_material = "roof";
  // Of CityJSON alone.
  std::string crs;                // "EPSG:28992", where the file does not say
  bool heights_as_filed = false;  // else each building is moved up or down onto the scene's ground
  std::map<std::string, std::string> surface_materials;  // "Window" to ours
  // Keys given that only one kind of file has a use for; which kind it is, is not known yet.
  struct Key {
    std::string path;  // "buildings[0].crs"
    core::Place place;
  };
  std::vector<Key> footprint_keys, city_keys;
  core::Place place;
};

struct TargetDescription {
  struct Waypoint {
    double time_s = 0.0;
    Spot at;
    double above_ground_m = 0.0;
  };
  // Fore and aft along the way: a leg, an arm.
  struct Swing {
    double amplitude_m = 0.0, period_s = 1.0;
    double phase_rad = 0.0;  // amplitude sin(2 pi t / period + phase)
    // The straight legs, of a 192nd of the period or less, that a part of the way becomes.
    double legs(double duration_s) const { return std::ceil(192.0 * duration_s / period_s); }
  };
  std::string name;
  materials::RcsModel rcs;
  std::optional<Swing> swing;
  double heading_rad = 0.0, tilt_rad = 0.0;  // boresight: clockwise from north, up from horizontal
  core::Swerling swerling = core::Swerling::steady;
  std::vector<Waypoint> path;
  bool from_airport = false;  // left out beyond the terrain, as its lights are
  core::Place place;
};

// Another radar on a target, which `fanbeam fmcw` hears (signal/synthesis/interference.h).
struct InterfererDescription {
  std::string name;
  std::string target;  // the [[target]] that carries it
  double eirp_W = 0.0;
  double centre_frequency_Hz = 0.0, bandwidth_Hz = 0.0;
  bool falling = false;
  double ramp_s = 0.0, interval_s = 0.0;
  double start_s = 0.0;  // one of its chirps begins, on the scene's clock
  core::Place place;
};

struct WireDescription {
  double radius_m = 0.01;
  double coherence_length_m = 0.0;         // 0 for the distance of two points
  std::optional<double> polarisation_rad;  // else from the sensor's and the line's slope
};

// A wire, pole or fence: point scatterers along a straight line. What stands at each of them is
// one of three: the line's even cross-section, a piece of wire, one typical object.
struct LineDescription {
  std::string name;
  Spot from, to;
  double from_above_m = 0.0, to_above_m = 0.0;
  double rcs_m2_per_m = 0.0, spacing_m = 1.0;
  std::optional<WireDescription> wire;
  std::optional<materials::RcsModel> object;
  core::Swerling swerling = core::Swerling::steady;  // of the object
  core::Place place;
};

// A rain cell whose place on the ground is still to be found.
struct RainCellDescription {
  Spot at;
  atmosphere::RainCell cell;  // without its centre
};

struct TrajectoryDescription {
  enum class Kind { none, ils, file, fixed };
  Kind kind = Kind::none;
  // file
  std::filesystem::path file;
  TrackPackets packets;       // where the file holds a simulator's
  TrajectoryColumns columns;  // of packets the windows and the offset of heights alone
  core::VerticalDatum datum = core::VerticalDatum::scene;
  AttitudeAssumptions assumptions;
  // Moves the flight: from this runway end to the named end of the scene's runway.
  bool transplanted = false;
  core::Geodetic source_threshold;
  double source_bearing_rad = 0.0;
  std::string onto_end;
  // ils
  std::string ils_end;
  IlsApproach ils;
  // fixed
  Spot at;
  double above_ground_m = 0.0, heading_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
  core::Place place;
};

// [[database]]: another scene that a CIGI host of fanbeam live may switch to by its number.
struct DatabaseDescription {
  int number = 0;     // 2 to 127; this scene is 1
  std::string scene;  // a folder beside this scene's, or a shipped scene's name
};

// [flight_volume]: heights in the scene's datum that an aircraft may have.
struct FlightHeights {
  std::optional<double> lowest_m, highest_m;
  bool stated = false;  // the table is there
  core::Place place;
};

struct SceneDescription {
  std::filesystem::path folder;
  std::string name, title;
  core::Geodetic origin;
  core::VerticalDatum datum = core::VerticalDatum::ellipsoid;
  terrain::EarthModel earth = terrain::EarthModel::wgs84;
  TerrainDescription terrain;
  std::vector<RunwayDescription> runways;
  std::vector<PavementDescription> pavements;
  std::vector<LightRowDescription> light_rows;
  std::vector<SurfaceDescription> surfaces;
  std::vector<ModelDescription> models;
  std::vector<BoxDescription> boxes;
  std::vector<BuildingsDescription> buildings;
  std::vector<TargetDescription> targets;
  std::vector<InterfererDescription> interferers;
  std::vector<LineDescription> lines;
  atmosphere::Weather weather;  // its rain cells are in `rain_cells`, not placed yet
  std::vector<RainCellDescription> rain_cells;
  sensors::Sensor sensor;
  std::filesystem::path signal_file;  // its radar at signal level; empty: none is named
  std::filesystem::path material_library;
  bool allow_extrapolation = false;  // materials may be used outside what their models know
  materials::SurfaceState surface_state = materials::SurfaceState::dry;
  TrajectoryDescription trajectory;
  FlightHeights flight_heights;
  std::vector<DatabaseDescription> databases;
  // Of the scene's [accuracy]; 0 when it does not say.
  double rays_per_cell = 0.0, accuracy_grey = 0.0, time_budget_ms = 0.0;
  renderer::CasterWish caster = renderer::CasterWish::automatic;
  core::Place caster_place;
  bool sample = false;  // frames show one realisation, not the expected power
  // False where a runway could not be read, or its name: any name of a runway may be one of those.
  bool runways_known = true;
  // In scene.toml; empty without such a file, and once the scene is built.
  core::KeyPlaces place_of_key;
  core::ResolvedConfig resolved;  // every setting with its default, for run.json
  // What the scene is made of beside scene.toml; files of models and buildings once they are read.
  std::vector<std::filesystem::path> files;
};

}  // namespace fanbeam::scenes
