// The folder that frames are written to: what is there already, what of it a run may replace, and
// what the record of the run lists.
//
// A folder holds pictures of one input. Files of the same input, whatever frames they are of, stay
// and are listed again; files that run.json lists of another input are replaced by the new run's;
// any other file is somebody's, and a run refuses to mix with it unless told to. A run whose files
// do not say what input they are of leaves a note between `begin` and `end`: killed, it leaves
// nothing that the next run takes for somebody's. So does one that replaces another input, whose
// record goes before the first new file is there: the note lists what it listed. A record that lists
// no frame that is there does not say its input, and counts as another's.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace fanbeam::session {

// The radar of a run at signal level (session/signal/radar_file.h).
extern const char* const kRadarFile;

// Throws InputError E-IO of --output where the folder, or one around it, is a file: told by the first file
// that is to be written there, it would cost the time to make that.
void check_can_be_folder(const std::filesystem::path& folder);

class OutputFolder {
 public:
  // Looks, and changes nothing. Throws InputError (E-RANGE of --overwrite: exit code 2) naming
  // files that neither run.json lists nor this input made, unless `overwrite`. Hidden files are
  // nobody's business. Throws as check_can_be_folder.
  OutputFolder(std::filesystem::path folder, std::string fingerprint, bool overwrite);
  // Of a run that failed before any file of its own was there, the record that it replaces comes back.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }

  // A frame was made and will be written: a record of another input goes, with what is of all its
  // frames together, and until `end` the `files` of all frames to come are those of a run that has not
  // ended.
  void begin_frames(const std::function<std::set<std::string>()>& files);
  // The same, whatever record is there, of `files` of all frames together and of frames' files in the
  // folders of `products`.
  void begin(const std::set<std::string>& products, const std::set<std::string>& files);
  // After run.json is written.
  void end();

  // Products of this input that are there, by frame; those of `written` without a look at them.
  std::map<int, std::set<std::string>> frames(
      const std::map<int, std::set<std::string>>& written) const;

  // Films of this input that its record listed when this run began: they do not say it themselves.
  const std::set<std::string>& films() const { return films_; }

  // Removes the files of frames and films that an earlier run.json lists, or with `overwrite` any
  // frame that says its input, unless they are among `files` (relative to the folder) or frames of this input, which
  // another part of its sequence may be writing there. Never leaves the folder. Of how many frames.
  int keep_only(const std::set<std::string>& files) const;

 private:
  std::optional<std::string> input_of(const std::filesystem::path& relative) const;
  bool is_of_this_input(const std::filesystem::path& relative) const;
  bool has_record_of_another() const;
  std::filesystem::path aside(const std::string& name) const;
  void take_place(const std::set<std::string>& products, const std::set<std::string>& files);
  void write_note(const std::set<std::string>& products, const std::set<std::string>& files);
  void restore_note() noexcept;
  std::map<std::string, std::filesystem::file_time_type> times() const;

  std::filesystem::path folder_;
  std::string fingerprint_;
  bool overwrite_;
  struct Listed {
    std::set<std::string> files;
    std::set<std::string> products, begun;  // of runs that did not end; files beside frames'
    bool contains(const std::filesystem::path& relative) const;
  };
  static Listed listed_in(const std::filesystem::path& folder);
  Listed listed_;  // by the run.json that was there, and the note
  Listed noted_;   // by the note as it is now
  std::set<std::string> films_{};
  bool begun_ = false;
  bool set_aside_ = false;  // the record of another input
  // What was there then, of what the note says.
  std::map<std::string, std::filesystem::file_time_type> before_;
};

// Whether a run that writes there has not ended, or was stopped: what is there may be of two.
bool is_unfinished(const std::filesystem::path& folder);

// Files of one frame, relative to the folder: {"power", 7} is "power/00007.exr".
std::set<std::string> frame_files(const std::set<std::string>& products, int index);

}  // namespace fanbeam::session
