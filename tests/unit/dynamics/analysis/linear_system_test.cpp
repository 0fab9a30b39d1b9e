// SPDX-License-Identifier: BSD-3-Clause
// Linear models against closed forms, natural frequencies and runs.
#include "limber/dynamics/analysis/linear_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "limber/common/dense/general_eigen.hpp"
#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/dynamics/analysis/steady_linearisation.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/joints/joint_kind.hpp"
#include "support/elastic_kinds.hpp"
#include "support/lattice_chain.hpp"
#include "support/linked_bodies.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::linear_system_test {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;

constexpr double kInertia = 0.4;
constexpr double kStiffness = 90.0;
constexpr double kDamping = 0.7;

/// A rotor on a hinge, turned by a drive and by a load.
struct Rotor {
  explicit Rotor(const joints::Drive::Parameters& drive) {
    SystemBuilder builder;
    const BodyIndex disc = builder.add_rigid_body(
        "disc", {2.0, Matrix3(Vector3(0.3, 0.3, kInertia).asDiagonal())});
    JointOptions options;
    options.held = {.translational_stiffness = 1e9,
                    .rotational_stiffness = 1e9};
    options.elements = {{0, joints::Drive(drive)}};
    builder.add_joint("hinge", joints::JointKind::revolute, {}, {.body = disc},
                      Vector3::UnitZ(), options);
    builder.add_load("push", builder.attach_frame("rim", disc, {}),
                     Vector3::Zero(), Vector3(0, 0, 5.0), LoadFrame::world,
                     Constant{});
    model = builder.build();
    state = make_state(model);
  }
  SystemModel model;
  SystemState state;
};

joints::Drive::Parameters make_position_drive() {
  return {.mode = joints::DriveMode::position,
          .stiffness = kStiffness,
          .damping = kDamping};
}

/// From an input to the motion of the hinge about z.
Complex find_gain(const LinearSystem& system, Index input, const Complex& s) {
  const Index n = system.A.rows();
  const Eigen::MatrixXcd pencil =
      s * Eigen::MatrixXcd::Identity(n, n) - system.A.cast<Complex>();
  const Eigen::VectorXcd z = dense::solve(
      pencil, Eigen::MatrixXcd(system.B.col(input).cast<Complex>()));
  return (system.links.row(5) * z)(0);
}

TEST(LinearSystem, OfADrivenRotorIsItsClosedForm) {
  const Rotor rotor(make_position_drive());
  const LinearSystem system = linearise(rotor.model, rotor.state);
  ASSERT_EQ(system.inputs.size(), 3U);
  EXPECT_EQ(system.inputs[0].name, "push");
  EXPECT_EQ(system.inputs[0].value, 1.0);
  EXPECT_EQ(system.inputs[1].name, "hinge");
  EXPECT_EQ(system.inputs[1].unit, "rad");
  EXPECT_EQ(system.inputs[2].name, "hinge.rate");
  for (const Complex s : {Complex(0, 0.1), Complex(0, 15), Complex(2, 40)}) {
    const Complex denominator = kInertia * s * s + kDamping * s + kStiffness;
    const double gains[] = {5.0, kStiffness, kDamping};
    for (Index i = 0; i < 3; ++i) {
      const Complex exact = gains[i] / denominator;
      EXPECT_LT(std::abs(find_gain(system, i, s) - exact),
                1e-9 * std::abs(exact));
    }
    // The drive's moment, and that of a command.
    const Complex held =
        (system.wrenches.row(5) *
         dense::solve(Eigen::MatrixXcd(s * Eigen::MatrixXcd::Identity(12, 12) -
                                       system.A.cast<Complex>()),
                      Eigen::MatrixXcd(system.B.col(1).cast<Complex>())))(0);
    const Complex moment = held + system.wrenches_by_input(5, 1);
    const Complex exact = kStiffness * kInertia * s * s / denominator;
    EXPECT_LT(std::abs(moment - exact), 1e-8 * kStiffness);
  }
}

