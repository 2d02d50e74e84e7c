#include "bindings/python/lookups.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "atmosphere/path_attenuation.h"
#include "bindings/python/convert.h"
#include "bindings/python/interruptible.h"
#include "bindings/python/weather_fields.h"
#include "core/number_range.h"
#include "core/stop.h"
#include "materials/library/material_library.h"
#include "session/shipped.h"

namespace fanbeam::bindings {
namespace {

using atmosphere::PathAttenuation;
using materials::Material;
using materials::MaterialLibrary;

using Angles = py::array_t<double, py::array::c_style | py::array::forcecast>;

// As computed in single precision, 90 degrees are a bit more than pi/2: so much passes for it.
constexpr double kRounding_rad = 1e-6;

core::Polarisation polarisation_of(const std::string& word, core::ProblemList& problems) {
  if (word != "HH" && word != "VV")
    problems.error(core::ErrorClass::ref, {}, "polarisation", "\"" + word + "\"", "HH or VV");
  return word == "VV" ? core::Polarisation::vertical : core::Polarisation::horizontal;
}

MaterialLibrary library_in(const py::handle& file) {
  core::ProblemList problems;
  MaterialLibrary library = MaterialLibrary::from_file(
      value_of<std::filesystem::path>(file, "library", problems), problems);
  problems.throw_if_errors();
  return library;
}

py::list materials_of(const py::handle& file) {
  const MaterialLibrary library = library_in(file);
  py::list rows;
  for (const Material& material : library.all())
    rows.append(py::make_tuple(material.name, name_of(material.model), name_of(material.confidence),
                               material.source, material.note));
  return rows;
}

// work(i) of every value until one gives false. Of many without Python's lock, and until Ctrl-C.
template <class Work>
void for_all(py::ssize_t count, const Work& work) {
  constexpr py::ssize_t kFew = 10000;  // in less time than a thread takes to start
  const auto part = [&](py::ssize_t begin, py::ssize_t end) {
    for (py::ssize_t i = begin; i < end; ++i)
      if (!work(i)) return false;
    return true;
  };
  if (count <= kFew) {
    part(0, count);
    return;
  }
  without_lock([&](const core::StopToken& stop) {
    const core::StopScope scope(stop);
    for (py::ssize_t begin = 0; begin < count; begin += kFew) {
      core::throw_if_stopped();
      if (!part(begin, std::min(begin + kFew, count))) return;
    }
  });
}

// "[3, 17]", as Python finds the value; "" of a number by itself.
std::string place_in(const std::vector<py::ssize_t>& shape, py::ssize_t flat) {
  std::string place;
  for (auto size = shape.rbegin(); size != shape.rend(); ++size) {
    place = std::to_string(flat % *size) + (place.empty() ? "" : ", ") + place;
    flat /= *size;
  }
  return place.empty() ? "" : "[" + place + "]";
}

std::vector<py::ssize_t> shape_of(const Angles& angles_rad) {
  return {angles_rad.shape(), angles_rad.shape() + angles_rad.ndim()};
}

Angles angles_of(const py::handle& told, core::ProblemList& problems) {
  // Truths, texts and None would be read as numbers.
  constexpr std::string_view kNumbers = "iuf";
  const py::array given = py::array::ensure(told);
  const bool numbers = given && kNumbers.find(given.dtype().kind()) != std::string_view::npos;
  const Angles angles_rad = numbers ? Angles::ensure(given) : Angles();
  if (!numbers || !angles_rad) refuse_type("grazing_rad", "a number or an array of numbers", told);
  const double* const values_rad = angles_rad.data();
  const std::vector<py::ssize_t> shape = shape_of(angles_rad);
  for_all(angles_rad.size(), [&](py::ssize_t i) {
    if (core::NumberRange{0.0, core::kPi / 2 + kRounding_rad}.holds(values_rad[i])) return true;
    const bool others = !problems.is_full();  // of the first that is not, that there are more
    core::check_range(problems, "grazing_rad" + place_in(shape, i), values_rad[i],
                      {0.0, core::kPi / 2}, "rad");
    return others;
  });
  return angles_rad;
}

// Linear, of every grazing angle.
py::array_t<double> nrcs(const py::handle& file, const py::handle& name,
                         const py::handle& grazing_rad, const py::handle& frequency_Hz,
                         const py::handle& polarisation, const py::handle& state,
                         const py::handle& extrapolate, py::list& warnings) {
  core::ProblemList problems;
  const auto material = value_of<std::string>(name, "material", problems);
  const Angles angles_rad = angles_of(grazing_rad, problems);
  core::ProblemList beyond;  // where nothing is extrapolated to
  const auto frequency =
      number_of<double>(frequency_Hz, "frequency_Hz", beyond, materials::kNrcsFrequencies_Hz, "Hz");
  problems.append(beyond.all());
  const core::Polarisation seen =
      polarisation_of(value_of<std::string>(polarisation, "polarisation", problems), problems);
  const auto state_word = value_of<std::string>(state, "state", problems);
  const bool allowed = value_of<bool>(extrapolate, "extrapolate", problems);
  std::optional<MaterialLibrary> library;
  collect(problems, [&] { library = library_in(file); });
  materials::SurfaceState surface{};
  collect(problems, [&] { surface = materials::surface_state_of(state_word, "state"); });
  const auto found = library ? library->find(material, {}, "material", problems) : std::nullopt;
  if (found && !beyond.has_errors())
    library->report_extrapolations(library->in_state(*found, surface), seen, frequency, allowed,
                                   problems, "extrapolate=True");
  problems.throw_if_errors();
  for (const py::handle warning : problems_list(problems.all())) warnings.append(warning);
  const materials::NrcsCurve curve((*library)[library->in_state(*found, surface)].model, seen,
                                   frequency);
  py::array_t<double> result(shape_of(angles_rad));
  const double* const from_rad = angles_rad.data();
  double* const to = result.mutable_data();
  for_all(angles_rad.size(), [&](py::ssize_t i) {
    to[i] = curve.sigma0(std::sin(std::min(from_rad[i], core::kPi / 2)));
    return true;
  });
  return result;
}

PathAttenuation air_of(const py::dict& weather, const py::handle& frequency_Hz) {
  core::ProblemList problems;
  const auto frequency = number_of<double>(frequency_Hz, "frequency_Hz", problems,
                                           atmosphere::kWeatherFrequencies_Hz, "Hz");
  if (!problems.has_errors()) return {changed_weather({}, weather, frequency), frequency};
  // What is wrong with the weather is told beside it: at a frequency that its laws take.
  constexpr double kUsual_Hz = 35e9;
  collect(problems, [&] {
    atmosphere::problems_in(changed_weather({}, weather, kUsual_Hz), kUsual_Hz).throw_if_errors();
  });
  throw core::InputError(problems.all());
}

// The air's profile ends there: a look-up beyond it would have the air of its ends go on for ever.
constexpr core::NumberRange kHeights_m{PathAttenuation::kLowest_m, PathAttenuation::kHighest_m};

py::dict by_cause(const PathAttenuation& air, const py::handle& height_m) {
  core::ProblemList problems;
  const auto height = number_of<double>(height_m, "height_m", problems, kHeights_m, "m");
  problems.throw_if_errors();
  const atmosphere::SpecificAttenuation loss = air.one_way_attenuation_dB_per_km(height);
  py::dict result;
  result["gas"] = loss.gas_dB_per_km;
  result["fog"] = loss.fog_dB_per_km;
  result["rain"] = loss.rain_dB_per_km;
  result["snow"] = loss.snow_dB_per_km;
  return result;
}

double one_way_dB(const PathAttenuation& air, const py::handle& from_height_m,
                  const py::handle& to_height_m, const py::handle& length_m) {
  core::ProblemList problems;
  const auto from_m = number_of<double>(from_height_m, "from_height_m", problems, kHeights_m, "m");
  const auto to_m = number_of<double>(to_height_m, "to_height_m", problems, kHeights_m, "m");
  const auto along_m = number_of<double>(length_m, "length_m", problems, {0.0}, "m");
  problems.throw_if_errors();
  // A path straight up or down may be as long as the difference but for rounding.
  constexpr double kRounding = 1e-9;
  const double apart_m = std::abs(to_m - from_m);
  if (along_m * (1.0 + kRounding) < apart_m)
    core::throw_input_error(
        core::ErrorClass::range, "length_m", along_m,
        "at least " + core::number_text(apart_m) + " m, what the two heights are apart");
  return air.one_way_dB(from_m, to_m, along_m);
}

}  // namespace

void add_lookups(py::module_& module) {
  module.def("shipped_above", &session::shipped_above, py::arg("file"));
  module.def("shipped_scenes", &session::shipped_scenes, py::arg("shipped"));
  module.def("shipped_sensors", &session::shipped_sensors, py::arg("shipped"));
  module.def("materials", &materials_of, py::arg("library"));
  module.def("nrcs", &nrcs, py::arg("library"), py::arg("material"), py::arg("grazing_rad"),
             py::arg("frequency_Hz"), py::arg("polarisation"), py::arg("state"),
             py::arg("extrapolate"), py::arg("warnings"));
  py::class_<PathAttenuation>(module, "Air", "Of fanbeam.Atmosphere, which documents it.")
      .def(py::init(&air_of), py::arg("weather"), py::arg("frequency_Hz"))
      .def("one_way_dB_per_km", &by_cause, py::arg("height_m"))
      .def("one_way_dB", &one_way_dB, py::arg("from_height_m"), py::arg("to_height_m"),
           py::arg("length_m"));
}

}  // namespace fanbeam::bindings
