// Decides which way a scene is seen, by rays or by azimuth slices: a pure function of the user's
// wish and of facts about the scene and its plan.
//
// Rays (ray_caster.h) show every geometry; they are the reference that all errors are stated
// against. Over buildings, and wherever double bounce runs, slices (profile/profile_caster.h) come as close in
// half of their time to all of it (docs/performance-notes.md), so `automatic`, the default, takes them
// wherever they show everything:
//   neither                         both come as close in the same time: rays
//   a fan wider than 150 deg        headings of slices would meet behind the sensor: rays
//   nothing but ground and prisms   slices, with any antenna
//   models or prisms over open air  a level antenna sees each azimuth in a vertical half-plane:
//                                   those azimuths go to rays, all others to slices. With a tilted
//                                   antenna or a cone scan an azimuth is no half-plane: rays alone,
//                                   for the frames far from the origin, or for all.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/constants.h"
#include "core/errors.h"
#include "renderer/casting/sampling.h"

namespace fanbeam::renderer {

// What slices span at most; with the azimuth beam, where they draw a picture.
inline constexpr double kWidestSlices_rad = 150.0 * core::kPi / 180.0;

enum class CasterWish { rays, profile, automatic };

struct CasterFacts {
  std::size_t buildings = 1;   // Solids::prisms
  std::size_t others = 0;      // models, CityJSON, prisms over open air: Solids::others
  bool double_bounce = false;  // as the scene's plan says
  bool stabilised = true;      // the antenna, against roll and pitch; others count as tilted
  bool plane_scan = true;
  // Smallest and largest angle between the vertical at the aircraft and that of the scene's origin: on a
  // round Earth even a stabilised antenna is not level in the scene far from its origin.
  double least_vertical_turn_rad = 0.0, vertical_turn_rad = 0.0;
  double fan_rad = 0.0;  // field of view with what the azimuth beam reaches beyond it
};

struct CasterChoice {
  CasterKind chosen = CasterKind::rays;
  CasterWish wish = CasterWish::automatic;
  std::string reason;         // one sentence
  std::string why_no_slices;  // empty where they can show the scene
  std::size_t others = 0;     // what stands in azimuths that slices leave to rays
};

// Throws InputError E-UNSUPPORTED of the field "caster" at `place` when slices are forced and cannot
// show the scene.
CasterChoice choose_caster(CasterWish wish, const CasterFacts& facts,
                           const core::Place& place = {});

// By the value of CasterWish: the words of the command line, scene files and run.json.
inline constexpr std::array<std::string_view, 3> kCasterWishes = {"rays", "profile", "auto"};
// Of one of these words.
CasterWish caster_wish(std::string_view word);
std::string_view name_of(CasterWish wish);
std::string_view name_of(CasterKind caster);

}  // namespace fanbeam::renderer
