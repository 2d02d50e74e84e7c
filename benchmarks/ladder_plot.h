// Error over frame time of both casters and the naive yardsticks, drawn by the gnuplot program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/measure.h"

namespace fanbeam::benchmarks {

// The picture of one scene as gnuplot commands, the figures in them: `name`.svg and `name`.png in
// the folder where gnuplot runs.
std::string ladder_plot_script(const std::string& name, const std::vector<ViewFigures>& views);

// Writes `folder`/performance-SCENE with the endings .gp, .svg and .png; the common name without
// its ending, or nothing and a line on stderr when gnuplot is missing or fails. Throws InputError
// E-IO when the commands cannot be written.
std::string draw_ladders(const std::vector<ViewFigures>& views,
                         const std::filesystem::path& folder);

}  // namespace fanbeam::benchmarks
