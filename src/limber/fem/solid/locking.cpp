// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/locking.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/solid/element_matrices.hpp"

namespace limber::fem {
namespace {

/// An edge of an element, by local corners, and the nodes of its sum S.
struct LocalEdge {
  std::array<int, 2> ends;
  std::vector<int> near;
};

std::vector<LocalEdge> find_local_edges(const ReferenceElement& element) {
  std::map<std::array<int, 2>, std::set<int>> edges;
  for (std::size_t f = 0; f < element.faces.size(); ++f) {
    const auto corners = static_cast<std::size_t>(element.face_corners[f]);
    const std::vector<int>& nodes = element.faces[f];
    for (std::size_t i = 0; i < corners; ++i) {
      const auto [a, b] = std::minmax(nodes[i], nodes[(i + 1) % corners]);
      std::set<int>& near = edges[{a, b}];
      near.insert({a, b});
      if (corners == 3) near.insert(nodes.begin(), nodes.end());
    }
  }
  std::vector<LocalEdge> list;
  for (const auto& [ends, near] : edges)
    list.push_back({ends, {near.begin(), near.end()}});
  return list;
}

/// The element's functions and then those of its edges at the points of a rule.
struct RefinedFunctions {
  MatrixX values;  ///< functions x points [-]
  ElementGradients gradients;
};

RefinedFunctions calc_functions(const ReferenceElement& element,
                                const std::vector<LocalEdge>& edges,
                                const Matrix3X& x) {
  const Quadrature& rule = element.curved;
  const Eigen::Index n = element.node_count;
  const auto count = n + static_cast<Eigen::Index>(edges.size());
  RefinedFunctions all{MatrixX(count, rule.weights.size()),
                       {{}, VectorX(rule.weights.size()), x * rule.shape}};
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const MatrixX& local = rule.gradients[static_cast<std::size_t>(q)];
    const Matrix3 jacobian = x * local.transpose();
    const Matrix3X g = jacobian.inverse().transpose() * local;
    const auto N = rule.shape.col(q);
    Matrix3X gradients(3, count);
    gradients.leftCols(n) = g;
    all.values.col(q).head(n) = N;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto [i, j] = edges[e].ends;
      double S = 0.0;
      Vector3 dS = Vector3::Zero();
      for (const int node : edges[e].near) {
        S += N[node];
        dS += g.col(node);
      }
      const double b = 4.0 * N[i] * N[j] / S;
      const Eigen::Index at = n + static_cast<Eigen::Index>(e);
      all.values(at, q) = b;
      gradients.col(at) =
          (4.0 * (N[i] * g.col(j) + N[j] * g.col(i)) - b * dS) / S;
    }
    all.gradients.at.push_back(std::move(gradients));
    all.gradients.measure[q] = rule.weights[q] * jacobian.determinant();
  }
  return all;
}

/// The functions of the edges of one element.
struct EdgeElement {
  std::vector<int> edges;  ///< indices in the mesh
  Eigen::MatrixXf K;       ///< 3 edges x 3 edges [N/m]
  Eigen::MatrixXf M;       ///< edges x edges [kg]
};

/// Values of the mode at an element's nodes, 3 x nodes.
template <typename Mode>
Matrix3X take_nodes(const Mode& mode, const int* nodes, Eigen::Index count) {
  Matrix3X values(3, count);
  for (Eigen::Index i = 0; i < count; ++i)
    values.col(i) = mode.template segment<3>(3 * Eigen::Index{nodes[i]});
  return values;
}

