// The rules of the house: which folder may include which, where third-party libraries may appear,
// what a folder may not do, how long a file may grow. The checker runs over the checkout, and over a
// tree of offenders to show that it would notice.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

// Folder -> folders whose headers it may include besides its own.
const std::map<std::string, Names>& layers() {
  static const std::map<std::string, Names> kLayers = {
      {"core", {}},
      {"feeds", {"core"}},
      {"materials", {"core"}},
      {"atmosphere", {"core"}},
      {"terrain", {"core"}},
      {"sensors", {"core"}},
      {"renderer", {"core", "materials", "atmosphere", "terrain", "sensors"}},
      {"signal", {"core", "sensors"}},
      {"tracking", {"core", "sensors", "signal"}},
      {"scenes", {"core", "feeds", "materials", "atmosphere", "terrain", "sensors", "renderer"}},
      {"session", {"core", "materials", "atmosphere", "terrain", "sensors", "renderer", "scenes"}},
      {"session/signal",
       {"core", "materials", "atmosphere", "terrain", "sensors", "renderer", "scenes", "session",
        "signal", "tracking"}},
      {"measure",
       {"core", "materials", "atmosphere", "terrain", "sensors", "renderer", "scenes", "session"}},
      {"datasets",
       {"core", "materials", "atmosphere", "terrain", "sensors", "renderer", "scenes", "session"}},
      {"live",
       {"core", "materials", "atmosphere", "terrain", "sensors", "renderer", "scenes", "session",
        "feeds"}},
      {"bindings/c",
       {"core", "materials", "atmosphere", "terrain", "sensors", "renderer", "scenes", "session"}},
      {"bindings/python",
       {"core", "materials", "atmosphere", "terrain", "sensors", "renderer", "scenes", "session",
        "session/signal", "signal"}},
      {"apps",
       {"core", "feeds", "live", "materials", "atmosphere", "terrain", "sensors", "renderer",
        "signal", "tracking", "scenes", "session", "session/signal", "measure", "datasets"}}};
  return kLayers;
}

// "session/signal" of "session/signal/chain.h", "session" of "session/plots/gnuplot.h".
std::string room_of(const std::string& path) {
  const std::size_t first = path.find('/');
  const std::size_t second = path.find('/', first + 1);
  const std::string nested = path.substr(0, second);
  return second != std::string::npos && layers().count(nested) > 0 ? nested : path.substr(0, first);
}

// A library that only one folder may include, and there only in sources.
struct Confined {
  const char* header_pattern;
  const char* folder;
};
constexpr Confined kConfined[] = {
    {"embree[0-9]*/.*", "terrain"},      {"tiny_gltf\\.h", "terrain"},
    {"GeographicLib/.*", "terrain"},     {"(gdal|ogr|cpl_|gdal/).*", "terrain"},
    {"(geos_c\\.h|geos/.*)", "terrain"}, {"proj(_.*)?\\.h", "terrain"},
    {"OpenImageIO/.*", "core"},          {"fftw3\\.h", "signal"},
    {"openssl/.*", "datasets"},          {"archive(_entry)?\\.h", "datasets"},
    {"nanoflann\\.hpp", "signal"},       {"boost/(asio|beast).*", "live"},
};

// What a folder's files may not include, and the rule that says so.
struct Barred {
  const char* folder;
  const char* header_pattern;
  const char* rule;
};
constexpr Barred kBarred[] = {
    {"renderer", R"(fstream|core/files\.h)", "the renderer reads no files"},
    {"scenes", R"(renderer/(accuracy/|frame_renderer|planned_frames|casting/(?!sampling\.h)).*)",
     "scenes cast no rays"},
};

// Names that print, and those of terrain::RayScene that cast.
constexpr const char* kPrinters[] = {"cout",  "cerr",    "clog",   "printf", "fprintf",   "puts",
                                     "fputs", "putchar", "perror", "spdlog", "fmt::print"};
constexpr const char* kCasts[] = {"intersect", "occluded", "find_occluded"};

