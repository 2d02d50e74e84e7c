#include "benchmarks/ladder_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/errors.h"
#include "core/files.h"

namespace fanbeam::benchmarks {
namespace {

namespace fs = std::filesystem;

struct Step {
  double frame_ms;
  PictureError error;
  std::string label;  // beside the point; empty for most
  bool is_default = false;
};

// A way of sampling: the same colour in all views.
struct Method {
  const char* title;
  const char* colour;  // Okabe and Ito 2008: apart in print and for most colour-blind eyes
  std::vector<Step> (*steps)(const ViewFigures&);
};

// The ends of a ladder and the default sampling are labelled.
std::vector<Step> ladder_steps(const CasterFigures& figures, double default_fineness) {
  std::vector<Step> steps;
  for (const SamplingFigures& step : figures.ladder) {
    const bool is_default = step.fineness == default_fineness;
    const bool is_end = &step == &figures.ladder.front() || &step == &figures.ladder.back();
    steps.push_back({step.frame_ms, step.error.bscope,
                     is_default || is_end ? core::number_text(step.fineness) : "", is_default});
  }
  return steps;
}

std::vector<Step> naive_steps(const ViewFigures& view, renderer::NaiveKind kind) {
  std::vector<Step> steps;
  for (const NaiveFigures& step : view.naive)
    if (step.kind == kind) steps.push_back({step.frame_ms, step.error.bscope, "", false});
  return steps;
}

const Method kMethods[] = {
    {"slices (number per column)", "#0072b2",
     [](const ViewFigures& view) {
       return ladder_steps(view.slices, renderer::kDefaultSlicesPerColumn);
     }},
    {"rays (number per cell and column)", "#d55e00",
     [](const ViewFigures& view) {
       return ladder_steps(view.rays, renderer::kDefaultRaysPerCell);
     }},
    {"naive, dithered", "#009e73",
     [](const ViewFigures& view) { return naive_steps(view, renderer::NaiveKind::dithered); }},
    {"naive, plain", "#8c8c8c",
     [](const ViewFigures& view) { return naive_steps(view, renderer::NaiveKind::plain); }},
};

struct Range {
  double low = 1e300;
  double high = 0.0;
  void take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// Data and what to draw of them. Columns: ms, error with noise, error noise-free, label.
class Curves {
 public:
  explicit Curves(const std::vector<ViewFigures>& views) {
    for (std::size_t v = 0; v < views.size(); ++v) add_view(views[v], v);
  }

  std::string data;
  std::string drawn;  // of the errors in gnuplot's variable `picture`
  Range time_ms, error_grey;

 private:
  void add_view(const ViewFigures& view, std::size_t index) {
    for (const Method& method : kMethods) {
      const std::string name = fmt::format("$view{}_method{}", index, &method - kMethods);
      const std::vector<Step> steps = method.steps(view);
      data += fmt::format("# {}, {:.0f} m: ms, error with noise, error noise-free, label\n",
                          method.title, view.view.distance_m);
      data += block(name, steps);
      draw(fmt::format("{} using 1:picture with linespoints lw 2 dt {} pt 7 ps 0.5 lc rgb '{}'",
                       name, index == 0 ? 1 : 2, method.colour));
      draw_marks(name, steps, method.colour, index == 0);
    }
  }

  // Labels stand at the farthest view's curves alone: those of the others run beside them.
  void draw_marks(const std::string& name, std::vector<Step> steps, const char* colour,
                  bool with_labels) {
    std::erase_if(steps, [](const Step& step) { return step.label.empty(); });
    if (with_labels && !steps.empty()) {
      data += block(name + "_labels", steps);
      draw(
          fmt::format("{}_labels using 1:picture:4 with labels offset 0.6, 0.7 left font ',9' "
                      "textcolor rgb '{}'",
                      name, colour));
    }
    std::erase_if(steps, [](const Step& step) { return !step.is_default; });
    if (steps.empty()) return;
    data += block(name + "_default", steps);
    draw(fmt::format("{}_default using 1:picture with points pt 6 ps 1.8 lw 2 lc rgb '{}'", name,
                     colour));
  }

  std::string block(const std::string& name, const std::vector<Step>& steps) {
    std::string text = name + " << END\n";
    for (const Step& step : steps) {
      const double noisy = step.error.with_noise.rms;
      const double clean = step.error.noise_free.rms;
      text += fmt::format("{:.2f} {:.3f} {:.3f} \"{}\"\n", step.frame_ms, noisy, clean, step.label);
      time_ms.take(step.frame_ms);
      error_grey.take(noisy);
      error_grey.take(clean);
    }
    return text + "END\n";
  }

