#include "renderer/accuracy/swept_picture.h"

#include <cstddef>

#include "core/errors.h"
#include "core/parallel.h"
#include "sensors/receiver/point_response.h"

namespace fanbeam::renderer {

sensors::Sensor thin_cells(sensors::Sensor sensor, int parts) {
  if (parts < 1 || parts > 64)
    core::throw_input_error(core::ErrorClass::range, "parts", parts, "1 to 64");
  sensor.range.cell_m /= parts;
  sensor.range.cells *= parts;
  sensor.waveform.window = sensors::Waveform::Window::none;
  sensor.scan.sweep = sensors::Scan::Sweep::per_column;
  return sensor;
}

std::vector<double> swept_power_W(const sensors::Sensor& sensor, const std::vector<double>& thin_W,
                                  int parts) {
  const int cells = sensor.range.cells, thin_cells = cells * parts;
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  if (thin_W.size() != static_cast<std::size_t>(thin_cells) * columns)
    throw core::InternalError("a picture of other cells");
  const bool varies = sensors::point_response_varies(sensor);
  // Share of a thin cell's power by its distance from the nearest thin cell of the gate.
  const auto shares_of = [&](int column) {
    const sensors::PointResponse response(sensor, column);
    std::vector<double> shares(static_cast<std::size_t>(2 * thin_cells));
    for (int i = 0; i < 2 * thin_cells; ++i) {
      const double offset_cells = (i - thin_cells + 0.5) / parts - 0.5;
      shares[static_cast<std::size_t>(i)] =
          response.density_per_m(offset_cells * sensor.range.cell_m) * sensor.range.cell_m;
    }
    return shares;
  };
  const std::vector<double> same = varies ? std::vector<double>() : shares_of(0);
  std::vector<double> power_W(static_cast<std::size_t>(cells) * columns, 0.0);
  core::parallel_for(columns, [&](std::size_t column) {
    const std::vector<double>& shares = varies ? shares_of(static_cast<int>(column)) : same;
    for (int cell = 0; cell < cells; ++cell) {
      double sum = 0.0;
      for (int thin = 0; thin < thin_cells; ++thin)
        sum += shares[static_cast<std::size_t>(thin - cell * parts + thin_cells)] *
               thin_W[static_cast<std::size_t>(thin) * columns + column];
      power_W[static_cast<std::size_t>(cell) * columns + column] = sum;
    }
  });
  return power_W;
}

}  // namespace fanbeam::renderer
