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

#include "renderer/stages/bounce_weights.h"
#include "renderer/surfaces/mirrors.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::renderer {

struct AntennaRay {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
};

class BounceTracer {
 public:
  // `world` must outlive the tracer. `noise`: the receiver's mean noise is in every cell that shows.
  BounceTracer(const World& world, bool noise);

  bool any() const { return mirrors_.any(); }

  // Adds to `echoes` what the rays from `first` on bring back: up to two echoes of each, that of
  // O A B O at the shorter range. Neighbours in the list are best neighbours in angle too;
  // `mirrored`: whether they are close enough to be neighbours still behind a mirror. Returns the
  // number of rays cast. Thread-safe.
  std::uint64_t trace(const sensors::AntennaFrame& antenna, const std::vector<AntennaRay>& rays,
                      std::size_t first, terrain::Packing mirrored,
                      std::vector<BounceEcho>& echoes) const;

 private:
  struct Block;
  template <int N>
  std::uint64_t trace_packets(const sensors::AntennaFrame& antenna,
                              const std::vector<AntennaRay>& rays, std::size_t first,
                              terrain::Packing mirrored, std::vector<BounceEcho>& echoes) const;
  template <int N>
  void trace_block(const AntennaRay* rays, int count, std::size_t first, terrain::Packing mirrored,
                   Block& block, std::vector<BounceEcho>& echoes) const;
  void find_mirrors(Block& block) const;

  const World& world_;
  Mirrors mirrors_;
  BounceWeights weights_;
  double beam_tangent_ = 0.0;
};

}  // namespace fanbeam::renderer
