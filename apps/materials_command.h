// `fanbeam materials`: what the library holds, plots of it, and fits of the Phong-like form.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common.h"

namespace fanbeam::apps {

// Which rows, and how they are looked at.
struct MaterialsView {
  std::string library;  // a file; empty for the shipped one
  double frequency_GHz = 35.0;
  std::string polarisation = "HH";
  std::string state = "dry";
  bool json = false;
};

struct MaterialsPlotOptions {
  std::string output;
  std::vector<std::string> names;  // all rows when empty
};

// The source of a fit: a model as library rows write it, a table of measurements, or a library.
struct MaterialsFitOptions {
  std::string model, terrain, medium, csv;
  std::vector<double> permittivity;  // real, loss
  std::optional<double> sea_state, rms_height_mm, rms_slope, temperature_C;
  std::string angles = "standard";
  bool whole_library = false;  // prints the library's text with all fits made again
};

struct MaterialsOptions {
  enum class Task { list, plot, fit, objects };  // its subcommands; none: list
  Task task = Task::list;
  MaterialsView view;
  MaterialsPlotOptions plot;
  MaterialsFitOptions fit;
};

// Returns an exit code; throws InputError for bad input.
int materials(const MaterialsOptions& options, const CommonOptions& common);
CLI::App& add_materials_command(CLI::App& program, MaterialsOptions& options);

}  // namespace fanbeam::apps
