#include "signal/transform/slot_compensation.h"

#include <cstddef>

#include "core/parallel.h"
#include "signal/checks_private.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

int slot_of(const Array& array, int channel) {
  return array.multiplex == Multiplex::time_division ? array.transmitter_of(channel) : 0;
}

void check_channels(std::size_t found, const Array& array) {
  if (found != static_cast<std::size_t>(array.channels()))
    refuse("channels", static_cast<double>(found),
           "as many as the array has: " + std::to_string(array.channels()));
}

}  // namespace

template <typename Real>
void compensate_slots(Cube<Real>& range_doppler, const Array& array) {
  const CubeShape& shape = range_doppler.shape;
  check_channels(static_cast<std::size_t>(shape.channels), array);
  if (array.slots() == 1) return;
  core::parallel_for(static_cast<std::size_t>(shape.channels), [&](std::size_t index) {
    const int channel = static_cast<int>(index);
    const int slot = slot_of(array, channel);
    if (slot == 0) return;
    for (int cell = 0; cell < shape.chirps; ++cell) {
      // f Ts = (cell - M/2) / (M S)
      const double turns = static_cast<double>(slot) * (cell - shape.chirps / 2) /
                           (static_cast<double>(shape.chirps) * array.slots());
      const auto turn = static_cast<std::complex<Real>>(unit_phasor(-turns));
      std::complex<Real>* const row = &range_doppler.at(channel, cell, 0);
      for (int i = 0; i < shape.samples; ++i)
        row[i] = {row[i].real() * turn.real() - row[i].imag() * turn.imag(),
                  row[i].real() * turn.imag() + row[i].imag() * turn.real()};
    }
  });
}

template void compensate_slots(FloatCube&, const Array&);
template void compensate_slots(DoubleCube&, const Array&);

void compensate_slots(std::vector<std::complex<double>>& snapshot, const Array& array,
                      double doppler_Hz, double slot_period_s) {
  check_channels(snapshot.size(), array);
  for (int channel = 0; channel < array.channels(); ++channel)
    snapshot[static_cast<std::size_t>(channel)] *=
        unit_phasor(-doppler_Hz * slot_period_s * slot_of(array, channel));
}

DopplerFold doppler_fold(const std::vector<std::complex<double>>& snapshot, const Array& array,
                         double doppler_Hz, double slot_period_s, double wavelength_m) {
  check_channels(snapshot.size(), array);
  const int slots = array.slots();
  const auto elements_m = virtual_elements_m(array);
  DopplerFold best;
  best.direction.power = -1.0;
  for (int k = -(slots / 2); k < slots - slots / 2; ++k) {
    // Of an even number of slots -S/2 and S/2 turn them alike: the one that keeps within +-1 / (2 Ts).
    const bool beyond = 2 * k == -slots && doppler_Hz < 0.0;
    const int fold = beyond ? k + slots : k;
    auto compensated = snapshot;
    compensate_slots(compensated, array, doppler_Hz + fold / (slots * slot_period_s),
                     slot_period_s);
    const AnglePeak direction = direction_peak(compensated, elements_m, wavelength_m);
    if (direction.power > best.direction.power) best = {fold, direction};
  }
  return best;
}

}  // namespace fanbeam::signal
