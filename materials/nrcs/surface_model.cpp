#include "materials/nrcs/surface_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/number_range.h"
#include "core/units.h"
#include "materials/nrcs/nrl_sea.h"
#include "materials/nrcs/oh1992.h"

namespace fanbeam::materials {
namespace {

using core::radians;

constexpr double kLowest_Hz = 0.1e9;
constexpr double kHighest_Hz = 300e9;
// Oh's model was fitted for these products of wave number and rms height.
constexpr Interval kOhWaveNumberHeight{0.1, 6.0};

struct Description {
  std::string_view name;
  std::string_view source;
};

// In the order of SurfaceModel.
constexpr std::array<Description, std::variant_size_v<SurfaceModel>> kDescriptions = {{
    {"phong", "fit of the Phong-like form; the material names its reference"},
    {"constant-gamma", "MathWorks surfacegamma, citing Nathanson 1999 and Long 2001"},
    {"kulemin", "Kulemin, Millimeter-Wave Radar Targets and Clutter, 2003 (recalled)"},
    {"git-land", "Georgia Tech land model, Eaves and Reedy 1987 (recalled)"},
    {"nrl-sea", "Gregers-Hansen and Mital, NRL/MR/5310--12-9346, 2012"},
    {"oh1992", "Oh, Sarabandi, Ulaby, IEEE TGRS 30(2), 1992"},
    {"rough-metal", "geometric optics (Barrick 1968) plus a diffuse part"},
    {"tabulated", "a table of the material's file"},
}};

double wavelength_m(double frequency_Hz) { return core::kSpeedOfLight_mps / frequency_Hz; }

// The frequencies at which k s lies within Oh's data and the medium is known.
Interval oh_frequency_Hz(const OhSurface& surface) {
  const DielectricMedium* medium = std::get_if<DielectricMedium>(&surface.medium);
  const Interval known = medium != nullptr ? valid_frequency_Hz(*medium) : Interval{1e9, 100e9};
  if (!(surface.rms_height_m > 0.0)) return known;
  const double unit_Hz = core::kSpeedOfLight_mps / (2.0 * core::kPi * surface.rms_height_m);
  // A surface too smooth or too rough at every known frequency keeps the nearest one.
  return {std::clamp(kOhWaveNumberHeight.low * unit_Hz, known.low, known.high),
          std::clamp(kOhWaveNumberHeight.high * unit_Hz, known.low, known.high)};
}

struct Validity {
  ModelValidity operator()(const PhongSurface& surface) const {
    return limited(surface.frequency_range_Hz, surface.grazing_range_rad, surface.polarisation);
  }
  ModelValidity operator()(const ConstantGammaSurface&) const {
    return {{kGammaLowest_Hz, kGammaHighest_Hz}, {radians(1.0), radians(60.0)}};
  }
  ModelValidity operator()(const KuleminSurface&) const {
    return {{kKuleminLowest_Hz, kKuleminHighest_Hz}, {radians(1.0), radians(30.0)}};
  }
  ModelValidity operator()(const GitLandSurface& surface) const {
    return {git_land_frequency_Hz(surface.terrain), {radians(1.0), radians(60.0)}};
  }
  ModelValidity operator()(const NrlSeaSurface&) const {
    return {{kNrlSeaLowest_Hz, kNrlSeaHighest_Hz}, {radians(0.1), radians(60.0)}};
  }
  ModelValidity operator()(const OhSurface& surface) const {
    return {oh_frequency_Hz(surface), {radians(20.0), radians(80.0)}};
  }
  ModelValidity operator()(const RoughMetal&) const {
    return {{10e9, 100e9}, {radians(1.0), radians(90.0)}};
  }
  ModelValidity operator()(const TabulatedSurface& surface) const {
    const std::vector<NrcsSample>& rows = surface.table.rows();
    return limited(surface.frequency_range_Hz, {rows.front().grazing_rad, rows.back().grazing_rad},
                   surface.polarisation);
  }
  static ModelValidity limited(Interval frequency_Hz, Interval grazing_rad,
                               std::optional<Polarisation> polarisation) {
    return {frequency_Hz, grazing_rad, polarisation != Polarisation::vertical,
            polarisation != Polarisation::horizontal};
  }
};

// The formula at an angle in (0, pi/2], frequency and polarisation being known to the model.
struct Formula {
  Polarisation polarisation;
  double frequency_Hz;
  double grazing_rad;

