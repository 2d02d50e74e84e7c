#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/spelling.h"
#include "terrain/gltf/gltf_reducer_private.h"

namespace fanbeam::terrain {
namespace {

using core::ErrorClass;
using nlohmann::json;

enum class Kind {
  integer,
  index,
  indices,
  size,
  flag,
  text,
  texts,
  numbers,
  object,
  objects,
  anything  // an object that is kept whole
};

// One member that is kept of a JSON object.
struct Member {
  const char* key;
  Kind kind;
  bool required = false;
  const char* refers_to = nullptr;    // index, indices: the root array they count in
  std::size_t length = 0;             // numbers: how many, 0 for any
  std::span<const Member> members{};  // object, objects
};

constexpr Member kAsset[] = {{"version", Kind::text, true}, {"minVersion", Kind::text}};
constexpr Member kScene[] = {{"nodes", Kind::indices, false, "nodes"}};
constexpr Member kNode[] = {{"name", Kind::text},
                            {"mesh", Kind::index, false, "meshes"},
                            {"children", Kind::indices, false, "nodes"},
                            {"matrix", Kind::numbers, false, nullptr, 16},
                            {"translation", Kind::numbers, false, nullptr, 3},
                            {"rotation", Kind::numbers, false, nullptr, 4},
                            {"scale", Kind::numbers, false, nullptr, 3}};
constexpr Member kAttributes[] = {{"POSITION", Kind::index, false, "accessors"}};
constexpr Member kPrimitive[] = {{"attributes", Kind::object, true, nullptr, 0, kAttributes},
                                 {"indices", Kind::index, false, "accessors"},
                                 {"material", Kind::index, false, "materials"},
                                 {"mode", Kind::integer},
                                 {"extensions", Kind::anything}};
constexpr Member kMesh[] = {{"name", Kind::text},
                            {"primitives", Kind::objects, true, nullptr, 0, kPrimitive}};
constexpr Member kMaterial[] = {{"name", Kind::text}, {"doubleSided", Kind::flag}};
constexpr Member kSparseIndices[] = {{"bufferView", Kind::index, true, "bufferViews"},
                                     {"byteOffset", Kind::integer},
                                     {"componentType", Kind::integer, true}};
constexpr Member kSparseValues[] = {{"bufferView", Kind::index, true, "bufferViews"},
                                    {"byteOffset", Kind::integer}};
constexpr Member kSparse[] = {{"count", Kind::integer, true},
                              {"indices", Kind::object, true, nullptr, 0, kSparseIndices},
                              {"values", Kind::object, true, nullptr, 0, kSparseValues}};
constexpr Member kAccessor[] = {{"bufferView", Kind::index, false, "bufferViews"},
                                {"byteOffset", Kind::size},
                                {"componentType", Kind::integer, true},
                                {"normalized", Kind::flag},
                                {"count", Kind::size, true},
                                {"type", Kind::text, true},
                                {"min", Kind::numbers},
                                {"max", Kind::numbers},
                                {"sparse", Kind::object, false, nullptr, 0, kSparse},
                                {"extensions", Kind::anything}};
constexpr Member kBufferView[] = {{"buffer", Kind::index, true, "buffers"},
                                  {"byteOffset", Kind::size},
                                  {"byteLength", Kind::size, true},
                                  {"byteStride", Kind::size},
                                  {"extensions", Kind::anything}};
constexpr Member kBuffer[] = {
    {"uri", Kind::text}, {"byteLength", Kind::size, true}, {"extensions", Kind::anything}};
constexpr Member kImage[] = {{"uri", Kind::text}};
constexpr Member kRoot[] = {{"asset", Kind::object, true, nullptr, 0, kAsset},
                            {"extensionsRequired", Kind::texts},
                            {"scene", Kind::index, false, "scenes"},
                            {"scenes", Kind::objects, false, nullptr, 0, kScene},
                            {"nodes", Kind::objects, false, nullptr, 0, kNode},
                            {"meshes", Kind::objects, false, nullptr, 0, kMesh},
                            {"materials", Kind::objects, false, nullptr, 0, kMaterial},
                            {"accessors", Kind::objects, false, nullptr, 0, kAccessor},
                            {"bufferViews", Kind::objects, false, nullptr, 0, kBufferView},
                            {"buffers", Kind::objects, false, nullptr, 0, kBuffer},
                            {"images", Kind::objects, false, nullptr, 0, kImage}};

// 36.0 becomes 36. Beyond 2^53 a double does not tell whole numbers apart.
void make_whole(json& value) {
  if (!value.is_number_float()) return;
  constexpr double kLargestExact = 9007199254740992.0;
  const double number = value.get<double>();
  if (std::abs(number) > kLargestExact || std::trunc(number) != number) return;
  if (number < 0.0)
    value = static_cast<std::int64_t>(number);
  else
    value = static_cast<std::uint64_t>(number);
}

std::vector<std::string> names_of(const json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

// Moves the wanted members out of the parsed text. The depth of its recursion is that of the
// tables above, whatever the file holds.
class Reducer {
 public:
  Reducer(std::string file, core::ProblemList& problems)
      : file_(std::move(file)), problems_(problems) {}

  json reduce_root(json& root) {
    for (const Member& member : kRoot)
      if (member.kind == Kind::objects && root.contains(member.key))
        counts_[member.key] = root[member.key].size();
    return reduce(root, kRoot, "");
  }

 private:
  json reduce(json& object, std::span<const Member> members, const std::string& path) {
    json kept = json::object();
    for (const Member& member : members) {
      const std::string member_path = path.empty() ? member.key : path + "." + member.key;
      const auto found = object.find(member.key);
      if (found != object.end())
        kept[member.key] = checked(*found, member, member_path);
      else if (member.required && !problems_.is_full())
        report(ErrorClass::parse, member_path, "missing",
               "it to be there" + core::names_there_text(member.key, names_of(object)));
    }
    return kept;
  }

  json checked(json& value, const Member& member, const std::string& path) {
    switch (member.kind) {
      case Kind::integer:
      case Kind::index:
        check_index(value, member, path);
        break;
      case Kind::size:
        make_whole(value);
        if (!value.is_number_integer())
          expect(false, value, path, kWhole);
        else if (!value.is_number_unsigned())
          report(ErrorClass::range, path, shown(value), "0 or more");
        break;
      case Kind::flag:
        expect(value.is_boolean(), value, path, "true or false");
        break;
      case Kind::text:
        expect(value.is_string(), value, path, "a string");
        break;
      case Kind::numbers:
        check_numbers(value, member, path);
        break;
      case Kind::object:
        if (expect(value.is_object(), value, path, "an object"))
          return reduce(value, member.members, path);
        break;
      case Kind::anything:
        if (!expect(value.is_object(), value, path, "an object")) return json::object();
        break;
      case Kind::texts:
      case Kind::indices:
      case Kind::objects:
        return checked_elements(value, member, path);
    }
    return std::move(value);
  }

  json checked_elements(json& array, const Member& member, const std::string& path) {
    json kept = json::array();
    if (!expect(array.is_array(), array, path, "an array")) return kept;
    Member element = member;
    element.kind = member.kind == Kind::texts     ? Kind::text
                   : member.kind == Kind::indices ? Kind::index
                                                  : Kind::object;
    for (std::size_t i = 0; i < array.size(); ++i)
      kept.push_back(checked(array[i], element, path + "[" + std::to_string(i) + "]"));
    return kept;
  }

  void check_index(json& value, const Member& member, const std::string& path) {
    make_whole(value);
    if (!expect(value.is_number_integer(), value, path, kWhole)) return;
    const auto most = std::numeric_limits<std::int32_t>::max();
    const bool fits = value.is_number_unsigned() && value.get<std::uint64_t>() <= most;
    if (member.refers_to != nullptr) {
      const std::size_t count = counts_.contains(member.refers_to) ? counts_[member.refers_to] : 0;
      if (!fits || value.get<std::uint64_t>() >= count)
        report(ErrorClass::ref, path, shown(value),
               "an index below the " + std::to_string(count) + " " + member.refers_to);
    } else if (!fits) {
      report(ErrorClass::range, path, shown(value), "0 to 2147483647");
    }
  }

  void check_numbers(const json& value, const Member& member, const std::string& path) {
    const auto is_number = [](const json& number) { return number.is_number(); };
    const std::string count = member.length > 0 ? std::to_string(member.length) + " " : "";
    expect(value.is_array() && (member.length == 0 || value.size() == member.length) &&
               std::all_of(value.begin(), value.end(), is_number),
           value, path, "an array of " + count + "numbers");
  }

  static constexpr const char* kWhole = "a whole number of at most 2^53";

  bool expect(bool condition, const json& value, const std::string& path, std::string expected) {
    if (!condition) report(ErrorClass::parse, path, shown(value), std::move(expected));
    return condition;
  }

  void report(ErrorClass error_class, std::string path, std::string value, std::string expected) {
    problems_.error(error_class, core::Place{file_}, std::move(path), std::move(value),
                    std::move(expected));
  }

  std::string file_;
  core::ProblemList& problems_;
  std::map<std::string, std::size_t> counts_;
};

}  // namespace

std::string shown(const json& value) {
  constexpr std::size_t kMostShown = 60;
  if (value.is_structured()) return value.is_array() ? "an array" : "an object";
  std::string text = value.dump(-1, ' ', true);
  if (text.size() > kMostShown) text = text.substr(0, kMostShown) + "...";
  return text;
}

json reduced_gltf(json& root, const std::string& file, core::ProblemList& problems) {
  return Reducer(file, problems).reduce_root(root);
}

}  // namespace fanbeam::terrain
