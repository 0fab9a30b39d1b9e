// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/operating_states.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "limber/common/errors.hpp"
#include "unit/reduction/bar.hpp"

namespace limber::flexbody::operating_states_test {
namespace {

using ::testing::AllOf;
using testing::Bar;
using ::testing::HasSubstr;
using testing::make_recipe;

constexpr double kRoundoff = 1e-10;  // of a stiffness with condition 1e6

/// Finite elements fixed at six degrees of freedom, without reactions under a
/// balanced load, then without rigid motion.
Matrix3X solve_held(const MeshedBody& body, const Matrix3X& load) {
  const MatrixX K = testing::dense_stiffness(body);
  const MatrixX R = testing::rigid_motions(body.mesh.x);
  const MatrixX held = R * R.transpose() * K.diagonal().mean();
  const VectorX x = (K + held).ldlt().solve(load.reshaped());
  const MatrixX MR = testing::kron(body.M_s, Matrix3::Identity()) * R;
  const VectorX part = (R.transpose() * MR).ldlt().solve(MR.transpose() * x);
  return (x - R * part).reshaped(3, load.cols());
}

template <class Function>
std::string error_of(const Function& function) {
  try {
    (void)function();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(AcceleratingState, IsFiniteElementsUnderInertiaLoads) {
  const Bar bar{.corner = {0.2, -0.1, 0.3}};
  const MeshedBody body(make_recipe(bar), {});
  const Matrix3X load = testing::make_load(body);
  const OperatingState state = find_accelerating_state(body, load);

  const MatrixX R = testing::rigid_motions(body.mesh.x);
  const MatrixX M = testing::kron(body.M_s, Matrix3::Identity());
  const VectorX q =
      R * (R.transpose() * M * R).ldlt().solve(R.transpose() * load.reshaped());
  const Matrix3X balanced = load - (M * q).reshaped(3, load.cols());
  const Matrix3X expected = solve_held(body, balanced);
  EXPECT_LT((state.u - expected).norm(), kRoundoff * expected.norm());
  EXPECT_LT((state.internal_force - balanced).norm(),
            kRoundoff * balanced.norm());
  EXPECT_NEAR(state.strain_energy, 0.5 * balanced.cwiseProduct(expected).sum(),
              kRoundoff * state.strain_energy);
  EXPECT_LT((state.acceleration - load.rowwise().sum() / bar.mass()).norm(),
            1e-12 * state.acceleration.norm());
  EXPECT_LT((R.transpose() * M * state.u.reshaped()).norm(),
            1e-12 * (M * state.u.reshaped()).norm());
  EXPECT_LT(state.support_force.norm(), 1e-12 * load.norm());
}

TEST(AcceleratingState, OfAClampedBodyIsItsStaticAnswer) {
  const MeshedBody body(make_recipe({.is_clamped = true}), {});
  const Matrix3X load = testing::make_load(body);
  const OperatingState state = find_accelerating_state(body, load);
  const std::vector<int>& free = body.support.free_nodes;
  const VectorX x = testing::dense_stiffness(body).ldlt().solve(
      take_rows(load.reshaped(), free).col(0));
  const VectorX found = take_rows(state.u.reshaped(), free);
  EXPECT_LT((found - x).norm(), kRoundoff * x.norm());
  EXPECT_EQ(state.acceleration, Vector3::Zero());
  EXPECT_LT((state.support_force + load.rowwise().sum()).norm(),
            1e-12 * load.norm());
}

/// The axial force decreases from F at the loaded end to 0: half of F L / (E
/// A).
TEST(AcceleratingState, PushedBarShortensByHalfOfItsStaticAnswer) {
  const Bar bar;
  const MeshedBody body(make_recipe(bar), {});
  const double F = 1e5;
  const OperatingState state =
      find_accelerating_state(body, testing::spread(body, 0, {F, 0.0, 0.0}));
  const double stiffness =
      bar.material.youngs_modulus * bar.size[1] * bar.size[2] / bar.size[0];
  const double shortening =
      state.u.row(0).maxCoeff() - state.u.row(0).minCoeff();
  EXPECT_NEAR(shortening, 0.5 * F / stiffness, 1e-10 * F / stiffness);
  // Stress is linear too: its energy is a third of the static one.
  EXPECT_NEAR(state.strain_energy, F * F / stiffness / 6.0,
              1e-10 * F * F / stiffness);
  EXPECT_NEAR(state.trust.strain, F / stiffness / bar.size[0],
              0.2 * F / stiffness);
  EXPECT_TRUE(state.trust.is_linear());
}

TEST(DriftingState, BalancesTheLoadByTheDragOfMassAndSurface) {
  const Bar bar{.corner = {0.2, -0.1, 0.3}};
  const MeshedBody body(make_recipe(bar), {});
  const Friction friction{.mass_rate = 0.7, .surface = 50.0};
  const Matrix3X load = testing::spread(body, 0, {3e4, 0.0, 0.0});
  const OperatingState state = find_drifting_state(body, load, friction);

  const Vector3& s = bar.size;
  const double area = 2.0 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]);
  const double drag = 0.7 * bar.mass() + 50.0 * area;
  EXPECT_LT((state.velocity - Vector3(3e4 / drag, 0.0, 0.0)).norm(),
            1e-11 * 3e4 / drag);
  const MatrixX D =
      testing::kron(make_drag(body, friction), Matrix3::Identity());
  const VectorX v = state.velocity.replicate(load.cols(), 1);
  const Matrix3X balanced = load - (D * v).reshaped(3, load.cols());
  const Matrix3X expected = solve_held(body, balanced);
  EXPECT_LT((state.u - expected).norm(), kRoundoff * expected.norm());
  EXPECT_LT(state.support_force.norm() + state.support_moment.norm(),
            1e-9 * load.norm());
}

/// Inertia and drag are then spread alike.
TEST(DriftingState, UnderDragOfMassAloneDeformsAsUnderAcceleration) {
  const MeshedBody body(make_recipe({}), {});
  const Matrix3X load = testing::spread(body, 1, {-1e4, 0.0, 0.0});
  const Matrix3X a = find_accelerating_state(body, load).u;
  const Matrix3X v =
      find_drifting_state(body, load, {.mass_rate = 3.0, .stiffness_time = 1.0})
          .u;
  EXPECT_LT((a - v).norm(), 1e-10 * a.norm());
}

TEST(SlowChange, GoesFromAccelerationToDriftAsTheRigidBodyDoes) {
  const Bar bar;
  const MeshedBody body(make_recipe(bar), {});
  const Friction friction{.surface = 200.0};
  const double F = 2e4;
  const Matrix3X load = testing::spread(body, 0, {F, 0.0, 0.0});
  const SlowChange change = find_slow_change(body, load, friction);
  const double drag = F / change.drifting.velocity[0];
  EXPECT_NEAR(change.rate, drag / bar.mass(), 1e-11 * change.rate);
  EXPECT_LT((change.at(0.0, body).u - change.accelerating.u).norm(),
            1e-12 * change.accelerating.u.norm());
  const MatrixX M = testing::kron(body.M_s, Matrix3::Identity());
  const MatrixX D =
      testing::kron(make_drag(body, friction), Matrix3::Identity());
  for (const double time : {0.3, 2.0}) {
    const double t = time / change.rate;
    const OperatingState state = change.at(t, body);
    EXPECT_NEAR(state.velocity[0], F / drag * (1.0 - std::exp(-time)),
                1e-11 * F / drag);
    EXPECT_NEAR(bar.mass() * state.acceleration[0] + drag * state.velocity[0],
                F, 1e-10 * F);
    const VectorX a = state.acceleration.replicate(load.cols(), 1);
    const VectorX v = state.velocity.replicate(load.cols(), 1);
    const VectorX rest = load.reshaped() - M * a - D * v;
    const Matrix3X expected = solve_held(body, rest.reshaped(3, load.cols()));
    EXPECT_LT((state.u - expected).norm(), kRoundoff * expected.norm());
  }
}

TEST(LinearTrust, EndsWhereDisplacementOrRotationIsATenth) {
  const Bar bar{.is_clamped = true};
  const MeshedBody body(make_recipe(bar), {});
  // Bending: w / L = F L^2 / (3 E I), the tip's rotation 3/2 of it.
  const double I = bar.size[1] * std::pow(bar.size[2], 3) / 12.0;
  const double F = 0.05 * 3.0 * bar.material.youngs_modulus * I;
  const auto trust = [&](double fraction) {
    return find_accelerating_state(
               body, testing::spread(body, 1, {0.0, 0.0, fraction * F}))
        .trust;
  };
  EXPECT_NEAR(trust(1.0).displacement, 0.05, 1e-3);
  EXPECT_NEAR(trust(1.0).rotation, 0.075, 2e-3);
  EXPECT_TRUE(trust(1.0).is_linear());
  EXPECT_THAT(describe(trust(1.0)), HasSubstr("within"));
  EXPECT_FALSE(trust(1.5).is_linear());
  EXPECT_THAT(describe(trust(1.5)), HasSubstr("beyond"));
}

TEST(OperatingState, WithoutALoadIsTrivialAndSaysSo) {
  const MeshedBody body(make_recipe({}), {});
  const Matrix3X none = Matrix3X::Zero(3, body.mesh.x.cols());
  EXPECT_THAT(error_of([&] { return find_accelerating_state(body, none); }),
              AllOf(HasSubstr("no load"), HasSubstr("trivial")));
  EXPECT_THAT(error_of([&] {
                return find_drifting_state(body, none, {.mass_rate = 1.0});
              }),
              HasSubstr("no load"));
  const Matrix3X bad = Matrix3X::Constant(3, none.cols(), std::nan(""));
  EXPECT_THAT(error_of([&] { return find_accelerating_state(body, bad); }),
              HasSubstr("not finite"));
}

TEST(DriftingState, RefusesWhatHasNoSteadySpeed) {
  const MeshedBody body(make_recipe({}), {});
  const Matrix3X push = testing::spread(body, 0, {1.0, 0.0, 0.0});
  EXPECT_THAT(error_of([&] {
                return find_drifting_state(body, push, {.stiffness_time = 1.0});
              }),
              HasSubstr("friction without damping"));
  EXPECT_THAT(error_of([&] {
                return find_drifting_state(body, push, {.mass_rate = -1.0});
              }),
              HasSubstr("mass_rate is -1"));
  const Matrix3X across = testing::spread(body, 0, {0.0, 1.0, 0.0});
  for (const double newtons : {1e-7, 1.0, 1e9}) {
    EXPECT_EQ(error_of([&] {
                return find_drifting_state(body, newtons * push,
                                           {.mass_rate = 1.0});
              }),
              "no error");
    EXPECT_THAT(error_of([&] {
                  return find_drifting_state(body, newtons * across,
                                             {.mass_rate = 1.0});
                }),
                AllOf(HasSubstr("centre of drag"), HasSubstr("would rotate")));
  }
  const MeshedBody held(make_recipe({.is_clamped = true}), {});
  EXPECT_THAT(error_of([&] {
                return find_drifting_state(held, push, {.mass_rate = 1.0});
              }),
              HasSubstr("clamped"));
}

}  // namespace
}  // namespace limber::flexbody::operating_states_test
