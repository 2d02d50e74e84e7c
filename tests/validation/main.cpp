// Holds fanbeam against published figures. Fails when a value leaves its tolerance or when
// docs/validation.md is not what these comparisons give; FANBEAM_APPROVE=1 writes it.
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <vector>

#include "core/files.h"
#include "tests/validation/report.h"

namespace {

using fanbeam::validation::Section;

std::vector<Section> all_sections() {
  namespace v = fanbeam::validation;
  std::vector<Section> all;
  for (const auto& part : {v::gas_sections, v::fog_sections, v::rain_sections, v::surface_sections,
                           v::precipitation_sections, v::dielectric_sections, v::target_sections,
                           v::sensor_sections, v::detection_sections}) {
    const std::vector<Section> sections = part();
    all.insert(all.end(), sections.begin(), sections.end());
  }
  return all;
}

// The first line in which two texts differ, for the message.
std::string first_difference(const std::string& a, const std::string& b) {
  std::istringstream left(a);
  std::istringstream right(b);
  std::string line_a;
  std::string line_b;
  for (int number = 1;; ++number) {
    const bool more_a = static_cast<bool>(std::getline(left, line_a));
    const bool more_b = static_cast<bool>(std::getline(right, line_b));
    if (!more_a && !more_b) return "only in line ends";
    if (line_a != line_b || more_a != more_b)
      return "line " + std::to_string(number) + "\n  now       " + line_a + "\n  committed " +
             line_b;
  }
}

int validate() {
  const std::vector<Section> sections = all_sections();
  std::size_t count = 0;
  for (const Section& section : sections) count += section.rows.size();
  const std::vector<std::string> failures = fanbeam::validation::failures(sections);
  for (const std::string& failure : failures) std::cerr << failure << '\n';
  std::cout << count << " comparisons in " << sections.size() << " tables, " << failures.size()
            << " outside their tolerance\n";
  const std::filesystem::path file =
      std::filesystem::path(FANBEAM_SOURCE_DIR) / "docs" / "validation.md";
  const std::string text = fanbeam::validation::markdown(sections);
  if (std::getenv("FANBEAM_APPROVE") != nullptr) fanbeam::core::write_file_atomically(file, text);
  const std::string committed = fanbeam::core::read_file(file, 1U << 24U);
  if (committed != text) {
    std::cerr << file.string() << " differs from what the comparisons give, "
              << first_difference(text, committed) << "\nFANBEAM_APPROVE=1 writes it anew.\n";
    return 1;
  }
  return failures.empty() ? 0 : 1;
}

}  // namespace

int main() {
  try {
    return validate();
  } catch (const std::exception& error) {
    std::cerr << "fanbeam_validation: " << error.what() << '\n';
    return 1;
  }
}
