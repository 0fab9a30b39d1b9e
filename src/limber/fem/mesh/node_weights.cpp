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

/// int N dA of a node, and int N x dA.
struct Contribution {
  double area = 0.0;
  Vector3 moment = Vector3::Zero();
};

using Contributions = std::map<int, Contribution>;
using Tangents = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Normal of a face, as long as its area ratio.
Vector3 calc_normal(const Tangents& tangents) {
  return Vector3(tangents.col(0)).cross(Vector3(tangents.col(1)));
}

/// Length, area or volume ratio of a map with these tangents.
double calc_measure(const Tangents& tangents) {
  if (tangents.cols() == 3) return Matrix3(tangents).determinant();
  if (tangents.cols() == 2) return calc_normal(tangents).norm();
  return tangents.col(0).norm();
}

/// Adds one element's, or one of its faces', to those nodes that are in
/// `contributions`.
/// @param dimension of what is integrated over @param x of all its nodes
/// @param measure of a map's tangents: length, area, volume, or part of it
template <typename Measure>
void add_contributions(const Quadrature& rule, int dimension, const Matrix3X& x,
                       const int* nodes, const Measure& measure,
                       Contributions& contributions) {
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const MatrixX& gradients = rule.gradients[static_cast<std::size_t>(q)];
    const Tangents tangents = x * gradients.topRows(dimension).transpose();
    const double area = rule.weights[q] * measure(tangents);
    const VectorX shape = rule.shape.col(q);
    const Vector3 place = x * shape;
    for (Eigen::Index i = 0; i < shape.size(); ++i) {
      const auto found = contributions.find(nodes[i]);
      if (found == contributions.end()) continue;
      found->second.area += area * shape[i];
      found->second.moment += area * shape[i] * place;
    }
  }
}

template <typename Measure>
void add_face(const Mesh& mesh, const BoundaryFace& face,
              const Measure& measure, Contributions& contributions) {
  const ElementBlock& block = mesh.blocks[static_cast<std::size_t>(face.block)];
  add_contributions(
      block.element->face_rules[static_cast<std::size_t>(face.face)], 2,
      element_positions(mesh, block, face.element),
      block.element_nodes(face.element), measure, contributions);
}

/// int n dA over faces [m^2].
Vector3 calc_projected_area(const Mesh& mesh,
                            const std::vector<BoundaryFace>& faces) {
  Vector3 area = Vector3::Zero();
  for (const BoundaryFace& face : faces) {
    const ElementBlock& block =
        mesh.blocks[static_cast<std::size_t>(face.block)];
    const Quadrature& rule =
        block.element->face_rules[static_cast<std::size_t>(face.face)];
    const Matrix3X x = element_positions(mesh, block, face.element);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      area += rule.weights[q] *
              calc_normal(
                  x * rule.gradients[static_cast<std::size_t>(q)].transpose());
    }
  }
  return area;
}

/// Weights of integrals over the region.
WeightedNodes normalised(const Mesh& mesh, const Contributions& contributions) {
  double total = 0.0;
  double largest = 0.0;
  for (const auto& [node, contribution] : contributions) {
    total += contribution.area;
    largest = std::max(largest, std::abs(contribution.area));
  }
  constexpr double kZero = 1e-12;  // corners of second-order triangles
  const auto count = static_cast<Eigen::Index>(contributions.size());
  WeightedNodes result{{}, VectorX(count), Matrix3X(3, count)};
  Eigen::Index next = 0;
  for (const auto& [node, contribution] : contributions) {
    result.nodes.push_back(node);
    const bool is_zero = std::abs(contribution.area) <= kZero * largest;
    result.weights[next] = is_zero ? 0.0 : contribution.area / total;
    result.moments.col(next++) = contribution.moment / total;
  }
  result.weights /= result.weights.sum();
  const Vector3 mean = mesh.x(Eigen::all, result.nodes) * result.weights;
  result.moments -= mean * result.weights.transpose();
  return result;
}

}  // namespace

WeightedNodes weigh_group(const Mesh& mesh, const PhysicalGroup& group) {
  if (group.dimension == 0) return weigh_equally(mesh, group.nodes);
  Contributions contributions;
  for (const int node : group.nodes) contributions[node] = {};
  for (const ElementBlock& block : group.blocks) {
    for (std::size_t e = 0; e < block.size(); ++e) {
      add_contributions(block.element->curved, block.element->dimension,
                        element_positions(mesh, block, e),
                        block.element_nodes(e), calc_measure, contributions);
    }
  }
  return normalised(mesh, contributions);
}

WeightedNodes weigh_equally(const Mesh& mesh, std::vector<int> nodes) {
  LIMBER_EXPECT(!nodes.empty());
  std::sort(nodes.begin(), nodes.end());
  const auto count = static_cast<Eigen::Index>(nodes.size());
  const double weight = 1.0 / static_cast<double>(count);
  const Matrix3X x = mesh.x(Eigen::all, nodes);
  return {std::move(nodes), VectorX::Constant(count, weight),
          weight * (x.colwise() - Vector3(x.rowwise().mean()))};
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
  Contributions contributions;
  for (const int node : nodes) contributions[node] = {};
  bool has_face = false;
  for (const BoundaryFace& face : mesh.boundary_faces) {
    const std::vector<int> on_face = face_nodes(mesh, face);
    if (!std::all_of(on_face.begin(), on_face.end(),
                     [&](int node) { return contributions.contains(node); }))
      continue;
    has_face = true;
    add_face(mesh, face, calc_measure, contributions);
  }
  return has_face ? normalised(mesh, contributions)
                  : weigh_equally(mesh, nodes);
}

WeightedNodes weigh_cut(const Mesh& mesh,
                        const std::vector<BoundaryFace>& faces) {
  const Vector3 along = calc_projected_area(mesh, faces).normalized();
  Contributions contributions;
  for (const BoundaryFace& face : faces) {
    for (const int node : face_nodes(mesh, face)) contributions[node] = {};
  }
  for (const BoundaryFace& face : faces) {
    add_face(
        mesh, face,
        [&](const Tangents& tangents) {
          return calc_normal(tangents).dot(along);
        },
        contributions);
  }
  WeightedNodes cut = normalised(mesh, contributions);
  cut.moments -= along * (along.transpose() * cut.moments);
  return cut;
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
