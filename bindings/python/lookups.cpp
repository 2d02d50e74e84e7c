#include "bindings/python/lookups.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>

#include "atmosphere/path_attenuation.h"
#include "bindings/python/convert.h"
#include "bindings/python/weather_fields.h"
#include "core/number_range.h"
#include "materials/library/material_library.h"
#include "session/shipped.h"

namespace fanbeam::bindings {
namespace {

using atmosphere::PathAttenuation;
using materials::Material;
using materials::MaterialLibrary;

core::Polarisation polarisation_of(const std::string& word) {
  if (word == "HH") return core::Polarisation::horizontal;
  if (word == "VV") return core::Polarisation::vertical;
  core::throw_input_error(core::ErrorClass::ref, "polarisation", "\"" + word + "\"", "HH or VV");
}

MaterialLibrary library_in(const std::filesystem::path& file) {
  core::ProblemList problems;
  MaterialLibrary library = MaterialLibrary::from_file(file, problems);
  problems.throw_if_errors();
  return library;
}

py::list materials_of(const std::filesystem::path& file) {
  const MaterialLibrary library = library_in(file);
  py::list rows;
  for (const Material& material : library.all())
    rows.append(py::make_tuple(material.name, name_of(material.model), name_of(material.confidence),
                               material.source, material.note));
  return rows;
}

// Linear, of every grazing angle.
py::array_t<double> nrcs(
    const std::filesystem::path& file, const std::string& name,
    const py::array_t<double, py::array::c_style | py::array::forcecast>& grazing_rad,
    double frequency_Hz, const std::string& polarisation, const std::string& state,
    bool extrapolate, py::list& warnings) {
  const MaterialLibrary library = library_in(file);
  core::ProblemList problems;
  const core::Polarisation seen = polarisation_of(polarisation);
  const materials::SurfaceState surface = materials::surface_state_of(state, "state");
  const auto found = library.find(name, {}, "material", problems);
  problems.throw_if_errors();
  const std::size_t shown = library.in_state(*found, surface);
  library.report_extrapolations(shown, seen, frequency_Hz, extrapolate, problems);
  for (py::ssize_t i = 0; i < grazing_rad.size(); ++i)
    core::check_range(problems, "grazing_rad", grazing_rad.data()[i], {0.0, core::kPi / 2}, "rad");
  problems.throw_if_errors();
  for (const py::handle warning : problems_list(problems.all())) warnings.append(warning);
  const materials::NrcsCurve curve(library[shown].model, seen, frequency_Hz);
  py::array_t<double> result(
      std::vector<py::ssize_t>(grazing_rad.shape(), grazing_rad.shape() + grazing_rad.ndim()));
  for (py::ssize_t i = 0; i < grazing_rad.size(); ++i)
    result.mutable_data()[i] = curve.sigma0(std::sin(grazing_rad.data()[i]));
  return result;
}

PathAttenuation air_of(const py::dict& weather, double frequency_Hz) {
  return {changed_weather({}, weather), frequency_Hz};
}

py::dict by_cause(const PathAttenuation& air, double height_m) {
  core::require_range("height_m", height_m, {});
  const atmosphere::SpecificAttenuation loss = air.one_way_attenuation_dB_per_km(height_m);
  py::dict result;
  result["gas"] = loss.gas_dB_per_km;
  result["fog"] = loss.fog_dB_per_km;
  result["rain"] = loss.rain_dB_per_km;
  result["snow"] = loss.snow_dB_per_km;
  return result;
}

double one_way_dB(const PathAttenuation& air, double from_height_m, double to_height_m,
                  double length_m) {
  core::ProblemList problems;
  core::check_range(problems, "from_height_m", from_height_m, {});
  core::check_range(problems, "to_height_m", to_height_m, {});
  core::check_range(problems, "length_m", length_m, {0.0}, "m");
  problems.throw_if_errors();
  // A path straight up or down may be as long as the difference but for rounding.
  constexpr double kRounding = 1e-9;
  const double apart_m = std::abs(to_height_m - from_height_m);
  if (length_m * (1.0 + kRounding) < apart_m)
    core::throw_input_error(
        core::ErrorClass::range, "length_m", length_m,
        "at least " + core::number_text(apart_m) + " m, what the two heights are apart");
  return air.one_way_dB(from_height_m, to_height_m, length_m);
}

}  // namespace

void add_lookups(py::module_& module) {
  module.def("shipped_above", &session::shipped_above, py::arg("file"));
  module.def("shipped_scenes", &session::shipped_scenes, py::arg("shipped"));
  module.def("shipped_sensors", &session::shipped_sensors, py::arg("shipped"));
  module.def("find_scene", &session::find_scene, py::arg("name"), py::arg("shipped"));
  module.def("find_sensor", &session::find_sensor, py::arg("name"), py::arg("shipped"),
             py::arg("field"));
  module.def(
      "check_data_folder",
      [](const std::string& folder, const std::string& field) {
        core::ProblemList problems;
        session::check_data_folder(folder, field, problems);
        problems.throw_if_errors();
      },
      py::arg("folder"), py::arg("field"));
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
