// Samples that another radar's chirp crossed, found and mended before the transforms.
//
// A crossing is short and strong. A sample is taken for one where its power, summed over the channels of
// its chirp that were received in the same moment, is `threshold` times the median over the chirp or
// more; two samples to either side go with it. Then
//   zero         they are set to 0: their share of every echo is lost and side lobes rise, the floor falls
//   interpolate  they are filled from the rest of the chirp, by spectral lines found with a falling
//                threshold (iterative method with adaptive thresholding, IMAT): 20 turns, from the strongest line
//                down to the mean of all
// Neither helps where most of a chirp is crossed, or where slopes are alike and the interferer stays in
// the band: chirps of which more than half are taken for crossed stay as they are.
// Sources: F. Marvasti et al., "Sparse signal processing using iterative method with adaptive
// thresholding", ICT 2012; J. Bechter, F. Roos, M. Rahman, C. Waldschmidt, "Automotive radar
// interference mitigation using a sparse sampling approach", EuRAD 2017.
// Inputs: threshold above 1 as a power ratio. Echoes of one or two equal strong scatterers reach 2
// times the median, noise of one channel 20 times in one sample of a million: the default. Noise of real samples of one
// channel, which stay real when a calibration turns their phase, is 52.8 times its median as often: 2.64 times the threshold
// counts there.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "signal/cube.h"
#include "signal/waveform/array.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

enum class Mitigation { none, zero, interpolate };

std::string_view name(Mitigation mitigation);
std::optional<Mitigation> mitigation_of(std::string_view name);

inline constexpr double kCrossedOverMedian = 20.0;

// Returns how many samples of all channels were mended.
// `waveform` tells whether samples were taken as real ones.
std::size_t mitigate(Mitigation mitigation, double threshold, const Waveform& waveform,
                     const Array& array, FloatCube& cube);

}  // namespace fanbeam::signal
