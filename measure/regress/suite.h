// A suite of pictures to be held against approved ones: a TOML file (docs/regression.md).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/config_table.h"
#include "core/errors.h"
#include "core/machine.h"
#include "measure/regress/tolerance.h"
#include "session/render_request.h"

namespace fanbeam::measure {

struct SuiteCase {
  std::string name;
  core::Place place;
  std::string folder;             // file_name_of(name)
  session::RenderRequest render;  // its keys: docs/regression.md
  std::optional<core::InstructionLevel> isa;
  std::map<std::string, Tolerance> tolerances;  // by product; every value equal where missing
};

struct Suite {
  std::string name;
  std::filesystem::path file;
  std::filesystem::path approved;  // folder with one folder per case
  std::vector<SuiteCase> cases;
  core::ResolvedConfig resolved;
};

// A name for a file or folder that stands for this text and for no other, of at most three times
// its length: letters, digits, "-", "_" and inner dots stay, every other byte becomes "~3C". It
// never names another folder, whatever the text, and needs no escape in a URL.
std::string file_name_of(const std::string& text);

// Paths in the file are relative to it; scenes and sensors that are not there are looked for in
// `shipped` (session/shipped.h). What is wrong is in `problems`, all together; throws InputError E-IO
// only where there is no such file. Data may lie elsewhere: run_suite looks for it.
Suite read_suite(const std::filesystem::path& file, const std::filesystem::path& shipped,
                 core::ProblemList& problems);
// The same for whoever can do nothing with a suite that is not valid: throws all problems.
Suite read_valid_suite(const std::filesystem::path& file, const std::filesystem::path& shipped);

}  // namespace fanbeam::measure
