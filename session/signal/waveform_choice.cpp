#include "session/signal/waveform_choice.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "core/text.h"
#include "signal/waveform/factories.h"

namespace fanbeam::session {
namespace {

using signal::WaveformKind;

// Hands out what was given and remembers what nobody asked for.
class Given {
 public:
  explicit Given(const WaveformSettings& options) : options_(options) {}

  void put(std::string_view option, double& value) {
    const std::size_t i = waveform_number(option);
    taken_.insert(i);
    if (options_.numbers[i]) value = *options_.numbers[i] * kWaveformNumbers[i].to_SI;
  }
  void put(std::string_view option, int& value) {
    const std::size_t i = waveform_number(option);
    double number = value;
    put(option, number);
    if (number == std::floor(number))
      value = static_cast<int>(number);
    else
      problems_.error(core::ErrorClass::range, {}, kWaveformNumbers[i].option,
                      core::number_text(number), "a whole number");
  }
  void put_complex(bool& complex_baseband) {
    real_taken_ = true;
    complex_baseband = !options_.real;
  }
  void put_down_first(bool& down_first) {
    down_first_taken_ = true;
    down_first = options_.down_first;
  }

  // With what else is wrong.
  void refuse_the_rest(const std::vector<core::Problem>& others) {
    problems_.append(others);
    for (std::size_t i = 0; i < kWaveformNumbers.size(); ++i)
      if (options_.numbers[i] && !taken_.contains(i))
        refuse(kWaveformNumbers[i].option, core::number_text(*options_.numbers[i]));
    if (options_.real && !real_taken_) refuse("--real", "given");
    if (options_.down_first && !down_first_taken_) refuse("--down-first", "given");
    problems_.throw_if_errors();
  }

 private:
  void refuse(const char* option, const std::string& value) {
    problems_.error(core::ErrorClass::unsupported, {}, option, value,
                    "a parameter of " + options_.kind);
  }

