#include "session/signal/waveform_figures.h"

#include <nlohmann/json.hpp>
#include <string>

namespace fanbeam::session {

std::vector<WaveformFigure> waveform_figures(const signal::StageFigures& stage) {
  const bool ramps = stage.slope_Hz_per_s != 0.0;
  const auto of_ramps = [&](double value) {
    return ramps ? std::optional<double>(value) : std::nullopt;
  };
  return {{"segments", "", "segments", stage.segments},
          {"duration of each", "s", "segment_s", stage.segment_s},
          {"samples in each", "", "samples", stage.samples},
          {"slope", "Hz/s", "slope_Hz_per_s", of_ramps(stage.slope_Hz_per_s)},
          {"frequency bin 1/T", "Hz", "frequency_bin_Hz", stage.frequency_bin_Hz},
          {"beat per metre", "Hz/m", "beat_Hz_per_m", of_ramps(stage.beat_Hz_per_m)},
          {"range read per speed", "m/(m/s)", "coupling_m_per_mps", stage.coupling_m_per_mps},
          {"range cell", "m", "range_cell_m", stage.range_cell_m},
          {"half-power width, no window", "m", "rectangular_width_m", stage.rectangular_width_m},
          {"half-power width, Taylor", "m", "taylor_width_m", stage.taylor_width_m},
          {"unambiguous range", "m", "unambiguous_range_m", stage.unambiguous_range_m},
          {"speed cell", "m/s", "speed_cell_mps", stage.speed_cell_mps},
          {"unambiguous speed, +-", "m/s", "unambiguous_speed_mps", stage.unambiguous_speed_mps}};
}

std::string waveform_json(const signal::Waveform& waveform) {
  nlohmann::ordered_json json = {{"kind", std::string(signal::name(waveform.kind))},
                                 {"centre_frequency_Hz", waveform.centre_frequency_Hz},
                                 {"wavelength_m", waveform.wavelength_m()},
                                 {"bandwidth_Hz", waveform.bandwidth_Hz},
                                 {"duration_s", waveform.duration_s()},
                                 {"complex_baseband", waveform.complex_baseband}};
  const std::vector<signal::StageFigures> stages = signal::figures(waveform);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    nlohmann::ordered_json entry = {{"sample_rate_Hz", waveform.sample_rate_Hz[i]}};
    for (const WaveformFigure& figure : waveform_figures(stages[i]))
      if (figure.value) entry[figure.key] = *figure.value;
    json["stages"].push_back(entry);
  }
  return json.dump();
}

}  // namespace fanbeam::session
