// fanbeam waveform: what a radar waveform can measure, and what it reads for a target.
#pragma once

#include <optional>
#include <string>

#include "apps/common.h"
#include "session/signal/waveform_settings.h"

namespace fanbeam::apps {

struct WaveformOptions : session::WaveformSettings {
  std::optional<double> range_m, speed_mps;  // of a target
  bool refuse_folding = false;
  bool json = false;
  std::string mixer;  // folder of --mixer; empty: none
};

int waveform(const WaveformOptions& options, const CommonOptions& common);
CLI::App& add_waveform_command(CLI::App& program, WaveformOptions& options);

}  // namespace fanbeam::apps
