#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <string>
#include <utility>

#include "terrain/gltf/gltf_nodes_private.h"

namespace fanbeam::terrain {
namespace {

using core::ErrorClass;

constexpr int kNoParent = -1;

std::string node_path(std::size_t i) { return "nodes[" + std::to_string(i) + "]"; }

class NodeCheck {
 public:
  NodeCheck(const GltfModel& model, core::ProblemList& problems)
      : model_(model),
        problems_(problems),
        parents_(model.parts.nodes.size(), kNoParent),
        last_scene_(model.parts.nodes.size(), -1) {}

  void check() {
    for (std::size_t i = 0; i < parents_.size(); ++i) check_children(i);
    check_loops();
    for (std::size_t i = 0; i < model_.parts.scenes.size(); ++i) check_scene(static_cast<int>(i));
    for (std::size_t i = 0; i < parents_.size(); ++i) check_transform(i);
  }

 private:
  void check_children(std::size_t i) {
    const std::vector<int>& children = model_.parts.nodes[i].children;
    for (std::size_t k = 0; k < children.size(); ++k) {
      const int child = children[k];
      const std::string path = node_path(i) + ".children[" + std::to_string(k) + "]";
      int& parent = parents_[child];
      if (child == static_cast<int>(i)) {
        report(ErrorClass::ref, path, std::to_string(child), "another node than itself");
      } else if (parent != kNoParent) {
        report(ErrorClass::ref, path, std::to_string(child),
               "a node without a parent, but nodes[" + std::to_string(parent) + "] has it");
      } else {
        parent = static_cast<int>(i);
      }
    }
  }

  // Every node has at most one parent here, so a loop is a way upwards that meets itself.
  void check_loops() {
    enum class State : char { unseen, on_the_way, done };
    std::vector<State> states(parents_.size(), State::unseen);
    std::vector<int> way;
    for (std::size_t start = 0; start < parents_.size(); ++start) {
      way.clear();
      int node = static_cast<int>(start);
      while (node != kNoParent && states[node] == State::unseen) {
        states[node] = State::on_the_way;
        way.push_back(node);
        node = parents_[node];
      }
      if (node != kNoParent && states[node] == State::on_the_way)
        report(ErrorClass::ref, node_path(static_cast<std::size_t>(node)) + ".children",
               "a loop that leads back to it", "a tree");
      for (const int passed : way) states[passed] = State::done;
    }
  }

  void check_scene(int i) {
    const std::vector<int>& roots = model_.parts.scenes[i].nodes;
    for (std::size_t k = 0; k < roots.size(); ++k) {
      const int root = roots[k];
      if (parents_[root] != kNoParent || last_scene_[root] == i)
        report(ErrorClass::ref,
               "scenes[" + std::to_string(i) + "].nodes[" + std::to_string(k) + "]",
               std::to_string(root), "a root node, once");
      last_scene_[root] = i;
    }
  }

  void check_transform(std::size_t i) {
    const tinygltf::Node& node = model_.parts.nodes[i];
    const std::string path = node_path(i);
    check_floats(node.matrix, path + ".matrix");
    check_floats(node.translation, path + ".translation");
    check_floats(node.rotation, path + ".rotation");
    check_floats(node.scale, path + ".scale");
    if (!node.rotation.empty()) {
      double squared_length = 0.0;
      for (const double component : node.rotation) squared_length += component * component;
      // Far below what rounding to a byte leaves of a unit quaternion.
      if (squared_length < 1e-6)
        report(ErrorClass::range, path + ".rotation",
               "length " + core::number_text(std::sqrt(squared_length)), "a unit quaternion");
    }
    if (!node.matrix.empty()) {
      constexpr double kRounding = 1e-6;
      const bool affine =
          std::abs(node.matrix[3]) <= kRounding && std::abs(node.matrix[7]) <= kRounding &&
          std::abs(node.matrix[11]) <= kRounding && std::abs(node.matrix[15] - 1.0) <= kRounding;
      if (!affine)
        report(ErrorClass::range, path + ".matrix", "another fourth row", "0 0 0 1 as fourth row");
    }
  }

