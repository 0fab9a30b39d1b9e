// SPDX-License-Identifier: BSD-3-Clause
#include "support/spring_network.hpp"

#include <fmt/format.h>

#include <Eigen/Sparse>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/flexbody/model/shape_integrals.hpp"

namespace limber::testing {
namespace {

class SpringSolver : public flexbody::FullBodySolver {
 public:
  explicit SpringSolver(std::shared_ptr<const SpringNetwork> network)
      : network_(std::move(network)),
        free_(network_->free_dofs()),
        free_mass_(network_->mass()(free_, free_)) {}

  double calc_internal_force(ConstField u, Field force) override {
    return network_->calc_force(u, force);
  }
  void multiply_mass(ConstField a, Field force) const override {
    force = a * network_->M_s;
  }
  void divide_mass(ConstField force, Field a) const override {
    const VectorX all = force.reshaped();
    const VectorX answer = free_mass_.solve(VectorX(all(free_)));
    a.setZero();
    a.reshaped()(free_) = answer;
  }
  void factor(ConstField u, double c) override {
    const MatrixX A = c * network_->mass() + network_->calc_tangent(u);
    factor_.compute(A(free_, free_));
    if (factor_.info() != Eigen::Success) {
      throw NumericalError("the tangent is not positive definite");
    }
  }
  void solve(Eigen::Ref<MatrixX> x) const override {
    const MatrixX answer = factor_.solve(MatrixX(x(free_, Eigen::all)));
    x.setZero();
    for (Eigen::Index i = 0; i < answer.rows(); ++i) {
      x.row(free_[static_cast<std::size_t>(i)]) = answer.row(i);
    }
  }

 private:
  std::shared_ptr<const SpringNetwork> network_;
  std::vector<Eigen::Index> free_;
  Eigen::LLT<MatrixX> free_mass_;
  Eigen::LLT<MatrixX> factor_;
};

flexbody::NodeSet make_set(const Matrix3X& x_B, const std::string& name,
                           std::vector<int> nodes) {
  VectorX weights(std::ssize(nodes));
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    weights[i] = 1.0 + 0.2 * static_cast<double>(i);
  }
  weights /= weights.sum();
  const Matrix3X x = x_B(Eigen::all, nodes);
  const Vector3 mean = x * weights;
  return {name, std::move(nodes), weights,
          (x.colwise() - mean) * weights.asDiagonal()};
}

}  // namespace

std::vector<Eigen::Index> SpringNetwork::free_dofs() const {
  std::vector<Eigen::Index> dofs;
  for (Eigen::Index i = 0; i < 3 * size(); ++i) {
    if (held[static_cast<std::size_t>(i / 3)] == 0) dofs.push_back(i);
  }
  return dofs;
}

MatrixX SpringNetwork::mass() const {
  MatrixX M = MatrixX::Zero(3 * size(), 3 * size());
  for (int i = 0; i < size(); ++i) {
    for (int j = 0; j < size(); ++j) {
      M.block<3, 3>(3 * i, 3 * j) = M_s(i, j) * Matrix3::Identity();
    }
  }
  return M;
}

double SpringNetwork::calc_force(const Eigen::Ref<const Matrix3X>& u,
                                 Eigen::Ref<Matrix3X> force) const {
  force.setZero();
  double energy = 0.0;
  for (const Spring& s : springs) {
    const Vector3 D = x_B.col(s.b) - x_B.col(s.a);
    const Vector3 e = u.col(s.b) - u.col(s.a);
    const Vector3 d = D + e;
    const double L2 = D.squaredNorm();
    if (d.squaredNorm() < least_stretch * least_stretch * L2) {
      throw NumericalError(fmt::format("spring {}-{} is inside out", s.a, s.b));
    }
    const double strain = (D.dot(e) + 0.5 * e.squaredNorm()) / L2;
    energy += 0.5 * s.stiffness * L2 * strain * strain;
    const Vector3 pull = s.stiffness * strain * d;
    force.col(s.b) += pull;
    force.col(s.a) -= pull;
  }
  return energy;
}