// How third-party types look when they get into a header without an include, as a forward
// declaration.
constexpr const char* kForeignTypes =
    R"(\b(RTC[A-Z]\w*|GDAL\w+|OGR\w+|GEOS\w+|PJ_\w+|OIIO|GeographicLib|tinygltf|nlohmann|tbb|toml|CLI|spdlog|fmt|r123|Eigen|fftwf?_\w+|nanoflann|boost)\b)";

constexpr std::size_t kMostLines = 600;

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

struct Source {
  std::string name;     // "terrain/mesh.h"
  std::string folder;   // "terrain", "session/signal"
  bool header = false;  // one that other folders may include
};

// Headers named *_private.h are for sources of their own folder: they may show what a library looks
// like.
bool is_private_header(std::string_view name) { return name.ends_with("_private.h"); }

bool matches(const std::string& text, const char* pattern) {
  return std::regex_match(text, std::regex(pattern));
}

// As a whole word.
bool names(const std::string& code, std::string_view name) {
  const auto in_word = [&](std::size_t at) {
    return at < code.size() &&
           (code[at] == '_' || std::isalnum(static_cast<unsigned char>(code[at])));
  };
  for (std::size_t at = code.find(name); at != std::string::npos; at = code.find(name, at + 1))
    if (!in_word(at - 1) && !in_word(at + name.size())) return true;
  return false;
}

// Nothing of ours reads its headers but itself: they may show the library that it is about.
bool is_end(const Source& source) {
  return source.folder == "apps" || source.folder == "bindings/python";
}

// Standard headers have neither a folder nor an extension: <vector>. Those of C have, in the one
// header that C programs read.
bool is_standard_or_glm(const Source& source, const std::string& included) {
  if (source.name == "bindings/c/fanbeam.h")
    return included == "stddef.h" || included == "stdint.h";
  return included.starts_with("glm/") || included.find_first_of("/.") == std::string::npos;
}

void check_own_include(const Source& source, const std::string& included, Names& violations) {
  const std::string folder = room_of(included);
  if (layers().count(folder) == 0 || included.find("..") != std::string::npos)
    violations.insert(source.name + " includes \"" + included +
                      "\", which is no path from the root to a library folder");
  else if (folder != source.folder && layers().at(source.folder).count(folder) == 0)
    violations.insert(source.name + " may not include " + folder + "/");
  else if (is_private_header(included) && (folder != source.folder || source.header))
    violations.insert(source.name + " may not include " + included);
}

void check_foreign_include(const Source& source, const std::string& included, Names& violations) {
  if (source.header && !is_end(source) && !is_standard_or_glm(source, included))
    violations.insert(source.name + " shows <" + included + "> in a header");
  for (const Confined& confined : kConfined)
    if (matches(included, confined.header_pattern) &&
        (source.folder != confined.folder || source.header))
      violations.insert(source.name + " includes <" + included + ">, which belongs in sources of " +
                        confined.folder);
}

void check_code(const Source& source, const std::string& code, Names& violations) {
  if (source.folder != "apps")
    for (const char* name : kPrinters)
      if (names(code, name))
        violations.insert(source.name + " names " + name + ": libraries never print");
  if (source.folder == "scenes")
    for (const char* name : kCasts)
      if (names(code, name))
        violations.insert(source.name + " names " + name + ": scenes cast no rays");
}

// The line without comments; `inside` tells whether it begins in one of C's.
std::string code_of(const std::string& line, bool& inside) {
  std::string code;
  for (std::size_t at = 0; at != std::string::npos;) {
    const std::size_t mark = line.find(inside ? "*/" : "/*", at);
    if (!inside) code += line.substr(at, mark - at);
    if (mark != std::string::npos) inside = !inside;
    at = mark == std::string::npos ? mark : mark + 2;
  }
  return code.substr(0, code.find("//"));
}

