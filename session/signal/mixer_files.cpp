#include "session/signal/mixer_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <system_error>

#include "core/errors.h"
#include "core/files.h"
#include "session/plots/gnuplot.h"

namespace fanbeam::session {
namespace {

constexpr std::size_t kMostRows = 20'000;
constexpr std::string_view kMixerColumns = "time_s,transmitted,received,product\n";
constexpr std::string_view kBeatColumns = "time_s,beat\n";

// A table that begins otherwise is somebody's, and so is a picture without the table that is written before it.
void refuse_tables_of_others(const std::filesystem::path& folder) {
  core::ProblemList problems;
  const auto check = [&](const char* name, bool ours) {
    std::error_code status;
    if (!ours && std::filesystem::exists(folder / name, status))
      problems.error(
          core::ErrorClass::range, {}, "--mixer", "\"" + folder.string() + "\"",
          fmt::format("a folder without {} of something else than fanbeam waveform", name));
  };
  const bool is_mixer = core::file_begins_with(folder / "mixer.csv", kMixerColumns);
  check("mixer.csv", is_mixer);
  check("beat.csv", core::file_begins_with(folder / "beat.csv", kBeatColumns));
  check("mixer.png", is_mixer);
  problems.throw_if_errors();
}

// gnuplot's inline data of y over x.
std::string data(const char* name, const std::vector<double>& values, std::size_t count,
                 double step_us) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (std::size_t i = 0; i < std::min(count, values.size()); ++i)
    text += fmt::format("{:.7g} {:.5g}\n", static_cast<double>(i) * step_us, values[i]);
  return text + "EOD\n";
}

std::string script(const signal::MixerTrace& trace, const std::string& title,
                   const std::filesystem::path& output) {
  // Some thirty turns of what is shown as the carrier.
  const auto rows = static_cast<std::size_t>(30.0 / (trace.carrier_Hz * trace.step_s));
  const double step_us = 1e6 * trace.step_s;
  std::string text =
      fmt::format("set terminal pngcairo size 960,760 font 'DejaVu Sans,11'\nset output {}\n",
                  gnuplot_text(output.string()));
  text += data("sent", trace.transmitted, rows, step_us) +
          data("heard", trace.received, rows, step_us) +
          data("product", trace.product, rows, step_us) +
          data("beat", trace.beat, kMostRows, 1e6 * trace.sample_s);
  text +=
      "set multiplot layout 3,1 title " +
      gnuplot_text(fmt::format("{}; carrier shown at {:.6g} MHz", title, 1e-6 * trace.carrier_Hz)) +
      "\nset grid\nset yrange [-1.15:1.15]\nset key outside right\nset lmargin 9\nset rmargin "
      "20\nset samples 2000\n";
  text += fmt::format("set xrange [0:{:.6g}]\nset ylabel 'signals'\n",
                      static_cast<double>(rows) * step_us);
  text +=
      "plot $sent smooth csplines lw 1.5 title 'transmitted', $heard smooth csplines lw 1.5 title "
      "'received'\n";
  text += "set ylabel 'product'\nplot $product smooth csplines lw 1.5 lc 3 title 'mixer out'\n";
  text += fmt::format(
      "set xrange [0:{:.6g}]\nset yrange [-0.6:0.6]\nset ylabel 'beat'\nset xlabel 'time, us'\n",
      1e6 * trace.sample_s * static_cast<double>(std::min(kMostRows, trace.beat.size())));
  return text + "plot $beat with lines lw 1.5 lc 4 title 'low pass'\nunset multiplot\n";
}

}  // namespace

void write_mixer(const std::filesystem::path& folder, const signal::MixerTrace& trace,
                 const std::string& title) {
  refuse_tables_of_others(folder);
  std::string rows(kMixerColumns);
  for (std::size_t i = 0; i < std::min(kMostRows, trace.product.size()); ++i)
    rows += fmt::format("{:.9g},{:.6f},{:.6f},{:.6f}\n", static_cast<double>(i) * trace.step_s,
                        trace.transmitted[i], trace.received[i], trace.product[i]);
  std::string beat(kBeatColumns);
  for (std::size_t i = 0; i < trace.beat.size(); ++i)
    beat += fmt::format("{:.9g},{:.7f}\n", static_cast<double>(i) * trace.sample_s, trace.beat[i]);
  core::write_file_atomically(folder / "mixer.csv", rows);
  core::write_file_atomically(folder / "beat.csv", beat);
  write_plot([&](const std::filesystem::path& output) { return script(trace, title, output); },
             folder / "mixer.png");
}

}  // namespace fanbeam::session