/// The system of the edges: K_bb, M_bb, and K_bn phi, M_bn phi, M_bn R.
class EdgeSystem {
 public:
  EdgeSystem(const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
             const LinearModes& modes)
      : modes_(modes) {
    number_edges(mesh);
    const auto size = 3 * static_cast<Eigen::Index>(edge_of_.size());
    K_Phi_ = MatrixX::Zero(size, modes.Phi.cols());
    M_Phi_ = MatrixX::Zero(size, modes.Phi.cols());
    M_R_ = MatrixX::Zero(size, modes.R.cols());
    diagonal_.resize(edge_of_.size(), Matrix3::Zero());
    for (const ElementBlock& block : mesh.blocks)
      add_block(mesh, block, materials);
    for (Matrix3& block : diagonal_) block = block.inverse().eval();
    hold_edges();
  }

  /// Rayleigh quotient of mode k with its correction.
  double refine(Eigen::Index k) const {
    const double lambda = modes_.lambda[k];
    const VectorX c = solve(lambda * M_Phi_.col(k) - K_Phi_.col(k));
    const double stiffness =
        lambda + 2.0 * c.dot(K_Phi_.col(k)) + c.dot(multiply_stiffness(c));
    const double mass = 1.0 + 2.0 * c.dot(M_Phi_.col(k)) +
                        c.dot(multiply_mass(c)) -
                        (M_R_.transpose() * c).squaredNorm();
    return stiffness / mass;
  }

 private:
  void number_edges(const Mesh& mesh) {
    for (const ElementBlock& block : mesh.blocks) {
      const std::vector<LocalEdge> edges = find_local_edges(*block.element);
      for (std::size_t e = 0; e < block.size(); ++e) {
        EdgeElement& element = elements_.emplace_back();
        for (const LocalEdge& edge : edges) {
          const int* const nodes = block.element_nodes(e);
          const std::pair<int, int> ends =
              std::minmax(nodes[edge.ends[0]], nodes[edge.ends[1]]);
          element.edges.push_back(
              edge_of_.emplace(ends, static_cast<int>(edge_of_.size()))
                  .first->second);
        }
      }
    }
  }

  void add_block(const Mesh& mesh, const ElementBlock& block,
                 const std::vector<ElasticMaterial>& materials) {
    const std::vector<LocalEdge> edges = find_local_edges(*block.element);
    for (std::size_t e = 0; e < block.size(); ++e) {
      const auto region = static_cast<std::size_t>(block.regions[e]);
      const RefinedFunctions functions = calc_functions(
          *block.element, edges, element_positions(mesh, block, e));
      add_element(functions, materials[region], block.element_nodes(e),
                  block.element->node_count, elements_[next_++]);
    }
  }

  void add_element(const RefinedFunctions& functions,
                   const ElasticMaterial& material, const int* nodes,
                   Eigen::Index n, EdgeElement& element) {
    const MatrixX K = calc_stiffness(functions.gradients, material);
    const MatrixX M =
        functions.values *
        (material.density * functions.gradients.measure).asDiagonal() *
        functions.values.transpose();
    const Eigen::Index m = K.rows() / 3 - n;
    element.K = K.bottomRightCorner(3 * m, 3 * m).cast<float>();
    element.M = M.bottomRightCorner(m, m).cast<float>();
    const auto add = [&](const Matrix3X& values, Eigen::Index column,
                         MatrixX& sums) {
      for (Eigen::Index i = 0; i < m; ++i)
        sums.col(column).segment<3>(row_of(element, i)) += values.col(i);
    };
    for (Eigen::Index k = 0; k < modes_.Phi.cols(); ++k) {
      const Matrix3X phi = take_nodes(modes_.Phi.col(k), nodes, n);
      const VectorX force = K.bottomLeftCorner(3 * m, 3 * n) * phi.reshaped();
      add(force.reshaped(3, m), k, K_Phi_);
      add(phi * M.topRightCorner(n, m), k, M_Phi_);
    }
    for (Eigen::Index k = 0; k < modes_.R.cols(); ++k)
      add(take_nodes(modes_.R.col(k), nodes, n) * M.topRightCorner(n, m), k,
          M_R_);
    for (Eigen::Index i = 0; i < m; ++i)
      diagonal_[static_cast<std::size_t>(row_of(element, i) / 3)] +=
          K.block<3, 3>(3 * (n + i), 3 * (n + i));
  }

