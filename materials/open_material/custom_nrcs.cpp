#include <algorithm>
#include <cmath>

#include "core/decibel.h"
#include "core/units.h"
#include "materials/open_material/custom_nrcs_private.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;
using core::Polarisation;

constexpr std::size_t kMostEntries = 64;
constexpr std::size_t kMostAngles = 1000;
constexpr double kDefaultReach = 0.1;
constexpr core::NumberRange kFrequency_GHz{0.1, 300.0};

// E-REF for what is not among `known`: a misspelt key of ours would go unnoticed otherwise.
void refuse_other_keys(const core::JsonNode& node, std::initializer_list<std::string_view> known) {
  std::string expected = "one of";
  for (const std::string_view key : known) expected.append(" ").append(key);
  for (const std::string& key : node.keys())
    if (std::find(known.begin(), known.end(), key) == known.end())
      node.problems().error(ErrorClass::ref, node.place(), node.member(key).pointer(),
                            "unknown key", expected);
}

std::optional<Polarisation> read_polarisation(const core::JsonNode& node) {
  const std::string name = node.text().value_or("any");
  if (name == "HH") return Polarisation::horizontal;
  if (name == "VV") return Polarisation::vertical;
  if (name != "any") node.error(ErrorClass::range, "\"HH\", \"VV\" or \"any\"");
  return std::nullopt;
}

Interval read_frequency_range_Hz(const core::JsonNode& node, double frequency_Hz) {
  if (!node.present())
    return {frequency_Hz * (1.0 - kDefaultReach), frequency_Hz * (1.0 + kDefaultReach)};
  const std::vector<double> ends_GHz = node.numbers(kFrequency_GHz, 2);
  if (ends_GHz.size() == 2 && ends_GHz[0] <= ends_GHz[1])
    return {ends_GHz[0] * 1e9, ends_GHz[1] * 1e9};
  if (node.is_array()) node.error(ErrorClass::range, "[low, high] in GHz");
  return {frequency_Hz, frequency_Hz};
}

PhongNrcs read_phong(const core::JsonNode& node) {
  const core::NumberRange coefficient{0.0, kLargestPhongCoefficient};
  const double a = node.required("a").number(coefficient).value_or(0.0);
  const double b = node.member("b").number(coefficient).value_or(0.0);
  const double c = node.member("c").number({1.0, kLargestPhongExponent}).value_or(1.0);
  return {a, b, c};
}

TabulatedNrcs read_table(const core::JsonNode& node) {
  const core::JsonNode angles = node.required("grazing_deg"), values = node.required("sigma0_dB");
  const std::vector<double> grazing_deg = angles.numbers({0.0, 90.0, true}, kMostAngles);
  const std::vector<double> sigma0_dB = values.numbers({-200.0, 60.0}, kMostAngles);
  std::vector<NrcsSample> rows;
  for (std::size_t i = 0; i < std::min(grazing_deg.size(), sigma0_dB.size()); ++i) {
    rows.push_back({core::radians(grazing_deg[i]), core::power_from_dB(sigma0_dB[i])});
    if (i > 0 && grazing_deg[i] <= grazing_deg[i - 1])
      angles.element(i).error(ErrorClass::range, "more than the angle before");
  }
  if (angles.present() && values.present() && grazing_deg.size() != sigma0_dB.size())
    values.error(ErrorClass::range,
                 "as many numbers as grazing_deg, " + std::to_string(grazing_deg.size()));
  else if (rows.empty() && angles.present())
    angles.error(ErrorClass::parse, "at least one angle");
  // A table with problems is left out by the caller; it needs a value all the same.
  const bool good = !rows.empty() && std::is_sorted(rows.begin(), rows.end(), [](auto& x, auto& y) {
    return x.grazing_rad <= y.grazing_rad;
  });
  return TabulatedNrcs(good ? std::move(rows) : std::vector<NrcsSample>{{core::kPi / 2.0, 0.0}});
}

CustomNrcs read_entry(const core::JsonNode& node) {
  CustomNrcs entry;
  entry.frequency_Hz = node.required("frequency_GHz").number(kFrequency_GHz).value_or(35.0) * 1e9;
  entry.polarisation = read_polarisation(node.member("polarisation"));
  node.member("source").text();
  const Interval range_Hz =
      read_frequency_range_Hz(node.member("frequency_range_GHz"), entry.frequency_Hz);
  if (node.member("grazing_deg").present() || node.member("sigma0_dB").present()) {
    refuse_other_keys(node, {"frequency_GHz", "frequency_range_GHz", "polarisation", "source",
                             "grazing_deg", "sigma0_dB"});
    entry.surface = TabulatedSurface{read_table(node), range_Hz, entry.polarisation};
    return entry;
  }
  refuse_other_keys(node, {"frequency_GHz", "frequency_range_GHz", "polarisation", "source", "a",
                           "b", "c", "frequency_exponent"});
  PhongSurface surface;
  surface.nrcs = read_phong(node);
  surface.reference_frequency_Hz = entry.frequency_Hz;
  surface.frequency_exponent = node.member("frequency_exponent").number({-4.0, 4.0}).value_or(0.0);
  surface.frequency_range_Hz = range_Hz;
  surface.polarisation = entry.polarisation;
  entry.surface = surface;
  return entry;
}

}  // namespace

std::vector<CustomNrcs> read_custom_nrcs(const core::JsonNode& custom_properties) {
  std::vector<CustomNrcs> entries;
  const core::JsonNode ours = custom_properties.member("fanbeam");
  refuse_other_keys(ours, {"nrcs"});
  const core::JsonNode nrcs = ours.member("nrcs");
  const bool single = nrcs.present() && nrcs.is_object();
  const std::size_t count = single ? 1 : nrcs.size(kMostEntries);
  for (std::size_t i = 0; i < count; ++i) {
    const core::JsonNode node = single ? nrcs : nrcs.element(i);
    const std::size_t before = node.problems().errors();
    if (!node.present() || !node.is_object()) {
      node.problems().error(ErrorClass::parse, node.place(), node.pointer(), "another value",
                            "an object");
      continue;
    }
    CustomNrcs entry = read_entry(node);
    if (node.problems().errors() == before) entries.push_back(std::move(entry));
  }
  return entries;
}

const CustomNrcs* best_of(const std::vector<CustomNrcs>& entries, const RadarQuery& query) {
  const auto rank = [&](const CustomNrcs& entry) {
    return std::pair(std::abs(std::log(entry.frequency_Hz / query.frequency_Hz)),
                     entry.polarisation ? 0 : 1);
  };
  const CustomNrcs* best = nullptr;
  for (const CustomNrcs& entry : entries) {
    const ModelValidity known = validity_of(entry.surface);
    if (!known.frequency_Hz.contains(query.frequency_Hz) || !known.knows(query.polarisation))
      continue;
    if (best == nullptr || rank(entry) < rank(*best)) best = &entry;
  }
  return best;
}

}  // namespace fanbeam::materials
