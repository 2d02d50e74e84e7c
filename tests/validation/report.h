// Comparisons of our values with published ones, and the Markdown document that lists them all.
#pragma once

#include <string>
#include <vector>

namespace fanbeam::validation {

struct Comparison {
  std::string what;
  double ours = 0.0;
  double published = 0.0;
};

// One published table or set of figures.
struct Section {
  enum class Measure {
    relative,    // |ours - published| / |published|
    difference,  // |ours - published|, in the section's unit
  };
  std::string title;
  std::string source;  // document, edition, table
  std::string unit;
  Measure measure = Measure::relative;
  double tolerance = 0.0;
  std::string reason;  // why this tolerance
  std::vector<Comparison> rows{};

  void add(std::string what, double ours, double published) {
    rows.push_back({std::move(what), ours, published});
  }
};

double deviation(const Section& section, const Comparison& row);

// Rows outside their tolerance, one line each; a value that is not finite is outside.
std::vector<std::string> failures(const std::vector<Section>& sections);

// Deviations below 1e-9 are printed as such: they are rounding, which differs between machines.
std::string markdown(const std::vector<Section>& sections);

// What each part of the program is held against.
std::vector<Section> gas_sections();
std::vector<Section> fog_sections();
std::vector<Section> rain_sections();
std::vector<Section> surface_sections();
std::vector<Section> dielectric_sections();
std::vector<Section> target_sections();
std::vector<Section> precipitation_sections();
std::vector<Section> sensor_sections();
std::vector<Section> detection_sections();

}  // namespace fanbeam::validation
