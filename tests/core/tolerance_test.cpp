// Catch takes a number that is within the margin OR within epsilon, 1.2e-5 of it unless told: a margin of a second at a
// Unix time lets five hours pass. So whoever states a margin states epsilon too.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

// The same length, with comments and what stands in quotes blanked.
std::string plain_code(std::string text) {
  static const std::regex kNoCode(
      R"re(//[^\n]*|/\*[^*]*\*+(?:[^/*][^*]*\*+)*/|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)')re");
  std::string code;
  auto from = text.cbegin();
  for (std::sregex_iterator part(text.begin(), text.end(), kNoCode), end; part != end; ++part) {
    code.append(from, (*part)[0].first).append(static_cast<std::size_t>(part->length()), ' ');
    from = (*part)[0].second;
  }
  return code.append(from, text.cend());
}

// Behind the bracket that closes the one at `open`.
std::size_t behind_bracket(const std::string& code, std::size_t open) {
  int depth = 0;
  for (std::size_t at = open; at < code.size(); ++at) {
    depth += (code[at] == '(') - (code[at] == ')');
    if (depth == 0) return at + 1;
  }
  return code.size();
}

struct Chain {
  std::vector<std::size_t> margins;
  bool has_epsilon = false;
};

// What is called on the Approx whose first bracket is at `open`.
Chain chain_at(const std::string& code, std::size_t open) {
  static const std::regex kCall(R"(\s*\.\s*(\w+)\s*\()");
  Chain chain;
  std::smatch call;
  std::size_t at = behind_bracket(code, open);
  while (std::regex_search(code.cbegin() + static_cast<std::ptrdiff_t>(at), code.cend(), call,
                           kCall, std::regex_constants::match_continuous)) {
    if (call[1] == "margin")
      chain.margins.push_back(static_cast<std::size_t>(call[1].first - code.cbegin()));
    chain.has_epsilon = chain.has_epsilon || call[1] == "epsilon";
    at = behind_bracket(code, at + static_cast<std::size_t>(call.length()) - 1);
  }
  return chain;
}

// The lines with a margin whose epsilon is not said in the same chain of calls.
std::vector<long> lone_margins(const std::string& text) {
  static const std::regex kApprox(R"(\bApprox(\s+\w+)?\s*\()"), kMargin(R"(\.\s*(margin)\s*\()");
  const std::string code = plain_code(text);
  std::vector<std::size_t> good;
  for (std::sregex_iterator found(code.begin(), code.end(), kApprox), end; found != end; ++found) {
    const Chain chain =
        chain_at(code, static_cast<std::size_t>(found->position() + found->length() - 1));
    if (chain.has_epsilon) good.insert(good.end(), chain.margins.begin(), chain.margins.end());
  }
  std::vector<long> lines;
  for (std::sregex_iterator found(code.begin(), code.end(), kMargin), end; found != end; ++found) {
    const auto at = static_cast<std::size_t>(found->position(1));
    if (std::find(good.begin(), good.end(), at) == good.end())
      lines.push_back(
          1 + std::count(code.begin(), code.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  }
  return lines;
}

std::string source_text(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("No test states a margin that Catch's own epsilon makes void", "[tolerance]") {
  std::size_t files = 0;
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(fs::path(FANBEAM_SOURCE_DIR) / "tests")) {
    const std::string extension = entry.path().extension().string();
    if (!entry.is_regular_file() || (extension != ".cpp" && extension != ".h")) continue;
    ++files;
    const std::string text = source_text(entry.path());
    if (text.find("margin") == std::string::npos) continue;
    for (const long line : lone_margins(text))
      FAIL_CHECK(entry.path().string() << ":" << line << ": .margin( without .epsilon( beside it");
  }
  CHECK(files > 100);
}

TEST_CASE("Lone margins are found, also beside or within one that has its epsilon", "[tolerance]") {
  using Lines = std::vector<long>;
  CHECK(lone_margins("CHECK(a == Approx(1.0).margin(0.1));") == Lines{1});
  CHECK(lone_margins("CHECK(a ==\n  Approx(f(1.0))\n      .margin(0.1));") == Lines{3});
  CHECK(lone_margins("CHECK((a == Approx(b).epsilon(0.0) &&\n c == Approx(d).margin(1)));") ==
        Lines{2});
  CHECK(lone_margins("Approx(f(Approx(1).margin(2))).epsilon(0.0);") == Lines{1});
  CHECK(lone_margins("Approx near(1.0);\nnear.margin(0.1);") == Lines{2});
  CHECK(lone_margins("Approx near(b).margin(0.1);") == Lines{1});
  CHECK(lone_margins("Approx(b).margin(0.1).epsilon(0.0); Approx(c).epsilon(0).margin(g(2));")
            .empty());
  CHECK(lone_margins("Approx(f(\")\")) /* ( */\n  .epsilon(0.0)  // (\n  .margin(column.margin);")
            .empty());
  CHECK(lone_margins("// Approx(1.0).margin(0.1)\n\"Approx(1.0).margin(0.1)\";").empty());
}