TEST(LinearSystem, OfADriveAtItsLimitIsWithoutThatInput) {
  joints::Drive::Parameters drive = make_position_drive();
  drive.signal = {joints::ConstantSignal{1.0}};
  drive.max_effort = 10.0;
  const Rotor rotor(drive);
  const LinearSystem system = linearise(rotor.model, rotor.state);
  EXPECT_TRUE(system.inputs.at(1).force.isZero(0.0));
  EXPECT_EQ(system.inputs.size(), 2U);
}

// At rest: about a motion of free bodies, frequencies leave their drift out.
TEST(LinearSystem, HasTheEigenvaluesOfTheNaturalModes) {
  for (const auto& link : testing::make_all_links(2.0)) {
    const auto linked =
        testing::make_linked_bodies(link, {true, false, true}, 3, 0.0);
    const NaturalModes modes = find_natural_modes(linked.model, linked.state);
    const LinearSystem system = linearise(linked.model, linked.state);
    const Eigen::VectorXcd found =
        dense::find_general_eigenpairs(system.A, false).values;
    const double largest = found.cwiseAbs().maxCoeff();
    int count = 0;
    for (const NaturalMode& mode : modes.modes) {
      if (mode.value == 0.0) continue;
      EXPECT_LT((found.array() - mode.value).abs().minCoeff(), 1e-9 * largest)
          << link.name << " " << mode.value;
      ++count;
    }
    EXPECT_GE(count, 8) << link.name;
  }
}

VectorX accelerate(const SystemModel& model, const SystemState& state) {
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  VectorX a = make_unknowns(model);
  solve_accelerations(model, terms, a);
  return a;
}

/// The difference of two systems' accelerations as x'' of SmallMotion, over
/// `step`.
VectorX find_difference(const SystemModel& model, const SmallMotion& motion,
                        const SystemState& state, const VectorX& plus,
                        const VectorX& minus, double step) {
  VectorX xddot = VectorX::Zero(motion.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Index p = motion.places[b];
    const BodyModel& body = model.bodies[b];
    const VectorX change = plus - minus;
    xddot.segment<3>(p) = translation_rows(body, change);
    xddot.segment<3>(p + 3) =
        state.bodies[b].quat_WB * Vector3(rotation_rows(body, change));
    xddot.segment(motion.modes[b], body.modes) = mode_rows(body, change);
  }
  return xddot / step;
}

TEST(LinearSystem, HasTheLoadsOfDifferencesOfTheAccelerations) {
  constexpr double kStep = 1e-3;  // forces are linear in the inputs
  const auto linked = testing::make_linked_bodies(
      testing::link_joints("hinge", joints::JointKind::revolute, 2.0),
      {true, false, true}, 4, 1.0);
  SystemModel model = linked.model;
  for (const bool in_world : {false, true}) {
    model.loads.push_back({in_world ? "world" : "body",
                           AttachmentIndex(in_world ? 1 : 4), Vector3(3, -2, 1),
                           Vector3(0.5, 0.2, -1), in_world,
                           Pulse{PulseShape::rectangular, -1.0, 2.0}});
  }
  const LinearSystem system = linearise(model, linked.state);
  ASSERT_EQ(system.inputs.size(), 2U);
  const SmallMotion motion = find_small_motion(model, linked.state);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto change = [&](double h) {
      SystemModel changed = model;
      changed.loads[i].function = Constant{-1.0};
      changed.loads[i].force *= 1.0 + h;
      changed.loads[i].moment *= 1.0 + h;
      return accelerate(changed, linked.state);
    };
    const VectorX exact =
        find_difference(model, motion, linked.state, change(kStep),
                        change(-kStep), 2.0 * kStep);
    const VectorX found = dense::solve(motion.M, system.inputs[i].force);
    EXPECT_GT(exact.norm(), 0.1);
    EXPECT_LT((found - exact).norm(), 1e-9 * (1.0 + exact.norm()));
  }
}