  void draw(const std::string& what) { drawn += "    " + what + " notitle, \\\n"; }
};

std::string key_entries(const std::vector<ViewFigures>& views) {
  std::string text;
  for (const Method& method : kMethods)
    text += fmt::format("    keyentry with lines lw 3 lc rgb '{}' title '{}', \\\n", method.colour,
                        method.title);
  for (std::size_t v = 0; v < views.size(); ++v)
    text += fmt::format(
        "    keyentry with lines lw 2 dt {} lc rgb 'black' title '{:.0f} m before the threshold', "
        "\\\n",
        v == 0 ? 1 : 2, views[v].view.distance_m);
  return text +
         "    keyentry with points pt 6 ps 1.8 lw 2 lc rgb 'black' title 'default sampling'\n";
}

std::string budgets() {
  std::string text;
  for (const auto& [budget_ms, name] :
       {std::pair{kBudget16Hz_ms, "16 Hz"}, std::pair{kBudget90Hz_ms, "90 Hz"}})
    text += fmt::format(
        "set arrow from {0:.3f}, graph 0 to {0:.3f}, graph 1 nohead lw 1.5 dt 3 lc rgb 'black' "
        "back\n"
        "set label '{1}: {0:.1f} ms' at {0:.3f}, graph 0.02 rotate by 90 left offset -1.2, 0\n",
        budget_ms, name);
  return text;
}

std::string axes(const Curves& curves) {
  constexpr double kLargestLow_ms = 5.0;  // left of the lines at 11.1 ms and their text
  const auto decade = [](double value) { return std::pow(10.0, std::floor(std::log10(value))); };
  return fmt::format(
      "set logscale xy\nset xrange [{:g}:{:g}]\nset yrange [{:g}:{:g}]\n"
      "set xtics (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000)\n"
      "set ytics (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)\n"
      "set xlabel 'frame time, ms (from the pose to both displays)'\n"
      "set ylabel 'B-scope error, grey levels RMS (of 255)'\n"
      "set grid xtics ytics lt 1 lc rgb '#d8d8d8'\n",
      std::min(kLargestLow_ms, decade(curves.time_ms.low)), 1.6 * curves.time_ms.high,
      decade(curves.error_grey.low), 1.3 * curves.error_grey.high);
}

// One of the two pictures side by side; left and right in shares of the whole width.
std::string panel(double left, double right, const char* title, int data_column,
                  const Curves& curves) {
  return fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\nset title '{}'\npicture = {}\n"
      "plot \\\n{}    NaN notitle\n",
      left, right, title, data_column, curves.drawn);
}

// Below both pictures, as a picture that holds nothing else.
std::string key_panel(const std::vector<ViewFigures>& views) {
  return "set lmargin at screen 0.02\nset rmargin at screen 0.98\n"
         "set tmargin at screen 0.115\nset bmargin at screen 0.005\n"
         "unset title\nunset xlabel\nunset ylabel\nunset tics\nunset border\n"
         "unset arrow\nunset label\n"
         "set key center center vertical maxrows 4 samplen 3 width 4\n"
         "plot \\\n    NaN notitle, \\\n" +
         key_entries(views);
}

}  // namespace

std::string ladder_plot_script(const std::string& name, const std::vector<ViewFigures>& views) {
  const Curves curves(views);
  const std::string head = fmt::format(
      "# Figures and pictures were written with docs/performance.md by fanbeam_bench.\n"
      "# gnuplot {0}.gp in this folder draws both pictures again.\n{1}"
      "do for [format in 'svg png'] {{\nreset\n"
      "if (format eq 'svg') {{\n"
      "  set terminal svg size 1200,660 font 'sans,13' background rgb 'white'\n"
      "}} else {{\n"
      "  set terminal pngcairo size 1200,660 font 'sans,11' background rgb 'white'\n"
      "}}\n"
      "set output '{0}.'.format\n"
      "set multiplot title '{2}: error over frame time (low and left is good)' font ',15' "
      "noenhanced\n"
      "set tmargin at screen 0.88\nset bmargin at screen 0.2\nunset key\n",
      name, curves.data, views.front().view.scene->name);
  return head + axes(curves) + budgets() +
         panel(0.06, 0.485, "as displayed, with the noise of the receiver", 2, curves) +
         panel(0.555, 0.985, "noise-free", 3, curves) + key_panel(views) +
         "unset multiplot\nset output\n}\n";
}

std::string draw_ladders(const std::vector<ViewFigures>& views, const fs::path& folder) {
  const std::string name = "performance-" + views.front().view.scene->name;
  core::write_file_atomically(folder / (name + ".gp"), ladder_plot_script(name, views));
  const std::string command = fmt::format("cd '{}' && gnuplot --default-settings '{}.gp'",
                                          fs::absolute(folder).string(), name);
  if (std::system(command.c_str()) == 0) return name;
  fmt::print(stderr, "[skipped] plot: no success with {}\n", command);
  return "";
}

}  // namespace fanbeam::benchmarks
