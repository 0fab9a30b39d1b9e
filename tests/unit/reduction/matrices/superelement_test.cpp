// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/integrators/energy_conserving.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/fem/matrices/read_matrices.hpp"
#include "limber/reduction/matrices/reduce_matrices.hpp"
#include "places.hpp"
#include "unit/reduction/matrices/mass_points.hpp"

/// Superelements of a curved beam whose mass is that of known points: what is
/// exact, what recovery rows and second moments give, what is refused.
namespace limber::flexbody::matrices_test {
namespace {

using dynamics::Fidelity;
using ::testing::HasSubstr;
using BodyPointer = std::shared_ptr<const ReducedBody>;

constexpr std::size_t kFirstPoint = 100;  // tag

/// The stiffness of the arch, and points about its nodes.
struct Arch {
  Arch() {
    const fem::MatrixModel read =
        fem::read_matrices({{LIMBER_SOURCE_DIR "/tests/data/matrices/arch"}});
    K = read.stiffness.entries;
    points.x = read.x;
    Draw draw;
    for (int n = 0; n < read.x.cols(); ++n)
      for (int i = 0; i < 6; ++i)
        points.points.push_back({0.1 + 0.05 * std::abs(draw()),
                                 {n},
                                 {1.0},
                                 {0.03 * draw.vector()}});
  }
  MatrixX K;
  PointModel points;
};

/// Craig and Bampton's reduction to some nodes and modes; none: Guyan's.
struct Superelement {
  Superelement(const Arch& arch, const std::vector<int>& boundary, int modes) {
    const MatrixX whole = arch.points.mass_matrix();
    std::vector<int> b;
    std::vector<int> inner;
    for (int i = 0; i < arch.K.rows(); ++i)
      (std::count(boundary.begin(), boundary.end(), i / 6) > 0 ? b : inner)
          .push_back(i);
    const MatrixX K_ii = arch.K(inner, inner);
    const Eigen::Index n = std::ssize(b) + modes;
    T = MatrixX::Zero(arch.K.rows(), n);
    for (std::size_t i = 0; i < b.size(); ++i)
      T(b[i], static_cast<Eigen::Index>(i)) = 1.0;
    MatrixX moved(std::ssize(inner), n);
    moved << -dense::solve(K_ii, MatrixX(arch.K(inner, b))),
        dense::find_eigenpairs(K_ii, MatrixX(whole(inner, inner)))
            .vectors.leftCols(modes);
    for (std::size_t i = 0; i < inner.size(); ++i)
      T.row(inner[i]) = moved.row(static_cast<Eigen::Index>(i));
    K = T.transpose() * arch.K * T;
    M = T.transpose() * whole * T;
    K = 0.5 * (K + K.transpose()).eval();
    M = 0.5 * (M + M.transpose()).eval();
    Matrix3X x(3, std::ssize(boundary));
    for (std::size_t i = 0; i < boundary.size(); ++i)
      x.col(static_cast<Eigen::Index>(i)) = arch.points.x.col(boundary[i]);
    model.source = "arm";
    model.x = x;
    for (std::size_t i = 0; i < boundary.size(); ++i) {
      model.tags.push_back(i + 1);
      for (int c = 0; c < 6; ++c)
        model.rows.push_back({static_cast<int>(i), c});
    }
    for (int k = 0; k < modes; ++k) model.rows.push_back({-1, -1});
    model.stiffness = {"arm/K.mtx", K.sparseView(), 17};
    model.mass = {"arm/M.mtx", this->M.sparseView(), 17};
  }

  /// Recovery rows of points.
  void recover(const Arch& arch, const std::vector<MassPoint>& points) {
    const Eigen::Index first = model.x.cols();
    model.x.conservativeResize(3, first + std::ssize(points));
    MatrixX rows(3 * std::ssize(points), T.cols());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      model.x.col(first + at) = arch.points.place(points[i]);
      model.tags.push_back(kFirstPoint + i);
      rows.middleRows<3>(3 * at) = arch.points.field(points[i]) * T;
      for (int c = 0; c < 3; ++c)
        model.condensed.push_back({static_cast<int>(first + at), c});
    }
    model.equations = rows.sparseView();
    model.has_recovery = true;
  }

