// Whole builds compile the sources of a folder together (FANBEAM_UNITY), where unnamed namespaces
// become one: what two of them define alike would not compile there, or call the other one, and only
// there.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

// "const Map&" of "const Map& map = {}"; of texts and of numbers, which become each other, what they are.
std::string type_of(std::string parameter) {
  static const std::regex kText(R"(^(const char\*|(const )?std::string(_view)?&?)$)");
  static const std::regex kNumber(
      R"(^(const )?(bool|int|unsigned|float|double|(std::)?size_t|(std::)?u?int\d+_t)$)");
  parameter = parameter.substr(0, parameter.find(" = "));
  const std::string type = std::regex_replace(
      parameter, std::regex(R"(^(.*\S)\s+\w+(\[\w*\])?$|^(.*[&*])\w+$)"), "$1$3");
  if (std::regex_match(type, kText)) return "text";
  return std::regex_match(type, kNumber) ? "number" : type;
}

// The types of "A a, std::map<B, C> b", one after the other.
std::string types_of(const std::string& parameters) {
  std::string types;
  std::string parameter;
  int depth = 0;
  for (const char letter : parameters + ",") {
    depth += (letter == '<' || letter == '(') - (letter == '>' || letter == ')');
    if (letter != ',' || depth > 0) {
      if (letter != ' ' || !parameter.empty()) parameter += letter;
      continue;
    }
    types += (types.empty() ? "" : ",") + type_of(parameter);
    parameter.clear();
  }
  return types;
}

// What a definition would clash with: a function its name and parameters, else the name. An alias
// may be said twice, of the same thing.
std::string key_of(const std::string& code) {
  static const std::regex kAlias(R"(^(?:using|namespace) (\w+) = .*)");
  static const std::regex kType(R"(^(?:struct|class|enum class|enum) (\w+)[^;]*$)");
  static const std::regex kFunction(R"(^[\w:<>,&* ]+[ &*](\w+)\(([^{;]*)\)[^()]*[{;].*)");
  static const std::regex kVariable(R"(^[\w:<>,&* ]+[ &*](\w+)(?:\[.*\])?(?: =|\{|;).*)");
  std::smatch parts;
  if (std::regex_match(code, parts, kAlias)) return code;
  if (std::regex_match(code, parts, kType)) return parts[1];
  if (std::regex_match(code, parts, kVariable)) return parts[1];
  if (std::regex_match(code, parts, kFunction))
    return parts[1].str() + "(" + types_of(parts[2]) + ")";
  return {};
}

std::set<std::string> hidden_in(std::istream& source) {
  std::set<std::string> keys;
  bool hidden = false;
  std::string code;
  for (std::string line; std::getline(source, line);) {
    if (line == "namespace {" || line == "}  // namespace") {
      hidden = line.starts_with('n');
      code.clear();
    } else if (hidden && !line.empty() && line.find_first_of("}#/{") != 0 &&
               !line.starts_with("template")) {
      if (line.front() != ' ') code.clear();
      if (line.front() == ' ' && code.empty()) continue;  // inside of what is told already
      code += (code.empty() ? "" : " ") + line.substr(line.find_first_not_of(' '));
      if (code.find_first_of("{;") == std::string::npos) continue;
      if (const std::string key = key_of(code); !key.empty()) keys.insert(key);
      code.clear();
    }
  }
  return keys;
}

// Aliases of one name count once they differ.
std::string name_of(const std::string& key) {
  std::smatch parts;
  return std::regex_match(key, parts, std::regex(R"((?:using|namespace) (\w+) = .*)"))
             ? parts[1].str()
             : key;
}

using Sources = std::map<std::string, std::string>;  // text by path

std::vector<std::string> clashes_in(const Sources& sources) {
  std::map<std::string, std::map<std::string, std::string>> first;  // folder: name: key
  std::vector<std::string> clashes;
  for (const auto& [path, text] : sources) {
    std::istringstream stream(text);
    const std::string folder = fs::path(path).parent_path().string();
    for (const std::string& key : hidden_in(stream)) {
      const auto [found, is_new] = first[folder].emplace(name_of(key), key);
      if (is_new || (found->second == key && key != name_of(key))) continue;
      clashes.push_back(path + ": " + key);
    }
  }
  return clashes;
}

Sources compiled_together() {
  Sources sources;
  for (const char* room : {"core", "feeds", "materials", "atmosphere", "terrain", "sensors",
                           "renderer", "signal", "tracking", "scenes", "session", "measure",
                           "datasets", "live", "bindings", "apps", "benchmarks", "tests"})
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(FANBEAM_SOURCE_DIR) / room)) {
      if (entry.path().extension() != ".cpp") continue;
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      sources[entry.path().lexically_relative(FANBEAM_SOURCE_DIR).string()] = text.str();
    }
  return sources;
}

std::string hidden(const std::string& code) {
  return "namespace {\n" + code + "\n}  // namespace\n";
}

}  // namespace

TEST_CASE("No folder defines one name in two unnamed namespaces", "[layering]") {
  const Sources sources = compiled_together();
  REQUIRE(sources.size() > 700);
  CHECK(clashes_in(sources) == std::vector<std::string>{});
}

TEST_CASE("The check of unnamed namespaces tells definitions from overloads", "[layering]") {
  struct Pair {
    const char* one;
    const char* other;
    bool clash;
  };
  const Pair pair = GENERATE(values<Pair>({
      {"double dBm(double x_W) {\n  return x_W;\n}", "double dBm(double power) { return 1.0; }",
       true},
      {"double dBm(double x_W) {\n  return x_W;\n}", "double dBm(float power) { return 1.0; }",
       true},
      {"double dBm(double x_W) {\n  return x_W;\n}", "double dBm(Watts power) { return 1.0; }",
       false},
      {"int say(const A& a, const char* b = 0) {", "int say(const A& a, const std::string& b) {",
       true},
      {"void put(const A& a,\n         int count = 0) {", "int put(const A& b, int c) {", true},
      {"constexpr double kShare = 0.1;", "constexpr int kShare{3};", true},
      {"struct Row {\n  int a = 0;\n};", "struct Row {\n  double b = 0;\n};", true},
      {"using Json = nlohmann::json;", "using Json = nlohmann::json;", false},
      {"using Json = nlohmann::json;", "using Json = nlohmann::ordered_json;", true},
      {"template <class T>\nT half(const std::map<T, T>& of) {",
       "template <class T>\nT half(const std::map<T, T>& it) {", true},
  }));
  INFO(pair.one << "\n" << pair.other);
  const std::string one = hidden(pair.one);
  const std::string other = hidden(pair.other);
  CHECK(clashes_in({{"core/a.cpp", one}, {"core/b.cpp", other}}).empty() != pair.clash);
  CHECK(clashes_in({{"core/a.cpp", one}, {"terrain/b.cpp", other}}).empty());
}
