#include "bindings/python/frame.h"

#include <pybind11/stl.h>

#include "sensors/display/display.h"

namespace fanbeam::bindings {
namespace {

using renderer::LayerSet;

// Of a B-scope turned, so that the farthest range is on top as in pictures.
py::dict layers_dict(const LayerSet& layers, std::size_t columns, bool of_bscope,
                     const py::object& owner) {
  py::dict result;
  const auto put = [&](const char* name, const auto& values) {
    result[name] = rows_of(values, columns, of_bscope, owner);
  };
  put("visibility", layers.visibility);
  if (!of_bscope) put("range_m", layers.range_m);
  put("grazing_rad", layers.grazing_rad);
  put("nrcs", layers.nrcs);
  if (of_bscope) put("elevation_rad", layers.elevation_rad);
  put("double_bounce", layers.double_bounce);
  put("material", layers.material);
  put("object", layers.object);
  return result;
}

py::array picture(core::Picture8&& made) {
  const auto held = std::make_shared<const core::Picture8>(std::move(made));
  return rows_of(held->pixels, static_cast<std::size_t>(held->columns), false, owner_of(held));
}

}  // namespace

py::dict frame_dict(const std::shared_ptr<const renderer::Frame>& frame,
                    const renderer::Products& wanted, const sensors::Sensor& sensor) {
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  const py::object owner = owner_of(frame);
  py::dict result;
  for (const char* name : {"bscope", "cscope", "bscope_grey", "cscope_grey", "bscope_W",
                           "cscope_W_m3", "layers", "cscope_layers"})
    result[name] = py::none();
  if (wanted.bscope) {
    result["bscope"] = picture(sensors::bscope_picture(sensor, frame->bscope_grey));
    result["bscope_grey"] = rows_of(frame->bscope_grey, columns, true, owner);
    result["bscope_W"] = rows_of(frame->bscope_W, columns, true, owner);
  }
  if (wanted.cscope) {
    result["cscope"] = picture(sensors::cscope_picture(sensor, frame->cscope_grey));
    result["cscope_grey"] = rows_of(frame->cscope_grey, columns, false, owner);
    result["cscope_W_m3"] = rows_of(frame->cscope_W_m3, columns, false, owner);
  }
  if (wanted.layers) result["layers"] = layers_dict(frame->layers->bscope, columns, true, owner);
  if (wanted.cscope_layers)
    result["cscope_layers"] = layers_dict(frame->layers->cscope, columns, false, owner);
  result["noise_W"] = frame->noise_W;
  result["rays"] = frame->rays;
  result["slices"] = frame->slices;
  result["events"] = frame->events;
  const auto estimate = [](bool of_wanted, double grey) {
    return of_wanted ? py::object(py::float_(grey)) : py::object(py::none());
  };
  result["estimated_error_grey"] = py::none();
  if (frame->error)
    result["estimated_error_grey"] =
        py::make_tuple(estimate(wanted.bscope, frame->error->rms_grey),
                       estimate(wanted.cscope, frame->error->cscope_rms_grey));
  return result;
}

}  // namespace fanbeam::bindings
