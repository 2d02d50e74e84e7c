#include "measure/frequency_choice.h"

#include <fmt/core.h>

#include <cmath>
#include <functional>

#include "atmosphere/path_attenuation.h"
#include "atmosphere/precipitation/rain_echo.h"
#include "session/plots/gnuplot.h"

namespace fanbeam::measure {
namespace {

namespace fs = std::filesystem;
using atmosphere::Weather;

constexpr double kFog_m = 150.0;        // the fog of the comparison in rain
constexpr double kDistance_m = 2000.0;  // of the comparison of losses
// Seed 001: 100 kW at 35 GHz against "a few kilowatts" at 94 GHz, "more than 18 dB".
constexpr double kTubePower_dB = -18.0;

Weather clear_weather(Weather weather) {
  weather.visibility_m.reset();
  weather.liquid_water_g_per_m3.reset();
  weather.fog_layers.clear();
  weather.rain_rate_mm_per_h = weather.snow_rate_mm_per_h = 0.0;
  weather.rain_cells.clear();
  weather.melting_layer = false;
  weather.melting_height_m.reset();
  return weather;
}

Weather foggy(const Weather& base, double visibility_m) {
  Weather weather = clear_weather(base);
  weather.visibility_m = visibility_m;
  return weather;
}

Weather rainy(const Weather& base, double rain_mm_per_h) {
  Weather weather = clear_weather(base);
  weather.rain_rate_mm_per_h = rain_mm_per_h;
  return weather;
}

double one_way_dB(const Weather& weather, double frequency_Hz, double range_m) {
  return atmosphere::PathAttenuation(weather, frequency_Hz).one_way_dB(0.0, 0.0, range_m);
}

// A geometric row of values.
std::vector<double> spread(double first, double last, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(first * std::pow(last / first, static_cast<double>(i) / (count - 1)));
  return values;
}

session::PlotSeries series(const std::string& title, const std::vector<double>& x,
                           const std::function<double(double)>& y,
                           session::PlotSeries::Style style = session::PlotSeries::Style::line) {
  session::PlotSeries result{title, x, {}, style};
  for (const double value : x) result.y.push_back(y(value));
  return result;
}

std::string name(double frequency_Hz) { return fmt::format("{} GHz", frequency_Hz * 1e-9); }

session::Plot fog_plot(const Weather& base, const std::vector<double>& frequencies_Hz) {
  session::Plot plot;
  plot.title = "Attenuation in fog and its saturated air, one way";
  plot.x = {"visibility [m]", true, 50.0, 1000.0};
  plot.y = {"dB/km", true, {}, {}};
  const std::vector<double> visibilities = spread(50.0, 1000.0, 40);
  for (const double f : frequencies_Hz) {
    plot.series.push_back(series(name(f), visibilities, [&](double visibility_m) {
      return one_way_dB(foggy(base, visibility_m), f, 1000.0);
    }));
    plot.series.push_back(series(
        name(f) + ", no fog", visibilities,
        [&](double) { return one_way_dB(clear_weather(base), f, 1000.0); },
        session::PlotSeries::Style::dashed_line));
  }
  return plot;
}

session::Plot rain_plot(const Weather& base, const std::vector<double>& frequencies_Hz) {
  session::Plot plot;
  plot.title = "Attenuation in rain, one way";
  plot.x = {"rain rate [mm/h]", true, 0.5, 100.0};
  plot.y = {"dB/km", true, {}, {}};
  const std::vector<double> rates = spread(0.5, 100.0, 40);
  for (const double f : frequencies_Hz)
    for (const atmosphere::RainLaw law :
         {atmosphere::RainLaw::itu_p838, atmosphere::RainLaw::mie}) {
      Weather weather = base;
      weather.rain_law = law;
      plot.series.push_back(series(
          name(f) + ", " + std::string(name_of(law)), rates,
          [&](double rate) { return rain_dB_per_km(weather, rate, f); },
          law == atmosphere::RainLaw::mie ? session::PlotSeries::Style::dashed_line
                                          : session::PlotSeries::Style::line));
    }
  return plot;
}

session::Plot loss_plot(const Weather& base, const std::vector<double>& frequencies_Hz) {
  session::Plot plot;
  plot.title = fmt::format("Two-way loss over {} m, air included", kDistance_m);
  plot.x = {"rain rate [mm/h]", true, 0.5, 100.0};
  plot.y = {"dB", true, {}, {}};
  const std::vector<double> rates = spread(0.5, 100.0, 40);
  for (const double f : frequencies_Hz) {
    plot.series.push_back(series(name(f) + ", rain", rates, [&](double rate) {
      return 2.0 * one_way_dB(rainy(base, rate), f, kDistance_m);
    }));
    plot.series.push_back(series(
        fmt::format("{}, fog {} m", name(f), kFog_m), rates,
        [&](double) { return 2.0 * one_way_dB(foggy(base, kFog_m), f, kDistance_m); },
        session::PlotSeries::Style::dashed_line));
  }
  return plot;
}

session::Plot balance_plot(const Weather& base, double first_Hz, double second_Hz) {
  session::Plot plot;
  plot.title = fmt::format("Echo of drops per watt: {} over {}", name(second_Hz), name(first_Hz));
  plot.x = {"range [km]", false, 0.0, 4.0};
  plot.y = {"dB", false, {}, {}};
  std::vector<double> ranges_km;
  for (int i = 0; i <= 16; ++i) ranges_km.push_back(0.25 * i);
  const auto sum = [](const PowerBalance& balance) {
    return balance.backscatter_dB + balance.attenuation_dB;
  };
  for (const double visibility_m : {50.0, 150.0})
    plot.series.push_back(series(fmt::format("fog {} m", visibility_m), ranges_km, [&](double km) {
      return sum(fog_balance(base, visibility_m, 1e3 * km, first_Hz, second_Hz));
    }));
  for (const double rate : {1.0, 4.0, 10.0})
    plot.series.push_back(series(
        fmt::format("rain {} mm/h", rate), ranges_km,
        [&](double km) { return sum(rain_balance(base, rate, 1e3 * km, first_Hz, second_Hz)); },
        session::PlotSeries::Style::dashed_line));
  plot.series.push_back(series(
      "18 dB", ranges_km, [](double) { return -kTubePower_dB; },
      session::PlotSeries::Style::points));
  return plot;
}

std::string figures_text(const Weather& base, double first_Hz, double second_Hz) {
  std::string text = fmt::format("two-way dB over {} m {:>22} {:>10}\n", kDistance_m,
                                 name(first_Hz), name(second_Hz));
  const auto line = [&](const std::string& what, const Weather& weather) {
    text += fmt::format("{:<34} {:>8.2f} {:>10.2f}\n", what,
                        2.0 * one_way_dB(weather, first_Hz, kDistance_m),
                        2.0 * one_way_dB(weather, second_Hz, kDistance_m));
  };
  line("air", clear_weather(base));
  for (const double visibility_m : {50.0, 150.0, 300.0})
    line(fmt::format("fog, visibility {} m", visibility_m), foggy(base, visibility_m));
  for (const double rate : {1.0, 4.0, 10.0, 50.0})
    line(fmt::format("rain {} mm/h", rate), rainy(base, rate));
  text += fmt::format("\necho of drops, {} over {} [dB]: backscatter, loss over {} m, sum\n",
                      name(second_Hz), name(first_Hz), kDistance_m);
  const auto balance = [&](const std::string& what, const PowerBalance& b) {
    text += fmt::format("{:<34} {:>8.2f} {:>10.2f} {:>10.2f}\n", what, b.backscatter_dB,
                        b.attenuation_dB, b.backscatter_dB + b.attenuation_dB);
  };
  for (const double visibility_m : {50.0, 150.0})
    balance(fmt::format("droplets of fog, visibility {} m", visibility_m),
            fog_balance(base, visibility_m, kDistance_m, first_Hz, second_Hz));
  for (const double rate : {1.0, 4.0, 10.0, 50.0})
    balance(fmt::format("rain {} mm/h", rate),
            rain_balance(base, rate, kDistance_m, first_Hz, second_Hz));
  return text;
}

}  // namespace

PowerBalance fog_balance(const Weather& base, double visibility_m, double range_m, double first_Hz,
                         double second_Hz) {
  const Weather weather = foggy(base, visibility_m);
  return {40.0 * std::log10(second_Hz / first_Hz),
          2.0 * (one_way_dB(weather, first_Hz, range_m) - one_way_dB(weather, second_Hz, range_m))};
}

PowerBalance rain_balance(const Weather& base, double rain_mm_per_h, double range_m,
                          double first_Hz, double second_Hz) {
  const Weather weather = rainy(base, rain_mm_per_h);
  const auto eta = [&](double frequency_Hz) {
    return rain_eta_m2_per_m3(weather.rain_echo_law, rain_mm_per_h, frequency_Hz,
                              rain_drops(weather));
  };
  return {10.0 * std::log10(eta(second_Hz) / eta(first_Hz)),
          2.0 * (one_way_dB(weather, first_Hz, range_m) - one_way_dB(weather, second_Hz, range_m))};
}

std::string compare_frequencies(const Weather& base, double first_Hz, double second_Hz,
                                const fs::path& folder) {
  for (const double frequency_Hz : {first_Hz, second_Hz})
    atmosphere::problems_in(clear_weather(base), frequency_Hz).throw_if_errors();
  const std::string text = figures_text(base, first_Hz, second_Hz);
  if (folder.empty()) return text;
  fs::create_directories(folder);
  const std::vector<std::pair<std::string, session::Plot>> plots = {
      {"fog", fog_plot(base, {first_Hz, second_Hz})},
      {"rain", rain_plot(base, {first_Hz, second_Hz})},
      {"loss", loss_plot(base, {first_Hz, second_Hz})},
      {"balance", balance_plot(base, first_Hz, second_Hz)}};
  for (const auto& [what, plot] : plots)
    session::write_plots(plot, folder / ("frequency-choice-" + what));
  return text;
}

}  // namespace fanbeam::measure