void check_source(const Source& source, const std::vector<std::string>& lines, Names& violations) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  static const std::regex kForeign(kForeignTypes);
  bool in_comment = false;
  for (const std::string& line : lines) {
    std::smatch parts;
    const std::string code = code_of(line, in_comment);
    if (std::regex_match(line, parts, kInclude)) {
      if (parts[1] == "<")
        check_foreign_include(source, parts[2], violations);
      else
        check_own_include(source, parts[2], violations);
      for (const Barred& barred : kBarred)
        if (source.folder == barred.folder && matches(parts[2], barred.header_pattern))
          violations.insert(source.name + " includes " + parts[2].str() + ": " + barred.rule);
      continue;
    }
    check_code(source, code, violations);
    if (source.header && !is_end(source)) {
      if (std::regex_search(code, parts, kForeign))
        violations.insert(source.name + " shows the type " + parts[1].str() + " in a header");
    }
  }
}

bool is_hidden_or_output(const fs::path& folder, const fs::path& root) {
  const std::string name = folder.filename().string();
  const bool output = folder.parent_path() == root && (name == "build" || name == "out");
  return output || name.starts_with('.');
}

void check_file(const fs::path& root, const fs::path& file, Names& violations) {
  const fs::path relative = file.lexically_relative(root);
  const std::string extension = file.extension().string();
  const bool code = extension == ".h" || extension == ".cpp";
  const bool build_file = file.filename() == "CMakeLists.txt" || extension == ".cmake" ||
                          file.filename() == "CMakePresets.json" || relative == "dev";
  const bool script =
      extension == ".py" || extension == ".sh" || extension == ".js" || extension == ".html";
  if (!code && !build_file && !script) return;

  const std::vector<std::string> lines = lines_of(file);
  if (lines.size() > kMostLines)
    violations.insert(relative.string() + " has " + std::to_string(lines.size()) + " lines");
  const bool header = extension == ".h" && !is_private_header(relative.string());
  const Source source{relative.string(), room_of(relative.string()), header};
  const bool ours = layers().count(source.folder) > 0;
  if (build_file || ours)
    for (const std::string& line : lines)
      if (matches(line, R"(.*(-ffast-math|-Ofast|-funsafe-math-optimizations|"fast-math").*)"))
        violations.insert(relative.string() + " gives up IEEE arithmetic");
  if (code && ours) check_source(source, lines, violations);
}

Names violations_in(const fs::path& root) {
  Names violations;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::end(entry); ++entry) {
    if (entry->is_directory() && is_hidden_or_output(entry->path(), root))
      entry.disable_recursion_pending();
    else if (entry->is_regular_file())
      check_file(root, entry->path(), violations);
  }
  return violations;
}

std::string listed(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += "  " + name + '\n';
  return text;
}

// A folder of its own that goes away at the end.
class SyntheticTree {
 public:
  explicit SyntheticTree(const std::string& name) : root_(fs::path(FANBEAM_BINARY_DIR) / name) {
    fs::remove_all(root_);
  }
  ~SyntheticTree() { fs::remove_all(root_); }
  SyntheticTree(const SyntheticTree&) = delete;
  SyntheticTree& operator=(const SyntheticTree&) = delete;

  void add(const std::string& relative, std::string_view text) const {
    fs::create_directories((root_ / relative).parent_path());
    std::ofstream(root_ / relative) << text;
  }
  const fs::path& root() const { return root_; }

 private:
  fs::path root_;
};

}  // namespace

TEST_CASE("The sources keep the layering, the confinement of libraries and the file length",
          "[layering]") {
  const fs::path root(FANBEAM_SOURCE_DIR);
  REQUIRE(fs::exists(root / "core" / "errors.h"));
  const Names violations = violations_in(root);
  INFO("violations:\n" << listed(violations));
  CHECK(violations.empty());
}

