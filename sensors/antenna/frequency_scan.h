// A frequency-scanned line array: which way the beam points at which frequency.
//
// Feed line (a waveguide folded so that its length between neighbouring elements is L, their
// spacing d): the phase from element to element is beta_g L, so the beam with order m points to
//     sin(theta) = (L/d) beta_g / k - m lambda / d ,   beta_g = sqrt(k^2 - k_c^2) ,
// k = 2 pi f / c, k_c that of the guide's cutoff. Broadside is where L is m guide wavelengths.
// (Skolnik, ed., Radar Handbook, 1st ed., chapter 13, "Frequency-scanned arrays", and Ishimaru and
// Tuan, Theory of frequency scanning of antennas, IRE Trans. AP-10, 1962; as recalled.)
// Table: azimuth is linear in frequency between the given rows.
// Azimuth is positive right and grows with frequency.
//
// Per column: the frequency that points there; the steering rate; the beam 1 / cos(theta) wider
// than at broadside; the two-way gain and wavelength against the centre.
//
// Input: L/d 1 to 1000, cutoff below the carrier, spacing 0.1 to 100 mm, order 0 to 1000.
// Neglected: loss along the line, the change of the guide's coupling with frequency, grating lobes.
// Accuracy: 1e-12 relative. Cost: closed form; a table one search.
#pragma once

#include <optional>

#include "sensors/sensor.h"

namespace fanbeam::sensors {

// The frequency whose beam points there. Nothing where there is none: |sin(theta)| out of reach, below
// cutoff, or outside the table.
std::optional<double> frequency_towards_Hz(const FrequencyScan& scan, double azimuth_rad);

// d azimuth / d frequency where the beam points to `azimuth_rad`; 0 where it cannot point.
double steering_rate_rad_per_Hz(const FrequencyScan& scan, double azimuth_rad);

// What differs from column to column of a frequency-scanned picture.
struct SteeredColumn {
  double azimuth_rad = 0.0;  // the column's middle
  double frequency_Hz = 0.0;
  double wavelength_m = 0.0;
  double rate_rad_per_Hz = 0.0;
  // Received power of a point target over that at broadside and the carrier, for an aperture of
  // fixed size and efficiency: G ~ cos(azimuth) / lambda^2, hence cos^2 (lambda_0 / lambda)^2.
  double point_power_ratio = 1.0;
};

// The sensor must be frequency scanned and reach the column, as read_sensor checks.
SteeredColumn steered_column(const Sensor& sensor, int column);

// The largest |10 log10(point_power_ratio)| over all columns: what the renderer neglects by using
// one gain, width and wavelength for the whole picture. 0 for a mechanical scan.
double neglected_steering_dB(const Sensor& sensor);

}  // namespace fanbeam::sensors
