#include "materials/library/library_text.h"

#include <map>

#include "core/text.h"
#include "materials/library/material_library.h"

namespace fanbeam::materials {
namespace {

using Values = std::map<std::string, std::string, std::less<>>;  // by key

Values fitted_values(const Material& material) {
  const auto& row = std::get<PhongSurface>(material.model);
  const PhongDerivation derived = derive(row, *material.reference);
  Values values = {{"a", five_digits(derived.fit.nrcs.a())},
                   {"b", five_digits(derived.fit.nrcs.b())},
                   {"c", five_digits(derived.fit.nrcs.c())}};
  if (material.reference->exponent_to_Hz > 0.0)
    values["frequency_exponent"] = four_digits(derived.frequency_exponent);
  return values;
}

// "a = 0.1  # why" with another value; lines without such a key come back as they are.
std::string with_value(std::string_view line, const Values& values) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return std::string(line);
  const auto found = values.find(core::trimmed(line.substr(0, equals)));
  if (found == values.end()) return std::string(line);
  const std::size_t comment = line.find('#', equals);
  std::string result = std::string(line.substr(0, equals)) + "= " + found->second;
  if (comment != std::string_view::npos)
    result += "  " + std::string(line.substr(comment));
  else if (line.ends_with('\r'))
    result += '\r';
  return result;
}

}  // namespace

std::string with_fits_made_again(std::string_view text, const std::string& file_name,
                                 core::ProblemList& problems) {
  core::ProblemList own;
  const MaterialLibrary library = MaterialLibrary::from_text(text, file_name, own);
  problems.append(own.all());
  if (own.has_errors()) return std::string(text);
  std::map<int, Values> fits;  // by the line of the row's header
  for (const Material& material : library.all())
    if (material.reference) fits[material.place.line] = fitted_values(material);
  std::string result;
  const Values none;
  const Values* current = &none;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    ++number;
    if (core::trimmed(line).starts_with("[")) {
      const auto fit = fits.find(number);
      current = fit == fits.end() ? &none : &fit->second;
    }
    result += with_value(line, *current);
    if (end == std::string_view::npos) break;
    result += '\n';
    text.remove_prefix(end + 1);
  }
  return result;
}

}  // namespace fanbeam::materials