  void check_floats(const std::vector<double>& numbers, const std::string& path) {
    constexpr auto kLargest = static_cast<double>(std::numeric_limits<float>::max());
    for (std::size_t k = 0; k < numbers.size(); ++k)
      if (!(std::abs(numbers[k]) <= kLargest))
        report(ErrorClass::nonfinite, path + "[" + std::to_string(k) + "]",
               core::number_text(numbers[k]), "a number that a 32-bit float holds");
  }

  void report(ErrorClass error_class, std::string field, std::string value, std::string expected) {
    problems_.error(error_class, core::Place{model_.file}, std::move(field), std::move(value),
                    std::move(expected));
  }

  const GltfModel& model_;
  core::ProblemList& problems_;
  std::vector<int> parents_;
  std::vector<int> last_scene_;  // that names the node as a root
};

glm::dmat4 local_transform(const tinygltf::Node& node) {
  glm::dmat4 local(1.0);
  if (!node.matrix.empty()) {
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row) local[column][row] = node.matrix[4 * column + row];
    return local;
  }
  const auto& t = node.translation;
  const auto& r = node.rotation;
  const auto& s = node.scale;
  if (!t.empty()) local = glm::translate(local, glm::dvec3(t[0], t[1], t[2]));
  if (!r.empty()) local *= glm::mat4_cast(glm::normalize(glm::dquat(r[3], r[0], r[1], r[2])));
  if (!s.empty()) local = glm::scale(local, glm::dvec3(s[0], s[1], s[2]));
  return local;
}

bool is_finite(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!std::isfinite(matrix[column][row])) return false;
  return true;
}

// Whether no triangle can keep an area.
bool flattens_to_a_line(const glm::dmat4& matrix) {
  const glm::dvec3 a(matrix[0]);
  const glm::dvec3 b(matrix[1]);
  const glm::dvec3 c(matrix[2]);
  const glm::dvec3 zero(0.0);
  return glm::cross(a, b) == zero && glm::cross(b, c) == zero && glm::cross(c, a) == zero;
}

std::vector<int> root_nodes(const tinygltf::Model& model) {
  if (!model.scenes.empty())
    return model.scenes[model.defaultScene < 0 ? 0 : model.defaultScene].nodes;
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const tinygltf::Node& node : model.nodes)
    for (const int child : node.children) is_child[child] = true;
  std::vector<int> roots;
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  return roots;
}

}  // namespace

void check_gltf_nodes(const GltfModel& model, core::ProblemList& problems) {
  NodeCheck(model, problems).check();
}

std::vector<GltfInstance> gltf_instances(const GltfModel& model, core::ProblemList& problems) {
  struct Waiting {
    int node;
    glm::dmat4 parent;
  };
  std::vector<GltfInstance> instances;
  std::vector<Waiting> waiting;
  const auto put_off = [&](const std::vector<int>& nodes, const glm::dmat4& parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
      waiting.push_back({*node, parent});
  };
  put_off(root_nodes(model.parts), glm::dmat4(1.0));
  while (!waiting.empty()) {
    const Waiting next = waiting.back();
    waiting.pop_back();
    const tinygltf::Node& node = model.parts.nodes[next.node];
    const std::string path = node_path(static_cast<std::size_t>(next.node));
    const glm::dmat4 world = next.parent * local_transform(node);
    if (!is_finite(world)) {
      problems.error(ErrorClass::nonfinite, core::Place{model.file}, path,
                     "product of the transforms above it", "finite numbers");
      continue;
    }
    if (node.mesh >= 0) {
      if (flattens_to_a_line(world))
        problems.warning("DEGENERATE", core::Place{model.file}, path,
                         "a transform without two dimensions", "its mesh is not drawn");
      else
        instances.push_back({node.mesh, world, next.node});
    }
    put_off(node.children, world);
  }
  return instances;
}

}  // namespace fanbeam::terrain
