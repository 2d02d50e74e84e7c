// What campaigns cost beside the frames in them, and what a city of CityJSON takes to load: by the program
// itself, as its users start it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "benchmarks/report_effort.h"
#include "benchmarks/verdict.h"

namespace fanbeam::benchmarks {

struct CampaignFigures {
  int runs = 0, frames = 0;  // of the campaign that workers share; frames of a run
  // The same runs by one worker of one thread, by one of two threads, by two workers of one thread each.
  double one_thread_s = 0.0, two_threads_s = 0.0, two_workers_s = 0.0;
  // The same frames by `fanbeam render` and by a campaign of one run, files and all; best of a few turns.
  int overhead_frames = 0;
  double render_s = 0.0, campaign_s = 0.0;
  // `campaign plan` of a million runs with 15 parameters.
  double plan_s = 0.0, plan_bytes = 0.0;
  // A scene of that many houses with gabled roofs.
  int houses = 0;
  double city_s = 0.0;

  double workers_over_threads() const { return two_threads_s / two_workers_s; }
  double overhead() const { return campaign_s / render_s - 1.0; }
};

// Nothing where the program is not there or fails.
std::optional<CampaignFigures> measure_campaigns(const Effort& effort);

std::string campaigns_markdown(const CampaignFigures& figures);
// Rows of the table of targets.
TargetRows campaign_rows(const CampaignFigures& figures);

}  // namespace fanbeam::benchmarks
