// Reading whole files with a cap, and writing so that a final name only ever holds a complete file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace fanbeam::core {

class ProblemList;

// Its bytes, from the first on. What is no regular file is not opened, as opening a named pipe waits for whoever
// writes to it: that, and what the system refuses, is E-IO in `problems`, and the stream is not open.
std::ifstream open_file(const std::filesystem::path& path, ProblemList& problems);

// Whether the file's first bytes are `text`: how a table tells who wrote it. False for what open_file does not open.
bool file_begins_with(const std::filesystem::path& path, std::string_view text);

// The file's bytes. Throws InputError: E-IO when it cannot be read, E-LIMIT when larger than
// `largest_bytes` (checked before anything is allocated).
std::string read_file(const std::filesystem::path& path, std::uint64_t largest_bytes);

// Writes beside the target under a temporary name and renames. Missing parent folders are made.
// Throws InputError E-IO with the path and the system's reason; the old file, if any, is then
// untouched.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

// The same for writers that want a path: `write` gets the temporary path (same extension as the
// target).
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

// "out/<name><ending>", where programs write to unless told where. Throws InternalError when `name`
// is no safe word (core/text.h): readers refuse such names, as this could be any place.
std::filesystem::path default_output_folder(const std::string& name,
                                            const std::string& ending = "");

// A name for what is to become `path`, hidden, in its folder and with its extension: this process's
// alone, also where several machines share the folder, and known to remove_abandoned_temporaries.
std::filesystem::path temporary_beside(const std::filesystem::path& path);

// Removes what processes of this machine that live no more left in `folder` (not below it) of
// write_atomically: files that were never finished. Of other machines, and of this one before it was
// started anew, what nothing was written to for a day. Does nothing where it may not, or where there
// is no such folder.
void remove_abandoned_temporaries(const std::filesystem::path& folder);

// Whether `path` lies in `folder` or is it (also where that is a file), links of both followed. What is not there
// lies where its name says. False too where the system does not answer.
bool lies_inside(const std::filesystem::path& folder, const std::filesystem::path& path);

// `relative` resolved inside `folder`. Throws InputError E-PATH when it is absolute, has a URI
// scheme (relative_uri.h), or leaves the folder (".." or a symbolic link). `place` and `field` go into the message.
std::filesystem::path path_inside(const std::filesystem::path& folder, const std::string& relative,
                                  const struct Place& place, const std::string& field);

}  // namespace fanbeam::core
