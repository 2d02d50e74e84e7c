// What the commands share: where shipped files are, how problems are told, exit codes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "scenes/scene_reader.h"

namespace CLI {
class App;
}

namespace fanbeam::apps {

inline constexpr int kExitDone = 0;
inline constexpr int kExitCompareFailed = 1;
inline constexpr int kExitUsage = 2;
inline constexpr int kExitInvalidInput = 3;
inline constexpr int kExitIo = 4;
inline constexpr int kExitBug = 5;

// Options that every command has.
struct CommonOptions {
  bool quiet = false;
  std::string log_level = "info";
  std::string isa;  // "v2", "v3" or "v4": no kernel uses more; empty without a limit
};
void set_up_log(const CommonOptions& options);

// The folder with scenes/, sensors/ and materials/: share/fanbeam beside an installed program, the
// source tree around a build. Throws InputError E-IO when neither is there.
std::filesystem::path shipped_folder();

// Reports E-IO when `--data` names what is no folder.
void check_data_folder(const std::string& from_command_line, core::ProblemList& problems);

// `--data DIR` first, then FANBEAM_DATA, then ../shared/data beside a source tree. Throws
// InputError E-IO when the first is no folder.
std::vector<std::filesystem::path> data_folders(const std::string& from_command_line);

// As people are told where a file lies.
std::string full_path(const std::filesystem::path& path);

// Throws InputError E-PATH of the option (exit code 2) where an output is one of what a command reads, or lies in one
// that is a folder; links are followed. Of an empty path nothing is said.
void refuse_output_among(const std::vector<std::filesystem::path>& inputs,
                         const std::filesystem::path& output, const std::string& option);

// Prints each problem on a line of its own, errors before warnings, each by place, with a
// count at the end.
void print_problems(std::vector<core::Problem> problems);

// What a program that met these errors exits with: kExitUsage when all concern options of the
// command line, kExitIo when the system refused all (E-IO without a line that asked for it), else
// kExitInvalidInput.
int exit_code_of(const std::vector<core::Problem>& problems);

// Runs a command and turns its exceptions into messages and exit codes; core::Stopped ends the process by the signal
// that asked for it.
int run_guarded(const std::function<int()>& command);

}  // namespace fanbeam::apps