  void integrate(const Arch& arch) {
    constexpr std::array<std::array<int, 2>, 6> kPlaces = {
        {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
    for (std::size_t p = 0; p < 6; ++p) {
      MatrixX S = MatrixX::Zero(T.cols(), T.cols());
      for (const MassPoint& point : arch.points.points) {
        const MatrixX F = arch.points.field(point) * T;
        S += point.m * F.row(kPlaces[p][0]).transpose() * F.row(kPlaces[p][1]);
      }
      model.moments[p] = S.sparseView();
    }
  }

  MatrixX T;
  MatrixX K;
  MatrixX M;
  fem::MatrixModel model;
};

Recipe make_arm_recipe(int modes = 8) {
  Recipe recipe;
  recipe.name = "arm";
  recipe.basis.eigenmodes = modes;
  recipe.rows = parse_rows({"all"});
  return recipe;
}

ReducedBody reduce_arm(const Arch& arch, const Superelement& arm,
                       int modes = 8) {
  return reduce_matrices(make_arm_recipe(modes),
                         make_matrix_part(arm.model, arch.points.mass(), 1.0));
}

/// S1 and S2 as sums over the arch's points, which the body recovers.
InertiaShapeIntegrals sum_recovered(const Arch& arch, const ReducedBody& body) {
  const auto m = static_cast<std::size_t>(body.mode_count());
  InertiaShapeIntegrals sums;
  sums.S1.assign(m, Matrix3::Zero());
  sums.S2.assign(m * m, Matrix3::Zero());
  for (std::size_t i = 0; i < body.rows.tags.size(); ++i) {
    if (body.rows.tags[i] < kFirstPoint) continue;
    const double mass = arch.points.points[body.rows.tags[i] - kFirstPoint].m;
    const auto at = static_cast<Eigen::Index>(i);
    const Vector3 x = body.rows.x_B.col(at);
    const MatrixX u = body.rows.Phi_B.middleRows<3>(3 * at);
    for (std::size_t k = 0; k < m; ++k) {
      const Vector3 u_k = u.col(static_cast<Eigen::Index>(k));
      sums.S1[k] += mass * x * u_k.transpose();
      for (std::size_t l = 0; l < m; ++l)
        sums.S2[k * m + l] +=
            mass * u_k * u.col(static_cast<Eigen::Index>(l)).transpose();
    }
  }
  return sums;
}

double compare(const std::vector<Matrix3>& found,
               const std::vector<Matrix3>& expected) {
  double largest = 0.0;
  double difference = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    largest = std::max(largest, expected[k].cwiseAbs().maxCoeff());
    difference =
        std::max(difference, (found[k] - expected[k]).cwiseAbs().maxCoeff());
  }
  return difference / largest;
}

dynamics::SystemState tumble(const BodyPointer& body) {
  dynamics::SystemBuilder builder;
  builder.add_flexible_body("arm", body, Fidelity::coupled, {});
  const dynamics::SystemModel model = builder.build();
  dynamics::SystemState state = dynamics::make_state(model);
  state.bodies.front().w_WB_B = Vector3(3.0, 20.0, 8.0);
  double sign = 1.0;
  for (double& rate : state.etadot) rate = (sign *= -0.7);
  dynamics::EnergyConserving scheme(model, {});
  constexpr double kStep = 1e-4;
  for (int i = 1; i <= 300; ++i) scheme.step(state, kStep, i * kStep);
  return state;
}

TEST(Superelement, HasTheMassAndFrequenciesOfItsMatrices) {
  const Arch arch;
  const Superelement arm(arch, {0, 12}, 8);
  const ReducedBody body = reduce_arm(arch, arm);
  EXPECT_NEAR(body.mass, arch.points.mass(), 1e-11 * body.mass);
  EXPECT_LT((body.p_MoBcm_M - arch.points.center()).norm(), 1e-11);
  const Matrix3 S0 = arch.points.sum(MatrixX(arch.K.rows(), 0)).S0;
  EXPECT_LT((body.integrals.S0 - S0).cwiseAbs().maxCoeff(), 1e-10 * S0.trace());
  const VectorX lambda = dense::find_eigenpairs(arm.K, arm.M).values;
  for (Eigen::Index k = 0; k < 8; ++k)
    EXPECT_NEAR(body.lambda[k], lambda[6 + k], 1e-8 * lambda[6 + k]) << k;
}

TEST(Superelement, WithoutRecoveryRowsIsRefusedAboveUncoupled) {
  const Arch arch;
  for (const int modes : {8, 0}) {
    const Superelement arm(arch, {0, 12}, modes);
    const auto body =
        std::make_shared<const ReducedBody>(reduce_arm(arch, arm, 4));
    EXPECT_THAT(body->inertia_record.gap, HasSubstr("--recovery"));
    for (const Fidelity level : {Fidelity::rigid, Fidelity::uncoupled})
      EXPECT_NO_THROW(
          dynamics::SystemBuilder().add_flexible_body("arm", body, level, {}));
    for (const Fidelity level : {Fidelity::one_way, Fidelity::coupled}) {
      try {
        dynamics::SystemBuilder().add_flexible_body("arm", body, level, {});
        FAIL();
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("choose level uncoupled"));
        EXPECT_THAT(error.what(), HasSubstr(modes > 0 ? "rows without a node"
                                                      : "condensed (Guyan)"));
      }
    }
  }
}

TEST(Superelement, WithRecoveredPointsMovesAsTheirMass) {
  const Arch arch;
  for (const int modes : {8, 0}) {  // also Guyan's
    Superelement arm(
        arch,
        modes > 0 ? std::vector<int>{0, 12} : std::vector<int>{0, 4, 8, 12},
        modes);
    arm.recover(arch, arch.points.points);
    ReducedBody body = reduce_arm(arch, arm);
    EXPECT_TRUE(body.inertia_record.gap.empty()) << body.inertia_record.gap;
    EXPECT_TRUE(body.inertia_record.notice.empty());
    const InertiaShapeIntegrals exact = sum_recovered(arch, body);
    EXPECT_LT(compare(body.integrals.S1, exact.S1), 1e-6) << modes;
    EXPECT_LT(compare(body.integrals.S2, exact.S2), 1e-6) << modes;
    const dynamics::SystemState found =
        tumble(std::make_shared<const ReducedBody>(body));
    body.integrals.S1 = exact.S1;
    body.integrals.S2 = exact.S2;
    const dynamics::SystemState expected =
        tumble(std::make_shared<const ReducedBody>(body));
    EXPECT_LT((found.eta - expected.eta).norm(), 1e-8 * expected.eta.norm());
    EXPECT_LT((found.bodies[0].w_WB_B - expected.bodies[0].w_WB_B).norm(),
              1e-9 * expected.bodies[0].w_WB_B.norm());
  }
}

/// Points on the axis do not turn with it.
TEST(Superelement, WithPointsOnItsAxisIsRefusedAboveUncoupled) {
  const Arch arch;
  Superelement arm(arch, {0, 12}, 8);
  std::vector<MassPoint> axis;
  for (int n = 0; n < 13; ++n)
    axis.push_back({0.0, {n}, {1.0}, {Vector3::Zero()}});
  arm.recover(arch, axis);
  const ReducedBody body = reduce_arm(arch, arm);
  EXPECT_THAT(body.inertia_record.gap, HasSubstr("residual"));
}

TEST(Superelement, WithSecondMomentsHasExactIntegrals) {
  const Arch arch;
  Superelement arm(arch, {0, 12}, 8);
  arm.recover(arch, arch.points.points);
  arm.integrate(arch);
  const ReducedBody body = reduce_arm(arch, arm);
  EXPECT_TRUE(body.inertia_record.gap.empty());
  const InertiaShapeIntegrals exact = sum_recovered(arch, body);
  EXPECT_LT(compare(body.integrals.S1, exact.S1), 1e-10);
  EXPECT_LT(compare(body.integrals.S2, exact.S2), 1e-10);
}

/// With all nodes in the model the nodes' blocks say all.
TEST(Superelement, WithAllNodesNeedsNoFit) {
  const Arch arch;
  const fem::MatrixModel whole =
      make_model(arch.points.x, arch.K, arch.points.mass_matrix());
  const ReducedBody body = reduce_matrices(
      make_arm_recipe(), make_matrix_part(whole, arch.points.mass(), 1.0));
  EXPECT_TRUE(body.inertia_record.gap.empty());
  EXPECT_TRUE(body.inertia_record.notice.empty());
}

}  // namespace
}  // namespace limber::flexbody::matrices_test
