#include "session/records/fingerprint.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <set>

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

class Hash {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  void add_file(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::vector<char> chunk(1U << 16U);
    while (stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) ||
           stream.gcount() > 0)
      add({chunk.data(), static_cast<std::size_t>(stream.gcount())});
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

// "dem.tif" and all that begins with "dem.", in the order of names. The folder is looked through to its end: its own
// order is the file system's.
std::set<fs::path> of_one_name(const fs::path& file) {
  std::set<fs::path> files;
  const std::string stem = file.stem().string() + ".";
  std::error_code status;
  for (fs::directory_iterator entry(file.parent_path(), status), end; !status && entry != end;
       entry.increment(status))
    if (entry->path().filename().string().starts_with(stem) && entry->is_regular_file(status))
      files.insert(entry->path());
  return files;
}

bool is_raster(const fs::path& file) {
  constexpr std::array<std::string_view, 7> kEndings = {".tif", ".tiff", ".asc", ".hgt",
                                                        ".dt0", ".dt1",  ".dt2"};
  std::string ending = file.extension().string();
  for (char& letter : ending)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

}  // namespace

std::vector<fs::path> with_companions(const std::vector<fs::path>& files) {
  std::vector<fs::path> all;
  for (const fs::path& file : files) {
    all.push_back(file);
    if (!is_raster(file)) continue;
    for (const fs::path& other : of_one_name(file))
      if (other != file) all.push_back(other);
  }
  return all;
}

std::string fingerprint_of(std::string_view settings, const std::vector<fs::path>& files) {
  Hash hash;
  hash.add(settings);
  for (const fs::path& file : with_companions(files)) hash.add_file(file);
  return fmt::format("{:016x}", hash.value());
}

}  // namespace fanbeam::session