/// Hinges with drives, and one along a path over all bodies.
testing::Link make_driven(joints::DriveMode mode, bool pulls_only,
                          double command) {
  const joints::Drive drive({.mode = mode,
                             .signal = {joints::ConstantSignal{command}},
                             .stiffness = 30.0,
                             .damping = 1.5,
                             .pulls_only = pulls_only});
  return {"driven", [=](SystemBuilder& builder, const testing::BodyEnds& ends) {
            testing::link_joints(
                "", joints::JointKind::revolute, 2.0,
                pulls_only ? std::vector<joints::JointElement>{}
                           : std::vector<joints::JointElement>{{0, drive}})
                .add(builder, ends);
            builder.add_path("rope", {ends.near[0], ends.far[1], ends.far[2]},
                             {drive});
          }};
}

TEST(LinearSystem, HasTheDrivesOfDifferencesOfTheAccelerations) {
  constexpr double kStep = 1e-3;
  constexpr double kCommand = 4.0;  // beyond the path's length: it pulls
  for (const auto mode :
       {joints::DriveMode::position, joints::DriveMode::velocity,
        joints::DriveMode::effort}) {
    for (const bool pulls_only : {false, true}) {
      if (pulls_only && mode != joints::DriveMode::effort) continue;
      const auto make = [&](double command) {
        return testing::make_linked_bodies(
            make_driven(mode, pulls_only, command), {true, false, true}, 4,
            1.0);
      };
      const auto linked = make(kCommand);
      const LinearSystem system = linearise(linked.model, linked.state);
      const SmallMotion motion = find_small_motion(linked.model, linked.state);
      VectorX force = VectorX::Zero(motion.size());
      std::size_t count = 0;
      for (const LinearInput& input : system.inputs) {
        if (input.name.find(".rate") != std::string::npos) continue;
        EXPECT_EQ(input.value, kCommand);
        force += input.force;
        ++count;
      }
      EXPECT_EQ(count, pulls_only ? 1U : 3U);
      const VectorX exact = find_difference(
          linked.model, motion, linked.state,
          accelerate(make(kCommand + kStep).model, linked.state),
          accelerate(make(kCommand - kStep).model, linked.state), 2.0 * kStep);
      const VectorX found = dense::solve(motion.M, force);
      EXPECT_GT(exact.norm(), 0.1);
      EXPECT_LT((found - exact).norm(), 1e-9 * (1.0 + exact.norm()));
    }
  }
}

// J s^2 -+ i spin J_p s + k = 0 of the circles of its tilts.
TEST(LinearSystem, OfASpinningDiscHasTheClosedFormsOfItsWhirls) {
  constexpr double kAcross = 0.02;
  constexpr double kPolar = 0.03;
  constexpr double kTilt = 50.0;
  constexpr double kSpin = 400.0;
  SystemBuilder builder;
  const BodyIndex disc = builder.add_rigid_body(
      "disc", {2.0, Matrix3(Vector3(kAcross, kAcross, kPolar).asDiagonal())});
  joints::Bushing::Parameters p;
  p.translational_stiffness = Vector3(8e3, 5e4, 1e6).asDiagonal();
  p.rotational_stiffness = Vector3(kTilt, kTilt, 0.0).asDiagonal();
  builder.add_coupler("bearings", joints::Bushing(p),
                      builder.attach_world("ground", {}),
                      builder.attach_frame("hub", disc, {}));
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B = Vector3(0, 0, kSpin);
  const LinearSystem system = linearise(model, state);
  EXPECT_TRUE(system.is_moving);
  EXPECT_TRUE(system.axes.w_W.isZero(0.0));
  EXPECT_EQ(system.free, 1);
  const double half = 0.5 * kSpin * kPolar / kAcross;
  const double root = std::hypot(half, std::sqrt(kTilt / kAcross));
  const Eigen::VectorXcd found =
      dense::find_general_eigenpairs(system.A, false).values;
  for (const double w : {root + half, root - half, std::sqrt(8e3 / 2.0),
                         std::sqrt(5e4 / 2.0), std::sqrt(1e6 / 2.0)}) {
    for (const Complex s : {Complex(0, w), Complex(0, -w)}) {
      EXPECT_LT((found.array() - s).abs().minCoeff(), 1e-9 * root) << s;
    }
  }
}

