#include "session/products/preview.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>

#include "core/errors.h"
#include "core/files.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& reason,
                         const std::string& expected) {
  core::throw_input_error(core::ErrorClass::io, core::Place{file.string()}, "preview", reason,
                          expected);
}

constexpr const char* kRoom = "room to write the film, and a working ffmpeg";

// Made before ffmpeg starts, which makes no folders.
fs::path temporary_for(const fs::path& file) {
  std::error_code status;
  fs::create_directories(file.parent_path(), status);
  if (status) refuse(file, status.message(), "a folder that can be made and written to");
  return core::temporary_beside(file);
}

std::vector<std::string> encoder(const fs::path& output, int columns, int rows,
                                 double frame_rate_Hz) {
  std::vector<std::string> words = {"ffmpeg",   "-loglevel",
                                    "error",    "-y",
                                    "-f",       "rawvideo",
                                    "-pix_fmt", "gray",
                                    "-s",       fmt::format("{}x{}", columns, rows),
                                    "-r",       fmt::format("{}", frame_rate_Hz),
                                    "-i",       "-"};
  if (output.extension() == ".mp4")
    for (const char* word :
         {"-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart"})
      words.emplace_back(word);
  words.push_back(output.string());
  return words;
}

// H.264 as every player takes it has one colour for each square of four pixels, and so even sides.
int side_of(const fs::path& film, int pixels) {
  return film.extension() == ".mp4" ? pixels + pixels % 2 : pixels;
}

// With black columns and rows behind its own.
core::Picture8 padded(const core::Picture8& picture, int columns, int rows) {
  core::Picture8 result{columns, rows, {}};
  result.pixels.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  for (int row = 0; row < picture.rows; ++row)
    std::copy_n(picture.pixels.begin() + static_cast<std::ptrdiff_t>(row) * picture.columns,
                picture.columns,
                result.pixels.begin() + static_cast<std::ptrdiff_t>(row) * columns);
  return result;
}

// Players take a GIF or PNG whose last bytes are missing; the formats do not.
bool ends_as_its_kind(const fs::path& film) {
  const std::string extension = film.extension().string();
  const std::string_view end = extension == ".gif"    ? std::string_view(";")
                               : extension == ".apng" ? std::string_view("IEND\xAE\x42\x60\x82")
                                                      : std::string_view();
  std::ifstream stream(film, std::ios::binary);
  std::string last(end.size(), '\0');
  stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  stream.read(last.data(), static_cast<std::streamsize>(last.size()));
  return stream.good() && last == end;
}

}  // namespace

Preview::Preview(fs::path file, int columns, int rows, double frame_rate_Hz)
    : file_(std::move(file)),
      temporary_{temporary_for(file_)},
      columns_(side_of(file_, columns)),
      rows_(side_of(file_, rows)),
      ffmpeg_(encoder(temporary_.path, columns_, rows_, frame_rate_Hz),
              core::ChildProcess::Pipe::to_its_input) {
  if (!ffmpeg_.started())
    refuse(file_, "ffmpeg cannot be started", "a working ffmpeg program (Debian package ffmpeg)");
}

Preview::Temporary::~Temporary() {
  std::error_code ignored;
  fs::remove(path, ignored);
}

void Preview::add(const core::Picture8& picture) {
  const core::Picture8 whole = padded(picture, columns_, rows_);
  const auto* bytes = reinterpret_cast<const char*>(whole.pixels.data());
  if (!ffmpeg_.send({bytes, whole.pixels.size()})) refuse(file_, "ffmpeg stopped reading", kRoom);
  ++pictures_;
}

void Preview::finish() {
  if (!ffmpeg_.succeeded()) refuse(file_, "ffmpeg failed", kRoom);
  if (!is_complete()) refuse(file_, "the film is not complete", kRoom);
  fs::rename(temporary_.path, file_);
}

// ffmpeg reads its own film and prints a line for each picture.
bool Preview::is_complete() const {
  core::ChildProcess reader(
      {"ffmpeg", "-loglevel", "quiet", "-xerror", "-i", temporary_.path.string(), "-map", "0:v:0",
       "-vsync", "passthrough", "-f", "framecrc", "-"},
      core::ChildProcess::Pipe::from_its_output);
  if (!reader.started()) return false;
  int pictures = 0;
  bool begins = true, comment = false;  // of a line
  for (std::string text; !(text = reader.receive()).empty();)
    for (const char c : text) {
      if (begins) comment = c == '#';
      begins = c == '\n';
      if (begins && !comment) ++pictures;
    }
  return reader.succeeded() && pictures == pictures_ && ends_as_its_kind(temporary_.path);
}

}  // namespace fanbeam::session
