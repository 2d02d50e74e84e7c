// Threshold detection of a target in receiver noise after square-law integration of N looks.
//
// A look's power in units of the mean noise power is |a + n|^2, n complex Gaussian of variance 1,
// |a|^2 the signal-to-noise ratio. The sum over N looks is compared with T:
//     Pfa = Q(N, T)                                          noise alone
//     Pd  = sum over k of w_k Q(N + k, T)                    with a target
// w_k is the Poisson law of the summed signal-to-noise ratio, mixed over the target's power. With a
// steady target it is Poisson, so that Pd is the generalised Marcum function; with a power that is
// gamma distributed of order m about its mean (Swerling 1: m = 1, 2: N, 3: 2, 4: 2N) it is negative
// binomial,
//     w_k = (m + k - 1)! / (k! (m - 1)!) (m / (m + S))^m (S / (m + S))^k,  S = N snr.
// All terms are positive, for every case, so nothing cancels.
//
// Sources: J. I. Marcum, "A statistical theory of target detection by pulsed radar", IRE Trans.
// IT-6, 1960; P. Swerling, the same issue; D. P. Meyer, H. A. Mayer, "Radar Target Detection",
// 1973; D. A. Shnidman, "The calculation of the probability of detection and the generalized
// Marcum Q-function", IEEE Trans. IT-35, 1989. Closed forms for one look follow:
// Swerling 1 and 2, Pd = Pfa^(1 / (1 + snr)).
//
// Inputs: looks 1 to 1000, snr 0 or more (linear, mean, per look), probabilities in (0, 1).
// Neglected: clutter (the threshold knows noise only), the estimate of the noise (it is taken as
// known), correlation between looks. Accuracy: absolute 1e-12 in Pd, against closed forms and
// quadrature; the signal-to-noise ratio 1e-9 relative. Cost: some thousand exponentials a call.
#pragma once

#include "core/swerling.h"

namespace fanbeam::sensors {

// T: threshold on the sum of the looks' powers, in units of the mean noise power of one look.
double detection_threshold(double false_alarm_probability, int looks);

double detection_probability(core::Swerling target, double snr, int looks, double threshold);

// Mean signal-to-noise ratio per look that reaches `probability`, which must be above the
// false-alarm probability. E-RANGE otherwise.
double required_snr(core::Swerling target, double probability, double false_alarm_probability,
                    int looks);

}  // namespace fanbeam::sensors
