// fanbeam._signal: what fanbeam/signal.py is written over. Links FFTW.
#include <fmt/format.h>
#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/python/convert.h"
#include "bindings/python/interruptible.h"
#include "bindings/python/scene_handle.h"
#include "core/number_range.h"
#include "core/parallel.h"
#include "core/text.h"
#include "session/signal/chain.h"
#include "session/signal/paths.h"
#include "session/signal/radar_file.h"
#include "session/signal/signal_session.h"
#include "session/signal/waveform_choice.h"
#include "session/signal/waveform_figures.h"

namespace fanbeam::bindings {
namespace {

// "--sample-rate" of the program is the argument sample_rate, KIND is kind.
std::string in_python_words(const std::string& text) {
  if (text == "KIND") return "kind";
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    if (text.compare(i, 2, "--") != 0) {
      result += text[i++];
      continue;
    }
    std::string word;
    for (i += 2; i < text.size() &&
                 (std::islower(static_cast<unsigned char>(text[i])) != 0 || text[i] == '-');
         ++i)
      word += text[i] == '-' ? '_' : text[i];
    // What Python has no argument for is said by a file.
    result += word.starts_with("cfar_") ? word + " of a radar file" : word;
  }
  return result;
}

// A number of the waveform by the name of Python's argument, in SI. Options and keys have handy units.
void tell_in_SI(core::Problem& problem) {
  for (const session::WaveformNumber& known : session::kWaveformNumbers) {
    if (problem.field != known.option && problem.field != std::string("waveform.") + known.key)
      continue;
    problem.field = known.option;
    if (const core::ParsedNumber value = core::parse_number(problem.value);
        value.error == core::NumberError::none)
      problem.value = fmt::format("{:.12g}", value.value * known.to_SI);
    return;
  }
}

// What `work` refuses by the program's options is told by Python's arguments.
template <class Work>
auto told_in_python_words(const Work& work) {
  try {
    return work();
  } catch (const core::InputError& error) {
    std::vector<core::Problem> problems = error.problems();
    for (core::Problem& problem : problems) {
      tell_in_SI(problem);
      problem.field = in_python_words(problem.field);
      problem.expected = in_python_words(problem.expected);
    }
    throw core::InputError(std::move(problems));
  }
}

// Of kWaveformNumbers by the name of their option, "bandwidth", "sample_rate": in SI, into the units
// that the options have.
template <class Settings>
void take_numbers(const py::dict& numbers, Settings& settings) {
  core::ProblemList problems;
  std::map<std::string, double> rest;
  for (const auto& [key, value] : numbers) {
    const auto name = value_of<std::string>(key, "numbers", problems, "names that are texts");
    if (const auto number = held_of<double>(value, name, problems)) rest[name] = *number;
  }
  for (std::size_t i = 0; i < session::kWaveformNumbers.size(); ++i) {
    const session::WaveformNumber& known = session::kWaveformNumbers[i];
    std::string name = std::string(known.option).substr(2);
    std::replace(name.begin(), name.end(), '-', '_');
    const auto found = rest.find(name);
    if (found == rest.end()) continue;
    core::check_range(problems, name, found->second,
                      {known.least * known.to_SI, known.most * known.to_SI}, "(SI)");
    settings.numbers[i] = found->second / known.to_SI;
    rest.erase(found);
  }
  std::string names;
  for (const session::WaveformNumber& known : session::kWaveformNumbers)
    names += (names.empty() ? "" : ", ") + std::string(known.option).substr(2);
  std::replace(names.begin(), names.end(), '-', '_');
  for (const auto& [name, value] : rest)
    problems.error(core::ErrorClass::ref, {}, name, core::number_text(value), names);
  problems.throw_if_errors();
}

// Of the names in fanbeam.signal.frame's `want`; none where it was not told.
using Products = std::optional<std::set<std::string>>;

Products products_of(const std::optional<py::list>& want, core::ProblemList& problems) {
  if (!want) return std::nullopt;
  constexpr std::array<std::string_view, 5> kNames = {"beat", "cube", "range-doppler",
                                                      "range-azimuth", "detections"};
  std::set<std::string> products;
  for (const py::handle name : *want)
    products.insert(value_of<std::string>(name, "want", problems, "an iterable of texts"));
  for (const std::string& name : products)
    if (std::find(kNames.begin(), kNames.end(), name) == kNames.end())
      problems.error(core::ErrorClass::ref, {}, "want", "\"" + name + "\"",
                     fmt::format("{}", fmt::join(kNames, ", ")));
  return products;
}

// What is wrong goes to `problems`. `own`: the radar file that the scene names, which another one
// replaces.
session::FmcwSettings settings_of(const py::dict& told, const std::filesystem::path& own,
                                  core::ProblemList& problems) {
  session::FmcwSettings settings;
  const auto given = value_of<std::filesystem::path>(told["radar"], "radar", problems);
  if (const std::filesystem::path& file = given.empty() ? own : given; !file.empty())
    collect(problems, [&] { settings = session::radar_settings(file); });
  // What is missing stays as the file or the default has it.
  const auto take = [&]<class T>(const char* name, T& value) {
    if (told.contains(name)) value = value_of<T>(told[name], name, problems);
  };
  const auto take_number = [&]<class T>(const char* name, T& value, const core::NumberRange& range,
                                        const char* unit = "") {
    if (told.contains(name)) value = number_of<T>(told[name], name, problems, range, unit);
  };
  std::string waveform;
  take("waveform", waveform);
  if (!waveform.empty()) settings.waveform = waveform;
  collect(problems, [&] { take_numbers(told["numbers"].cast<py::dict>(), settings); });
  if (told.contains("transmitters") || told.contains("receivers")) settings.put_on_a_line();
  take("real", settings.real);
  take_number("transmitters", settings.transmitters, {1, 64});
  take_number("receivers", settings.receivers, {1, 64});
  take_number("false_alarm_probability", settings.false_alarm_probability, {1e-12, 0.1});
  take_number("rays_per_cell", settings.rays_per_cell, {0.3, 1000.0});
  take_number("line_width_Hz", settings.line_width_Hz, {0.0, 1e6}, "Hz");
  take_number("adc_bits", settings.adc_bits, {0, 24});
  take("unfold", settings.unfold);
  take("seed", settings.seed);
  return settings;
}

// [channel, chirp, sample] over the cube's memory.
py::array cube_array(const signal::FloatCube& cube, const py::object& owner) {
  if (cube.values.empty())
    return py::array_t<std::complex<float>>(std::vector<py::ssize_t>{0, 0, 0});
  return py::array(py::dtype::of<std::complex<float>>(),
                   {cube.shape.channels, cube.shape.chirps, cube.shape.samples}, cube.values.data(),
                   owner);
}

py::object map_array(const signal::PowerMap& map, const py::object& owner) {
  if (map.values_W.empty()) return py::none();
  return rows_of(map.values_W, static_cast<std::size_t>(map.columns), false, owner);
}

struct Made {
  session::FmcwRadar radar;
  session::FmcwPaths paths;
  session::FmcwFrame frame;
};

// A row a detection: range, radial speed, azimuth, elevation, power, snr, cluster (-1 for none).
py::object detections_array(const std::optional<session::FmcwDetections>& found) {
  if (!found) return py::none();
  py::array_t<double> rows({found->detections.size(), std::size_t{7}});
  auto to = rows.mutable_unchecked<2>();
  for (std::size_t i = 0; i < found->detections.size(); ++i) {
    const signal::RadarDetection& at = found->detections[i];
    const double values[] = {at.range_m,
                             at.radial_speed_mps,
                             at.azimuth_rad,
                             at.elevation_rad,
                             at.power_W,
                             at.snr,
                             static_cast<double>(found->clusters[i])};
    for (int k = 0; k < 7; ++k) to(static_cast<py::ssize_t>(i), k) = values[k];
  }
  return rows;
}

py::dict axes_of(const session::FmcwRadar& radar) {
  py::dict result;
  result["azimuth_rad"] = radar.azimuths_rad;
  result["range_step_m"] = radar.axes.range_step_m;
  result["range_cells"] = radar.detection.transform.kept_range_cells;  // 0 without maps
  result["doppler_step_Hz"] = radar.axes.doppler_step_Hz;
  result["doppler_cells"] = radar.axes.doppler_cells;
  result["wavelength_m"] = radar.axes.wavelength_m;
  return result;
}

// Of nothing asked for, what the waveform has.
std::set<std::string> chosen_products(const Products& asked, const session::FmcwRadar& radar) {
  if (!asked)
    return radar.maps ? std::set<std::string>{"beat", "detections"} : std::set<std::string>{"beat"};
  for (const std::string& name : *asked)
    if (name != "beat" && !radar.maps)
      core::throw_input_error(
          core::ErrorClass::unsupported, "want", "\"" + name + "\"",
          "beat: maps and detections need a chirp sequence, of 2 chirps or more");
  return *asked;
}

py::dict frame(const Scene& scene, int index, const std::optional<py::list>& want,
               const py::dict& told) {
  const std::shared_ptr<const scenes::Scene> now = scene.session().scene();
  core::ProblemList problems;
  const Products asked = products_of(want, problems);
  const session::FmcwSettings settings = settings_of(told, now->description.signal_file, problems);
  problems.throw_if_errors();
  const sensors::Sensor& sensor = now->description.sensor;
  const auto made = std::make_shared<Made>();
  told_in_python_words([&] {
    without_lock([&](const core::StopToken& stop) {
      const core::StopScope scope(stop);
      const core::ThreadLimit limit(scene.session().threads());
      made->radar = session::fmcw_radar(settings, sensor);
      const std::set<std::string> products = chosen_products(asked, made->radar);
      session::check_processing(made->radar, products);
      const auto planned = session::planned_for_signals(now);
      made->paths = session::fmcw_paths(*planned, index, settings);
      made->frame =
          session::fmcw_frame(made->radar, *planned, made->paths, index, settings, products);
    });
  });
  const py::object owner = owner_of(made);
  py::list beats;
  for (const signal::FloatCube& beat : made->frame.beats) beats.append(cube_array(beat, owner));
  py::dict result;
  result["beats"] = beats;
  result["cube"] = made->frame.cube.values.empty()
                       ? py::object(py::none())
                       : py::object(cube_array(made->frame.cube, owner));
  result["range_doppler_W"] = map_array(made->frame.range_doppler, owner);
  result["range_azimuth_W"] = map_array(made->frame.range_azimuth, owner);
  result["detections"] = detections_array(made->frame.found);
  result["axes"] = axes_of(made->radar);
  result["waveform"] = session::waveform_json(made->radar.waveform);
  result["paths"] = made->paths.paths.size();
  result["rays"] = made->paths.rays;
  result["noise_cell_W"] = made->radar.noise_cell_W;
  result["synthesis_error"] = made->frame.synthesis_error;
  result["warnings"] = problems_list(made->frame.warnings);
  return result;
}

std::string waveform(const py::handle& kind, const py::dict& numbers, const py::handle& real,
                     const py::handle& down_first) {
  core::ProblemList problems;
  session::WaveformSettings settings;
  settings.kind = value_of<std::string>(kind, "kind", problems);
  settings.real = value_of<bool>(real, "real", problems);
  settings.down_first = value_of<bool>(down_first, "down_first", problems);
  take_numbers(numbers, settings);
  return told_in_python_words(
      [&] { return session::waveform_json(session::chosen_waveform(settings)); });
}

}  // namespace
}  // namespace fanbeam::bindings

PYBIND11_MODULE(_signal, module) {
  using namespace fanbeam;
  module.doc() = "What fanbeam.signal is written over; use that.";
  bindings::py::module_::import("fanbeam._core");
  bindings::translate_errors();
  module.def("frame", &bindings::frame, bindings::py::arg("scene"), bindings::py::arg("index"),
             bindings::py::arg("products"), bindings::py::arg("told"));
  module.def("waveform", &bindings::waveform, bindings::py::arg("kind"),
             bindings::py::arg("numbers"), bindings::py::arg("real"),
             bindings::py::arg("down_first"));
}
