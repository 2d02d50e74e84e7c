#include "session/signal/tracks/study.h"

#include <fmt/format.h>

#include "core/files.h"

namespace fanbeam::session {

void track_study(const std::vector<StudyScenario>& scenarios, const core::HighwayRadar& radar,
                 const TrackSettings& settings, const std::filesystem::path& folder,
                 const std::function<void(const char* part)>& told) {
  std::string page;
  const auto add = [&](const char* what, const StudyPart& part) {
    page += part.text + "\n";
    for (const auto& [name, plot] : part.plots) {
      write_plots(plot, folder / name);
      page += fmt::format("![{}]({}.png)\n\n", plot.title, name);
    }
    told(what);
  };
  add("buffer", study_buffer(radar, settings.seed));
  add("noise figure", study_noise_figure(radar, settings.seed));
  add("noise and reflections", study_reflections(radar, settings.seed));
  add("ghosts", study_ghosts(radar, settings.seed));
  add("waveforms and associations", study_tracks(scenarios, settings));
  add("families of traffic", study_families(radar, settings));
  add("crossings", study_crossing(settings.seed));
  while (page.ends_with("\n\n")) page.pop_back();
  core::write_file_atomically(folder / "study.md", page);
}

}  // namespace fanbeam::session