TEST_CASE("The layering check accepts what the design allows", "[layering]") {
  const SyntheticTree tree("layering_good");
  tree.add("core/image.cpp", "#include <OpenImageIO/imageio.h>\n");
  tree.add("terrain/mesh.h",
           "#include <glm/vec3.hpp>\n#include \"core/errors.h\"\n// built by tinygltf\n");
  tree.add("terrain/mesh.cpp",
           "#include <embree3/rtcore.h>\n#include <gdal_priv.h>\nRTCScene scene;\n");
  tree.add("terrain/gltf_private.h", "#include <tiny_gltf.h>\ntinygltf::Model load();\n");
  tree.add("terrain/gltf.cpp", "#include \"terrain/gltf_private.h\"\n");
  tree.add("renderer/cast.cpp", "#include \"sensors/sensor.h\"\n#include \"terrain/mesh.h\"\n");
  tree.add("tracking/filter.h", "#include \"signal/cfar.h\"\n");
  tree.add("apps/options.h", "#include <CLI/CLI.hpp>\n");
  tree.add("apps/main.cpp", "#include <cstdio>\nint main() { std::puts(\"\"); }\n");
  tree.add("core/text.cpp", "/* as\nprintf does */ std::snprintf(a, 1, b);  // or cout\n");
  tree.add("scenes/scene.cpp", "#include \"renderer/casting/sampling.h\"\nint intersections;\n");
  tree.add("bindings/c/fanbeam.h",
           "/* of toml\n * files */\n#include <stddef.h>\n#include <stdint.h>\n");
  tree.add("bindings/c/calls.cpp", "#include \"bindings/c/fanbeam.h\"\n#include \"session/a.h\"\n");
  tree.add("tests/core/mesh_test.cpp", "#include \"terrain/mesh.h\"\n");
  tree.add("build/release/core/copy.h", "#include <embree3/rtcore.h>\n");
  const Names violations = violations_in(tree.root());
  INFO("violations:\n" << listed(violations));
  CHECK(violations.empty());
}

