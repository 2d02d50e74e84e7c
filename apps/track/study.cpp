#include "apps/track/study.h"

#include <fmt/format.h>

#include "core/files.h"

namespace fanbeam::apps {

int track_study(const std::vector<StudyScenario>& scenarios, const core::HighwayRadar& radar,
                std::uint64_t seed, const std::filesystem::path& folder,
                const CommonOptions& common) {
  std::string page;
  const auto add = [&](const char* what, const StudyPart& part) {
    page += part.text + "\n";
    for (const auto& [name, plot] : part.plots) {
      session::write_plots(plot, folder / name);
      page += fmt::format("![{}]({}.png)\n\n", plot.title, name);
    }
    if (!common.quiet) fmt::print("{}\n", what);
  };
  add("buffer", study_buffer(radar, seed));
  add("noise figure", study_noise_figure(radar, seed));
  add("noise and reflections", study_reflections(radar, seed));
  add("ghosts", study_ghosts(radar, seed));
  add("waveforms and associations", study_tracks(scenarios, seed));
  add("crossings", study_crossing(seed));
  while (page.ends_with("\n\n")) page.pop_back();
  core::write_file_atomically(folder / "study.md", page);
  if (!common.quiet)
    fmt::print("record {}\n",
               std::filesystem::absolute(folder / "study.md").lexically_normal().string());
  return kExitDone;
}

}  // namespace fanbeam::apps
