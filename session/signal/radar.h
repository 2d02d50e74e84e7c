// The radar of fanbeam fmcw: which waveform, which array, how a cube is read.
#pragma once

#include <string>
#include <vector>

#include "sensors/sensor.h"
#include "session/signal/fmcw_settings.h"
#include "signal/detection/clusters.h"
#include "signal/detection/detections.h"
#include "signal/waveform/array.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::session {

struct FmcwRadar {
  std::string waveform_name;
  signal::Waveform waveform;
  signal::Array array;
  double pitch_m = 0.0;  // of a line; else half a wavelength
  bool line = true;      // virtual elements in order at one pitch
  double noise_figure = 1.0;
  // Of the chirp sequence in stage 0, of two chirps or more; nothing of it is valid where `maps` is false.
  bool maps = false;
  signal::CubeTiming timing;
  double middle_s = 0.0;  // of its chirps, on the waveform's clock: detections have the range there
  signal::RangeDopplerAxes axes;
  signal::DetectionSettings detection;
  signal::ClusterScales clusters;
  std::vector<double> azimuths_rad;  // of the cube's cells, rising
  double noise_cell_W = 0.0;         // mean, in a cell of one transformed channel
  double noise_azimuth_W = 0.0;      // about the largest of a range-azimuth map without echoes
  // Of maps and spectra over what the transforms of samples give: 2 for real ones, half of whose power lies
  // at the negative beat.
  double power_scale = 1.0;
};

// Whether stage 0 of this kind is a chirp sequence.
bool is_sequence(signal::WaveformKind kind);

// Which kind of waveform the options mean for this sensor: "automotive-76ghz" from 70 to 82 GHz,
// else "chirp-sequence", unless one is named.
std::string waveform_name(const FmcwSettings& options, const sensors::Sensor& sensor);

// Frequency and sweep are the sensor's; what the options say replaces the rest. Throws InputError
// for what does not go together, E-UNSUPPORTED for a cone scan.
FmcwRadar fmcw_radar(const FmcwSettings& options, const sensors::Sensor& sensor);

// The same of a radar that no sensor file describes: its settings say frequency, sweep and noise
// figure (E-REF where they do not).
FmcwRadar fmcw_radar(const FmcwSettings& options);

// E-UNSUPPORTED for a waveform that has no maps, detections or cells.
void check_has_maps(const FmcwRadar& radar);
// Beside that E-RANGE where the detector's window would meet itself around the Doppler cells, or its guard cells leave
// some of the windows' main lobe to the background.
void check_detects(const FmcwRadar& radar);

// Recorded samples had a rate of their own, which decides their ranges: E-REF where the settings of a chirp
// sequence do not tell it.
void check_tells_samples(const FmcwSettings& options);

}  // namespace fanbeam::session
