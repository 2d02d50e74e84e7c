// What accuracy costs a road radar: buffer, noise figure, waveform and association against error
// and time, as one page of tables and its plots.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/highway.h"
#include "session/plots/gnuplot.h"
#include "session/signal/tracks/track_settings.h"

namespace fanbeam::session {

// With the file's radar, the scenario's own changes and the options' in it.
struct StudyScenario {
  const core::HighwayScenario* scenario;
  core::HighwayRadar radar;
};

// A table of Markdown, and the plots that belong to it, by file name without ending.
struct StudyPart {
  std::string text;
  std::vector<std::pair<std::string, Plot>> plots;
};

// Of a table; a dash where a figure is of nothing.
std::string figure_cell(int count, double value, int decimals);

// One car of 10 m2 at 100 m that closes at 100 km/h, measured from samples of 1 to 32 of the radar's triangles
// (triangle_ramp_s, triangle_rate_Hz): root mean square errors of 100 draws beside their bound, those that are
// wrong by over 1 m left out and counted.
StudyPart study_buffer(const core::HighwayRadar& radar, std::uint64_t seed);
// The same of one triangle, over the noise figure.
StudyPart study_noise_figure(const core::HighwayRadar& radar, std::uint64_t seed);
// Over the noise figure without a reflecting road, and with roads of reflection coefficients -0.7 and -1, antenna
// and car 0.5 m high, ranges 60 to 140 m: figures 8 and 9 of the paper that the scenarios come from.
StudyPart study_reflections(const core::HighwayRadar& radar, std::uint64_t seed);
// Missed targets and ghosts of every waveform over the number of targets: ranges 10 to 200 m,
// speeds within 60 m/s, one beam, a match within 1 m and 1 m/s, 200 frames.
StudyPart study_ghosts(const core::HighwayRadar& radar, std::uint64_t seed);
// Waveforms x associations in each scenario, 10 runs each; and from samples, one.
StudyPart study_tracks(const std::vector<StudyScenario>& scenarios, const TrackSettings& settings);
// `family_draws` of each family of traffic (tracking/simulation/road_families.h), from frequencies by two
// stages or from samples, as the settings say. `told` of each family, once it is done.
StudyPart study_families(const core::HighwayRadar& radar, const TrackSettings& settings,
                         const std::function<void(const char* family)>& told);
// Swaps of a pair 3 km/h apart over what is known of its speeds: the closed form, what the tracker
// would say on average, and what happens.
StudyPart study_crossing(std::uint64_t seed);

// Writes study.md and its plots into `folder`. `radar` is the file's, for what has no scenario. Of
// `settings` every part takes the seed, tracks their acceleration and coasting too, and measurements from
// frequencies their misses and false ones; association and waveform are what is studied. With `samples` the
// page has the families alone, from samples. `told` of each part and each family, once it is done.
void track_study(const std::vector<StudyScenario>& scenarios, const core::HighwayRadar& radar,
                 const TrackSettings& settings, const std::filesystem::path& folder,
                 const std::function<void(const char* part)>& told);

}  // namespace fanbeam::session