MatrixX SpringNetwork::calc_tangent(const Eigen::Ref<const Matrix3X>& u) const {
  MatrixX K = MatrixX::Zero(3 * size(), 3 * size());
  for (const Spring& s : springs) {
    const Vector3 D = x_B.col(s.b) - x_B.col(s.a);
    const Vector3 d = D + u.col(s.b) - u.col(s.a);
    const double L2 = D.squaredNorm();
    const double strain = 0.5 * (d.squaredNorm() / L2 - 1.0);
    const Matrix3 k =
        s.stiffness * (strain * Matrix3::Identity() + d * d.transpose() / L2);
    for (const int i : {s.a, s.b}) {
      for (const int j : {s.a, s.b}) {
        K.block<3, 3>(3 * i, 3 * j) += i == j ? k : Matrix3(-k);
      }
    }
  }
  return K;
}

SpringNetwork make_lattice(const LatticeOptions& options) {
  SpringNetwork network;
  const int n = 4 * options.layers;
  network.x_B.resize(3, n);
  for (int i = 0; i < n; ++i) {
    const int layer = i / 4;
    network.x_B.col(i) = options.edge * Vector3(i % 2, (i / 2) % 2, layer);
  }
  network.M_s = MatrixX::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    network.M_s(i, i) = 1.0 + 0.3 * std::sin(2.0 * i);
    for (int j = 0; j < i; ++j) {
      if (i / 4 - j / 4 > 1) continue;
      network.springs.push_back(
          {j, i, options.stiffness * (1.0 + 0.4 * std::cos(3.0 * i + j))});
      // A bar's consistent mass.
      network.M_s(i, i) += 0.1;
      network.M_s(j, j) += 0.1;
      network.M_s(i, j) += 0.05;
      network.M_s(j, i) += 0.05;
    }
  }
  network.M_s *= options.mass / network.M_s.sum();
  const Vector3 center = network.x_B * network.node_mass() / options.mass;
  network.x_B.colwise() -= center;
  network.held.assign(static_cast<std::size_t>(n), 0);
  for (std::size_t i = 0; i < 4 && options.is_clamped; ++i) {
    network.held[i] = 1;
  }
  return network;
}

std::shared_ptr<const flexbody::FullBody> make_full(
    const SpringNetwork& network) {
  auto body = std::make_shared<flexbody::FullBody>();
  body->x_B = network.x_B;
  body->node_mass = network.node_mass();
  const Vector3 center = network.x_B * body->node_mass / body->node_mass.sum();
  body->first_moment = (network.x_B.colwise() - center) * network.M_s;
  body->held = network.held;
  const int n = network.size();
  body->interfaces = {make_set(body->x_B, "first", {0, 1, 2, 3}),
                      make_set(body->x_B, "last", {n - 4, n - 3, n - 2, n - 1}),
                      make_set(body->x_B, "edge", {1, 5, 9}),
                      make_set(body->x_B, "node", {n - 1}),
                      make_set(body->x_B, "block", {0, 1, 2, 3, 4, 5, 6, 7})};
  const auto shared = std::make_shared<const SpringNetwork>(network);
  body->make_solver = [shared] {
    return std::make_unique<SpringSolver>(shared);
  };
  return body;
}

std::shared_ptr<const flexbody::ReducedBody> make_reduced(
    const SpringNetwork& network, int modes) {
  const std::vector<Eigen::Index> free = network.free_dofs();
  const Eigen::Index n = network.size();
  const MatrixX K = network.calc_tangent(Matrix3X::Zero(3, n));
  const MatrixX M = network.mass();
  const dense::Eigenpairs eigen =
      dense::find_eigenpairs(K(free, free), M(free, free));
  auto body = std::make_shared<flexbody::ReducedBody>();
  body->name = "lattice";
  body->clamped = std::ssize(free) < 3 * n;
  const Eigen::Index rigid = body->clamped ? 0 : 6;
  body->mass = network.M_s.sum();
  body->size =
      network.x_B.rowwise().maxCoeff() - network.x_B.rowwise().minCoeff();
  body->lambda = eigen.values.segment(rigid, modes);
  MatrixX Phi = MatrixX::Zero(3 * n, modes);
  for (std::size_t i = 0; i < free.size(); ++i) {
    Phi.row(free[i]) =
        eigen.vectors.row(static_cast<Eigen::Index>(i)).segment(rigid, modes);
  }
  body->rows.x_B = network.x_B;
  body->rows.Phi_B = Phi;
  for (Eigen::Index i = 0; i < n; ++i) {
    body->rows.tags.push_back(static_cast<std::size_t>(i) + 1);
  }
  const Eigen::SparseMatrix<double> M_s = network.M_s.sparseView();
  body->integrals = flexbody::calc_shape_integrals(M_s, network.x_B, Phi);
  return body;
}

}  // namespace limber::testing
