// exp(j 2 pi (a + b m + c m^2)) for m = 0, 1, 2, ..., eight values at a time, by products in double.
//
// Values m + 8 follow from values m by one product with a step, which itself turns by a constant.
// The rounding error after M values is about 1e-16 M / 8 turns.
#pragma once

#include <complex>

#include "signal/synthesis/lanes_private.h"

namespace fanbeam::signal {

struct QuadraticTurns {
  double constant = 0.0, linear = 0.0, quadratic = 0.0;
  double at(double m) const { return constant + m * (linear + m * quadratic); }
};

struct PhaseRun {
  // Begins at index `first`, each value times `amplitude`.
  PhaseRun(const QuadraticTurns& turns, double first, std::complex<double> amplitude);

  StoredLanes values, steps, turn;
};

// A PhaseRun taken up by a function, which puts it back at its end.
struct MovingRun {
  ComplexLanes<double> values, steps, turn;

  FANBEAM_LANES_INLINE explicit MovingRun(const PhaseRun& run) {
    load(run.values, values);
    load(run.steps, steps);
    load(run.turn, turn);
  }
  FANBEAM_LANES_INLINE void advance() {
    multiply_by(values, steps);
    multiply_by(steps, turn);
  }
  FANBEAM_LANES_INLINE void put_back(PhaseRun& run) const {
    store(values, run.values);
    store(steps, run.steps);
  }
};

}  // namespace fanbeam::signal
