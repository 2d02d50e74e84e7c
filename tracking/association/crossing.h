// Who is who after two targets could not be told apart for a while.
//
// While a pair is unresolved its tracks coast. Afterwards there are two hypotheses: a is where c
// was seen and b where d was, or the other way round (swapped). With the predicted measurements of
// the tracks, N(z; h, H P H^T) before noise, and the two measurements:
//   P(kept) / P(swapped) = N(c; a) N(d; b) / (N(d; a) N(c; b)) x prior odds .
// Speed is what tells targets apart that meet in range: with speeds alone, each known to sigma on
// both sides, the log of the odds is (va - vb)(vc - vd) / (2 sigma^2). These odds are calibrated
// over pairs whose speeds differ by anything, all differences alike likely. A decision by the order
// of speeds is wrong, before the data are seen, with
//   p = Q(dv / (sqrt(2) sigma)),  P(swap) = 2 p (1 - p):
// one of the two differences has the wrong sign. For pairs of one given dv the odds above are too
// modest (0.10 instead of 0.048 at 3 km/h and 0.3 m/s); `kept_by_speed` therefore takes the amount
// D of the difference from the data, the root mean square of both weighted with 1 / variance, and
// asks each side only for its sign,
//   P(sign of d) = 1 / (1 + exp(-2 d D / var)),  kept where both or none of the signs are right.
// Its mean meets 2 p (1 - p) within 0.02 for sigma up to 0.5 m/s at 3 km/h, that is dv / sigma
// above 1.6 (0.03 off at 1.4).
// Source: Y. Bar-Shalom, P. K. Willett, X. Tian, "Tracking and Data Fusion", 2011, 6.2 (joint
// hypotheses); the closed forms are derived above.
// Neglected: more than two targets at once; correlation of the two tracks' errors.
#pragma once

#include "tracking/filters/imm.h"

namespace fanbeam::tracking {

// Q(x), the upper tail of the normal law.
double normal_tail(double x);

// 2 p (1 - p). E-RANGE for a sigma not above 0.
double swap_probability(double speed_difference_mps, double speed_sigma_mps);

// Differences a - b before and c - d after, with their variances (above 0, E-RANGE otherwise).
double kept_by_speed(double before_mps, double before_variance, double after_mps,
                     double after_variance);

// P(kept) from the two logarithms of likelihood. Never NaN: two impossible hypotheses leave the
// prior.
double kept_probability(double log_likelihood_kept, double log_likelihood_swapped,
                        double prior_kept = 0.5);

// Of two tracks, predicted to the time of the measurements.
double kept_probability(const ImmState& a, const ImmState& b, Measured measured,
                        const RadarMeasurement& c, const RadarMeasurement& d,
                        double prior_kept = 0.5);

}  // namespace fanbeam::tracking
