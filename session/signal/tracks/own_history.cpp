#include "session/signal/tracks/own_history.h"

#include <cmath>

#include "tracking/tracker/track_geometry.h"

namespace fanbeam::session {
namespace {

constexpr std::size_t kStanding = 6, kDots = 4;  // of the plot's eight colours

std::size_t colour_of_track(int id) {
  constexpr std::size_t kOthers[] = {0, 1, 2, 3, 5, 7};
  return kOthers[static_cast<std::size_t>(id) % std::size(kOthers)];
}

}  // namespace

void OwnHistory::add(const MeasuredFrame& frame, const tracking::Tracker& tracker) {
  const auto put = [&](double range_m, double azimuth_rad, Line& line) {
    line.time_s.push_back(frame.time_s);
    line.range_m.push_back(range_m);
    line.forward_m.push_back(range_m * std::cos(azimuth_rad));
    line.right_m.push_back(range_m * std::sin(azimuth_rad));
  };
  for (const tracking::RadarMeasurement& one : frame.measurements)
    put(one.range_m, one.azimuth_rad, measurements_);
  for (const tracking::Track& track : tracker.tracks()) {
    if (!track.confirmed) continue;
    const tracking::PolarPlace place = polar(track.state);
    Line& line = tracks_[track.id];
    put(place.range_m, place.azimuth_rad, line);
    line.moving += is_moving(track, frame.radar_velocity_mps) ? 1 : 0;
  }
}

Plot OwnHistory::ranges(const std::string& name) const {
  Plot plot;
  plot.title =
      name + ": measurements (dots), tracks of what moves in colours, of what stands black";
  plot.x.label = "time, s";
  plot.y.label = "range, m";
  plot.y.low = 0.0;
  plot.series.push_back(
      {"", measurements_.time_s, measurements_.range_m, PlotSeries::Style::points, kDots});
  for (const auto& [id, line] : tracks_)
    plot.series.push_back({"", line.time_s, line.range_m, PlotSeries::Style::line,
                           line.moves() ? colour_of_track(id) : kStanding});
  return plot;
}

Plot OwnHistory::plan(const std::string& name) const {
  Plot plot;
  plot.title = name + ": where tracks were seen from the radar";
  plot.x.label = "right, m";
  plot.y.label = "forward, m";
  plot.series.push_back(
      {"", measurements_.right_m, measurements_.forward_m, PlotSeries::Style::points, kDots});
  for (const auto& [id, line] : tracks_)
    plot.series.push_back({"", line.right_m, line.forward_m, PlotSeries::Style::line,
                           line.moves() ? colour_of_track(id) : kStanding});
  return plot;
}

}  // namespace fanbeam::session
