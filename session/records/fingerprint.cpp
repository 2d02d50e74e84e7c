#include "session/records/fingerprint.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "core/relative_uri.h"

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

// "dem.tif" and all that begins with "dem.", in the order of names.
std::set<fs::path> of_one_name(const fs::path& file) {
  constexpr std::size_t kMostEntries = 10'000;  // of a folder that is worth a look
  std::set<fs::path> files;
  const std::string stem = file.stem().string() + ".";
  std::error_code status;
  std::size_t seen = 0;
  for (fs::directory_iterator entry(file.parent_path(), status), end;
       !status && entry != end && ++seen < kMostEntries; entry.increment(status))
    if (entry->path().filename().string().starts_with(stem) && entry->is_regular_file(status))
      files.insert(entry->path());
  return files;
}

// Files that the text names as URIs; what is refused as one is no part of the model.
std::set<fs::path> named_as_uris(const fs::path& gltf) {
  std::ifstream stream(gltf, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  static const std::regex kUri("\"uri\"[ \t\r\n]*:[ \t\r\n]*\"([^\"]{1,1000})\"");
  std::set<fs::path> files;
  std::error_code status;
  for (std::sregex_iterator found(text.begin(), text.end(), kUri), end; found != end; ++found) {
    try {
      const fs::path file =
          core::file_of_uri(gltf.parent_path(), gltf, (*found)[1].str(), {}, "uri");
      if (fs::is_regular_file(file, status)) files.insert(file);
    } catch (const core::InputError&) {
      continue;
    }
  }
  return files;
}

bool is_raster(const fs::path& file) {
  constexpr std::array<std::string_view, 7> kEndings = {".tif", ".tiff", ".asc", ".hgt",
                                                        ".dt0", ".dt1",  ".dt2"};
  const std::string ending = file.extension().string();
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

}  // namespace

std::string fingerprint_of(std::string_view settings, const std::vector<fs::path>& files) {
  Hash hash;
  hash.add(settings);
  for (const fs::path& file : files) {
    hash.add_file(file);
    std::set<fs::path> more;
    if (file.extension() == ".gltf") more = named_as_uris(file);
    if (is_raster(file)) more = of_one_name(file);
    for (const fs::path& other : more)
      if (other != file) hash.add_file(other);
  }
  return fmt::format("{:016x}", hash.value());
}

}  // namespace fanbeam::session