  const WaveformSettings& options_;
  std::set<std::size_t> taken_;
  bool real_taken_ = false, down_first_taken_ = false;
  core::ProblemList problems_;
};

void put_chirps(Given& given, signal::ChirpSequenceParameters& chirps) {
  given.put("--frequency", chirps.frequency_Hz);
  given.put("--bandwidth", chirps.bandwidth_Hz);
  given.put("--ramp", chirps.ramp_s);
  // Without pauses unless they are asked for.
  chirps.interval_s = chirps.ramp_s;
  given.put("--interval", chirps.interval_s);
  given.put("--chirps", chirps.chirps);
  given.put("--slots", chirps.slots);
  given.put("--sample-rate", chirps.sample_rate_Hz);
  given.put_complex(chirps.complex_baseband);
}

void put_triangle(Given& given, const char* ramp, const char* rate,
                  signal::TriangleParameters& triangle) {
  given.put("--frequency", triangle.frequency_Hz);
  given.put("--bandwidth", triangle.bandwidth_Hz);
  given.put(ramp, triangle.ramp_s);
  given.put(rate, triangle.sample_rate_Hz);
  given.put_complex(triangle.complex_baseband);
}

signal::Waveform flat_waveform(WaveformKind kind, Given& given) {
  if (kind == WaveformKind::pulsed) {
    signal::PulsedParameters pulsed;
    given.put("--frequency", pulsed.frequency_Hz);
    given.put("--pulse-width", pulsed.pulse_width_s);
    given.put("--interval", pulsed.interval_s);
    given.put("--pulses", pulsed.pulses);
    given.put("--sample-rate", pulsed.sample_rate_Hz);
    return signal::pulsed(pulsed);
  }
  if (kind == WaveformKind::sinusoidal) {
    signal::SinusoidalParameters sinusoidal;
    given.put("--frequency", sinusoidal.frequency_Hz);
    given.put("--bandwidth", sinusoidal.deviation_Hz);
    given.put("--modulation", sinusoidal.modulation_Hz);
    given.put("--sample-rate", sinusoidal.sample_rate_Hz);
    given.put_complex(sinusoidal.complex_baseband);
    return signal::sinusoidal(sinusoidal);
  }
  if (kind == WaveformKind::stepped) {
    signal::SteppedParameters stepped;
    given.put("--frequency", stepped.frequency_Hz);
    given.put("--bandwidth", stepped.bandwidth_Hz);
    given.put("--shift", stepped.shift_Hz);
    given.put("--steps", stepped.steps);
    given.put("--step", stepped.step_s);
    given.put("--sample-rate", stepped.sample_rate_Hz);
    return signal::stepped(stepped);
  }
  signal::ContinuousParameters tone;
  given.put("--frequency", tone.frequency_Hz);
  given.put("--duration", tone.duration_s);
  given.put("--sample-rate", tone.sample_rate_Hz);
  given.put_complex(tone.complex_baseband);
  return signal::continuous(tone);
}

signal::Waveform ramped_waveform(WaveformKind kind, Given& given) {
  if (kind == WaveformKind::chirp_sequence) {
    signal::ChirpSequenceParameters chirps;
    put_chirps(given, chirps);
    return signal::chirp_sequence(chirps);
  }
  if (kind == WaveformKind::two_stage) {
    signal::TwoStageParameters stages;
    put_chirps(given, stages.coarse);
    put_triangle(given, "--fine-ramp", "--fine-sample-rate", stages.fine);
    given.put_down_first(stages.fine.down_first);
    return signal::two_stage(stages);
  }
  if (kind == WaveformKind::coded_triangle) {
    signal::CodedTriangleParameters coded;
    put_triangle(given, "--ramp", "--sample-rate", coded.ramps);
    given.put("--flat", coded.flat_s);
    given.put("--hop", coded.hop_Hz);
    given.put("--code-degree", coded.code_degree);
    return signal::coded_triangle(coded);
  }
  signal::TwoSlopesParameters slopes;
  put_triangle(given, "--ramp", "--sample-rate", slopes.first);
  given.put_down_first(slopes.first.down_first);
  if (kind == WaveformKind::triangle) return signal::triangle(slopes.first);
  given.put("--second-ramp", slopes.second_ramp_s);
  return signal::two_slopes(slopes);
}

// The factories name fields in SI; whoever asked named options in their units.
core::Problem in_words_of_options(core::Problem problem) {
  constexpr std::pair<const char*, const char*> kNames[] = {{"frequency_Hz", "--frequency"},
                                                            {"bandwidth_Hz", "--bandwidth"},
                                                            {"deviation_Hz", "--bandwidth"},
                                                            {"sample_rate_Hz", "--sample-rate"},
                                                            {"interval_s", "--interval"},
                                                            {"ramp_s", "--ramp"},
                                                            {"second_ramp_s", "--second-ramp"},
                                                            {"pulse_width_s", "--pulse-width"},
                                                            {"hop_Hz", "--hop"},
                                                            {"|shift_Hz|", "--shift"}};
  // Of no single option: a product.
  if (problem.field == "chirps x slots") problem.field = "--chirps x slots";
  if (problem.field == "samples") {
    problem.field = "--sample-rate";
    problem.value += " samples";
  }
  for (const auto& [field, option] : kNames)
    for (const WaveformNumber& number : kWaveformNumbers)
      if (problem.field == field && std::string_view(option) == number.option)
        if (const core::ParsedNumber value = core::parse_number(problem.value);
            value.error == core::NumberError::none) {
          problem.field = option;
          // To the digits that somebody told, without those of the conversion.
          problem.value = fmt::format("{:.12g}", value.value / number.to_SI);
          return problem;
        }
  return problem;
}

}  // namespace

std::string waveform_kinds_text() {
  std::string text;
  for (const WaveformKind kind : signal::all_waveform_kinds())
    text.append(text.empty() ? "" : ", ").append(signal::name(kind));
  return text;
}

std::size_t waveform_number(std::string_view option) {
  for (std::size_t i = 0; i < kWaveformNumbers.size(); ++i)
    if (kWaveformNumbers[i].option == option) return i;
  throw core::InternalError("no such number of a waveform");
}

signal::Waveform chosen_waveform(const WaveformSettings& options) {
  const std::optional<WaveformKind> kind = signal::waveform_kind(options.kind);
  if (!kind)
    core::throw_input_error(core::ErrorClass::ref, "KIND", "\"" + options.kind + "\"",
                            "one of: " + waveform_kinds_text());
  Given given(options);
  const bool is_flat = *kind == WaveformKind::continuous || *kind == WaveformKind::pulsed ||
                       *kind == WaveformKind::sinusoidal || *kind == WaveformKind::stepped;
  signal::Waveform waveform;
  std::vector<core::Problem> problems;
  try {
    waveform = is_flat ? flat_waveform(*kind, given) : ramped_waveform(*kind, given);
  } catch (const core::InputError& error) {
    for (const core::Problem& problem : error.problems())
      problems.push_back(in_words_of_options(problem));
  }
  given.refuse_the_rest(problems);
  return waveform;
}

}  // namespace fanbeam::session
