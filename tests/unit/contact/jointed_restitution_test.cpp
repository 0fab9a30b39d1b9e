// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/contact/make_contact.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"

/// Restitution of bodies in joints: the ball that strikes an arm parts from it
/// with e times the speed of approach, and as the impulse on links under ideal
/// constraints says.
namespace limber::contact::jointed_restitution_test {
namespace {

using dynamics::BodyIndex;
using dynamics::SystemBuilder;

constexpr double kRadius = 0.01;  // [m]
constexpr SurfaceMaterial kPlastic{2e9, 0.3};
constexpr double kHalf = 0.2;   // of a link's length [m]
constexpr double kSpeed = 0.5;  // [m/s]

struct Strike {
  int links = 1;
  double fraction = 0.5;  ///< of the last link's half length, from its centre
  double mass = 1.0;      ///< of a link [kg]
  double ball = 0.1;      ///< [kg]
  bool is_held = true;
  bool has_names_swapped = false;
  Vector3 turn = Vector3::Zero();  ///< of the scene [rad]
};

// Of a slender link: a capsule's axis along z is turned to x.
Matrix3 find_inertia(double mass) {
  const double J = mass * kHalf * kHalf / 3.0;
  return Vector3(1e-3 * J, J, J).asDiagonal();
}

/// Speeds after an impact on a straight chain of hinged links from above.
struct Parting {
  double ball = 0.0;   ///< of the ball, upwards [m/s]
  double point = 0.0;  ///< of the struck point [m/s]
};

// The impulse that a struck chain opposes, each link by its vertical speed and
// spin, hinges as constraints: J = (1 + e) v / (1/m + n' (M^-1 - ..) n).
Parting find_parting(const Strike& strike, double e) {
  const int n = strike.links;
  MatrixX inverse = MatrixX::Zero(2 * n, 2 * n);
  for (int i = 0; i < n; ++i) {
    inverse(2 * i, 2 * i) = 1.0 / strike.mass;
    inverse(2 * i + 1, 2 * i + 1) = 1.0 / (strike.mass * kHalf * kHalf / 3.0);
  }
  const int held = strike.is_held ? 1 : 0;
  MatrixX G = MatrixX::Zero(n - 1 + held, 2 * n);
  const auto add = [&](Eigen::Index row, int i, double arm, double sign) {
    G(row, 2 * i) += sign;
    G(row, 2 * i + 1) += sign * arm;
  };
  for (int i = 0; i + 1 < n; ++i) {
    add(i, i, kHalf, 1.0);
    add(i, i + 1, -kHalf, -1.0);
  }
  if (strike.is_held) add(n - 1, 0, -kHalf, 1.0);
  MatrixX Y = inverse;
  if (G.rows() > 0) {
    const MatrixX C = G * inverse * G.transpose();
    Y -= inverse * G.transpose() * C.ldlt().solve(G * inverse);
  }
  VectorX normal = VectorX::Zero(2 * n);
  normal[2 * n - 2] = 1.0;
  normal[2 * n - 1] = strike.fraction * kHalf;
  const double yield = normal.dot(Y * normal);
  const double impulse = (1.0 + e) * kSpeed / (1.0 / strike.ball + yield);
  return {impulse / strike.ball - kSpeed, -impulse * yield};
}

Parting run(const Strike& strike, double e) {
  const Matrix3 R = exp_rotation(strike.turn);
  SystemBuilder builder;
  const Matrix3 inertia = find_inertia(strike.mass);
  const Matrix3 ball_inertia =
      0.4 * strike.ball * kRadius * kRadius * Matrix3::Identity();
  std::vector<BodyIndex> links;
  for (int i = 0; i < strike.links; ++i) {
    links.push_back(builder.add_rigid_body("link" + std::to_string(i),
                                           {strike.mass, inertia}));
  }
  const auto law = joints::make_joint(
      joints::JointKind::revolute, Vector3::UnitY(), {},
      {.translational_stiffness = 1e11, .rotational_stiffness = 1e10});
  const auto frame = [&](BodyIndex link, double x) {
    return builder.attach_frame("f", link,
                                {Matrix3::Identity(), Vector3(x, 0.0, 0.0)});
  };
  if (strike.is_held) {
    builder.add_coupler(
        "root", law,
        builder.attach_world("w", {R, R * Vector3(-kHalf, 0.0, 0.0)}),
        frame(links[0], -kHalf));
  }
  for (std::size_t i = 0; i + 1 < links.size(); ++i) {
    builder.add_coupler("hinge" + std::to_string(i), law,
                        frame(links[i], kHalf), frame(links[i + 1], -kHalf));
  }
  const auto ball = builder.add_rigid_body("ball", {strike.ball, ball_inertia});
  const ContactSide rod{
      Shape{Capsule{kRadius, kHalf},
            {exp_rotation(Vector3(0.0, M_PI / 2.0, 0.0)), Vector3::Zero()}},
      kPlastic, strike.mass, inertia};
  const ContactSide sphere{Shape{Sphere{kRadius}, {}}, kPlastic, strike.ball,
                           ball_inertia};
  const ContactParameters parameters{.restitution = e};
  if (strike.has_names_swapped) {
    builder.add_pair("p", ball, links.back(),
                     make_contact(sphere, rod, parameters));
  } else {
    builder.add_pair("p", links.back(), ball,
                     make_contact(rod, sphere, parameters));
  }
  const dynamics::SystemModel model = builder.build();
  dynamics::SystemState state = make_state(model);
  for (std::size_t i = 0; i < links.size(); ++i) {
    state.bodies[i].quat_WB = Quaternion(R);
    state.bodies[i].p_WB =
        R * Vector3(2.0 * kHalf * static_cast<double>(i), 0.0, 0.0);
  }
  const double x = 2.0 * kHalf * (strike.links - 1) + strike.fraction * kHalf;
  dynamics::BodyState& body = state.bodies.back();
  body.p_WB = R * Vector3(x, 0.0, 2.0 * kRadius + 1e-6);
  body.v_WB_W = R * Vector3(0.0, 0.0, -kSpeed);
  dynamics::RunRecord record;
  dynamics::SimulationStatistics statistics;
  const double end = 3e-3 * std::sqrt(std::max(1.0, strike.ball));
  simulate(model, state, {.end_time = end, .step = 1e-3 * end}, {}, {},
           statistics, {}, {}, record);
  EXPECT_EQ(record.contacts.size(), 1U);
  const dynamics::BodyState& last = state.bodies[links.size() - 1];
  const Vector3 up = R * Vector3::UnitZ();
  const Vector3 point =
      last.v_WB_W +
      R * last.w_WB_B.cross(Vector3(strike.fraction * kHalf, 0.0, 0.0));
  return {state.bodies.back().v_WB_W.dot(up), point.dot(up)};
}

void expect_right(const Strike& strike, double e) {
  const Parting right = find_parting(strike, e);
  const Parting found = run(strike, e);
  EXPECT_NEAR((found.ball - found.point) / kSpeed, e, 6e-3);
  EXPECT_NEAR(found.ball / kSpeed, right.ball / kSpeed, 6e-3);
  EXPECT_NEAR(found.point / kSpeed, right.point / kSpeed, 6e-3);
}

TEST(JointedRestitution, OfArmsThatABallStrikesIsThatAskedFor) {
  for (const int links : {1, 2, 4}) {
    for (const double fraction : {0.9, -0.3}) {
      for (const double e : {0.9, 0.5, 0.2}) {
        SCOPED_TRACE(::testing::Message()
                     << links << " links, at " << fraction << ", e " << e);
        expect_right({.links = links, .fraction = fraction}, e);
      }
    }
  }
}

TEST(JointedRestitution, IsThatOfAnArmThatNothingHolds) {
  expect_right({.links = 3, .fraction = 0.7, .is_held = false}, 0.5);
}

TEST(JointedRestitution, DoesNotDependOnMassesNamesAndAxes) {
  expect_right({.links = 2, .fraction = 0.6, .mass = 1e3, .ball = 100.0}, 0.5);
  expect_right({.links = 2, .fraction = 0.6, .ball = 10.0}, 0.5);
  const Strike strike{.links = 2, .fraction = 0.6};
  Strike changed = strike;
  changed.has_names_swapped = true;
  changed.turn = {0.4, -1.1, 2.0};
  const Parting a = run(strike, 0.7);
  const Parting b = run(changed, 0.7);
  EXPECT_NEAR(a.ball, b.ball, 1e-6);
  EXPECT_NEAR(a.point, b.point, 1e-6);
}

}  // namespace
}  // namespace limber::contact::jointed_restitution_test
