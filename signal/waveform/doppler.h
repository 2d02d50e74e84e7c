// Doppler shift and folding of a sampled axis.
#pragma once

namespace fanbeam::signal {

// Received minus transmitted frequency of an echo, exact: f (1 + u/c)/(1 - u/c) - f = 2 u f/(c - u)
// with u the closing speed, u = -v. Positive when closing; the beat (transmitted minus received)
// has the other sign. Speeds below that of light in amount; E-RANGE otherwise.
double doppler_shift_Hz(double radial_speed_mps, double frequency_Hz);

// `value` brought into [-half, half) by whole steps of 2 half: the border +half goes to -half, as
// in a transform of even length, whose bin N/2 stands for the negative border.
double fold(double value, double half);

// `value` brought into [0, length) by whole steps of `length`.
double fold_positive(double value, double length);

}  // namespace fanbeam::signal
