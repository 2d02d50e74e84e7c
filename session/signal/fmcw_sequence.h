// Frames of a scene's flight at signal level on disk: samples, maps, detections and B-scopes, and the
// records of how they came about (session/sequence.h is the same of pictures).
//
// A stop (core/stop.h) leaves whole files alone, and no record.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "session/sequence.h"
#include "session/signal/fmcw_settings.h"
#include "session/signal/record.h"

namespace fanbeam::session {

// The product that has its own sweeps, one a column, and looks at nothing of the radar's chain.
inline constexpr const char* kScanProduct = "bscope";
inline constexpr const char* kSpectrogramProduct = "spectrogram";  // one of all frames

struct FmcwSequenceSettings {
  FmcwSettings radar{};
  std::filesystem::path
      radar_file{};                  // that `radar` was read from, for messages; empty: the scene's
  std::filesystem::path output{};    // empty: out/<scene name>-fmcw
  std::string frames{};              // as parse_frames takes it
  std::set<std::string> products{};  // empty: all that the waveform has but samples and cubes
  std::string spectrogram_of{};      // targets whose names begin with it; empty: all ranges
  bool overwrite = false;            // where other files are
};

struct FmcwSequence {
  std::vector<FmcwFrameRecord> frames;
  std::vector<ProductPlace> places;  // of the products, and of the record at the end
};

// Throws InputError: E-UNSUPPORTED for maps of a waveform without, E-REF for other radars and targets
// that the scene has not, as fmcw_radar, parse_frames, OutputFolder, E-IO.
FmcwSequence run_fmcw(const scenes::Scene& scene, const FmcwSequenceSettings& settings,
                      const ProgressListener& progress);

}  // namespace fanbeam::session
