// SPDX-License-Identifier: BSD-3-Clause
#include "fem/explicit_solid.hpp"

#include <cmath>
#include <random>
#include <utility>

#include "common/errors.hpp"

namespace limber::fem {

ExplicitSolid::ExplicitSolid(const NonlinearSolid& solid, const NodalMass& mass,
                             NodalForces forces)
    : solid_(solid),
      mass_(mass),
      forces_(std::move(forces)),
      workspace_(solid.make_workspace()),
      internal_(Matrix3X::Zero(3, solid.node_count())),
      external_(internal_),
      a_(internal_),
      next_{0.0, internal_, internal_} {}

void ExplicitSolid::accelerate(double t, const Matrix3X& u) {
  external_.setZero();
  forces_(t, external_);
  strain_energy_ = solid_.calc_force(u, internal_, workspace_);
  external_ -= internal_;
  mass_.divide(external_, a_);
}

void ExplicitSolid::start(const SolidState& state) {
  LIMBER_EXPECT(state.u.cols() == solid_.node_count() &&
                state.v.cols() == solid_.node_count());
  accelerate(state.t, state.u);
}

void ExplicitSolid::step(SolidState& state, double h, double end) {
  next_.t = end;
  next_.v = state.v + 0.5 * h * a_;
  next_.u = state.u + h * next_.v;
  accelerate(end, next_.u);
  next_.v += 0.5 * h * a_;
  std::swap(state, next_);
}

double ExplicitSolid::kinetic_energy(const SolidState& state) const {
  return 0.5 * mass_.multiply(state.v).cwiseProduct(state.v).sum();
}

double estimate_stable_step(const SparseMatrix& K_lower,
                            const NodalMass& mass) {
  constexpr double kEnough = 1e-3;
  constexpr int kMostIterations = 2000;
  const Eigen::Index nodes = K_lower.cols() / 3;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Matrix3X x = Matrix3X::NullaryExpr(3, nodes, [&] { return uniform(random); });
  Matrix3X force(3, nodes);
  double eigenvalue = 0.0;
  int settled = 0;
  for (int i = 0; i < kMostIterations && settled < 20; ++i) {
    x /= x.norm();
    Eigen::Map<VectorX>(force.data(), force.size()) =
        K_lower.selfadjointView<Eigen::Lower>() *
        Eigen::Map<const VectorX>(x.data(), x.size());
    const double next =
        x.cwiseProduct(force).sum() / x.cwiseProduct(mass.multiply(x)).sum();
    settled =
        std::abs(next - eigenvalue) < 0.01 * kEnough * next ? settled + 1 : 0;
    eigenvalue = next;
    mass.divide(force, x);
  }
  return 2.0 / std::sqrt(eigenvalue);
}

}  // namespace limber::fem
