// Energy, reciprocity and the monostatic limit of the bistatic law, and what is left to mirrors.
#include "renderer/surfaces/bistatic_nrcs.h"

#include <catch2/catch.hpp>

#include "core/constants.h"
#include "core/units.h"
#include "materials/library/material_library.h"
#include "renderer/surfaces/mirrors.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using renderer::BistaticNrcs;
using renderer::NrcsTable;
using tests::kRough;

namespace {

// Of what arrives at `sin_in`, summed over directions given as unit vectors.
double share_by_vectors(const BistaticNrcs& nrcs, double sin_in) {
  constexpr int kSines = 128, kTurns = 180;
  const glm::dvec3 towards_source(-std::sqrt(1.0 - sin_in * sin_in), 0.0, sin_in);
  double sum = 0.0;
  for (int i = 0; i < kSines; ++i)
    for (int k = 0; k < kTurns; ++k) {
      const double sin_out = (i + 0.5) / kSines;
      const double cos_out = std::sqrt(1.0 - sin_out * sin_out);
      const double turn_rad = core::kPi * (k + 0.5) / kTurns;
      const glm::dvec3 out(cos_out * std::cos(turn_rad), cos_out * std::sin(turn_rad), sin_out);
      const double on_half = glm::normalize(out + towards_source).z;
      sum += nrcs.sigma0_over_sine(sin_in, sin_out, std::min(on_half, 1.0));
    }
  return sum * 2.0 * core::kPi / (kSines * kTurns) / (4.0 * core::kPi);
}

}  // namespace

TEST_CASE("No row of the library scatters more than arrives, from 0.5 deg up", "[bistatic]") {
  core::ProblemList problems;
  const materials::MaterialLibrary library = materials::MaterialLibrary::from_file(
      std::string(FANBEAM_SOURCE_DIR) + "/materials/library.toml", problems);
  problems.throw_if_errors();
  int limited = 0;
  for (const materials::Material& material : library.all())
    for (const auto polarisation : {core::Polarisation::horizontal, core::Polarisation::vertical}) {
      const materials::NrcsCurve curve(material.model, polarisation, 35e9);
      const BistaticNrcs nrcs{NrcsTable(curve)};
      double largest = 0.0;
      for (const double grazing_deg : {0.5, 1.0, 1.7, 3.0, 6.0, 10.0, 20.0, 45.0, 90.0}) {
        INFO(material.name << " at " << grazing_deg << " deg");
        const double share = share_by_vectors(nrcs, std::sin(core::radians(grazing_deg)));
        CHECK(share > 0.0);
        CHECK(share <= 1.0);
        largest = std::max(largest, share);
      }
      if (largest > 0.95) ++limited;
    }
  CHECK(limited >= 6);  // snow, rugged mountain and town, which would pass 1
}

TEST_CASE("The limit acts where the unlimited law passes 1 and nowhere else", "[bistatic]") {
  // Constant gamma: unlimited, the share is gamma / (3 sqrt(sin)): 1 at sin = 0.09.
  const BistaticNrcs even(NrcsTable(materials::PhongNrcs(0.9, 0.0, 1.0)));
  CHECK(even.sigma0_over_sine(0.2, 0.3, 0.5) == Approx(0.9 * std::sqrt(1.5)).epsilon(1e-12));
  CHECK(even.sigma0_over_sine(0.0225, 0.3, 0.5) ==
        Approx(0.9 * std::sqrt(0.3 / 0.0225) * 0.5).epsilon(0.02));
  CHECK(even.scattered(0.16) == Approx(0.75).epsilon(0.02));
  for (const double sine : {0.08, 0.03, 0.01, 0.003}) {
    CHECK(even.scattered(sine) > 0.97);
    CHECK(even.scattered(sine) <= 1.0);
  }
  // sigma_B / sin stays finite however flat the wave comes in.
  CHECK(even.sigma0_over_sine(1e-9, 1.0, 0.7) < 3.1);
}

TEST_CASE("The bistatic form is reciprocal, and monostatic where the directions meet",
          "[bistatic]") {
  const BistaticNrcs rough{NrcsTable(kRough)};
  const BistaticNrcs bright{NrcsTable(materials::PhongNrcs(1.4, 0.5, 2.0))};
  for (const double sine : {0.05, 0.3, 0.9})
    CHECK(rough.sigma0_over_sine(sine, sine, sine) ==
          Approx(kRough.sigma0(sine) / sine).epsilon(1e-4));
  // Both, one or none of the angles where the bright surface is limited.
  for (const auto& [in, out, on_half] :
       {std::array{0.1, 0.7, 0.6}, {0.004, 0.02, 0.3}, {0.01, 0.9, 0.8}, {0.4, 0.8, 1.0}})
    for (const BistaticNrcs& nrcs : {rough, bright})
      CHECK(nrcs.sigma0_over_sine(in, out, on_half) * in ==
            Approx(nrcs.sigma0_over_sine(out, in, on_half) * out).epsilon(1e-12));
  CHECK(rough.sigma0_over_sine(0.1, -0.1, 0.6) == 0.0);
}

TEST_CASE("A surface mirrors no more than it leaves unscattered", "[bistatic]") {
  const materials::SpecularSurface polished{{1.0, 1e9}, 0.0};
  const BistaticNrcs faint{NrcsTable(materials::PhongNrcs(0.00005, 0.0003, 3.0))};
  // Sheet metal of the library: geometric optics of slopes of 0.2, a mirror with all its power in
  // the lobe.
  const BistaticNrcs sheet{NrcsTable(materials::PhongNrcs(0.16393, 12.088, 24.664))};
  const renderer::Mirrors mirrors({polished, polished}, {faint, sheet},
                                  tests::hivision().wavelength_m());
  CHECK(mirrors.power(0, 1.0, 1.0) > 0.998);
  CHECK(mirrors.power(1, 1.0, 1.0) < 0.25);
  CHECK(mirrors.power(2, 1.0, 1.0) == 0.0);
  for (int i = 1; i <= 32; ++i)
    CHECK(mirrors.power(1, i / 32.0, 1.0) + sheet.scattered(i / 32.0) <= 1.0 + 1e-12);
}

// Bounds of a surface's state count on it. The second surface is darker at grazing angles and bright at
// the normal: it scatters less there, and has more of it cut off by the limit.
TEST_CASE("A change of NRCS changes bistatic echoes by up to twice as many dB", "[bistatic]") {
  const NrcsTable even(materials::PhongNrcs(3.0, 0.0, 1.0)),
      lobed(materials::PhongNrcs(0.75, 11.25, 3.0));
  const double change_dB = lobed.largest_change_dB(even);
  CHECK(change_dB == Approx(10.0 * std::log10(4.0)).epsilon(1e-3));
  const BistaticNrcs before(even), after(lobed);
  double largest_dB = 0.0;
  for (const double in : {0.01, 0.03, 0.1, 0.3, 0.6, 1.0})
    for (const double out : {0.01, 0.03, 0.1, 0.3, 0.6, 1.0})
      for (const double on_half : {(in + out) / 2, std::min((in + out) / 2 + 0.3, 1.0), 1.0}) {
        const double ratio =
            after.sigma0_over_sine(in, out, on_half) / before.sigma0_over_sine(in, out, on_half);
        largest_dB = std::max(largest_dB, std::abs(10.0 * std::log10(ratio)));
      }
  CHECK(largest_dB > 1.1 * change_dB);
  CHECK(largest_dB <= 2.0 * change_dB);
}
