// How many raindrops of each size a cubic metre holds: N(D) = N0 exp(-c R^-0.21 D).
//
//   name                       N0 [1/(m3 mm)]  c     rain
//   marshall-palmer (default)  8000            4.1   widespread            [1]
//   joss-drizzle               30000           5.7   drizzle, small drops  [2]
//   joss-thunderstorm          1400            3.0   showers, large drops  [2]
//
// R in mm/h, D the diameter in mm, taken from 0.05 to 8 mm.
// [1] Marshall and Palmer 1948, J. Meteorology 5, 165   [2] Joss, Thams and Waldvogel 1968,
// Proc. Int. Conf. Cloud Physics, Toronto. Confidence: the constants are quoted in texts on radar
// meteorology; the originals were not seen.
// Accuracy: laws of the mean; single minutes of rain scatter by a factor 2 in N.
#pragma once

#include <string_view>

namespace fanbeam::atmosphere {

enum class DropSizes { marshall_palmer, joss_drizzle, joss_thunderstorm };

// Names as in the table. Throws InputError E-REF for any other name.
DropSizes drop_sizes_named(std::string_view name);
std::string_view name_of(DropSizes sizes);

inline constexpr double kSmallestDrop_mm = 0.05;
inline constexpr double kLargestDrop_mm = 8.0;

// N(D) in 1/(m3 mm); rain rate 0 or more (0: no drops), diameter 0.05 to 8 mm. Not checked.
double drops_per_m3_mm(DropSizes sizes, double rain_rate_mm_per_h, double diameter_mm);

}  // namespace fanbeam::atmosphere