TEST(LinearSystem, IsNotOfUnreducedBodies) {
  testing::LatticeChain chain;
  chain.add(Fidelity::full);
  chain.join_world(1e4, 1.0);
  const SystemModel model = chain.build();
  SystemState state = make_state(model);
  place_nodes(model, {}, {}, state);
  try {
    (void)linearise(model, state);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("at level full"),
              std::string::npos);
  }
}

/// Two bodies that bend, one on a hinge on the world and one on the other, with
/// springs; at rest. A small force pushes the second from 0.1 s on.
struct Arm {
  explicit Arm(Fidelity level,
               const TimeFunction& function = StepSequence{{kStart}, {1.0}},
               double push = kPush) {
    const testing::PointMassBody body =
        testing::make_point_mass_body(20, 4, 3.0, 1.0, 8.0, 11);
    const auto near = testing::make_interface(body, 0, 6);
    const auto far = testing::make_interface(body, 6, 12);
    SystemBuilder builder;
    const auto reduced = testing::share(body);
    const auto first = builder.add_flexible_body("first", reduced, level, {});
    const auto second = builder.add_flexible_body("second", reduced, level, {});
    JointOptions options;
    options.held = {.translational_stiffness = 300.0,
                    .rotational_stiffness = 40.0,
                    .translational_damping = 1.0,
                    .rotational_damping = 1.0};
    options.elements = {
        {0, joints::ScalarSpring({.curve = joints::SpringCurve(
                                      {.stiffness = 20.0, .extensions = {}}),
                                  .damping = 0.1})}};
    const Pose at_near{Matrix3::Identity(), near.p_B};
    builder.add_joint("root", joints::JointKind::revolute, {.X_BF = at_near},
                      {.body = first, .X_BF = at_near, .interface = near},
                      Vector3::UnitY(), options);
    builder.add_joint(
        "elbow", joints::JointKind::revolute, {.body = first, .interface = far},
        {.body = second, .interface = far}, Vector3::UnitZ(), options);
    tip = builder.attach_interface("tip", second, near, at_near);
    builder.add_load("push", tip, push * Vector3(1, -2, 1), Vector3::Zero(),
                     LoadFrame::body, function);
    model = builder.build();
    state = make_state(model);
  }
  static constexpr double kPush = 1e-6;
  static constexpr double kStart = 0.1;
  AttachmentIndex tip;
  SystemModel model;
  SystemState state;
};

/// exp(A h), by scaling and squaring of a Taylor series.
MatrixX find_transition(const MatrixX& A, double h) {
  const int squarings =
      std::max(0, static_cast<int>(std::ceil(std::log2(A.norm() * h))) + 4);
  const MatrixX X = A * (h / std::pow(2.0, squarings));
  MatrixX sum = MatrixX::Identity(A.rows(), A.cols());
  MatrixX term = sum;
  for (int k = 1; k < 20; ++k) {
    term = (term * X / double(k)).eval();
    sum += term;
  }
  for (int k = 0; k < squarings; ++k) sum = (sum * sum).eval();
  return sum;
}

