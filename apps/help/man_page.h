// Manual pages from the declared commands.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace fanbeam::apps {

// The page of a command, or of the program, in the man macros of roff.
std::string man_page(const CLI::App& command);

// fanbeam.1, fanbeam-render.1, fanbeam-materials-plot.1 and so on, one for each command and
// subcommand below `program`. Throws InputError E-IO.
void write_man_pages(const CLI::App& program, const std::filesystem::path& folder);

}  // namespace fanbeam::apps
