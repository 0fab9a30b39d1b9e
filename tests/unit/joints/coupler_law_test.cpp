// SPDX-License-Identifier: BSD-3-Clause
// Every law keeps the same contract; a new law joins by one line in `laws`.
#include "joints/coupler_law.hpp"

#include <gtest/gtest.h>

#include <random>

#include "common/errors.hpp"
#include "common/rotation.hpp"
#include "joints/joint_kind.hpp"

namespace limber::joints {
namespace {

constexpr double kDifferenceError = 1e-6;  // of central differences, relative
constexpr double kStep = 1e-6;

struct NamedLaw {
  const char* name;
  CouplerLaw law;
};

Matrix3 random_semidefinite(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Matrix3 a;
  for (double& x : a.reshaped()) x = uniform(random);
  return 50.0 * a * a.transpose();
}

std::vector<NamedLaw> laws() {
  std::mt19937 random(7);
  const JointParameters stiff{.translational_stiffness = 300.0,
                              .rotational_stiffness = 40.0,
                              .translational_damping = 3.0,
                              .rotational_damping = 0.4,
                              .free_damping = 0.2};
  const Vector3 axis = Vector3(1.0, -2.0, 0.5).normalized();
  return {
      {"bushing",
       Bushing({random_semidefinite(random), random_semidefinite(random),
                random_semidefinite(random), random_semidefinite(random)})},
      {"fixed", make_joint_bushing(JointKind::fixed, axis, stiff)},
      {"revolute", make_joint_bushing(JointKind::revolute, axis, stiff)},
      {"prismatic", make_joint_bushing(JointKind::prismatic, axis, stiff)},
      {"planar", make_joint_bushing(JointKind::planar, axis, stiff)},
      {"spring",
       PointSpring({.stiffness = 200.0, .damping = 3.0, .free_length = 0.7})},
      {"spring without length",
       PointSpring({.stiffness = 200.0, .damping = 3.0})},
  };
}

RelativeMotion random_motion(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] {
    return Vector3(uniform(random), uniform(random), uniform(random));
  };
  RelativeMotion motion;
  motion.R_FM = exp_rotation(3.0 * vector().normalized());
  motion.p_FM_F = vector();
  motion.v_FM_F = vector();
  motion.w_FM_F = vector();
  return motion;
}

RelativeMotion moved(const RelativeMotion& motion, int direction, double by) {
  RelativeMotion m = motion;
  if (direction < 3) {
    m.p_FM_F[direction] += by;
  } else {
    m.R_FM = exp_rotation(by * Vector3::Unit(direction - 3)) * m.R_FM;
  }
  return m;
}

class CouplerLaws : public ::testing::TestWithParam<NamedLaw> {
 protected:
  std::mt19937 random_{11};
};

TEST_P(CouplerLaws, ForceIsMinusEnergyGradient) {
  double largest = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    RelativeMotion motion = random_motion(random_);
    motion.v_FM_F.setZero();
    motion.w_FM_F.setZero();
    const CouplerResponse at = evaluate(GetParam().law, motion);
    for (int i = 0; i < 6; ++i) {
      const double gradient =
          (evaluate(GetParam().law, moved(motion, i, kStep)).energy -
           evaluate(GetParam().law, moved(motion, i, -kStep)).energy) /
          (2.0 * kStep);
      EXPECT_NEAR(at.wrench[i], -gradient,
                  kDifferenceError * (1.0 + at.wrench.norm()));
      largest = std::max(largest, std::abs(gradient));
    }
  }
  EXPECT_GT(largest, 1.0);  // the law does something
}

TEST_P(CouplerLaws, StiffnessIsMinusForceDerivative) {
  for (int trial = 0; trial < 20; ++trial) {
    const RelativeMotion motion = random_motion(random_);
    const Matrix6 K = evaluate(GetParam().law, motion).stiffness;
    for (int i = 0; i < 6; ++i) {
      const Vector6 column =
          -(evaluate(GetParam().law, moved(motion, i, kStep)).wrench -
            evaluate(GetParam().law, moved(motion, i, -kStep)).wrench) /
          (2.0 * kStep);
      EXPECT_LT((K.col(i) - column).norm(), kDifferenceError * (1 + K.norm()));
    }
  }
}

TEST_P(CouplerLaws, DampingIsMinusForceDerivativeByVelocity) {
  for (int trial = 0; trial < 5; ++trial) {
    const RelativeMotion motion = random_motion(random_);
    const Matrix6 C = evaluate(GetParam().law, motion).damping;
    for (int i = 0; i < 6; ++i) {
      const auto pushed = [&](double by) {
        RelativeMotion m = motion;
        (i < 3 ? m.v_FM_F[i] : m.w_FM_F[i - 3]) += by;
        return evaluate(GetParam().law, m).wrench;
      };
      const Vector6 column = -(pushed(kStep) - pushed(-kStep)) / (2.0 * kStep);
      EXPECT_LT((C.col(i) - column).norm(), kDifferenceError * (1 + C.norm()));
    }
  }
}

