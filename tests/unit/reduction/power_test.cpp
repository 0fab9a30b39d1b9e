// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/power.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"
#include "limber/flexbody/modal/modal_response.hpp"
#include "limber/reduction/departure.hpp"
#include "unit/reduction/bar.hpp"

namespace limber::flexbody::power_test {
namespace {

using testing::Bar;
using testing::make_recipe;

/// Random loads, and random motions with M v' + D v + K x = F, of a bar.
class Power : public ::testing::TestWithParam<bool> {
 protected:
  [[nodiscard]] VectorX draw() {
    std::normal_distribution<double> normal;
    return VectorX::NullaryExpr(M_.cols(), [&] { return normal(random_); });
  }
  [[nodiscard]] VectorX draw_deformation() {
    return body_.inverse.project_motion(draw());
  }

  /// All terms of the equations of motion of one order of magnitude.
  [[nodiscard]] BodyMotion draw_motion() {
    const MatrixX& R = body_.support.R;
    const auto rigid = [&] { return VectorX(R * (R.transpose() * draw())); };
    const double mass = M_.diagonal().mean();
    return {rigid(), rigid(), draw_deformation() * mass / K_.diagonal().mean(),
            draw_deformation(), draw_deformation()};
  }
  /// The load required for a motion, by dense matrices.
  [[nodiscard]] VectorX find_load(const BodyMotion& motion,
                                  const Friction& friction) const {
    const VectorX v = motion.qdot + motion.xdot;
    const VectorX Dv = multiply_damping(body_, friction, v);
    return M_ * (motion.qddot + motion.xddot) + Dv + K_ * motion.x;
  }

