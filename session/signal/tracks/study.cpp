#include "session/signal/tracks/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/files.h"

namespace fanbeam::session {
namespace {

// gnuplot fails where it has nothing to draw.
bool has_points(const Plot& plot) {
  return std::any_of(plot.series.begin(), plot.series.end(), [](const PlotSeries& series) {
    return std::any_of(series.y.begin(), series.y.end(), [](double y) { return std::isfinite(y); });
  });
}

}  // namespace

std::string figure_cell(int count, double value, int decimals) {
  return count > 0 ? fmt::format("{:.{}f}", value, decimals) : std::string("-");
}

void track_study(const std::vector<StudyScenario>& scenarios, const core::HighwayRadar& radar,
                 const TrackSettings& settings, const std::filesystem::path& folder,
                 const std::function<void(const char* part)>& told) {
  std::string page;
  const auto add = [&](const char* what, const StudyPart& part) {
    page += part.text + "\n";
    for (const auto& [name, plot] : part.plots) {
      if (!has_points(plot)) continue;
      write_plots(plot, folder / name);
      page += fmt::format("![{}]({}.png)\n\n", plot.title, name);
    }
    told(what);
  };
  const auto families = [&] { add("families of traffic", study_families(radar, settings, told)); };
  if (settings.samples) {
    families();
  } else {
    add("buffer", study_buffer(radar, settings.seed));
    add("noise figure", study_noise_figure(radar, settings.seed));
    add("noise and reflections", study_reflections(radar, settings.seed));
    add("ghosts", study_ghosts(radar, settings.seed));
    add("waveforms and associations", study_tracks(scenarios, settings));
    families();
    add("crossings", study_crossing(settings.seed));
  }
  while (page.ends_with("\n\n")) page.pop_back();
  core::write_file_atomically(folder / "study.md", page);
}

}  // namespace fanbeam::session
