// Help, man pages and their judge.
#include <map>
#include <regex>
#include <set>

#include "tests/apps/commands.h"
#include "tests/needed_program.h"

using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

std::string on_one_line(const std::string& text) {
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

// Whole ones: --frame is not taken for --frames.
std::set<std::string> options_in(const std::string& help) {
  static const std::regex kOption("(?:^|[\\s,\\[(])(--[a-z0-9]+(?:-[a-z0-9]+)*)(?![\\w-])");
  std::set<std::string> options;
  for (std::sregex_iterator found(help.begin(), help.end(), kOption), end; found != end; ++found)
    options.insert((*found)[1]);
  return options;
}

std::string examples_in(const std::string& help) {
  const std::size_t at = help.find("\nExamples:\n");
  return at == std::string::npos ? std::string() : help.substr(at + 11);
}

}  // namespace

TEST_CASE("help without a command names them all under headings, with first steps", "[cli][help]") {
  const Result help = run_fanbeam("help");
  CHECK(help.exit_code == 0);
  CHECK(help.output.rfind(run_fanbeam("--help").output, 0) == 0);
  for (const char* heading :
       {"\nPictures of a scene:\n", "\nScenes and their checks:\n", "\nComparing pictures:\n",
        "\nSignals and tracks:\n", "\nLook-ups:\n", "\nExamples:\n  fanbeam list scenes\n"})
    CHECK(help.output.find(heading) != std::string::npos);
  for (const ManPage& page : man_pages())
    if (!page.command.empty() && page.command.find(' ') == std::string::npos)
      CHECK(help.output.find("\n  " + page.command + " ") != std::string::npos);
}

TEST_CASE("help COMMAND is the help of the command with examples whose options exist",
          "[cli][help]") {
  std::map<std::string, std::string> helps;
  for (const ManPage& page : man_pages())
    helps[page.command] = run_fanbeam(page.command + " --help").output;
  for (const auto& [command, own] : helps) {
    INFO("fanbeam help " << command);
    const Result help = run_fanbeam("help " + command);
    CHECK(help.exit_code == 0);
    CHECK(help.output.rfind(own, 0) == 0);
    const std::string examples = examples_in(help.output);
    CHECK(examples.find(command.empty() ? "fanbeam render" : "fanbeam " + command) !=
          std::string::npos);
    std::set<std::string> known;  // options of the command and those below it
    for (const auto& [other, text] : helps)
      if (other == command || other.starts_with(command + " ")) known.merge(options_in(text));
    std::istringstream words(examples);
    for (std::string word; words >> word;) {
      if (word.ends_with(')')) word.pop_back();
      INFO(word);
      if (word.starts_with("--")) CHECK(known.contains(word));
    }
  }
}

TEST_CASE("Examples name scenes and sensors that ship and fit each other", "[cli][help]") {
  std::size_t checked = 0;
  for (const char* command : {"render", "plan", "cost", "doctor", "validate"}) {
    std::istringstream lines(examples_in(run_fanbeam(std::string("help ") + command).output));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("  fanbeam ") || line.find("my-scene") != std::string::npos) continue;
      std::istringstream words(line);
      std::string scene, sensor;
      for (std::string word, before; words >> word; before = word) {
        if (fs::exists(fs::path(FANBEAM_SOURCE_DIR "/scenes") / word / "scene.toml")) scene = word;
        if (before == "--sensor") sensor = " --sensor " + word;
      }
      const Result valid = run_fanbeam("validate -q " + scene + sensor);
      INFO(line << ": " << valid.output);
      CHECK(valid.exit_code == 0);
      ++checked;
    }
  }
  CHECK(checked >= 8);
}

TEST_CASE("Every command tells its exit codes, and every number its limits", "[cli][help]") {
  const std::regex limits("-?[0-9.]+(e[0-9]+)? to (-?[0-9.]+|saturation)");
  for (const ManPage& page : man_pages()) {
    INFO("fanbeam " << page.command);
    CHECK(on_one_line(run_fanbeam(page.command + " --help").output).find("Exit codes: 0 done, ") !=
          std::string::npos);
    CHECK(page.text.find(".SH EXIT STATUS\n.TP\n0\ndone\n") != std::string::npos);
    std::set<std::string> tags;
    for (const ManOption& option : page.options) {
      INFO(option.tag << ": " << option.text);
      CHECK(tags.insert(option.tag).second);
      CHECK(option.text.size() > 3);
      if (option.tag.find(" NUMBER") != std::string::npos || option.takes("N"))
        CHECK(std::regex_search(option.text, limits));
    }
  }
  const auto codes = [](const char* command) {
    return on_one_line(run_fanbeam(std::string(command) + " --help").output);
  };
  CHECK(codes("compare").find("0 done, 1 comparison failed, 2 usage") != std::string::npos);
  CHECK(codes("doctor").find("1 something is worse than delicate") != std::string::npos);
  CHECK(codes("render").find("130 or 143 stopped by Ctrl-C or kill") != std::string::npos);
}

TEST_CASE("Help fits 80 columns", "[cli][help]") {
  for (const ManPage& page : man_pages()) {
    std::istringstream lines(run_fanbeam(page.command + " --help").output);
    for (std::string line; std::getline(lines, line);) {
      INFO(page.command << ": " << line);
      CHECK(line.size() <= 80);
    }
  }
}

TEST_CASE("man sets every page without a warning, options as they are typed", "[cli][help]") {
  if (!needed_program("man")) return;
  const TemporaryFolder folder;
  REQUIRE(run_fanbeam("help --man-pages " + quoted(folder.path())).exit_code == 0);
  const auto pages = contents(folder.path());
  CHECK(pages.count("fanbeam.1") == 1);
  CHECK(pages.count("fanbeam-render.1") == 1);
  CHECK(pages.count("fanbeam-materials-plot.1") == 1);
  const std::string before = "LC_ALL=C.UTF-8 MANROFFSEQ= MANWIDTH=80 ";
  for (const auto& [name, text] : pages) {
    const std::string file = quoted(folder.path() / name);
    const Result judged =
        run_shell(before + "man --warnings=w -E UTF-8 -l -Tutf8 -Z " + file + " 2>&1 >/dev/null");
    INFO(name << ": " << judged.output);
    CHECK(judged.exit_code == 0);
    CHECK(judged.output.empty());
  }
  const Result set = run_shell(before + "man -l " + quoted(folder.path() / "fanbeam-render.1") +
                               " 2>&1 | sed 's/.\\x08//g; s/\\x1b\\[[0-9;]*m//g'");
  for (const char* text : {"fanbeam-render - Render a scene", "SYNOPSIS", "--rays-per-cell NUMBER",
                           "0 to 18446744073709551615; default 0", "EXIT STATUS", "FANBEAM_DATA",
                           "fanbeam render my-scene --data ~/terrain --resume"}) {
    INFO(text);
    CHECK(set.output.find(text) != std::string::npos);
  }
}
