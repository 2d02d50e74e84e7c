// Runs the built fanbeam program and looks at what it leaves behind.
#pragma once

#include <sys/wait.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/terrain/ascii_grid.h"

namespace fanbeam::tests {

struct Result {
  int exit_code = -1;
  std::string output;  // standard output and error together
};

inline Result run_shell(const std::string& command) {
  Result result;
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::array<char, 4096> chunk{};
  for (std::size_t count = 0; (count = fread(chunk.data(), 1, chunk.size(), pipe)) > 0;)
    result.output.append(chunk.data(), count);
  const int status = pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

// `words` go to the shell as they are.
inline Result run_fanbeam(const std::string& words, const std::string& before = "") {
  return run_shell(before + " '" FANBEAM_BINARY_DIR "/bin/fanbeam' " + words + " 2>&1 </dev/null");
}

inline std::string quoted(const std::filesystem::path& path) {
  return std::string("'").append(path.string()).append("'");
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

// What must succeed: a scene by its name, or by its folder as the shell takes it.
inline Result render(const std::string& scene, const std::filesystem::path& folder,
                     const std::string& words) {
  const Result result = run_fanbeam("render " + scene + " -o " + quoted(folder) + " " + words);
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  return result;
}

// Three of the obstacle field with texture, walls and targets.
inline const std::string kThreeFrames = " --frames 100:160:20 ";

inline Result track(const std::filesystem::path& input, const std::filesystem::path& out,
                    const std::string& words = "") {
  return run_fanbeam("track " + quoted(input) + " -q " + words + " -o " + quoted(out));
}

// HiVision, but for so few columns that even a reference is quick, and for what `stabilised` says.
inline std::string narrow_sensor(int columns, bool stabilised = true) {
  std::string sensor = bytes_of(FANBEAM_SOURCE_DIR "/sensors/hivision.toml");
  const auto replace = [&](const std::string& from, const std::string& to) {
    const std::size_t at = sensor.find(from);
    REQUIRE(at != std::string::npos);
    sensor.replace(at, from.size(), to);
  };
  replace("field_of_view_deg = 41.0", "field_of_view_deg = " + std::to_string(0.25 * columns));
  replace("columns = 164", "columns = " + std::to_string(columns));
  replace("stabilised = true", stabilised ? "stabilised = true" : "stabilised = false");
  return sensor;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline nlohmann::json json_of(const std::filesystem::path& path) {
  return nlohmann::json::parse(bytes_of(path));
}

// Every file below a folder with its bytes; folders with none.
inline std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    files[entry.path().lexically_relative(folder).string()] =
        entry.is_regular_file() ? bytes_of(entry.path()) : "";
  return files;
}

// As contents, without the file that tells how long it took.
inline std::map<std::string, std::string> results(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files = contents(folder);
  files.erase("timing.json");
  return files;
}

}  // namespace fanbeam::tests
