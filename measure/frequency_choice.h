// Two radar frequencies in fog and rain, as figures and plots: which one sees farther?
#pragma once

#include <filesystem>
#include <string>

#include "atmosphere/weather.h"

namespace fanbeam::measure {

// Answers with a table as text and, when `folder` is not empty, writes
// frequency-choice-{fog,rain,loss,balance} there, each as .svg and .png. Temperature, pressure,
// laws and drop sizes are those of `base`; its fog and rain are replaced by what each plot varies.
// Level paths at the origin's height.
std::string compare_frequencies(const atmosphere::Weather& base, double first_Hz, double second_Hz,
                                const std::filesystem::path& folder);

// What a watt sent at the second frequency brings back of a volume of water drops, over what it
// brings at the first, in dB, the antenna's area, beam filling and receiver being equal.
struct PowerBalance {
  double backscatter_dB = 0.0;  // eta over eta
  double attenuation_dB = 0.0;  // two-way loss, first minus second: negative when the second loses
};

// In cloud or fog droplets of Rayleigh size under a visibility (a drop returns 1 / wavelength^4).
PowerBalance fog_balance(const atmosphere::Weather& base, double visibility_m, double range_m,
                         double first_Hz, double second_Hz);
// In rain, both backscatter and loss by the weather's laws.
PowerBalance rain_balance(const atmosphere::Weather& base, double rain_mm_per_h, double range_m,
                          double first_Hz, double second_Hz);

}  // namespace fanbeam::measure