  static Eigen::Index row_of(const EdgeElement& element, Eigen::Index i) {
    return 3 * Eigen::Index{element.edges[static_cast<std::size_t>(i)]};
  }

  /// Edges between clamped nodes do not move.
  void hold_edges() {
    const auto is_held = [&](int node) {
      return std::binary_search(modes_.held.begin(), modes_.held.end(), node);
    };
    for (const auto& [ends, edge] : edge_of_)
      if (is_held(ends.first) && is_held(ends.second))
        diagonal_[static_cast<std::size_t>(edge)].setZero();
  }

  VectorX multiply_stiffness(const VectorX& c) const {
    VectorX product = VectorX::Zero(c.size());
    for (const EdgeElement& element : elements_) {
      const auto m = static_cast<Eigen::Index>(element.edges.size());
      Eigen::VectorXf local(3 * m);
      for (Eigen::Index i = 0; i < m; ++i)
        local.segment<3>(3 * i) =
            c.segment<3>(row_of(element, i)).cast<float>();
      const Eigen::VectorXf force = element.K * local;
      for (Eigen::Index i = 0; i < m; ++i)
        product.segment<3>(row_of(element, i)) +=
            force.segment<3>(3 * i).cast<double>();
    }
    return product;
  }

  VectorX multiply_mass(const VectorX& c) const {
    VectorX product = VectorX::Zero(c.size());
    for (const EdgeElement& element : elements_)
      for (Eigen::Index i = 0; i < element.M.rows(); ++i)
        for (Eigen::Index j = 0; j < element.M.cols(); ++j)
          product.segment<3>(row_of(element, i)) +=
              static_cast<double>(element.M(i, j)) *
              c.segment<3>(row_of(element, j));
    return product;
  }

  VectorX precondition(const VectorX& residual) const {
    VectorX step(residual.size());
    for (std::size_t e = 0; e < diagonal_.size(); ++e) {
      const auto row = 3 * static_cast<Eigen::Index>(e);
      step.segment<3>(row) = diagonal_[e] * residual.segment<3>(row);
    }
    return step;
  }

  /// Conjugate gradients: the error of the energy goes with the square of the
  /// tolerance, and any end of the iteration gives an upper bound.
  VectorX solve(VectorX residual) const {
    constexpr int kMost = 200;
    constexpr double kTolerance = 1e-2;
    VectorX c = VectorX::Zero(residual.size());
    VectorX step = precondition(residual);
    double work = residual.dot(step);
    const double enough = kTolerance * kTolerance * work;
    for (int i = 0; i < kMost && work > enough; ++i) {
      const VectorX force = multiply_stiffness(step);
      const double length = work / step.dot(force);
      c += length * step;
      residual -= length * force;
      const VectorX scaled = precondition(residual);
      const double next = residual.dot(scaled);
      step = scaled + next / work * step;
      work = next;
    }
    return c;
  }

  const LinearModes& modes_;
  std::map<std::pair<int, int>, int> edge_of_;
  std::vector<EdgeElement> elements_;
  std::size_t next_ = 0;
  MatrixX K_Phi_, M_Phi_, M_R_;
  std::vector<Matrix3> diagonal_;  // inverses of K's blocks; zero where held
};

}  // namespace

VectorX calc_refined_eigenvalues(const Mesh& mesh,
                                 const std::vector<ElasticMaterial>& materials,
                                 const LinearModes& modes) {
  LIMBER_EXPECT(is_first_order(mesh));
  LIMBER_EXPECT(materials.size() == mesh.volume_groups.size());
  const EdgeSystem system(mesh, materials, modes);
  VectorX refined(modes.lambda.size());
  for (Eigen::Index k = 0; k < refined.size(); ++k)
    refined[k] = system.refine(k);
  return refined;
}

}  // namespace limber::fem
