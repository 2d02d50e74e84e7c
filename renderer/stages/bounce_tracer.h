// What one direction of the antenna brings back after two or three reflections.
//
// A ray from the radar O meets a surface A at p, is mirrored there with the power reflection rho,
// and meets a surface B at q, which scatters. With R1 = |Op|, R2 = |pq|, R3 = |qO|, K the radar
// constant, g one-way gains, L losses over the whole path, psi_i and psi_s the grazing angles of
// the incoming and the outgoing ray at B, h half way between their directions and n the normal:
//
//   O A B O and O B A O   dP = 4 K g(p) g(q) rho sigma_B / sin(psi_i) L dOmega / R3^2
//                         at the range (R1 + R2 + R3) / 2
//   O A B A O             dP = K g(p)^2 rho^2 gamma_B(sin psi_i) L dOmega / (R1 + R2)^2
//                         at the range R1 + R2
//   sigma_B and gamma_B: bistatic_nrcs.h
//
// The plane mirror keeps the ray's solid angle, so B's lit area is (R1 + R2)^2 dOmega / sin psi_i.
// The factor 4: the two senses of the first route have the same length and, by reciprocity, the
// same amplitude. Directions whose first surface does not reflect bring nothing here, so no route
// is counted twice. docs/physics/double-bounce.md has the derivation, sources and limits.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/stages/bistatic_nrcs.h"
#include "renderer/stages/mirrors.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {

// An echo with its power per solid angle of the first ray, at azimuth gain 1 around `azimuth_rad`,
// the mean of the first and the last direction.
struct BounceEcho {
  double range_m = 0.0;
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
  double density_W_per_rad2 = 0.0;
};

struct Bounce {
  bool met = false;  // a mirrored ray met something, whether or not anything came back
  BounceEcho pair;   // O A B O with O B A O
  BounceEcho image;  // O A B A O
};

struct AntennaRay {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
};

class BounceTracer {
 public:
  // `world` must outlive the tracer.
  explicit BounceTracer(const World& world);

  bool any() const { return mirrors_.any(); }

  static constexpr int kAtOnce = 8;
  // Traces `count` rays, at most kAtOnce. Returns the number of rays cast. Thread-safe.
  std::uint64_t trace(const sensors::AntennaFrame& antenna, const AntennaRay* rays, int count,
                      Bounce* bounces) const;

 private:
  struct Lane;
  bool mirror(const sensors::AntennaFrame& antenna, const terrain::RayPacket<kAtOnce>& packet,
              int i, Lane& lane) const;
  // True when a shadow ray was cast.
  bool weigh(const sensors::AntennaFrame& antenna, const AntennaRay& ray, const Lane& lane,
             const terrain::RayPacket<kAtOnce>& packet, int i, Bounce& bounce) const;
  double loss_factor(const glm::dvec3& a_m, const glm::dvec3& b_m, double length_m) const;

  const World& world_;
  std::vector<BistaticNrcs> nrcs_;  // by material id
  Mirrors mirrors_;
  sensors::TwoWayTable elevation_gain_;
  double radar_constant_W_m2_ = 0.0;
  double faintest_ = 0.0;  // a mirror that keeps less is not followed
};

}  // namespace fanbeam::renderer
