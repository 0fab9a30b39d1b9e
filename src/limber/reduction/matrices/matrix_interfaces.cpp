// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/matrix_interfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::flexbody {
namespace {

/// The node with this number, or those that a program put in its place.
std::vector<int> find_tagged(const MatrixSystem& system, std::size_t tag) {
  const auto found = std::find(system.tags.begin(), system.tags.end(), tag);
  if (found != system.tags.end())
    return {static_cast<int>(found - system.tags.begin())};
  const auto expanded = std::find_if(
      system.sets.begin(), system.sets.end(),
      [&](const auto& set) { return set.name == fmt::format("node:{}", tag); });
  if (expanded != system.sets.end()) return expanded->nodes;
  throw InputError(
      fmt::format("{}: no node has the number {}; expected one of the {} "
                  "nodes of its table",
                  system.source, tag, system.node_count()));
}

/// The nodes of "node:TAG"; none for any other text.
std::vector<int> find_by_number(const MatrixSystem& system,
                                const std::string& text) {
  constexpr std::string_view kPrefix = "node:";
  if (!text.starts_with(kPrefix)) return {};
  std::size_t tag = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + kPrefix.size(), end, tag);
  if (read.ec != std::errc() || read.ptr != end)
    throw InputError(fmt::format(
        "'{}' is not a node; expected 'node:' and its number", text));
  return find_tagged(system, tag);
}

template <typename Distance>
std::vector<int> find_near(const MatrixSystem& system, const Distance& distance,
                           double tolerance, const std::string& what) {
  std::vector<int> nodes;
  double nearest = 1e300;
  for (int n = 0; n < static_cast<int>(system.node_count()); ++n) {
    if (!system.is_moving[static_cast<std::size_t>(n)]) continue;
    const double d = distance(Vector3(system.x.col(n)));
    nearest = std::min(nearest, d);
    if (d <= tolerance) nodes.push_back(n);
  }
  if (nodes.empty())
    throw InputError(fmt::format(
        "{}: no node belongs to {}; the nearest is {:.3g} m away. Move or "
        "widen it; look at the length unit.",
        system.source, what, nearest));
  return nodes;
}

int find_nearest(const MatrixSystem& system, const Vector3& point) {
  double least = 1e300;
  int nearest = -1;
  for (int n = 0; n < static_cast<int>(system.node_count()); ++n) {
    const double d = (system.x.col(n) - point).norm();
    if (!system.is_moving[static_cast<std::size_t>(n)] || d >= least) continue;
    least = d;
    nearest = n;
  }
  LIMBER_EXPECT(nearest >= 0);
  return nearest;
}

std::vector<int> select_matrix_nodes(const MatrixSystem& system,
                                     const NodeSelection& selection) {
  return std::visit(
      Overloaded{
          [&](const GroupNodes& group) {
            return find_matrix_nodes(system, group.group);
          },
          [&](const TaggedNode& node) { return find_tagged(system, node.tag); },
          [&](const NearestNode& node) {
            return std::vector<int>{find_nearest(system, node.point)};
          },
          [&](const auto& region) {
            return find_near(
                system,
                [&](const Vector3& p) { return calc_distance(region, p); },
                find_tolerance(region, system.size().maxCoeff()),
                describe(selection));
          }},
      selection);
}

void check_moving(const MatrixSystem& system, const std::vector<int>& nodes) {
  for (const int node : nodes)
    if (!system.is_moving[static_cast<std::size_t>(node)])
      throw InputError(fmt::format(
          "{}: node {} has no three translations in the matrices (it belongs "
          "to no element, or was condensed without equations)",
          system.source, system.tags[static_cast<std::size_t>(node)]));
}

fem::WeightedNodes weigh_all_equally(const MatrixSystem& system,
                                     std::vector<int> nodes) {
  const auto count = static_cast<Eigen::Index>(nodes.size());
  fem::WeightedNodes weighted;
  weighted.weights = VectorX::Constant(count, 1.0 / static_cast<double>(count));
  const Matrix3X x = system.x(Eigen::all, nodes);
  weighted.moments = (x.colwise() - Vector3(x * weighted.weights)) /
                     static_cast<double>(count);
  weighted.nodes = std::move(nodes);
  return weighted;
}

/// Axes of a node's own rotation; none if only one is there.
Matrix3X find_own_axes(const MatrixSystem& system, int node) {
  const auto& can = system.can_rotate[static_cast<std::size_t>(node)];
  Matrix3X axes(3, 0);
  for (int c = 0; c < 3; ++c) {
    if (!can[static_cast<std::size_t>(c)]) continue;
    axes.conservativeResize(3, axes.cols() + 1);
    axes.col(axes.cols() - 1) = Vector3::Unit(c);
  }
  return axes.cols() == 1 ? Matrix3X(3, 0) : axes;
}

/// Fields have the node's translations as node 2n and its rotations as 2n + 1.
InterfaceMotion make_motion(const MatrixSystem& system,
                            const fem::WeightedNodes& selection) {
  const Eigen::Index count = 2 * static_cast<Eigen::Index>(system.tags.size());
  if (selection.nodes.size() == 1) {
    const int node = selection.nodes.front();
    return InterfaceMotion::of_frame(2 * node, 2 * node + 1, system.x.col(node),
                                     find_own_axes(system, node), count);
  }
  Matrix3X x = Matrix3X::Zero(3, count);
  std::vector<int> translations;
  for (const int node : selection.nodes) {
    translations.push_back(2 * node);
    x.col(2 * node) = system.x.col(node);
  }
  return {translations, selection.weights, selection.moments, x,
          system.size().maxCoeff()};
}

}  // namespace

std::vector<int> find_matrix_nodes(const MatrixSystem& system,
                                   const std::string& set) {
  if (auto nodes = find_by_number(system, set); !nodes.empty()) return nodes;
  std::vector<std::string> known;
  for (const fem::MatrixNodeSet& one : system.sets) {
    if (one.name == set && !one.nodes.empty()) return one.nodes;
    if (!one.name.starts_with("node:")) known.push_back(one.name);
  }
  throw InputError(
      fmt::format("{}: {}; a node is called by its number, as 'node:12'",
                  system.source, describe_unknown("node set", set, known)));
}

std::vector<Interface> find_interfaces(const MatrixSystem& system,
                                       const Recipe& recipe) {
  std::vector<Interface> interfaces;
  std::set<std::string> names;
  std::vector<std::string> problems;
  for (const InterfaceRequest& request : recipe.interfaces) {
    if (!names.insert(request.name).second)
      throw InputError(
          fmt::format("body '{}': two interfaces are called '{}'. Give each "
                      "its own name.",
                      recipe.name, request.name));
    try {
      const std::vector<int> nodes = select_matrix_nodes(system, request.nodes);
      check_moving(system, nodes);
      fem::WeightedNodes selection = weigh_all_equally(system, nodes);
      InterfaceMotion motion = make_motion(system, selection);
      interfaces.push_back({request.name, request.static_modes,
                            std::move(selection), std::move(motion)});
    } catch (const InputError& error) {
      problems.push_back(
          fmt::format("interface '{}': {}", request.name, error.what()));
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return interfaces;
}

}  // namespace limber::flexbody
