// The files of a run: in a folder of its own, or one after the other in one archive, so that a shared file
// system has one file a run to look after.
//
//   DIR/runs/000123/bscope/00600.png     a folder
//   DIR/runs/000123.tar                  POSIX ustar, not compressed: run.json first, then the others by name;
//                                        owner 0, time 0: same bytes for the same files
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fanbeam::datasets {

inline constexpr const char* kRunRecord = "run.json";
// In it the fingerprint of the run's scene as it was opened, with its sensor, terrain and the campaign's
// settings: the same in all runs of the scene, whatever they draw.
inline constexpr const char* kSceneInput = "scene_input";
inline constexpr std::uint64_t kLargestRunFile_bytes = 1ULL << 32U;

std::filesystem::path run_folder(const std::filesystem::path& campaign, int run);
std::filesystem::path run_archive(const std::filesystem::path& campaign, int run);

class RunFiles {
 public:
  static bool is_there(const std::filesystem::path& campaign, int run);
  // Nothing where the run is not there, in neither form. A damaged archive has the files before the damage.
  static std::optional<RunFiles> of(const std::filesystem::path& campaign, int run);

  // Bytes of a file, wherever they lie: enough to read it without this program.
  struct Where {
    std::string
        file;  // relative to the campaign: "runs/000123/bscope/00600.png", "runs/000123.tar"
    std::uint64_t offset = 0, bytes = 0;
  };
  std::optional<Where> where(const std::string& name) const;
  // Throws InputError E-IO for what is not there, E-LIMIT beyond `most_bytes`.
  std::string read(const std::string& name, std::uint64_t most_bytes) const;
  // For messages.
  std::string shown(const std::string& name) const;

 private:
  RunFiles(std::filesystem::path campaign, std::string place)
      : campaign_(std::move(campaign)), place_(std::move(place)) {}

  std::filesystem::path campaign_;
  std::string place_;  // of the folder or archive, relative to the campaign
  std::optional<std::map<std::string, Where>> members_;  // of an archive
};

// Puts all files of the folder into a new archive. Throws InputError E-IO.
void pack(const std::filesystem::path& folder, const std::vector<std::string>& names,
          const std::filesystem::path& archive);

}  // namespace fanbeam::datasets