  double operator()(const PhongSurface& surface) const {
    return surface.at_frequency(frequency_Hz).sigma0(std::sin(grazing_rad));
  }
  double operator()(const ConstantGammaSurface& surface) const {
    return constant_gamma_sigma0(gamma_at(surface.terrain, frequency_Hz), grazing_rad);
  }
  double operator()(const KuleminSurface& surface) const {
    return kulemin_sigma0(surface.terrain, frequency_Hz, held());
  }
  double operator()(const GitLandSurface& surface) const {
    return git_land_sigma0(surface.terrain, frequency_Hz, held());
  }
  double operator()(const NrlSeaSurface& surface) const {
    return nrl_sea_sigma0(polarisation, surface.sea_state, frequency_Hz, held());
  }
  double operator()(const OhSurface& surface) const {
    const DielectricMedium* medium = std::get_if<DielectricMedium>(&surface.medium);
    const Permittivity permittivity =
        medium != nullptr ? permittivity_of(*medium, frequency_Hz, surface.temperature_K)
                          : std::get<Permittivity>(surface.medium);
    const OhNrcs nrcs =
        oh1992_sigma0(permittivity, surface.rms_height_m, wavelength_m(frequency_Hz), grazing_rad);
    return polarisation == Polarisation::horizontal ? nrcs.hh : nrcs.vv;
  }
  double operator()(const RoughMetal& surface) const {
    return rough_metal_sigma0(surface, wavelength_m(frequency_Hz), grazing_rad);
  }
  double operator()(const TabulatedSurface& surface) const {
    return surface.table.sigma0(grazing_rad);
  }
  double held() const { return std::min(grazing_rad, kSteepestEmpiricalGrazing_rad); }
};

bool ends_in_zero_by_itself(const SurfaceModel& model) {
  return std::holds_alternative<PhongSurface>(model) ||
         std::holds_alternative<ConstantGammaSurface>(model);
}

std::string interval_text(const Interval& interval, double unit) {
  return core::number_text(interval.low / unit) + " to " + core::number_text(interval.high / unit);
}

}  // namespace

PhongNrcs PhongSurface::at_frequency(double frequency_Hz) const {
  const double factor = std::pow(frequency_Hz / reference_frequency_Hz, frequency_exponent);
  return {nrcs.a() * factor, nrcs.b() * factor, nrcs.c()};
}

ModelValidity validity_of(const SurfaceModel& model) { return std::visit(Validity{}, model); }

std::string_view name_of(const SurfaceModel& model) { return kDescriptions[model.index()].name; }

std::string_view source_of(const SurfaceModel& model) {
  return kDescriptions[model.index()].source;
}

std::vector<Extrapolation> extrapolations_of(const SurfaceModel& model, Polarisation polarisation,
                                             double frequency_Hz) {
  const ModelValidity known = validity_of(model);
  std::vector<Extrapolation> result;
  if (!known.frequency_Hz.contains(frequency_Hz))
    result.push_back({"frequency_GHz", core::number_text(frequency_Hz / 1e9),
                      interval_text(known.frequency_Hz, 1e9)});
  if (!known.knows(polarisation))
    result.push_back(
        {"polarisation", core::name_of(polarisation),
         core::name_of(known.horizontal ? Polarisation::horizontal : Polarisation::vertical)});
  return result;
}

double sigma0(const SurfaceModel& model, Polarisation polarisation, double frequency_Hz,
              double grazing_rad) {
  if (!std::isfinite(frequency_Hz))
    core::require_range("frequency_Hz", frequency_Hz, {0.0, kHighest_Hz});
  for (const Extrapolation& outside : extrapolations_of(model, polarisation, frequency_Hz))
    core::throw_input_error(core::ErrorClass::range, outside.quantity, outside.asked,
                            outside.known + " (model " + std::string(name_of(model)) + ")");
  return continued_sigma0(model, polarisation, frequency_Hz, grazing_rad);
}

double continued_sigma0(const SurfaceModel& model, Polarisation polarisation, double frequency_Hz,
                        double grazing_rad) {
  core::require_range("frequency_Hz", frequency_Hz, {kLowest_Hz, kHighest_Hz});
  core::require_range("grazing_rad", grazing_rad, {-core::kPi / 2.0, core::kPi / 2.0});
  if (grazing_rad <= 0.0) return 0.0;
  const ModelValidity known = validity_of(model);
  Formula formula{polarisation, frequency_Hz, grazing_rad};
  if (!known.knows(polarisation))
    formula.polarisation = known.horizontal ? Polarisation::horizontal : Polarisation::vertical;
  if (!std::holds_alternative<PhongSurface>(model))
    formula.frequency_Hz =
        std::clamp(frequency_Hz, known.frequency_Hz.low, known.frequency_Hz.high);
  if (grazing_rad >= kLowestGrazing_rad || ends_in_zero_by_itself(model))
    return std::visit(formula, model);
  formula.grazing_rad = kLowestGrazing_rad;
  return std::visit(formula, model) * (std::sin(grazing_rad) / std::sin(kLowestGrazing_rad));
}

}  // namespace fanbeam::materials