  Bar bar_{.is_clamped = GetParam()};
  MeshedBody body_{make_recipe(bar_), {}};
  MatrixX K_ = testing::dense_stiffness(body_);
  MatrixX M_ = testing::kron(body_.support.matrices.M_s, Matrix3::Identity());
  std::mt19937 random_{7};
};
INSTANTIATE_TEST_SUITE_P(Support, Power, ::testing::Bool(), [](const auto& p) {
  return p.param ? "Clamped" : "Free";
});

constexpr double kRoundoff = 1e-13;

double sum_sizes(const PowerBalance& power) {
  return std::abs(power.into_motion) + std::abs(power.into_deformation) +
         std::abs(power.rigid) + std::abs(power.swing) +
         std::abs(power.elastic) + std::abs(power.rigid_friction) +
         std::abs(power.internal_friction);
}

TEST_P(Power, PartsOfALoadDoNoWorkOnEachOthersMotion) {
  for (int i = 0; i < 10; ++i) {
    const VectorX F = draw();
    const LoadSplit split = split_load(body_, F);
    const VectorX parallel = split.parallel;
    const VectorX perpendicular = split.perpendicular;
    EXPECT_LT((parallel + perpendicular - F).norm(), kRoundoff * F.norm());
    const VectorX x = draw_deformation();
    EXPECT_LT(std::abs(parallel.dot(x)), kRoundoff * F.norm() * x.norm());
    if (GetParam()) {
      EXPECT_EQ(parallel.norm(), 0.0);
      continue;
    }
    const MatrixX rigid = testing::rigid_motions(body_.mesh.x);
    const VectorX q = rigid * Vector6::NullaryExpr([&](Eigen::Index k) {
                        return std::cos(static_cast<double>(k + i));
                      });
    EXPECT_LT(std::abs(perpendicular.dot(q)), kRoundoff * F.norm() * q.norm());
    // M q_f with the rigid acceleration q_f that Newton and Euler give to F.
    const VectorX c = dense::solve(MatrixX(rigid.transpose() * M_ * rigid),
                                   VectorX(rigid.transpose() * F));
    EXPECT_LT((parallel - M_ * rigid * c).norm(), 1e-11 * F.norm());
  }
}

TEST_P(Power, TermsSumToThePowerOfTheLoad) {
  const Friction friction{
      .mass_rate = 1.0,
      .stiffness_time = M_.diagonal().mean() / K_.diagonal().mean(),
      .surface = 1.0};
  for (int i = 0; i < 10; ++i) {
    const BodyMotion motion = draw_motion();
    const VectorX F = find_load(motion, friction);
    const PowerBalance power = calc_power(body_, F, motion, friction);
    const double size = sum_sizes(power);
    EXPECT_NEAR(power.supplied(), F.dot(motion.qdot + motion.xdot),
                kRoundoff * size);
    EXPECT_NEAR(power.residual(), 0.0, kRoundoff * size);
    EXPECT_GT(power.dissipated(), 0.0);
  }
}

/// The memo's last equation: x' F_intern, F_intern = M q'' + D q', is the work
/// of drag alone, because M q'' is orthogonal to x'.
TEST_P(Power, InstantaneousDeformationTakesWorkOfTheInternalForce) {
  const Friction friction{.mass_rate = 1.0, .surface = 1.0};
  BodyMotion motion = draw_motion();
  motion.xddot.setZero();
  const VectorX F = find_load(motion, friction);
  const VectorX Dq = multiply_damping(body_, friction, motion.qdot);
  const VectorX Dx = multiply_damping(body_, friction, motion.xdot);
  const VectorX Mq = M_ * motion.qddot;
  const double internal = motion.xdot.dot(Mq + Dq);
  EXPECT_NEAR(motion.xdot.dot(Mq), 0.0,
              kRoundoff * motion.xdot.norm() * Mq.norm());
  const PowerBalance power = calc_power(body_, F, motion, friction);
  // The memo neglects D x'.
  EXPECT_NEAR((F - Dx).dot(motion.qdot + motion.xdot),
              power.rigid + power.elastic + internal + power.rigid_friction,
              kRoundoff * sum_sizes(power));
}

TEST_P(Power, StaticStateStoresHalfTheWorkOfItsDeformingLoad) {
  const Matrix3X load = testing::make_load(body_);
  const OperatingState state = find_accelerating_state(body_, load);
  const std::vector<int>& nodes = body_.support.free_nodes;
  const VectorX x = take_rows(state.u.reshaped(), nodes);
  const VectorX F = take_rows(load.reshaped(), nodes);
  const VectorX zero = VectorX::Zero(x.size());
  const BodyEnergy energy = calc_energy(body_, {zero, zero, x, zero, zero});
  EXPECT_EQ(energy.rigid + energy.swing, 0.0);
  EXPECT_NEAR(energy.elastic, state.strain_energy, 1e-12 * energy.elastic);
  EXPECT_NEAR(energy.elastic,
              0.5 * split_load(body_, F).perpendicular.col(0).dot(x),
              1e-10 * energy.elastic);
}

/// A departure from rest under a held load, exact in time: the load's work,
/// F^T (q + x), is the energy, and its power what the three energies gain.
TEST_P(Power, EnergyOfADepartureIsTheWorkOfItsLoad) {
  const Matrix3X load = testing::make_load(body_);
  const DepartureModel model = make_departure_model(body_, load.reshaped(), 4);
  const MatrixX& Phi = model.basis.Phi;
  const MatrixX& R = body_.support.R;
  const VectorX F = take_rows(load.reshaped(), body_.support.free_nodes);
  const VectorX acceleration = R * (R.transpose() * F);
  const ModalResponse response(
      model.basis.lambda, VectorX::Zero(model.basis.lambda.size()),
      {.steps = {{0.0}, model.Q}, .sinusoids = {}}, {});
  for (const double phase : {0.1, 1.0, 2.5, 20.0}) {
    const double t = phase / std::sqrt(model.basis.lambda[0]);
    const ModalHistory at = response.evaluate({t});
    const VectorX r = at.eta.col(0);
    const VectorX rddot = model.Q - model.basis.lambda.cwiseProduct(r);
    const BodyMotion motion{t * acceleration, acceleration, Phi * r,
                            Phi * at.etadot.col(0), Phi * rddot};
    const double work = F.dot(0.5 * t * t * acceleration + motion.x);
    EXPECT_NEAR(calc_energy(body_, motion).total(), work, 1e-10 * work);
    const PowerBalance power = calc_power(body_, F, motion);
    EXPECT_NEAR(power.residual(), 0.0, 1e-10 * sum_sizes(power));
    EXPECT_EQ(power.dissipated(), 0.0);
  }
}

/// A departure beside rigid motion: the model has no x'^T D q'.
TEST_P(Power, PowerOfADepartureClosesUnderRayleighDampingAndNotUnderDrag) {
  const Matrix3X load = testing::make_load(body_);
  const VectorX F = take_rows(load.reshaped(), body_.support.free_nodes);
  const MatrixX& R = body_.support.R;
  const auto find_power = [&](const Friction& friction) {
    const DepartureModel model =
        make_departure_model(body_, load.reshaped(), 3, friction);
    const MatrixX& Phi = model.basis.Phi;
    const VectorX& lambda = model.basis.lambda;
    const VectorX r = 0.5 * model.calc_static();
    const VectorX rdot = lambda.cwiseSqrt().cwiseProduct(r);
    const VectorX rddot = model.Q - model.C * rdot - lambda.cwiseProduct(r);
    const VectorX qdot = R * VectorX::Constant(R.cols(), rdot.norm());
    const VectorX Dq = multiply_damping(body_, friction, qdot);
    return calc_power(body_, F,
                      {qdot, R * (R.transpose() * (F - Dq)), Phi * r,
                       Phi * rdot, Phi * rddot},
                      friction);
  };
  const PowerBalance rayleigh =
      find_power({.mass_rate = 50.0, .stiffness_time = 1e-5});
  EXPECT_GT(rayleigh.dissipated(), 1e-3 * sum_sizes(rayleigh));
  EXPECT_NEAR(rayleigh.residual(), 0.0, 1e-10 * sum_sizes(rayleigh));
  const PowerBalance drag = find_power({.surface = 1e5});
  if (GetParam())
    EXPECT_NEAR(drag.residual(), 0.0, 1e-10 * sum_sizes(drag));
  else
    EXPECT_GT(std::abs(drag.residual()), 1e-6 * sum_sizes(drag));
}

TEST_P(Power, RefusesALoadThatIsNotFinite) {
  VectorX F = draw();
  F[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)split_load(body_, F), InputError);
}

}  // namespace
}  // namespace limber::flexbody::power_test
