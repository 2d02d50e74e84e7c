#include "session/plots/gnuplot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/child_process.h"
#include "core/errors.h"
#include "core/files.h"
#include "core/png_check.h"
#include "core/text.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

// Colours that stay apart in print and for most colour-blind eyes (Okabe and Ito 2008).
constexpr std::array<const char*, 8> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#56b4e9", "#e69f00", "#000000", "#8c6d1f"};

// gnuplot has those of a logarithmic axis at powers of ten, of which a short one holds one or two:
// there twice and five times those too.
std::string tick_commands(char name, const PlotAxis& axis) {
  constexpr double kShort = 100.0;
  if (!axis.logarithmic || !axis.low || !axis.high || !(*axis.low > 0.0) ||
      *axis.high > kShort * *axis.low)
    return "";
  std::string text;
  for (double power = std::pow(10.0, std::floor(std::log10(*axis.low))); power <= *axis.high;
       power *= 10.0)
    for (const double tick : {2.0 * power, 5.0 * power})
      text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ", tick);
  return fmt::format("set {}tics add ({})\n", name, text);
}

std::string axis_commands(char name, const PlotAxis& axis) {
  const auto end = [](const std::optional<double>& value) {
    return value ? core::number_text(*value) : std::string("*");
  };
  std::string text = fmt::format("set {}label {} noenhanced\n", name, gnuplot_text(axis.label));
  if (axis.logarithmic) text += fmt::format("set logscale {}\n", name);
  return text + fmt::format("set {}range [{}:{}]\n", name, end(axis.low), end(axis.high)) +
         tick_commands(name, axis);
}

std::string style_of(const PlotSeries& series, std::size_t index) {
  const char* colour = kColours[series.colour.value_or(index) % kColours.size()];
  if (series.style == PlotSeries::Style::points)
    return fmt::format("with points pt 7 ps 0.6 lc rgb '{}'", colour);
  if (series.style == PlotSeries::Style::line_points)
    return fmt::format("with linespoints lw 2 pt 7 ps 0.6 lc rgb '{}'", colour);
  // When the colours come round again, dots in the line tell the curves apart; dashes mean a style.
  constexpr std::array<int, 4> kSolidThenDotted = {1, 4, 5, 3};
  const bool dashed = series.style == PlotSeries::Style::dashed_line;
  const std::size_t round = series.colour ? 0 : index / kColours.size();
  const int dashes = dashed ? 2 : kSolidThenDotted[round % 4];
  return fmt::format("with lines lw 2 dt {} lc rgb '{}'", dashes, colour);
}

std::string mark_commands(const Plot& plot) {
  std::string text;
  for (const PlotMark& mark : plot.marks) {
    const std::string x = core::number_text(mark.x);
    text += fmt::format(
        "set arrow from first {}, graph 0 to first {}, graph 1 nohead dt 2 lc rgb "
        "'#606060'\nset label {} at first {}, graph 0.02 rotate by 90 left offset "
        "-0.7,0 tc rgb '#606060' noenhanced\n",
        x, x, gnuplot_text(mark.text), x);
  }
  for (const PlotLabel& label : plot.labels)
    text += fmt::format("set label {} at {}, {} left offset 0.8,0 font ',10' noenhanced\n",
                        gnuplot_text(label.text), core::number_text(label.x),
                        core::number_text(label.y));
  return text;
}

std::string data_block(const PlotSeries& series, std::size_t index) {
  std::string text = fmt::format("$series{} << END\n", index);
  const std::size_t count = std::min(series.x.size(), series.y.size());
  for (std::size_t i = 0; i < count; ++i) {
    const bool finite = std::isfinite(series.x[i]) && std::isfinite(series.y[i]);
    text += finite ? core::number_text(series.x[i]) + ' ' + core::number_text(series.y[i]) + '\n'
                   : std::string("\n");
  }
  return text + "END\n";
}

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) {
  core::throw_input_error(core::ErrorClass::io, core::Place{file.string()}, "plot", reason,
                          "a working gnuplot program (Debian package gnuplot-nox)");
}

// Without the user's own settings.
void run_gnuplot(const std::string& script, const fs::path& file) {
  core::ChildProcess gnuplot({"gnuplot", "--default-settings", "-"},
                             core::ChildProcess::Pipe::to_its_input);
  if (!gnuplot.started()) refuse(file, "gnuplot cannot be started");
  const bool sent = gnuplot.send(script);
  if (!gnuplot.succeeded() || !sent) refuse(file, "gnuplot failed");
}

// gnuplot reports success when a full disk has cut its picture off.
void check_complete(const fs::path& picture, const fs::path& file) {
  bool complete = false;
  try {
    if (picture.extension() == ".svg") {
      const std::string text = core::read_file(picture, 1ULL << 30U);
      complete = core::trimmed(text).ends_with("</svg>");
    } else {
      complete = core::check_png(picture, [](const core::ClaimedSize&) {});
    }
  } catch (const core::InputError&) {
    complete = false;
  }
  if (!complete)
    core::throw_input_error(core::ErrorClass::io, core::Place{file.string()}, "plot",
                            "it is not complete", "room to write");
}

}  // namespace

// Single quotes keep gnuplot from reading escapes; a quote inside is doubled.
std::string gnuplot_text(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    result += c == '\n' ? ' ' : c;
  }
  return result + "'";
}

std::string gnuplot_script(const Plot& plot, const fs::path& output) {
  const char* terminal = output.extension() == ".svg" ? "svg" : "pngcairo";
  std::string text = fmt::format(
      "set terminal {} size {},{} font 'sans,13' background rgb 'white'\nset output {}\n", terminal,
      plot.width_px, plot.height_px, gnuplot_text(output.string()));
  text += fmt::format("set title {} noenhanced\n", gnuplot_text(plot.title));
  text += axis_commands('x', plot.x) + axis_commands('y', plot.y);
  text += fmt::format("set grid lt 1 lc rgb '#d0d0d0'\nset key {} noenhanced maxcols {}\n",
                      plot.key_below ? "below left Left reverse height 1" : "outside right top",
                      plot.key_below ? 2 : 1);
  text += mark_commands(plot);
  for (std::size_t i = 0; i < plot.series.size(); ++i) text += data_block(plot.series[i], i);
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    text +=
        fmt::format("{}$series{} using 1:2 {} {}", i == 0 ? "plot " : ", \\\n     ", i,
                    style_of(plot.series[i], i),
                    plot.series[i].title.empty() ? std::string("notitle")
                                                 : "title " + gnuplot_text(plot.series[i].title));
  return text + "\nset output\n";
}

void write_plot(const Plot& plot, const fs::path& file) {
  write_plot([&](const fs::path& output) { return gnuplot_script(plot, output); }, file);
}

void write_plots(const Plot& plot, const fs::path& name) {
  for (const char* ending : kPlotEndings) write_plot(plot, name.string() + ending);
}

void write_plot(const std::function<std::string(const fs::path&)>& script, const fs::path& file) {
  if (file.extension() != ".svg" && file.extension() != ".png")
    core::throw_input_error(core::ErrorClass::unsupported, core::Place{file.string()}, "plot",
                            "\"" + file.extension().string() + "\"", "a name with .svg or .png");
  core::write_atomically(file, [&](const fs::path& temporary) {
    run_gnuplot(script(temporary), file);
    check_complete(temporary, file);
  });
}

}  // namespace fanbeam::session
