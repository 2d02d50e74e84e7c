// The ground of a scene while it is being built: frame, runways in local metres, posts, and how
// places and heights in the scene's datum become local coordinates.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/errors.h"
#include "materials/library/material_library.h"
#include "scenes/description.h"
#include "terrain/height_field.h"
#include "terrain/local_frame.h"
#include "terrain/runway.h"

namespace fanbeam::scenes {

// Material ids of names, with E-REF for unknown ones. Of a library that is not sound, which has been told, every
// name may have been one.
class MaterialNames {
 public:
  MaterialNames(const materials::MaterialLibrary& library, core::ProblemList& problems,
                bool sound = true)
      : library_(library), problems_(problems), sound_(sound) {}
  bool knows(const std::string& name) const;
  // Tells a name as unknown; id() tells it no more.
  void refuse(const std::string& name, const core::Place& place, const std::string& field) const;
  terrain::MaterialId id(const std::string& name, const core::Place& place,
                         const std::string& field) const;
  // Indices in the library of the materials asked for so far.
  const std::set<std::size_t>& used() const { return used_; }

 private:
  const materials::MaterialLibrary& library_;
  core::ProblemList& problems_;
  bool sound_;
  mutable std::set<std::size_t> used_;
  mutable std::set<std::string> refused_;
};

class NaturalGround;

// How near a runway a place is: what grows there depends on it.
enum class Zone { open, approach, airfield };

class Ground {
 public:
  // Loads rasters, generates what is to be generated, flattens the runway strips. W-OVERLAP for two
  // runways whose lines differ by more than 0.5 m where their strips overlap, both of [[airport]] by 2 m.
  Ground(const SceneDescription& scene, const terrain::LocalFrame& frame,
         const MaterialNames& names, core::ProblemList& problems);

  const terrain::HeightField& field() const { return field_; }
  const std::vector<terrain::Runway>& runways() const { return runways_; }
  // Height of a plain and mean of generated country, in the scene's datum.
  double level_m() const;

  // Height above the ellipsoid (or the scene's unknown datum) of a height in the datum at a
  // position.
  double ellipsoidal_m(double height_m, double latitude_rad, double longitude_rad,
                       core::VerticalDatum datum) const;

  // Landing on the named end: threshold and direction; nothing when there is no such end, which check_names
  // (scene_names.h) tells.
  struct LandingEnd {
    const terrain::Runway* runway = nullptr;
    const RunwayDescription* description = nullptr;
    int end = 0;
    glm::dvec2 threshold_m{0.0}, direction{0.0, 1.0};
  };
  std::optional<LandingEnd> landing_end(const std::string& name) const;
  // The threshold's position with its ellipsoidal height, and the true bearing of landing.
  core::Geodetic threshold(const LandingEnd& end) const;
  double bearing_rad(const LandingEnd& end) const;

  // Local east-north of a spot; E-RANGE outside the terrain, nothing as of landing_end.
  std::optional<glm::dvec2> local_m(const Spot& spot) const;
  // The point `above_m` over the ground there.
  glm::dvec3 on_ground_m(glm::dvec2 position_m, double above_m) const;
  glm::dvec2 local_m(double latitude_rad, double longitude_rad) const;
  // The point at a height in the scene's datum there.
  glm::dvec3 at_height_m(glm::dvec2 position_m, double height_m) const;
  // Of a position whose height counts from the scene's datum.
  glm::dvec3 local_m(const core::Geodetic& position) const;

 private:
  terrain::Runway place_runway(const RunwayDescription& description, const NaturalGround& natural,
                               const MaterialNames& names) const;
  // Of a runway's end whose elevation is not known, in the scene's datum: on the straight line that the
  // elevation data under the runway come nearest to.
  double elevation_on_ground_m(const RunwayDescription& description, int end,
                               const NaturalGround& natural) const;
  // Of runways whose strips overlap at different heights.
  void tell_steps() const;
  void shape(const NaturalGround& natural);
  // Local up of a post, nothing where the elevation data end.
  std::optional<double> post_up_m(const NaturalGround& natural, glm::dvec2 position_m) const;
  Zone zone(glm::dvec2 position_m) const;

  const SceneDescription& scene_;
  const terrain::LocalFrame& frame_;
  core::ProblemList& problems_;
  std::vector<terrain::Runway> runways_;
  terrain::HeightField field_;
};

}  // namespace fanbeam::scenes
