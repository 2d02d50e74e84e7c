// How likely a confirmed track's target is there, whether or not it is seen.
//
// Three states: there and seen by the radar, there and hidden (behind a truck, or merged with another), gone. From
// frame to frame what is seen hides once in 10 s on average, what is hidden comes back once in T and is gone at a
// rate kappa; nothing ends while it is seen. A frame then weighs the states by how likely it is in each:
//   measured   seen by Pd g / lambda, the others by 1 (the measurement is a false one)
//   not        seen by 1 - Pd Pg, the others by 1
// Unmeasured since t, almost all is hidden or gone, and with b = 1 / T
//   existence = h / (h + n),  h = exp(-(b + kappa) t),  n = kappa / (b + kappa) (1 - h),
// as what came back would have been measured. kappa = 0.4456 / T makes that one half at t = T: T is how long a target is
// believed in without a measurement.
// Source: D. Musicki, R. Evans, "Joint integrated probabilistic data association: JIPDA", IEEE Trans. AES-40, 2004
// (its Markov chain with hidden targets, there called chain two).
#pragma once

namespace fanbeam::tracking {

struct Existence {
  double seen = 0.5, hidden = 0.0;
  double probability() const { return seen + hidden; }

  // `step_s` later; `believed_s` is T, above 0.
  void pass(double step_s, double believed_s);
  // `probability` is Pd Pg.
  void missed(double probability);
  // `ratio` is Pd g / lambda; its logarithm, since g has no largest value.
  void measured(double log_ratio);
  // After joint association with `seen` for what exists: what it found, and how likely none was measured; `probability`
  // as above.
  void associated(double seen_after, double none_measured, double probability);
};

}  // namespace fanbeam::tracking
