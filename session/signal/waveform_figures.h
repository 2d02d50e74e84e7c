// What a waveform can measure, as fanbeam waveform prints it and as records hold it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signal/waveform/figures.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::session {

// One figure of a stage; without a value where the stage does not measure it.
struct WaveformFigure {
  const char* text;
  const char* unit;
  const char* key;  // in JSON
  std::optional<double> value;
};

std::vector<WaveformFigure> waveform_figures(const signal::StageFigures& stage);

// Kind, frequencies and the figures of every stage.
// An object of a waveform and its figures.
std::string waveform_json(const signal::Waveform& waveform);

}  // namespace fanbeam::session
