// Rows of tracks.csv and measurements.csv. Times have all their digits, so that they are those of the input also where they
// count from 1970.
#pragma once

#include <string>

#include "session/signal/radar_velocity.h"
#include "tracking/tracker/track.h"

namespace fanbeam::session {

// x forward, y right, relative to the radar.
inline constexpr const char* kTrackColumns =
    "time_s,track,confirmed,x_m,y_m,vx_mps,vy_mps,range_m,range_rate_mps,azimuth_rad,moving,"
    "identity_probability";
inline constexpr const char* kCovarianceColumns = "xx,xy,xvx,xvy,yy,yvx,yvy,vxvx,vxvy,vyvy";
// Standard deviations of noise, and of what else the source knows to be wrong (merged beats).
inline constexpr const char* kMeasurementColumns =
    "time_s,range_m,range_rate_mps,azimuth_rad,"
    "range_sigma_m,range_rate_sigma_mps,azimuth_sigma_rad,"
    "range_systematic_m,range_rate_systematic_mps,azimuth_systematic_rad\n";

// Of kTrackColumns. `radar_velocity_mps` forward and right: moving is meant over ground.
std::string track_cells(double time_s, const tracking::Track& track,
                        const RadarVelocity_mps& radar_velocity_mps);
// Of kCovarianceColumns, a comma before each.
std::string covariance_cells(const tracking::Gaussian& state);
std::string measurement_row(double time_s, const tracking::RadarMeasurement& measurement);

}  // namespace fanbeam::session
