// When `fanbeam fmcw` made files that do not tell it, and how the radar moved then.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/errors.h"
#include "session/signal/radar_velocity.h"

namespace fanbeam::session {

struct RecordedMoment {
  double time_s = 0.0;
  RadarVelocity_mps radar_velocity_mps{};
};

// Of each of these files, one or more, by the run.json one folder above them; none, and a warning (W-TIMES) with what
// counts `instead`, where that is a record of fmcw which does not tell it of all in the order of time.
std::vector<RecordedMoment> recorded_moments(const std::vector<std::filesystem::path>& files,
                                             const std::string& instead,
                                             core::ProblemList& warnings);

}  // namespace fanbeam::session
