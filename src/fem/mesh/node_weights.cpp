// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/node_weights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"

namespace limber::fem {
namespace {

using Shares = std::map<int, double>;

/// Length, area or volume ratio of a map with these tangents.
double calc_measure(const Eigen::Matrix<double, 3, Eigen::Dynamic>& tangents) {
  if (tangents.cols() == 3) return Matrix3(tangents).determinant();
  if (tangents.cols() == 2)
    return Vector3(tangents.col(0)).cross(Vector3(tangents.col(1))).norm();
  return tangents.col(0).norm();
}

/// int N_n over one element of dimension 1 to 3.
VectorX calc_shares(const ReferenceElement& element, const Matrix3X& x) {
  const Quadrature& rule = element.curved;
  VectorX shares = VectorX::Zero(element.node_count);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const MatrixX& gradients = rule.gradients[static_cast<std::size_t>(q)];
    const double measure =
        calc_measure(x * gradients.topRows(element.dimension).transpose());
    shares += rule.weights[q] * measure * rule.shape.col(q);
  }
  return shares;
}

void add_shares(const Mesh& mesh, const ElementBlock& block, Shares& shares) {
  for (std::size_t e = 0; e < block.size(); ++e) {
    const VectorX part =
        calc_shares(*block.element, element_positions(mesh, block, e));
    const int* nodes = block.element_nodes(e);
    for (int i = 0; i < block.element->node_count; ++i)
      shares[nodes[i]] += part[i];
  }
}

WeightedNodes normalised(const Shares& shares) {
  WeightedNodes result;
  double largest = 0.0;
  for (const auto& [node, share] : shares)
    largest = std::max(largest, std::abs(share));
  constexpr double kZero = 1e-12;  // corners of second-order triangles
  result.weights.resize(static_cast<Eigen::Index>(shares.size()));
  Eigen::Index next = 0;
  for (const auto& [node, share] : shares) {
    result.nodes.push_back(node);
    result.weights[next++] = std::abs(share) > kZero * largest ? share : 0.0;
  }
  result.weights /= result.weights.sum();
  return result;
}

/// int N_n over one face of a solid element.
VectorX calc_face_shares(const ReferenceElement& element, std::size_t face,
                         const Matrix3X& x) {
  const Quadrature& rule = element.face_rules[face];
  VectorX shares = VectorX::Zero(element.node_count);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
    shares += rule.weights[q] *
              calc_measure(
                  x * rule.gradients[static_cast<std::size_t>(q)].transpose()) *
              rule.shape.col(q);
  return shares;
}

}  // namespace

WeightedNodes weigh_group(const Mesh& mesh, const PhysicalGroup& group) {
  if (group.dimension == 0) return weigh_equally(group.nodes);
  Shares shares;
  for (const int node : group.nodes) shares[node] = 0.0;
  for (const ElementBlock& block : group.blocks)
    add_shares(mesh, block, shares);
  return normalised(shares);
}

WeightedNodes weigh_equally(std::vector<int> nodes) {
  LIMBER_EXPECT(!nodes.empty());
  std::sort(nodes.begin(), nodes.end());
  const auto count = static_cast<Eigen::Index>(nodes.size());
  return {std::move(nodes),
          VectorX::Constant(count, 1.0 / static_cast<double>(count))};
}

NearNodes find_boundary_nodes(
    const Mesh& mesh, const std::function<double(const Vector3&)>& distance,
    double tolerance) {
  NearNodes near;
  near.nearest = std::numeric_limits<double>::infinity();
  for (const int node : mesh.boundary_nodes) {
    const double d = distance(mesh.x.col(node));
    near.nearest = std::min(near.nearest, d);
    if (d <= tolerance) near.nodes.push_back(node);
  }
  return near;
}

WeightedNodes weigh_boundary(const Mesh& mesh, const std::vector<int>& nodes) {
  Shares shares;
  for (const int node : nodes) shares[node] = 0.0;
  bool has_face = false;
  for (const BoundaryFace& face : mesh.boundary_faces) {
    const std::vector<int> on_face = face_nodes(mesh, face);
    if (!std::all_of(on_face.begin(), on_face.end(),
                     [&](int node) { return shares.contains(node); }))
      continue;
    has_face = true;
    const ElementBlock& block =
        mesh.blocks[static_cast<std::size_t>(face.block)];
    const VectorX part =
        calc_face_shares(*block.element, static_cast<std::size_t>(face.face),
                         element_positions(mesh, block, face.element));
    const int* all = block.element_nodes(face.element);
    for (int i = 0; i < block.element->node_count; ++i)
      if (const auto found = shares.find(all[i]); found != shares.end())
        found->second += part[i];
  }
  return has_face ? normalised(shares) : weigh_equally(nodes);
}

int find_tagged_node(const Mesh& mesh, std::size_t tag) {
  const auto found = std::lower_bound(mesh.tags.begin(), mesh.tags.end(), tag);
  if (found != mesh.tags.end() && *found == tag)
    return static_cast<int>(found - mesh.tags.begin());
  throw InputError(fmt::format(
      "{}: no node has the tag {}. Expected the tag of a node that a solid "
      "element uses (they run from {} to {}).",
      mesh.source, tag, mesh.tags.front(), mesh.tags.back()));
}

int find_nearest_node(const Mesh& mesh, const Vector3& point) {
  Eigen::Index nearest = 0;
  (mesh.x.colwise() - point).colwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

}  // namespace limber::fem
