#include "apps/common.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <system_error>

#include "apps/stop_on_signals.h"
#include "core/files.h"
#include "core/stop.h"
#include "session/shipped.h"

namespace fanbeam::apps {

namespace fs = std::filesystem;

void set_up_log(const CommonOptions& options) {
  auto logger = spdlog::stderr_color_mt("fanbeam");
  logger->set_pattern("%^%l%$: %v");
  spdlog::set_default_logger(logger);
  spdlog::set_level(options.quiet ? spdlog::level::err
                                  : spdlog::level::from_str(options.log_level));
}

fs::path shipped_folder() { return session::shipped_above(fs::read_symlink("/proc/self/exe")); }

void check_data_folder(const std::string& from_command_line, core::ProblemList& problems) {
  if (!from_command_line.empty()) session::check_data_folder(from_command_line, "--data", problems);
}

std::vector<fs::path> data_folders(const std::string& from_command_line) {
  core::ProblemList problems;
  check_data_folder(from_command_line, problems);
  problems.throw_if_errors();
  std::vector<fs::path> folders;
  if (!from_command_line.empty()) folders.emplace_back(from_command_line);
  if (const char* variable = std::getenv("FANBEAM_DATA"); variable != nullptr && *variable != '\0')
    folders.emplace_back(variable);
  const fs::path beside = shipped_folder().parent_path() / "shared" / "data";
  if (fs::is_directory(beside)) folders.push_back(beside);
  return folders;
}

std::string full_path(const fs::path& path) {
  return fs::absolute(path).lexically_normal().string();
}

void refuse_output_among(const std::vector<fs::path>& inputs, const fs::path& output,
                         const std::string& option) {
  for (const fs::path& input : inputs)
    if (!output.empty() && !input.empty() && core::lies_inside(input, output))
      core::throw_input_error(core::ErrorClass::path, option, "\"" + output.string() + "\"",
                              "a place apart from " + input.string() + ", which is read");
}

void print_problems(std::vector<core::Problem> problems) {
  const auto is_error = [](const core::Problem& problem) { return problem.is_error(); };
  core::sort_by_place(problems);
  const auto warnings = std::stable_partition(problems.begin(), problems.end(), is_error);
  for (const core::Problem& problem : problems) std::cerr << core::to_string(problem) << '\n';
  const auto errors = warnings - problems.begin();
  if (errors > 0) std::cerr << errors << (errors == 1 ? " error" : " errors") << "\n";
}

int exit_code_of(const std::vector<core::Problem>& problems) {
  bool usage = true;
  bool io = true;
  for (const core::Problem& problem : problems) {
    if (!problem.is_error()) continue;
    usage = usage && problem.field.starts_with("--") && problem.code != code(core::ErrorClass::io);
    // A missing file that a line of the scene names is the scene's fault.
    io = io && problem.code == code(core::ErrorClass::io) && problem.place.line == 0;
  }
  if (io) return kExitIo;
  return usage ? kExitUsage : kExitInvalidInput;
}

int run_guarded(const std::function<int()>& command) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit of its size is a failed write
  try {
    const int exit_code = command();
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0)
      throw std::system_error(errno, std::generic_category(), "standard output");
    return exit_code;
  } catch (const core::InputError& error) {
    print_problems(error.problems());
    return exit_code_of(error.problems());
  } catch (const core::Stopped&) {
    return end_by_stop_signal();
  } catch (const std::system_error& error) {  // of files, of printing to a full disk, of threads
    std::cerr << "fanbeam: E-IO: " << error.what() << '\n';
    return kExitIo;
  } catch (const std::exception& error) {
    std::cerr << "fanbeam: internal error: " << error.what()
              << "\nThis is a bug: please report it with the scene.\n";
    return kExitBug;
  }
}

}  // namespace fanbeam::apps
