// What a receiver does to the samples of a frame, as effects: bounds and causes of the catalogue's
// rows of the signal level. They need SceneFacts::signal.
//
// Bounds are of the mean power of a cell over the draws of noise and of the echoes' phases (from one
// draw to the next a cell of noise strays by 5.6 dB RMS anyway), against the mean N that thermal
// noise leaves there. A transform with weights w turns white noise of N1 a sample into
// N = N1 sum |w|^2 / |sum w|^2; what the others below add goes through the same factor, so that
// windows and lengths cancel. With P the sum of the echoes' powers and C the channels that a beam
// sums (it keeps a common pedestal and lowers noise by C; 1 where no product has beams):
//
//   receiver noise  the floor itself, on which thresholds, colours and watts stand, those of a B-scope
//                   too, however dark its display is: the whole window.
//   phase noise     exp(j theta), theta Gaussian, of a density of at most S on either side and a
//                   variance of at most v whatever the echo's delay (signal/receiver/oscillator.h),
//                   common to all channels: an echo keeps exp(-v) of its power, the rest is a pedestal
//                   of a density of at most S (1 - exp(-v)) / v (exp(R) - 1 <= R (exp(v) - 1) / v
//                   for 0 <= R <= v):
//                     max(10 log10(1 + C P fs S (1 - exp(-v)) / (v N1)), 4.34 v)
//                   twice the pedestal for real samples, whose image adds its own.
//   quantiser       steps q no longer than the noise's standard deviation s per part make an error
//                   that is white, of q^2 / 12 per part (what is left of its dependence on the
//                   signal is below 2e-9 q): 10 log10(1 + q^2 / (12 s^2)). Longer ones are not
//                   hidden: the whole window. q = largest part / 2^(bits - 1), the largest with
//                   the largest draw there is, 6.77 s; or a given full scale, and where the largest
//                   part may be beyond that, clipping changes anything: the whole window.
//
//   interference    a cell is a weighted sum of samples, so that by Cauchy and Schwarz it holds at most
//                   sum |w|^2 times the energy E = sum |x|^2 of other radars' chirps in one channel's
//                   samples, tone, burst or ghost alike: 10 log10(1 + C E / N1), twice E for real
//                   samples.
//
// Where the user switches the noise off nothing hides either: the whole window. The same where
// samples are a product themselves.
// Sources: B. Widrow, I. Kollar, "Quantization Noise", 2008, chapter 5 (Gaussian input); M. C.
// Budge, M. P. Burt, IEEE Radar Conf. 1993 (signal/receiver/oscillator.h).
// Neglected: the few samples that a quantiser without a given full scale clips, by a step at most; the dependence between
// channels that share a receiver in the same moment.
#pragma once

#include <string>

#include "renderer/plan/scene_facts.h"

namespace fanbeam::renderer {

bool has_phase_noise(const SceneFacts& facts);
bool has_quantiser(const SceneFacts& facts);
bool has_interference(const SceneFacts& facts);

double phase_noise_bound_dB(const SceneFacts& facts);
double quantiser_bound_dB(const SceneFacts& facts);
double interference_bound_dB(const SceneFacts& facts);

std::string receiver_noise_cause(const SceneFacts& facts, double bound_dB);
std::string phase_noise_cause(const SceneFacts& facts, double bound_dB);
std::string quantiser_cause(const SceneFacts& facts, double bound_dB);
std::string interference_cause(const SceneFacts& facts, double bound_dB);

}  // namespace fanbeam::renderer
