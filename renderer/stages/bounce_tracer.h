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

#include "renderer/surfaces/bistatic_nrcs.h"
#include "renderer/surfaces/mirrors.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {

// An echo with its power per solid angle of the first ray, at azimuth gain 1 around `azimuth_rad`,
// the mean of the first and the last direction; of it `left` comes through the air. The rates are derivatives by the first ray's
// elevation, on planes through the facets that were hit: what a ray stands for in elevation lies
// along them.
struct BounceEcho {
  double range_m = 0.0, range_m_per_rad = 0.0;
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0, elevation_rate = 0.0;
  double density_W_per_rad2 = 0.0, left = 1.0;
};

struct Bounce {
  BounceEcho pair;   // O A B O with O B A O
  BounceEcho image;  // O A B A O
};

struct AntennaRay {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
};

class BounceTracer {
 public:
  // `world` must outlive the tracer. `noise`: the receiver's mean noise is in every cell that shows.
  BounceTracer(const World& world, bool noise);

  bool any() const { return mirrors_.any(); }

  // What each of `rays` brings back that `bounces` does not hold yet, as the last ones. Neighbours in
  // the list are best neighbours in angle too. Returns the number of rays cast. Thread-safe.
  std::uint64_t trace(const sensors::AntennaFrame& antenna, const std::vector<AntennaRay>& rays,
                      std::vector<Bounce>& bounces) const;

 private:
  struct Hit;
  struct Lane;
  struct Return;
  struct Way;
  struct Scratch;
  template <int N>
  class Packets;
  template <int N>
  std::uint64_t trace_packets(const sensors::AntennaFrame& antenna,
                              const std::vector<AntennaRay>& rays,
                              std::vector<Bounce>& bounces) const;
  template <int N>
  void find_mirrors(const sensors::AntennaFrame& antenna, const std::vector<AntennaRay>& rays,
                    std::size_t first, Packets<N>& packets, std::vector<Lane>& lanes) const;
  template <int N>
  void follow(const sensors::AntennaFrame& antenna, const std::vector<AntennaRay>& rays,
              const std::vector<Lane>& lanes, Packets<N>& packets, std::vector<Bounce>& bounces,
              std::vector<Return>& returns) const;
  template <int N>
  void look_back(const sensors::AntennaFrame& antenna, const std::vector<Return>& returns,
                 Packets<N>& packets, std::vector<Bounce>& bounces) const;
  bool is_cone() const { return world_.sensor.scan.surface == sensors::ScanSurface::cone; }
  bool mirror(const sensors::AntennaFrame& antenna, const Hit& hit, Lane& lane) const;
  double farthest_m(const Lane& lane) const;
  bool weigh(const sensors::AntennaFrame& antenna, const AntennaRay& ray, const Lane& lane,
             const Hit& hit, Bounce& bounce) const;
  Way way_to(const sensors::AntennaFrame& antenna, const Lane& lane, const Hit& hit) const;
  double jacobian(const AntennaRay& ray) const;
  BounceEcho image_of(const AntennaRay& ray, const Lane& lane, const Hit& hit,
                      const Way& way) const;
  // Without asking whether B sees O.
  BounceEcho pair_of(const sensors::AntennaFrame& antenna, const AntennaRay& ray, const Lane& lane,
                     const Hit& hit, const Way& way) const;
  bool within_beam(const sensors::AntennaFrame& antenna, const glm::dvec3& first,
                   const glm::dvec3& last) const;
  // Whether an echo can show, were the whole beam as bright.
  bool shows(const BounceEcho& echo) const;
  double loss_dB(const glm::dvec3& a_m, const glm::dvec3& b_m, double length_m) const;

  const World& world_;
  const std::vector<BistaticNrcs>& nrcs_;  // by material id
  Mirrors mirrors_;
  sensors::TwoWayTable elevation_gain_;
  double beam_tangent_ = 0.0;
  double radar_constant_W_m2_ = 0.0;
  std::vector<double> faintest_W_per_rad2_;  // echo by range cell: less need not be followed
  double faintest_mirror_ = 0.0;             // that keeps less is not followed
};

}  // namespace fanbeam::renderer
