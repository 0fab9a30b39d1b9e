// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"
#include "limber/reduction/operating_states.hpp"
#include "unit/reduction/bar.hpp"

namespace limber::flexbody::spinning_state_test {
namespace {

using ::testing::AllOf;
using testing::Bar;
using ::testing::HasSubstr;
using testing::kron;
using testing::make_recipe;

constexpr double kRoundoff = 1e-10;  // of a stiffness with condition 1e6

template <class Function>
std::string error_of(const Function& function) {
  try {
    (void)function();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

Matrix3 cross_matrix(const Vector3& n) {
  Matrix3 cross;
  cross << 0.0, -n[2], n[1], n[2], 0.0, -n[0], -n[1], n[0], 0.0;
  return cross;
}

/// Without Poisson's ratio each direction is an independent bar, stretched by
/// rho Omega^2 (x + u): E u'' + rho Omega^2 (x + u) = 0, free at +-L/2.
double stretch(double x, double L, double k) {
  return std::sin(k * x) / (k * std::cos(0.5 * k * L)) - x;
}

double rod_error(int cells, int order, double k) {
  const Bar bar{
      .corner = {-0.5, -0.05, -0.025}, .cells = cells, .order = order};
  const MeshedBody body(make_recipe(bar), {});
  const double speed =
      k * std::sqrt(bar.material.youngs_modulus / bar.material.density);
  const OperatingState state =
      find_spinning_state(body, {.direction = {0.0, 0.0, -3.0}}, speed);
  double error = 0.0;
  for (Eigen::Index n = 0; n < state.u.cols(); ++n) {
    const Vector3 expected(stretch(body.mesh.x(0, n), bar.size[0], k),
                           stretch(body.mesh.x(1, n), bar.size[1], k), 0.0);
    error = std::max(error, (state.u.col(n) - expected).norm());
  }
  return error / stretch(0.5, 1.0, k);
}

TEST(SpinningState, StretchesAFreeRodAsTheClosedFormAndConverges) {
  const double k = 0.05;  // below the critical speed of bending
  // Slow: rho Omega^2 / (2 E) (L^2 x / 4 - x^3 / 3).
  EXPECT_NEAR(stretch(0.5, 1.0, 1e-2) / (0.5e-4 * (0.125 - 0.125 / 3.0)), 1.0,
              1e-4);
  const double coarse = rod_error(4, 1, k);
  const double fine = rod_error(8, 1, k);
  EXPECT_LT(coarse, 0.05);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.3);
  const double quadratic_coarse = rod_error(4, 2, k);
  EXPECT_LT(quadratic_coarse, 1e-3);
  EXPECT_GT(std::log2(quadratic_coarse / rod_error(8, 2, k)), 2.7);
}

/// Fixed at the axis: u' = 0 at L. The clamp also holds the section's width,
/// which stretches by (w / L)^3 of the length.
TEST(SpinningState, StretchesAClampedRodAsTheClosedForm) {
  const Bar bar{.corner = {0.0, -0.01, -0.01},
                .size = {1.0, 0.02, 0.02},
                .cells = 20,
                .is_clamped = true};
  const MeshedBody body(make_recipe(bar), {});
  const double k = 0.01;
  const double speed =
      k * std::sqrt(bar.material.youngs_modulus / bar.material.density);
  const OperatingState state =
      find_spinning_state(body, {.direction = Vector3::UnitZ()}, speed);
  const double tip = std::sin(k) / (k * std::cos(k)) - 1.0;
  EXPECT_NEAR(state.u.row(0).maxCoeff() / tip, 1.0, 2e-5);
  // The clamp pulls the rod's mass round its centre.
  const double pull = bar.material.youngs_modulus * bar.size[1] * bar.size[2] *
                      (1.0 / std::cos(k) - 1.0);
  EXPECT_NEAR(state.support_force[0] / -pull, 1.0, 2e-8);
}

class Spinning : public ::testing::TestWithParam<bool> {
 protected:
  Bar bar_{.corner = {0.2, -0.1, 0.3},
           .size = {1.0, 0.3, 0.2},
           .material = {200e9, 0.3, 8000.0},
           .is_clamped = GetParam()};
  MeshedBody body_{make_recipe(bar_), {}};
  SpinAxis axis_{.direction = {0.3, -1.0, 0.8}, .point = {0.1, 0.2, -0.3}};
  Vector3 n_ = axis_.direction.normalized();
  Matrix3X r_ = body_.mesh.x.colwise() - axis_.point;
  /// Columns of the identity at the free nodes' degrees of freedom.
  MatrixX free_ =
      put_rows(MatrixX::Identity(body_.support.matrices.dof_count(),
                                 body_.support.matrices.dof_count()),
               body_.support.free_nodes, r_.cols());
  MatrixX ME_ = kron(body_.M_s, Matrix3::Identity() - n_ * n_.transpose());

  /// What a free body may have of a residual: multiples of M R.
  [[nodiscard]] MatrixX constraint() const {
    if (bar_.is_clamped) return MatrixX(free_.cols(), 0);
    return kron(body_.M_s, Matrix3::Identity()) *
           testing::rigid_motions(body_.mesh.x);
  }
};
INSTANTIATE_TEST_SUITE_P(Support, Spinning, ::testing::Bool(),
                         [](const auto& p) {
                           return p.param ? "Clamped" : "Free";
                         });

TEST_P(Spinning, AboutAnyAxisIsADenseSolutionWithTheRigidPartHeld) {
  const double speed = 300.0;
  const OperatingState state = find_spinning_state(body_, axis_, speed);
  ASSERT_LT(speed, *state.critical_speed);
  const MatrixX C = constraint();
  const Eigen::Index n = free_.cols();
  MatrixX A = MatrixX::Zero(n + C.cols(), n + C.cols());
  A.topLeftCorner(n, n) = testing::dense_stiffness(body_) -
                          speed * speed * free_.transpose() * ME_ * free_;
  const double scale = A.diagonal().cwiseAbs().maxCoeff();
  A.topRightCorner(n, C.cols()) = scale * C;
  A.bottomLeftCorner(C.cols(), n) = scale * C.transpose();
  VectorX b = VectorX::Zero(A.rows());
  b.head(n) = speed * speed * free_.transpose() * ME_ * r_.reshaped();
  const VectorX expected = free_ * dense::solve(A, b).head(n);
  EXPECT_LT((state.u.reshaped() - expected).norm(),
            kRoundoff * expected.norm());
  EXPECT_LT((state.angular_velocity - speed * n_).norm(), 1e-10);
}

TEST_P(Spinning, UnderTorqueAndFrictionBalancesForcesAndTorque) {
  const Friction friction{.mass_rate = 2.0, .surface = 300.0};
  Matrix3X load(3, r_.cols());
  for (Eigen::Index i = 0; i < r_.cols(); ++i)
    load.col(i) = 2e4 * n_.cross(Vector3(r_.col(i)));
  load.colwise() -= Vector3(load.rowwise().mean());
  const OperatingState state =
      find_driven_spin_state(body_, axis_, load, friction);
  const double speed = state.angular_velocity.dot(n_);
  EXPECT_GT(speed, 100.0);
  EXPECT_LT(speed, *state.critical_speed);

  const VectorX arm = (r_ + state.u).reshaped();
  const VectorX turning =
      kron(MatrixX::Identity(r_.cols(), r_.cols()), cross_matrix(n_)) * arm;
  const VectorX resisted =
      kron(make_drag(body_, friction), Matrix3::Identity()) * turning;
  const double torque = turning.dot(load.reshaped());
  EXPECT_NEAR(speed * turning.dot(resisted), torque, 1e-9 * torque);

  const VectorX forces =
      load.reshaped() + speed * speed * ME_ * arm - speed * resisted;
  VectorX residual =
      testing::dense_stiffness(body_) *
          take_rows(state.u.reshaped(), body_.support.free_nodes) -
      free_.transpose() * forces;
  const MatrixX C = constraint();
  if (C.cols() > 0)
    residual -= C * dense::solve(MatrixX(C.transpose() * C),
                                 VectorX(C.transpose() * residual));
  EXPECT_LT(residual.norm(), 1e-9 * forces.norm());
}

TEST_P(Spinning, AtTheCriticalSpeedIsRefusedNamingBoth) {
  const double critical =
      *find_spinning_state(body_, axis_, 1.0).critical_speed;
  const auto spin = [&](double speed) {
    return error_of([&] { return find_spinning_state(body_, axis_, speed); });
  };
  EXPECT_EQ(spin(0.99 * critical), "no error");
  EXPECT_THAT(spin(-1.5 * critical),
              AllOf(HasSubstr(fmt::format("{:.6g} rad/s", 1.5 * critical)),
                    HasSubstr(fmt::format("{:.6g} rad/s", critical)),
                    HasSubstr("critical")));
}

/// A free body's centre of mass must be held on its circle.
TEST(SpinningState, OfAFreeBodyTellsWhatHoldsItOnItsCircle) {
  const Bar bar;
  const MeshedBody body(make_recipe(bar), {});
  const Vector3 center = 0.5 * bar.size;
  const Vector3 offset(0.0, 0.7, 0.0);
  const OperatingState state = find_spinning_state(
      body, {.direction = Vector3::UnitX(), .point = center - offset}, 20.0);
  EXPECT_LT((state.support_force + bar.mass() * 400.0 * offset).norm(), 1e-7);
  const OperatingState centred = find_spinning_state(
      body, {.direction = Vector3::UnitX(), .point = center}, 20.0);
  EXPECT_LT(centred.support_force.norm(), 1e-7);
  EXPECT_LT((state.u - centred.u).norm(), 1e-10 * centred.u.norm());
}

/// Drag in proportion to mass: Omega = T / (alpha J).
TEST(DrivenSpin, OfAStiffBodyHasTheRigidBodysSpeed) {
  const Bar bar;
  const MeshedBody body(make_recipe(bar), {});
  const double F = 1e-3;
  const Matrix3X load = testing::spread(body, 1, {0.0, F, 0.0}) +
                        testing::spread(body, 0, {0.0, -F, 0.0});
  const OperatingState state = find_driven_spin_state(
      body, {.direction = Vector3::UnitZ(), .point = 0.5 * bar.size}, load,
      {.mass_rate = 0.5});
  const double J = bar.mass() *
                   (bar.size[0] * bar.size[0] + bar.size[1] * bar.size[1]) /
                   12.0;
  EXPECT_NEAR(state.angular_velocity[2] / (F * bar.size[0] / (0.5 * J)), 1.0,
              1e-8);
}

TEST(SpinningState, RefusesWhatIsNone) {
  const MeshedBody body(make_recipe({}), {});
  EXPECT_THAT(error_of([&] {
                return find_spinning_state(body, {.direction = Vector3::Zero()},
                                           1.0);
              }),
              AllOf(HasSubstr("axis"), HasSubstr("no direction")));
  EXPECT_THAT(error_of([&] { return find_spinning_state(body, {}, 0.0); }),
              HasSubstr("trivial"));
}

TEST(DrivenSpin, RefusesWhatIsNone) {
  const MeshedBody body(make_recipe({}), {});
  const SpinAxis axis{.point = {0.5, 0.05, 0.025}};
  const Friction friction{.mass_rate = 1.0};
  const auto drive = [&](const Matrix3X& load, const Friction& resist) {
    return error_of(
        [&] { return find_driven_spin_state(body, axis, load, resist); });
  };
  const Matrix3X pull = testing::spread(body, 1, {1.0, 0.0, 0.0});
  const Matrix3X push = testing::spread(body, 0, {-1.0, 0.0, 0.0});
  EXPECT_THAT(drive(pull, friction), HasSubstr("net force"));
  EXPECT_THAT(drive(pull + push, friction), HasSubstr("no torque"));
  EXPECT_THAT(drive(pull + push, {}), HasSubstr("friction without damping"));
  EXPECT_THAT(drive(0.0 * pull, friction), HasSubstr("no load"));
}

}  // namespace
}  // namespace limber::flexbody::spinning_state_test
