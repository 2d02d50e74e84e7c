#include "signal/synthesis/phase_run_private.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

// The library's product checks for infinities; there are none here.
std::complex<double> product(std::complex<double> a, std::complex<double> b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

PhaseRun::PhaseRun(const QuadraticTurns& turns, double first, std::complex<double> amplitude) {
  std::complex<double> value = product(amplitude, unit_phasor(turns.at(first)));
  std::complex<double> step = unit_phasor(turns.linear + turns.quadratic * (2.0 * first + 1.0));
  const std::complex<double> curl = unit_phasor(2.0 * turns.quadratic);
  std::complex<double> eight = 1.0;  // from a value to the one eight later
  for (int lane = 0; lane < kLanes; ++lane) {
    values.re[lane] = value.real();
    values.im[lane] = value.imag();
    value = product(value, step);
    eight = product(eight, step);
    step = product(step, curl);
  }
  std::complex<double> curl8 = curl;
  for (int i = 0; i < 3; ++i) curl8 = product(curl8, curl8);
  std::complex<double> curl64 = curl8;
  for (int i = 0; i < 3; ++i) curl64 = product(curl64, curl64);
  for (int lane = 0; lane < kLanes; ++lane) {
    steps.re[lane] = eight.real();
    steps.im[lane] = eight.imag();
    turn.re[lane] = curl64.real();
    turn.im[lane] = curl64.imag();
    eight = product(eight, curl8);
  }
}

}  // namespace fanbeam::signal
