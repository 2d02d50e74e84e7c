#include "bindings/python/weather_fields.h"

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "bindings/python/convert.h"
#include "core/errors.h"

namespace fanbeam::bindings {
namespace {

namespace py = pybind11;
using atmosphere::Weather;

using Member = std::variant<std::optional<double> Weather::*, double Weather::*, bool Weather::*>;
struct Field {
  const char* name;
  Member member;
};

const Field kFields[] = {{"visibility_m", &Weather::visibility_m},
                         {"liquid_water_g_per_m3", &Weather::liquid_water_g_per_m3},
                         {"fog_top_m", &Weather::fog_top_m},
                         {"rain_rate_mm_per_h", &Weather::rain_rate_mm_per_h},
                         {"rain_top_m", &Weather::rain_top_m},
                         {"melting_layer", &Weather::melting_layer},
                         {"melting_height_m", &Weather::melting_height_m},
                         {"snow_rate_mm_per_h", &Weather::snow_rate_mm_per_h},
                         {"snow_top_m", &Weather::snow_top_m},
                         {"temperature_C", &Weather::temperature_C},
                         {"pressure_hPa", &Weather::pressure_hPa},
                         {"humidity", &Weather::humidity}};

}  // namespace

Weather changed_weather(Weather weather, const py::dict& changes, double frequency_Hz) {
  const Weather usual;
  core::ProblemList problems;
  for (const auto& [key, entry] : changes) {
    const py::handle value = entry;
    const auto name = key.cast<std::string>();
    const Field* found = nullptr;
    for (const Field& field : kFields)
      if (name == field.name) found = &field;
    if (found == nullptr) throw py::type_error("the weather has no \"" + name + "\"");
    const auto put = [&](auto& place, const auto& without) {
      using Value = std::conditional_t<std::is_same_v<decltype(place), bool&>, bool, double>;
      if (value.is_none())
        place = without;
      else if (const auto held = held_of<Value>(value, name, problems))
        place = *held;
    };
    std::visit([&](auto member) { put(weather.*member, usual.*member); }, found->member);
  }
  // Whoever speaks of fog tells all of it.
  const auto given = [&](const char* name) {
    return changes.contains(name) && !changes[name].is_none();
  };
  if (changes.contains("visibility_m") || changes.contains("liquid_water_g_per_m3")) {
    if (!given("visibility_m")) weather.visibility_m.reset();
    if (!given("liquid_water_g_per_m3")) weather.liquid_water_g_per_m3.reset();
  }
  if (problems.has_errors()) problems.append(atmosphere::problems_in(weather, frequency_Hz).all());
  problems.throw_if_errors();
  return weather;
}

py::dict weather_dict(const Weather& weather) {
  py::dict result;
  for (const Field& field : kFields)
    std::visit([&](auto member) { result[field.name] = weather.*member; }, field.member);
  return result;
}

}  // namespace fanbeam::bindings