TEST_P(CouplerLaws, DissipationIsPowerOfTheVelocityPartAndNeverNegative) {
  for (int trial = 0; trial < 20; ++trial) {
    const RelativeMotion motion = random_motion(random_);
    RelativeMotion still = motion;
    still.v_FM_F.setZero();
    still.w_FM_F.setZero();
    const CouplerResponse moving = evaluate(GetParam().law, motion);
    const Vector6 damper =
        moving.wrench - evaluate(GetParam().law, still).wrench;
    const double power = damper.head<3>().dot(motion.v_FM_F) +
                         damper.tail<3>().dot(motion.w_FM_F);
    EXPECT_NEAR(moving.dissipation, -power, 1e-12 * (1.0 + std::abs(power)));
    EXPECT_GE(moving.dissipation, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, CouplerLaws, ::testing::ValuesIn(laws()),
                         [](const auto& instance) {
                           std::string name;
                           for (const char c :
                                std::string(instance.param.name)) {
                             if (c != ' ') name += c;
                           }
                           return name;
                         });

TEST(JointBushing, RevoluteIsFreeThroughManyTurns) {
  const Vector3 axis = Vector3(0.0, 0.6, 0.8);
  const Bushing hinge = make_joint_bushing(
      JointKind::revolute, axis,
      {.translational_stiffness = 1e9, .rotational_stiffness = 1e7});
  for (double angle = -700.0; angle < 700.0; angle += 7.3) {
    RelativeMotion motion;
    motion.R_FM = exp_rotation(angle * axis);
    const CouplerResponse r = hinge.evaluate(motion);
    // Round-off of a rotation matrix times the stiffness.
    EXPECT_LT(r.wrench.norm(), 1e7 * 1e-14);
    EXPECT_LT(std::abs(r.energy), 1e7 * 1e-14);
  }
}

TEST(JointBushing, TiltOfARevoluteIsHeldWithItsStiffness) {
  const Bushing hinge = make_joint_bushing(
      JointKind::revolute, Vector3::UnitZ(), {.rotational_stiffness = 500.0});
  RelativeMotion motion;
  motion.R_FM = exp_rotation(1e-5 * Vector3::UnitX()) *
                exp_rotation(2.0 * Vector3::UnitZ());
  const CouplerResponse r = hinge.evaluate(motion);
  EXPECT_NEAR(r.wrench[3], -500.0 * 1e-5, 1e-10);
  EXPECT_NEAR(r.energy, 0.5 * 500.0 * 1e-10, 1e-14);
}

TEST(JointBushing, PrismaticHoldsAllButItsAxis) {
  const Bushing slider = make_joint_bushing(
      JointKind::prismatic, Vector3::UnitX(),
      {.translational_stiffness = 10.0, .rotational_stiffness = 10.0});
  RelativeMotion motion;
  motion.p_FM_F = Vector3(5.0, 1.0, 2.0);
  EXPECT_EQ(Vector3(slider.evaluate(motion).wrench.head<3>()),
            Vector3(0.0, -10.0, -20.0));
}

TEST(JointBushing, PlanarHoldsNormalTranslationAndTilt) {
  const Bushing plane = make_joint_bushing(
      JointKind::planar, Vector3::UnitZ(),
      {.translational_stiffness = 10.0, .rotational_stiffness = 10.0});
  RelativeMotion motion;
  motion.p_FM_F = Vector3(5.0, 1.0, 2.0);
  motion.R_FM = exp_rotation(1.0 * Vector3::UnitZ());
  const Vector6 wrench = plane.evaluate(motion).wrench;
  EXPECT_EQ(Vector3(wrench.head<3>()), Vector3(0.0, 0.0, -20.0));
  EXPECT_LT(wrench.tail<3>().norm(), 1e-14);
}

TEST(JointBushing, FloatingHoldsNothing) {
  const Bushing free = make_joint_bushing(JointKind::floating, Vector3::Zero(),
                                          {.translational_stiffness = 10.0});
  RelativeMotion motion;
  motion.p_FM_F = Vector3(5.0, 1.0, 2.0);
  EXPECT_EQ(free.evaluate(motion).wrench.norm(), 0.0);
}

TEST(Laws, RefuseParametersOutOfRange) {
  EXPECT_THROW(PointSpring({.stiffness = -1.0}), InputError);
  EXPECT_THROW(PointSpring({.stiffness = 1.0, .free_length = -1.0}),
               InputError);
  EXPECT_THROW(Bushing({.translational_stiffness = -Matrix3::Identity()}),
               InputError);
  Matrix3 skewed = Matrix3::Identity();
  skewed(0, 1) = 0.5;
  EXPECT_THROW(Bushing({.rotational_stiffness = skewed}), InputError);
  EXPECT_THROW(static_cast<void>(make_joint_bushing(JointKind::revolute,
                                                    Vector3::Zero(), {})),
               InputError);
  EXPECT_THROW(
      static_cast<void>(make_joint_bushing(JointKind::fixed, Vector3::UnitX(),
                                           {.translational_stiffness = -5.0})),
      InputError);
}

TEST(PointSpring, EndsThatCoincideHaveNoDirection) {
  const PointSpring spring({.stiffness = 1.0, .free_length = 1.0});
  EXPECT_THROW(static_cast<void>(spring.evaluate({})), NumericalError);
}

}  // namespace
}  // namespace limber::joints
