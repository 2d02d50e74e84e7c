// fanbeam fmcw: a scene at signal level, from scatterers to detections.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "apps/common.h"
#include "apps/scene_choice.h"
#include "session/signal/fmcw_settings.h"

namespace fanbeam::apps {

struct FmcwOptions : SceneChoice, session::FmcwSettings {
  FmcwOptions() { scene = "street-76ghz"; }
  std::string output;  // default out/<scene name>-fmcw
  std::string frames = "0";
  std::string products;        // empty: all that the waveform has but samples and cubes
  double accuracy_grey = 0.0;  // 0: the scene's, else the default
  std::string effects;         // --effects; empty: what the scene and its samples call for
  bool overwrite = false;      // where other files are
  std::string spectrogram_of;  // targets whose names begin with it; empty: all ranges
  std::string radar_file;      // --radar, read already
  std::set<std::string> given_for_chain{};  // options given that the B-scope does not look at
  // Puts the options that were given over the settings again: the scene may name a radar file.
  std::function<void()> put_given_again = [] {};
  int threads = 0;
};

CLI::App& declare_fmcw(CLI::App& program, FmcwOptions& options);

}  // namespace fanbeam::apps
