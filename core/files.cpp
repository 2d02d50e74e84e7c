#include "core/files.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <regex>
#include <system_error>
#include <vector>

#include "core/errors.h"
#include "core/relative_uri.h"
#include "core/text.h"

namespace fanbeam::core {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_io(const fs::path& path, const std::string& reason,
                           const std::string& expected) {
  throw_input_error(ErrorClass::io, Place{path.string()}, "", reason, expected);
}

constexpr std::size_t kLongestName_bytes = 255;  // of a file, on any file system in use

// Of another machine nobody can ask whether the owner lives. A film of converged frames may be written
// to once an hour.
constexpr std::chrono::hours kForgotten{24};

// Where a process id means the same process: this start of this machine, this container.
const std::string& process_space() {
  static const std::string space = [] {
    std::ifstream start("/proc/sys/kernel/random/boot_id");
    std::string text{std::istreambuf_iterator<char>(start), std::istreambuf_iterator<char>()};
    std::error_code unknown;
    text += fs::read_symlink("/proc/self/ns/pid", unknown).string();
    std::array<char, 9> digits{};
    std::snprintf(digits.data(), digits.size(), "%08x",
                  static_cast<unsigned>(std::hash<std::string>{}(text)));
    return std::string(digits.data());
  }();
  return space;
}

bool is_forgotten(const fs::path& path) {
  std::error_code gone;
  const fs::file_time_type written = fs::last_write_time(path, gone);
  return !gone && fs::file_time_type::clock::now() - written > kForgotten;
}

}  // namespace

fs::path default_output_folder(const std::string& name, const std::string& ending) {
  if (!is_safe_word(name)) throw InternalError("a name that is no safe word: " + name);
  return fs::path("out") / (name + ending);
}

fs::path temporary_beside(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  std::string end = "." + process_space();
  end.append("-").append(std::to_string(getpid()));
  end.append(".")
      .append(std::to_string(counter++))
      .append(".tmp")
      .append(path.extension().string());
  const std::size_t room = kLongestName_bytes - std::min(end.size() + 1, kLongestName_bytes);
  return path.parent_path() / std::string(".").append(path.stem().string(), 0, room).append(end);
}

std::ifstream open_file(const fs::path& path, ProblemList& problems) {
  std::error_code status;
  std::ifstream stream;
  std::string fault;
  if (!fs::is_regular_file(path, status))
    fault = status ? status.message() : "not a file";
  else if (stream.open(path, std::ios::binary); !stream.is_open())
    fault = std::strerror(errno);
  if (!fault.empty()) {
    stream.setstate(std::ios::failbit);
    problems.error(ErrorClass::io, Place{path.string()}, "", fault, "a readable file");
  }
  return stream;
}

bool file_begins_with(const fs::path& path, std::string_view text) {
  ProblemList none;
  std::ifstream stream = open_file(path, none);
  std::string head(text.size(), '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head == text;
}

std::string read_file(const fs::path& path, std::uint64_t largest_bytes) {
  ProblemList problems;
  std::ifstream stream = open_file(path, problems);
  problems.throw_if_errors();
  std::error_code status;
  const std::uint64_t size = fs::file_size(path, status);
  if (status) throw_io(path, status.message(), "a readable file");
  if (size > largest_bytes)
    throw_input_error(ErrorClass::limit, Place{path.string()}, "file size",
                      std::to_string(size) + " bytes",
                      "at most " + std::to_string(largest_bytes) + " bytes");
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) throw_io(path, "read failed", "a readable file");
  return bytes;
}

void write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  std::error_code status;
  if (!path.parent_path().empty()) fs::create_directories(path.parent_path(), status);
  if (status)
    throw_io(path.parent_path(), status.message(), "a folder that can be made and written to");
  const fs::path temporary = temporary_beside(path);
  try {
    write(temporary);
  } catch (...) {
    fs::remove(temporary, status);
    throw;
  }
  fs::rename(temporary, path, status);
  if (status) {
    const std::string reason = status.message();
    fs::remove(temporary, status);
    throw_io(path, reason, "a file that can be written");
  }
}

void remove_abandoned_temporaries(const fs::path& folder) {
  static const std::regex kTemporary(
      R"(\..*\.(?:([0-9a-f]{8})-)?([0-9]{1,9})\.[0-9]+\.tmp(\..*)?)");
  std::error_code status;
  std::vector<fs::path> abandoned;
  for (fs::directory_iterator entry(folder, status), end; !status && entry != end;
       entry.increment(status)) {
    const std::string name = entry->path().filename().string();
    std::smatch parts;
    if (!std::regex_match(name, parts, kTemporary)) continue;
    const bool left = parts[1] == process_space()
                          ? kill(std::stoi(parts[2]), 0) != 0 && errno == ESRCH
                          : is_forgotten(entry->path());
    if (left) abandoned.push_back(entry->path());
  }
  for (const fs::path& path : abandoned) fs::remove_all(path, status);
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  write_atomically(path, [&](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    if (!stream) throw_io(path, std::strerror(errno), "a file that can be written");
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream)
      throw_io(path, "write failed: " + std::string(std::strerror(errno)), "enough space to write");
  });
}

bool lies_inside(const fs::path& folder, const fs::path& path) {
  std::error_code status;
  if (fs::equivalent(folder, path, status)) return true;  // by a hard link, too
  const fs::path root = fs::weakly_canonical(folder, status);
  if (status) return false;
  const fs::path full = fs::weakly_canonical(path, status);
  if (status) return false;
  const fs::path back = full.lexically_relative(root);
  return !back.empty() && *back.begin() != "..";
}

fs::path path_inside(const fs::path& folder, const std::string& relative, const Place& place,
                     const std::string& field) {
  const auto refuse = [&](const std::string& why) {
    throw_input_error(ErrorClass::path, place, field, "\"" + relative + "\"",
                      "a path inside " + folder.string() + " (" + why + ")");
  };
  const fs::path asked(relative);
  if (relative.empty()) refuse("it is empty");
  if (relative.find('\0') != std::string::npos) refuse("it holds a zero byte");
  if (asked.is_absolute()) refuse("it is absolute");
  if (has_uri_scheme(relative)) refuse("it names a URI scheme");
  std::error_code status;
  const fs::path root = fs::weakly_canonical(folder, status);
  const fs::path full = fs::weakly_canonical(root / asked, status);
  if (status) refuse(status.message());
  if (!lies_inside(root, full)) refuse("it leaves the folder");
  return full;
}

}  // namespace fanbeam::core
