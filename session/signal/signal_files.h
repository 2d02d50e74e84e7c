// What fanbeam fmcw leaves of a frame on disk.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "session/signal/chain.h"
#include "session/signal/radar_velocity.h"
#include "session/signal/spectrogram.h"

namespace fanbeam::session {

struct FmcwStamp {
  int frame = 0;
  double time_s = 0.0;
  std::string scene;
  double dynamic_range_dB = 60.0;  // of the pictures' colours, from the noise up
  double radar_speed_mps = 0.0;    // over ground
  RadarVelocity_mps radar_velocity_mps{};
};

// Files DIR/<product>/00000.*, of every product that is wanted and that the waveform has. Throws
// InputError E-IO.
// Answers with the names of the files, relative to the folder.
std::set<std::string> write_fmcw_products(const std::filesystem::path& folder,
                                          const std::set<std::string>& products,
                                          const FmcwRadar& radar, const FmcwFrame& frame,
                                          const FmcwStamp& stamp);

// Files DIR/spectrogram/all.png and .exr; answers as above.
std::set<std::string> write_spectrogram(const std::filesystem::path& folder,
                                        const Spectrogram& spectrogram, const std::string& scene,
                                        double dynamic_range_dB);

}  // namespace fanbeam::session
