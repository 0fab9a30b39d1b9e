// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/joint_state.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/coupler_motion.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::joint_state_test {
namespace {

using joints::JointKind;
using ::testing::HasSubstr;

constexpr double kRoundOff = 1e-12;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const RigidInertia kInertia{2.0, Vector3(0.1, 0.2, 0.25).asDiagonal()};
const Pose kNear{exp_rotation(Vector3(0.2, -0.1, 0.4)), {-0.3, 0.1, 0.0}};
const Pose kFar{exp_rotation(Vector3(-0.3, 0.5, 0.1)), {0.4, 0.0, 0.2}};

/// World - a (hinge) - b (slider) - c (universal) - d (ball), each rigid; d is
/// the parent of its joint.
SystemModel make_chain() {
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", kInertia);
  const auto b = builder.add_rigid_body("b", kInertia);
  const auto c = builder.add_rigid_body("c", kInertia);
  const auto d = builder.add_rigid_body("d", kInertia);
  // Those at the end first: order does not matter.
  builder.add_joint("ball", JointKind::ball, {d, kNear}, {c, kFar});
  builder.add_joint("universal", JointKind::universal, {b, kFar}, {c, kNear},
                    {0, 3, 0});
  builder.add_joint("slider", JointKind::prismatic, {a, kFar}, {b, kNear},
                    {1, 1, 0});
  builder.add_joint("hinge", JointKind::revolute, {kWorld, kFar}, {a, kNear});
  return builder.build();
}

JointStates make_joints(double dt) {
  return {{"hinge", {{0.5 + 0.7 * dt}, {0.7}}},
          {"slider", {{0.2 - 0.4 * dt}, {-0.4}}},
          {"universal", {{0.3 + 0.2 * dt, -0.4 + 0.9 * dt}, {0.2, 0.9}}}};
}

std::string refusal(const SystemModel& model, const JointStates& joints) {
  try {
    (void)make_state(model, joints);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(JointState, PutsEveryJointAtItsCoordinatesWithoutStress) {
  const SystemModel model = make_chain();
  const SystemState state = make_state(model, make_joints(0.0));
  EXPECT_LT(calc_energy(model, state).coupler, 1e-12);
  for (const auto& [name, q] : make_joints(0.0)) {
    if (q.position.size() != 1) continue;
    const CoordinateReading reading =
        evaluate_coordinate(model, state, model.find_coupler(name), 0);
    EXPECT_NEAR(reading.motion.z, q.position[0], kRoundOff);
    EXPECT_NEAR(reading.motion.rate, q.velocity[0], kRoundOff);
  }
}

TEST(JointState, MovesBodiesAtTheRatesOfTheirPoses) {
  const SystemModel model = make_chain();
  constexpr double h = 1e-5;
  // Central differences: truncation h^2, round-off 1e-16 / h.
  constexpr double kTolerance = 1e-9;
  const SystemState now = make_state(model, make_joints(0.0));
  const SystemState before = make_state(model, make_joints(-h));
  const SystemState after = make_state(model, make_joints(h));
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyState& body = now.bodies[b];
    EXPECT_GT(body.v_WB_W.norm(), 0.1);
    EXPECT_LT(((after.bodies[b].p_WB - before.bodies[b].p_WB) / (2.0 * h) -
               body.v_WB_W)
                  .norm(),
              kTolerance);
    const Quaternion turn =
        before.bodies[b].quat_WB.conjugate() * after.bodies[b].quat_WB;
    EXPECT_LT((log_rotation(turn) / (2.0 * h) - body.w_WB_B).norm(),
              kTolerance);
  }
}

TEST(JointState, OfAHangingPairIsTheClosedForm) {
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", kInertia);
  const auto b = builder.add_rigid_body("b", kInertia);
  const Pose near{Matrix3::Identity(), {-0.5, 0, 0}};
  const Pose far{Matrix3::Identity(), {0.5, 0, 0}};
  builder.add_joint("1", JointKind::revolute, {}, {a, near});
  builder.add_joint("2", JointKind::revolute, {a, far}, {b, near});
  const SystemModel model = builder.build();
  const double q1 = 0.4;
  const double q2 = 1.1;
  const SystemState state =
      make_state(model, {{"1", {{q1}, {2.0}}}, {"2", {{q2}, {3.0}}}});
  EXPECT_LT((state.bodies[1].p_WB -
             Vector3(std::cos(q1) + 0.5 * std::cos(q1 + q2),
                     std::sin(q1) + 0.5 * std::sin(q1 + q2), 0.0))
                .norm(),
            kRoundOff);
  EXPECT_LT((state.bodies[1].v_WB_W -
             Vector3(-2.0 * std::sin(q1) - 2.5 * std::sin(q1 + q2),
                     2.0 * std::cos(q1) + 2.5 * std::cos(q1 + q2), 0.0))
                .norm(),
            kRoundOff);
  EXPECT_LT((state.bodies[1].w_WB_B - Vector3(0, 0, 5)).norm(), kRoundOff);
}

TEST(JointState, CountsFullTurns) {
  const SystemModel model = make_chain();
  const double turns = 6.0 * std::numbers::pi + 0.25;
  const SystemState state = make_state(model, {{"hinge", {{turns}, {}}}});
  EXPECT_NEAR(evaluate_coordinate(model, state, model.find_coupler("hinge"), 0)
                  .motion.z,
              turns, kRoundOff);
}

TEST(JointState, LeavesAFreeRootWhereItIsAndBringsTheRest) {
  SystemBuilder builder;
  const auto hand = builder.add_rigid_body("hand", kInertia);
  const auto base = builder.add_rigid_body("base", kInertia);
  builder.add_joint("wrist", JointKind::revolute, {base, kFar}, {hand, kNear});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[1].p_WB = {1, 2, 3};
  state.bodies[1].quat_WB = Quaternion(exp_rotation(Vector3(0.1, 0.2, 0.3)));
  state.bodies[1].v_WB_W = {4, 5, 6};
  state.bodies[1].w_WB_B = {0.3, -0.2, 0.1};
  const BodyState root = state.bodies[1];
  place_bodies(model, {{"wrist", {{0.3}, {}}}}, state);
  EXPECT_EQ(state.bodies[1].p_WB, root.p_WB);
  EXPECT_EQ(state.bodies[1].v_WB_W, root.v_WB_W);
  // As one rigid body.
  const Vector3 w_W = root.quat_WB * root.w_WB_B;
  EXPECT_LT((state.bodies[0].v_WB_W -
             (root.v_WB_W + w_W.cross(state.bodies[0].p_WB - root.p_WB)))
                .norm(),
            kRoundOff);
  EXPECT_LT(calc_energy(model, state).coupler, 1e-12);
}

TEST(JointState, FollowsInterfacesOfABentBodyThatMoves) {
  auto points = testing::make_point_mass_body(12, 4, 2.0, 0.5, 100.0, 3);
  points.reduced.interfaces = {testing::make_interface(points, 0, 5),
                               testing::make_interface(points, 6, 11)};
  points.reduced.interfaces[0].name = "root";
  points.reduced.interfaces[1].name = "tip";
  for (auto& table : points.reduced.interfaces) {
    table.rotation_axes = Matrix3::Identity();
    table.flexibility = 1e-6 * Matrix6::Identity();
  }
  SystemBuilder builder;
  const auto beam = builder.add_flexible_body("beam", testing::share(points),
                                              Fidelity::coupled, {});
  const auto end = builder.add_rigid_body("end", kInertia);
  builder.add_joint("root", JointKind::fixed, {}, {beam, {}, "root"});
  builder.add_joint("tip", JointKind::revolute, {beam, {}, "tip"},
                    {end, kNear});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.eta.setConstant(0.05);
  state.etadot.setConstant(-0.2);
  place_bodies(model, {{"tip", {{0.2}, {0.6}}}}, state);
  EXPECT_LT(calc_energy(model, state).coupler, 1e-9);
  for (const CouplerIndex c : {CouplerIndex(0), CouplerIndex(1)}) {
    const joints::RelativeMotion motion = find_relative_motion(model, state, c);
    EXPECT_LT(motion.v_FM_F.norm(), kRoundOff);
    EXPECT_LT((motion.w_FM_F - (c == 0 ? 0.0 : 0.6) * Vector3::UnitZ()).norm(),
              kRoundOff);
  }
}

/// A square of hinges about z, the last of which closes it.
/// @param side [m]
/// @param arm of a pendulum beside it, 0: none [m]
SystemModel make_square(double side = 1.0, double arm = 0.0) {
  SystemBuilder builder;
  const Pose near{Matrix3::Identity(), {-0.5 * side, 0, 0}};
  const Pose far{Matrix3::Identity(), {0.5 * side, 0, 0}};
  const Pose corner{Matrix3::Identity(), {side, 0, 0}};
  if (arm > 0.0) {
    const auto stranger = builder.add_rigid_body("stranger", kInertia);
    const Pose end{Matrix3::Identity(), {arm, 0, 0}};
    builder.add_joint("E", JointKind::revolute, {}, {stranger, end});
  }
  const auto left = builder.add_rigid_body("left", kInertia);
  const auto top = builder.add_rigid_body("top", kInertia);
  const auto right = builder.add_rigid_body("right", kInertia);
  builder.add_joint("A", JointKind::revolute, {}, {left, near});
  builder.add_joint("B", JointKind::revolute, {left, far}, {top, near});
  builder.add_joint("C", JointKind::revolute, {top, far}, {right, near});
  builder.add_joint("D", JointKind::revolute, {right, far}, {kWorld, corner});
  return builder.build();
}

TEST(JointState, ClosesALoopWhoseCoordinatesDo) {
  const double q = 1.2;
  const double u = 0.5;
  const SystemModel model = make_square();
  const auto joints = [&](double angle_C, double rate_C) -> JointStates {
    return {
        {"A", {{q}, {u}}}, {"B", {{-q}, {-u}}}, {"C", {{angle_C}, {rate_C}}}};
  };
  const double closed = q - std::numbers::pi;
  EXPECT_EQ(refusal(model, joints(closed, u)), "");
  // 0.1 rad at the end of a side of 1 m, and 0.1 rad/s.
  EXPECT_THAT(refusal(model, joints(closed + 0.1, u)),
              HasSubstr(fmt::format("joint 'D': it closes a loop, and its "
                                    "frames are {:.3g} m",
                                    2.0 * std::sin(0.05))));
  EXPECT_THAT(refusal(model, joints(closed, u + 0.1)),
              HasSubstr("frames separate at 0.1 m/s and 0 rad/s"));
}

// A millimetre of 1 m is closed beside an arm of 1 km, if that counts.
TEST(JointState, JudgesALoopByItsOwnSize) {
  const double q = 1.2;
  const double error = 1e-4;
  for (const double side : {1e-3, 1.0, 1e3}) {
    for (const double arm : {0.0, 1e3}) {
      const auto refuse = [&](double angle) {
        return refusal(
            make_square(side, arm),
            {{"A", {{q}, {}}}, {"B", {{-q}, {}}}, {"C", {{angle}, {}}}});
      };
      EXPECT_EQ(refuse(q - std::numbers::pi), "") << side << ' ' << arm;
      EXPECT_THAT(refuse(q - std::numbers::pi + error),
                  HasSubstr("joint 'D': it closes a loop, and its frames are"))
          << side << ' ' << arm;
    }
  }
}

// Whatever the unit of time: an error of all of a rate is refused, one of a
// hundred-millionth is not.
TEST(JointState, JudgesTheRatesOfALoopByItsOwnSpeeds) {
  const double q = 1.2;
  for (const double u : {1e-8, 1.0, 1e8}) {
    const auto refuse = [&](double rate_C) {
      return refusal(make_square(),
                     {{"A", {{q}, {u}}},
                      {"B", {{-q}, {-u}}},
                      {"C", {{q - std::numbers::pi}, {rate_C}}}});
    };
    EXPECT_EQ(refuse(u * (1.0 + 1e-8)), "") << u;
    EXPECT_THAT(refuse(2.0 * u), HasSubstr("frames separate")) << u;
  }
}

// Such as one that carries a spring, or is measured.
TEST(JointState, AJointThatHoldsNothingClosesAnyLoop) {
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", kInertia);
  const auto b = builder.add_rigid_body("b", kInertia);
  builder.add_joint("A", JointKind::revolute, {kWorld, kFar}, {a, kNear});
  builder.add_joint("B", JointKind::revolute, {a, kFar}, {b, kNear});
  builder.add_joint("C", JointKind::floating, {b, kFar}, {kWorld, kNear});
  EXPECT_EQ(
      refusal(builder.build(), {{"A", {{0.3}, {1.0}}}, {"B", {{0.7}, {2.0}}}}),
      "");
}

TEST(JointState, RefusesCoordinatesOfAJointThatClosesALoop) {
  EXPECT_THAT(refusal(make_square(), {{"D", {{0.1}, {}}}}),
              HasSubstr("joint 'D': it closes a loop, so its coordinates"));
}

TEST(JointState, RefusesWhatIsNoCoordinateOfAJointAllAtOnce) {
  const SystemModel model = make_chain();
  const std::string text =
      refusal(model, {{"hinje", {{0.1}, {}}},
                      {"slider", {{0.1, 0.2}, {}}},
                      {"hinge", {{}, {kNaN}}},
                      {"", {}},
                      {"universal", {{INFINITY, 0}, {1}}}});
  EXPECT_THAT(text, HasSubstr("unknown joint 'hinje'; did you mean 'hinge'?"));
  EXPECT_THAT(text, HasSubstr("'slider': its position has 2 numbers; it has 1 "
                              "coordinate"));
  EXPECT_THAT(text, HasSubstr("'hinge': its velocity has the value nan"));
  EXPECT_THAT(text, HasSubstr("unknown joint ''"));
  EXPECT_THAT(text, HasSubstr("'universal': its position has the value inf"));
  EXPECT_THAT(text, HasSubstr("'universal': its velocity has 1 numbers"));
}

TEST(JointState, LeavesTheStateAsItWasWhenItRefuses) {
  const SystemModel model = make_square();
  SystemState state = make_state(model);
  EXPECT_THROW(place_bodies(model, {{"A", {{0.3}, {}}}}, state), InputError);
  for (const BodyState& body : state.bodies) {
    EXPECT_TRUE(body.p_WB.isZero());
  }
  state.bodies.pop_back();
  EXPECT_THROW(place_bodies(model, {}, state), ContractError);
}

}  // namespace
}  // namespace limber::dynamics::joint_state_test
