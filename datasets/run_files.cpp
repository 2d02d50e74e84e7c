#include "datasets/run_files.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <string>
#include <system_error>

#include "core/errors.h"
#include "core/files.h"

namespace fanbeam::datasets {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kHeader_bytes = 512;

struct Closer {
  void operator()(archive* a) const { archive_free(a); }
};
struct EntryCloser {
  void operator()(archive_entry* e) const { archive_entry_free(e); }
};

[[noreturn]] void throw_io(const fs::path& file, const std::string& what) {
  core::throw_input_error(core::ErrorClass::io, core::Place{file.string()}, "archive", what,
                          "a run's archive that can be written and read");
}

std::map<std::string, RunFiles::Where> members_of(const fs::path& campaign,
                                                  const std::string& place) {
  const std::unique_ptr<archive, Closer> tar(archive_read_new());
  archive_read_support_format_tar(tar.get());
  std::map<std::string, RunFiles::Where> members;
  if (archive_read_open_filename(tar.get(), (campaign / place).c_str(), 65536) != ARCHIVE_OK)
    return members;
  archive_entry* entry = nullptr;
  while (archive_read_next_header(tar.get(), &entry) == ARCHIVE_OK) {
    const char* name = archive_entry_pathname(entry);
    const auto at = static_cast<std::uint64_t>(archive_read_header_position(tar.get()));
    if (name != nullptr && archive_entry_filetype(entry) == AE_IFREG)
      members[name] = {place, at + kHeader_bytes,
                       static_cast<std::uint64_t>(archive_entry_size(entry))};
  }
  return members;
}

}  // namespace

fs::path run_folder(const fs::path& campaign, int run) {
  return campaign / "runs" / fmt::format("{:06}", run);
}

fs::path run_archive(const fs::path& campaign, int run) {
  return campaign / "runs" / fmt::format("{:06}.tar", run);
}

bool RunFiles::is_there(const fs::path& campaign, int run) {
  std::error_code none;
  return fs::is_regular_file(run_folder(campaign, run) / kRunRecord, none) ||
         fs::is_regular_file(run_archive(campaign, run), none);
}

std::optional<RunFiles> RunFiles::of(const fs::path& campaign, int run) {
  std::error_code none;
  const fs::path folder = run_folder(campaign, run), tar = run_archive(campaign, run);
  if (fs::is_regular_file(folder / kRunRecord, none))
    return RunFiles(campaign, folder.lexically_relative(campaign).string());
  if (!fs::is_regular_file(tar, none)) return std::nullopt;
  RunFiles files(campaign, tar.lexically_relative(campaign).string());
  files.members_ = members_of(campaign, files.place_);
  return files;
}

std::optional<RunFiles::Where> RunFiles::where(const std::string& name) const {
  if (members_) {
    const auto at = members_->find(name);
    return at == members_->end() ? std::nullopt : std::optional(at->second);
  }
  std::error_code none;
  const std::string file = place_ + "/" + name;
  if (!fs::is_regular_file(campaign_ / file, none)) return std::nullopt;
  return Where{file, 0, fs::file_size(campaign_ / file, none)};
}

std::string RunFiles::read(const std::string& name, std::uint64_t most_bytes) const {
  const auto place = where(name);
  if (!place)
    core::throw_input_error(
        core::ErrorClass::io, core::Place{shown(name)}, "file", "missing",
        "what the run's record names; fanbeam campaign verify tells how to repair it");
  if (!members_) return core::read_file(campaign_ / place->file, most_bytes);
  if (place->bytes > most_bytes)
    core::throw_input_error(core::ErrorClass::limit, core::Place{shown(name)}, "file",
                            std::to_string(place->bytes) + " bytes",
                            "at most " + std::to_string(most_bytes));
  std::ifstream stream(campaign_ / place->file, std::ios::binary);
  std::string bytes(place->bytes, '\0');
  stream.seekg(static_cast<std::streamoff>(place->offset));
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) throw_io(shown(name), "cut short");
  return bytes;
}

std::string RunFiles::shown(const std::string& name) const {
  return (campaign_ / (place_ + (members_ ? ": " : "/") + name)).string();
}

void pack(const fs::path& folder, const std::vector<std::string>& names, const fs::path& file) {
  const std::unique_ptr<archive, Closer> tar(archive_write_new());
  const auto check = [&](la_ssize_t status) {
    if (status >= ARCHIVE_OK) return;
    const int why = archive_errno(tar.get());  // "Write error" alone names no full disk
    throw_io(file, std::string(archive_error_string(tar.get())) +
                       (why > 0 ? ": " + std::generic_category().message(why) : ""));
  };
  check(archive_write_set_format_ustar(tar.get()));
  check(archive_write_open_filename(tar.get(), file.c_str()));
  const std::unique_ptr<archive_entry, EntryCloser> entry(archive_entry_new());
  for (const std::string& name : names) {
    const std::string bytes = core::read_file(folder / name, kLargestRunFile_bytes);
    archive_entry_clear(entry.get());
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes.size()));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), 0644);
    archive_entry_set_mtime(entry.get(), 0, 0);
    check(archive_write_header(tar.get(), entry.get()));
    check(archive_write_data(tar.get(), bytes.data(), bytes.size()));
  }
  check(archive_write_close(tar.get()));
}

}  // namespace fanbeam::datasets