TEST_CASE("The layering check notices each kind of offence", "[layering]") {
  struct Offence {
    const char* file;
    std::string text;
    const char* told;
  };
  const Offence offence = GENERATE(values<Offence>({
      {"core/a.cpp", "#include \"terrain/mesh.h\"\n", "may not include terrain/"},
      {"materials/a.h", "  #  include \"atmosphere/fog/fog.h\"\n", "may not include atmosphere/"},
      {"terrain/a.cpp", "#include \"materials/nrcs.h\"\n", "may not include materials/"},
      {"renderer/a.cpp", "#include \"scenes/scene.h\"\n", "may not include scenes/"},
      {"signal/a.cpp", "#include \"renderer/cast.h\"\n", "may not include renderer/"},
      {"tracking/a.cpp", "#include \"terrain/mesh.h\"\n", "may not include terrain/"},
      {"scenes/a.cpp", "#include \"apps/main.h\"\n", "may not include apps/"},
      {"session/plots/a.cpp", "#include \"session/signal/chain.h\"\n",
       "may not include session/signal/"},
      {"session/a.cpp", "#include \"signal/cube.h\"\n", "may not include signal/"},
      {"bindings/c/a.cpp", "#include \"session/signal/chain.h\"\n",
       "may not include session/signal/"},
      {"bindings/c/a.cpp", "#include \"live/hub.h\"\n", "may not include live/"},
      {"bindings/python/a.cpp", "#include \"live/hub.h\"\n", "may not include live/"},
      {"bindings/c/fanbeam.h", "#include <vector>\n", "in a header"},
      {"core/b.h", "/* a */ toml::table t; /* b\n */\n", "shows the type toml"},
      {"core/a.cpp", "#include \"bindings/c/fanbeam.h\"\n", "may not include bindings/c/"},
      {"apps/a.cpp", "#include \"tests/shared_data.h\"\n", "no path from the root"},
      {"core/a.cpp", "#include \"errors.h\"\n", "no path from the root"},
      {"core/a.cpp", "#include \"core/../terrain/mesh.h\"\n", "no path from the root"},
      {"renderer/a.cpp", "#include <embree3/rtcore.h>\n", "belongs in sources of terrain"},
      {"scenes/a.cpp", "#include <gdal.h>\n", "belongs in sources of terrain"},
      {"scenes/a.cpp", "#include <ogrsf_frmts.h>\n", "belongs in sources of terrain"},
      {"scenes/a.cpp", "#include <tiny_gltf.h>\n", "belongs in sources of terrain"},
      {"core/a.cpp", "#include <GeographicLib/Geodesic.hpp>\n", "belongs in sources of terrain"},
      {"core/a.cpp", "#include <geos_c.h>\n", "belongs in sources of terrain"},
      {"scenes/a.cpp", "#include <proj.h>\n", "belongs in sources of terrain"},
      {"apps/a.cpp", "#include <OpenImageIO/imageio.h>\n", "belongs in sources of core"},
      {"renderer/a.cpp", "#include <fftw3.h>\n", "belongs in sources of signal"},
      {"tracking/a.cpp", "#include <nanoflann.hpp>\n", "belongs in sources of signal"},
      {"signal/a.h", "#include <Eigen/Dense>\n", "in a header"},
      {"signal/a.h", "struct A { fftwf_plan plan; };\n", "shows the type fftwf_plan"},
      {"core/a.h", "#include <OpenImageIO/imageio.h>\n", "in a header"},
      {"terrain/a.h", "#include <embree3/rtcore.h>\n", "in a header"},
      {"scenes/a.h", "#include <toml++/toml.h>\n", "in a header"},
      {"terrain/a.h", "struct A { RTCScene scene; };\n", "shows the type RTCScene"},
      {"terrain/a.h", "namespace tinygltf { class Model; }\n", "shows the type tinygltf"},
      {"scenes/a.cpp", "#include \"terrain/gltf_private.h\"\n",
       "may not include terrain/gltf_private.h"},
      {"terrain/a.h", "#include \"terrain/gltf_private.h\"\n",
       "may not include terrain/gltf_private.h"},
      {"renderer/a_private.h", "#include <embree3/rtcore.h>\n", "belongs in sources of terrain"},
      {"renderer/a.cpp", "#include <fstream>\n", "the renderer reads no files"},
      {"renderer/a.cpp", "#include \"core/files.h\"\n", "the renderer reads no files"},
      {"renderer/a.h", "#include \"core/files.h\"\n", "the renderer reads no files"},
      {"scenes/a.cpp", "#include \"renderer/casting/caster.h\"\n", "scenes cast no rays"},
      {"scenes/a.cpp", "#include \"renderer/frame_renderer.h\"\n", "scenes cast no rays"},
      {"scenes/a.cpp", "  rays.find_occluded(active, packet);\n", "scenes cast no rays"},
      {"scenes/a.cpp", "  if (rays->occluded(from_m, to_m, 0.1))\n", "scenes cast no rays"},
      {"terrain/a.cpp", "  std::cout << 1;\n", "libraries never print"},
      {"session/a.h", "inline void a() { std::fprintf(stderr, \"a\"); }\n",
       "libraries never print"},
      {"measure/a.cpp", "  fmt::print(\"a\");\n", "libraries never print"},
      {"live/a.cpp", "puts(\"a\");\n", "libraries never print"},
      {"bindings/c/a.cpp", "  spdlog::info(\"a\");\n", "libraries never print"},
      {"CMakeLists.txt", "add_compile_options(-O3 -ffast-math)\n", "IEEE"},
      {"core/a.cpp", "#pragma GCC optimize(\"fast-math\")\n", "IEEE"},
      {"tests/core/a.cpp", std::string(kMostLines + 1, '\n'), "601 lines"},
      {"bindings/python/a.py", std::string(kMostLines + 1, '\n'), "601 lines"},
      {"live/page.html", std::string(kMostLines + 1, '\n'), "601 lines"},
  }));
  const SyntheticTree tree("layering_bad");
  tree.add(offence.file, offence.text);
  const Names violations = violations_in(tree.root());
  INFO(offence.file << ": " << offence.text.substr(0, 80) << "told:\n" << listed(violations));
  CHECK(std::any_of(violations.begin(), violations.end(), [&](const std::string& violation) {
    return violation.find(offence.told) != std::string::npos &&
           violation.find(offence.file) != std::string::npos;
  }));
}