TEST(LinearSystem, RespondsToAStepAsASmallNonlinearRun) {
  constexpr double kEnd = 1.0;
  for (const Fidelity level :
       {Fidelity::uncoupled, Fidelity::one_way, Fidelity::coupled}) {
    const Arm arm(level);
    const LinearSystem system = linearise(arm.model, arm.state, {arm.tip});
    ASSERT_EQ(system.inputs.size(), 1U);
    EXPECT_EQ(system.inputs[0].value, 0.0);
    const Index n = system.A.rows();
    MatrixX with_input = MatrixX::Zero(n + 1, n + 1);
    with_input.topLeftCorner(n, n) = system.A;
    with_input.topRightCorner(n, 1) = system.B;
    const VectorX z =
        find_transition(with_input, kEnd - Arm::kStart).col(n).head(n);
    SimulationSettings settings;
    settings.integrator = IntegratorKind::runge_kutta_4;
    settings.step = 2e-4;
    settings.end_time = kEnd;
    settings.output_times = {kEnd};
    SystemState state = arm.state;
    simulate(arm.model, state, settings, [](const auto&, const auto&) {});
    const FrameMotion before = find_frame_motion(arm.model, arm.state, arm.tip);
    const FrameMotion after = find_frame_motion(arm.model, state, arm.tip);
    const Vector3 moved = after.X_WF.p - before.X_WF.p;
    const VectorX found = system.frames * z;
    const VectorX velocity = system.frame_velocities * z;
    EXPECT_GT(moved.norm(), 1e-8);
    EXPECT_LT((found.head<3>() - moved).norm(), 1e-6 * moved.norm());
    EXPECT_LT((velocity.head<3>() - after.v_WF_W).norm(),
              1e-6 * after.v_WF_W.norm());
    EXPECT_LT((velocity.tail<3>() - after.w_WF_W).norm(),
              1e-6 * after.w_WF_W.norm());
  }
}

// At level nonlinear what a body resists and how its frames move depend on its
// shape.
TEST(LinearSystem, AboutALoadedEquilibriumHasTheDifferencesOfTheAccelerations) {
  constexpr double kStep = 1e-5;
  for (const bool is_bent : {false, true}) {
    Arm arm(Fidelity::coupled, Constant{}, 2.0);
    if (is_bent) testing::bend(arm.model, 0.2);
    const SystemState state = find_equilibrium(arm.model, arm.state).state;
    EXPECT_GT(state.eta.norm(), 0.01);
    const LinearSystem system = linearise(arm.model, state);
    EXPECT_FALSE(system.imbalance.matters);
    const SteadyMotion steady = linearise_steadily(arm.model, state);
    const MatrixX& Q = steady.basis.Q;
    const Index n = Q.cols();
    const VectorX scale = system.A.topRightCorner(n, n).diagonal();
    const VectorX z = VectorX::LinSpaced(2 * n, -1.0, 1.3).array().sin();
    const VectorX x = Q * z.head(n).cwiseQuotient(scale);
    const VectorX rate = Q * z.tail(n);
    const auto move = [&](double h) {
      SystemState moved = state;
      for (std::size_t b = 0; b < moved.bodies.size(); ++b) {
        BodyState& at = moved.bodies[b];
        const Index p = steady.motion.places[b];
        const Quaternion q_BW = at.quat_WB.conjugate();
        at.p_WB += h * x.segment<3>(p);
        at.v_WB_W += h * rate.segment<3>(p);
        at.w_WB_B += h * (q_BW * Vector3(rate.segment<3>(p + 3)));
        at.quat_WB = at.quat_WB *
                     exp_quaternion(h * (q_BW * Vector3(x.segment<3>(p + 3))));
        const BodyModel& body = arm.model.bodies[b];
        const Index m = steady.motion.modes[b];
        moved.eta.segment(body.offset, body.modes) +=
            h * x.segment(m, body.modes);
        moved.etadot.segment(body.offset, body.modes) +=
            h * rate.segment(m, body.modes);
      }
      return accelerate(arm.model, moved);
    };
    const VectorX exact =
        find_difference(arm.model, steady.motion, state, move(kStep),
                        move(-kStep), 2.0 * kStep);
    const VectorX found = Q * (system.A * z).tail(n);
    EXPECT_GT(exact.norm(), 1.0);
    EXPECT_LT((found - exact).norm(), 1e-7 * exact.norm()) << is_bent;
  }
}

}  // namespace
}  // namespace limber::dynamics::linear_system_test
