// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/coupler_probe.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::coupler_probe_test {
namespace {

using dynamics::SystemBuilder;
using dynamics::SystemModel;
using dynamics::SystemState;
using joints::JointKind;
using test::input_error;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Q = CouplerQuantity;

constexpr double kPi = std::numbers::pi;
constexpr double kRoundoff = 1e-12;
constexpr double kMass = 2.0;
constexpr double kInertia = 0.1;

std::vector<double> read(const SystemModel& model, const SystemState& state,
                         const CouplerProbeSpec& spec) {
  std::vector<double> values;
  append_values(make_coupler_probe(spec, model), model, state, values);
  return values;
}

Vector3 read_vector(const SystemModel& model, const SystemState& state,
                    const CouplerProbeSpec& spec) {
  const std::vector<double> values = read(model, state, spec);
  EXPECT_EQ(values.size(), 3U);
  return {values[0], values[1], values[2]};
}

/// A body whose origin is frame M; F is the pose X_WF of the world.
SystemModel make_system(const joints::CouplerLaw& law,
                        const Pose& X_WF = Pose{}) {
  SystemBuilder builder;
  const auto body =
      builder.add_rigid_body("body", {kMass, kInertia * Matrix3::Identity()});
  builder.add_coupler("c", law, builder.attach_world("F", X_WF),
                      builder.attach_frame("M", body, Pose{}));
  return builder.build();
}

joints::Joint make_hinge(std::vector<joints::JointElement> elements = {}) {
  joints::JointParameters parameters;
  parameters.translational_stiffness = 1e6;
  parameters.rotational_stiffness = 1e6;
  parameters.translational_damping = 100.0;
  parameters.rotational_damping = 100.0;
  return joints::make_joint(JointKind::revolute, Vector3::UnitZ(),
                            Vector3::UnitX(), parameters, std::move(elements));
}

// Frame F anyhow, the hinge anywhere, the weight below it by m g / k.
TEST(CouplerProbe, HingeCarriesTheWeightOnEachSideInEachFrame) {
  const Pose X_WF{exp_rotation(Vector3(0.4, -0.7, 1.1)), Vector3(1, 2, 3)};
  const SystemModel model = make_system(make_hinge(), X_WF);
  const Vector3 weight(0.0, 0.0, -9.81 * kMass);
  SystemState state = dynamics::make_state(model);
  const Matrix3 R_WM = X_WF.R * exp_rotation(Vector3(0.0, 0.0, 0.8));
  state.bodies[0].quat_WB = Quaternion(R_WM);
  state.bodies[0].p_WB = X_WF.p + weight / 1e6;
  for (const ProbeSide side : {ProbeSide::F, ProbeSide::M}) {
    const Vector3 held_W = side == ProbeSide::M ? Vector3(-weight) : weight;
    const auto force = [&](ProbeAxes axes) {
      return read_vector(model, state, {"c", Q::force, side, axes});
    };
    // k p loses the digits by which p is smaller than the position.
    const double roundoff = 1e6 * 1e-15 * 4.0;
    EXPECT_LT((force(ProbeAxes::world) - held_W).norm(), roundoff);
    EXPECT_LT((force(ProbeAxes::F) - X_WF.R.transpose() * held_W).norm(),
              roundoff);
    EXPECT_LT((force(ProbeAxes::M) - R_WM.transpose() * held_W).norm(),
              roundoff);
    EXPECT_LT(
        read_vector(model, state, {"c", Q::moment, side, ProbeAxes::world})
            .norm(),
        roundoff);
  }
  EXPECT_NEAR(read(model, state, {"c", Q::coordinate}).at(0), 0.8, 1e-9);
}

// Both sides' wrenches cancel about any point, here the world's origin.
TEST(CouplerProbe, SidesBalanceEachOther) {
  const Pose X_WF{exp_rotation(Vector3(0.4, -0.7, 1.1)), Vector3(1, 2, 3)};
  const SystemModel model = make_system(make_hinge(), X_WF);
  SystemState state = dynamics::make_state(model);
  state.bodies[0].p_WB = X_WF.p + Vector3(0.1, -0.2, 0.3);
  state.bodies[0].quat_WB =
      Quaternion(X_WF.R * exp_rotation(Vector3(0.1, 0.2, 0.3)));
  state.bodies[0].v_WB_W = Vector3(1, 2, 3);
  state.bodies[0].w_WB_B = Vector3(3, 2, 1);
  Vector3 total = Vector3::Zero();
  double size = 0.0;
  for (const ProbeSide side : {ProbeSide::F, ProbeSide::M}) {
    const Vector3& p = side == ProbeSide::F ? X_WF.p : state.bodies[0].p_WB;
    const Vector3 force =
        read_vector(model, state, {"c", Q::force, side, ProbeAxes::world});
    const Vector3 moment =
        read_vector(model, state, {"c", Q::moment, side, ProbeAxes::world});
    total += moment + p.cross(force);
    size += moment.norm();
  }
  EXPECT_GT(size, 1e4);
  EXPECT_LT(total.norm(), kRoundoff * size);
}

TEST(CouplerProbe, RelativeMotionIsThatOfMInF) {
  const Pose X_WF{exp_rotation(Vector3(0.0, 0.0, kPi / 2)), Vector3(1, 0, 0)};
  const SystemModel model = make_system(joints::Bushing({}), X_WF);
  SystemState state = dynamics::make_state(model);
  const Matrix3 R_FM = exp_rotation(Vector3(0.3, 0.0, 0.0));
  state.bodies[0].quat_WB = Quaternion(X_WF.R * R_FM);
  state.bodies[0].p_WB = Vector3(1, 2, 0);
  state.bodies[0].v_WB_W = Vector3(0, 0, 5);
  state.bodies[0].w_WB_B = Vector3(0, 1, 0);
  const auto near = [&](Q quantity, ProbeAxes axes, const Vector3& expected) {
    const Vector3 value =
        read_vector(model, state, {"c", quantity, ProbeSide::M, axes});
    EXPECT_LT((value - expected).norm(), kRoundoff) << value.transpose();
  };
  near(Q::relative_position, ProbeAxes::world, {0, 2, 0});
  near(Q::relative_position, ProbeAxes::F, {2, 0, 0});
  near(Q::relative_rotation, ProbeAxes::F, {0.3, 0, 0});
  near(Q::relative_velocity, ProbeAxes::F, {0, 0, 5});
  near(Q::relative_velocity, ProbeAxes::M, R_FM.transpose() * Vector3(0, 0, 5));
  near(Q::relative_angular_velocity, ProbeAxes::M, {0, 1, 0});
}

TEST(CouplerProbe, SpringTellsLengthTensionAndEnergy) {
  const SystemModel model = make_system(joints::PointSpring(
      {.stiffness = 800.0, .damping = 3.0, .free_length = 1.0}));
  SystemState state = dynamics::make_state(model);
  state.bodies[0].p_WB = Vector3(0.0, 1.1, 0.0);
  state.bodies[0].v_WB_W = Vector3(7.0, 2.0, 0.0);
  const auto value = [&](Q quantity) {
    return read(model, state, {"c", quantity}).at(0);
  };
  EXPECT_NEAR(value(Q::coordinate), 1.1, kRoundoff);
  EXPECT_NEAR(value(Q::coordinate_rate), 2.0, kRoundoff);
  EXPECT_NEAR(value(Q::effort), 800.0 * 0.1 + 3.0 * 2.0, 1e-10);
  EXPECT_NEAR(value(Q::energy), 0.5 * 800.0 * 0.01, 1e-11);
  EXPECT_NEAR(value(Q::dissipation), 3.0 * 4.0, 1e-11);
  EXPECT_EQ(value(Q::power), 0.0);
}

// c_d (s - w) = c w at the end: the drive's power is what both dampers burn.
TEST(CouplerProbe, PowerOfAVelocityDriveIsWhatDampingBurns) {
  const double c = 0.3;
  const double drive_c = 0.5;
  const double speed = 4.0;
  joints::Drive::Parameters drive;
  drive.mode = joints::DriveMode::velocity;
  drive.signal.base = joints::ConstantSignal{speed};
  drive.damping = drive_c;
  const SystemModel model = make_system(make_hinge(
      {{0, joints::Friction({.viscous = c})}, {0, joints::Drive(drive)}}));
  SystemState state = dynamics::make_state(model);
  dynamics::SimulationSettings settings;
  settings.step = 1e-2;
  settings.end_time = 40.0 * kInertia / (c + drive_c);
  dynamics::simulate(model, state, settings, {});
  const double rate = drive_c * speed / (c + drive_c);
  const auto value = [&](Q quantity) {
    return read(model, state, {"c", quantity}).at(0);
  };
  const double tolerance = 1e-9;  // of Newton's method
  EXPECT_NEAR(value(Q::coordinate_rate), rate, tolerance);
  EXPECT_NEAR(value(Q::effort), 0.0, tolerance);
  EXPECT_NEAR(value(Q::power), drive_c * (speed - rate) * speed, tolerance);
  EXPECT_NEAR(value(Q::dissipation), value(Q::power), tolerance);
}

TEST(CouplerProbe, CountsTwentyTurnsWithoutAJump) {
  joints::Drive::Parameters drive;
  drive.signal.base = joints::RampSignal{
      .to = 40.0 * kPi, .duration = 1.0, .shape = joints::RampShape::smooth};
  drive.stiffness = 1e4;
  drive.damping = 20.0;
  const SystemModel model =
      make_system(make_hinge({{0, joints::Drive(drive)}}));
  const CouplerProbe angle = make_coupler_probe({"c", Q::coordinate}, model);
  SystemState state = dynamics::make_state(model);
  dynamics::SimulationSettings settings;
  settings.step = 1e-3;
  settings.end_time = 1.5;
  for (int i = 0; i <= 150; ++i) settings.output_times.push_back(0.01 * i);
  std::vector<double> angles;
  dynamics::simulate(model, state, settings,
                     [&](const SystemState& now, const auto&) {
                       append_values(angle, model, now, angles);
                     });
  ASSERT_EQ(angles.size(), 151U);
  // 1.875 times the mean rate is the ramp's steepest; outputs are more than a
  // third of a turn apart there.
  const double steepest = 1.875 * 40.0 * kPi * 0.01;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    EXPECT_GT(angles[i] - angles[i - 1], -1e-3);
    EXPECT_LT(angles[i] - angles[i - 1], 1.05 * steepest);
  }
  EXPECT_NEAR(angles.back(), 40.0 * kPi, 1e-6);
}

TEST(CouplerProbe, TendonTellsLengthAndTensionAGearWhatItsTeethCarry) {
  SystemBuilder builder;
  const auto body =
      builder.add_rigid_body("body", {kMass, kInertia * Matrix3::Identity()});
  const auto hinge = builder.add_coupler(
      "hinge", make_hinge(), builder.attach_world("F", Pose{}),
      builder.attach_frame("M", body, Pose{}));
  const auto line = joints::ScalarSpring(
      {.curve = joints::SpringCurve({.stiffness = 50.0, .extensions = {}}),
       .rest = 2.0,
       .tension_only = true});
  builder.add_path("tendon",
                   {builder.attach_world("a", {Matrix3::Identity(), {0, 3, 0}}),
                    builder.attach_frame("b", body, Pose{})},
                   {line});
  const auto mesh = joints::ScalarSpring(
      {.curve = joints::SpringCurve({.stiffness = 9.0, .extensions = {}})});
  builder.add_joint_sum("gear", {{{hinge, 0, 2.0}}, 0.1}, {mesh});
  const SystemModel model = builder.build();
  SystemState state = dynamics::make_state(model);
  state.bodies[0].quat_WB = Quaternion(exp_rotation(Vector3(0, 0, 0.2)));
  const auto value = [&](const char* name, Q quantity) {
    return read(model, state, {name, quantity}).at(0);
  };
  EXPECT_NEAR(value("tendon", Q::coordinate), 3.0, kRoundoff);
  EXPECT_NEAR(value("tendon", Q::effort), 50.0, 1e-10);
  EXPECT_NEAR(value("tendon", Q::energy), 25.0, 1e-10);
  EXPECT_NEAR(value("gear", Q::coordinate), 2.0 * 0.2 - 0.1, kRoundoff);
  EXPECT_NEAR(value("gear", Q::effort), -9.0 * 0.3, 1e-11);
  const auto unit = [&](const char* name, Q quantity) {
    return column_names(make_coupler_probe({name, quantity}, model), "p")
        .at(0)
        .unit;
  };
  EXPECT_EQ(unit("tendon", Q::coordinate), "m");
  EXPECT_EQ(unit("gear", Q::effort), "N m");
  EXPECT_THAT(input_error([&] {
                (void)make_coupler_probe({"gear", Q::force}, model);
              }),
              HasSubstr("joins no two frames"));
}

std::vector<std::string> columns_of(const joints::CouplerLaw& law, Q quantity) {
  const SystemModel model = make_system(law);
  std::vector<std::string> columns;
  for (const ProbeColumnName& column :
       column_names(make_coupler_probe({"c", quantity}, model), "p")) {
    columns.push_back(column.name + " [" + column.unit + "]");
  }
  return columns;
}

TEST(CouplerProbe, ColumnsHaveTheUnitOfTheirCoordinate) {
  joints::JointParameters parameters;
  parameters.translational_stiffness = 1.0;
  const joints::Joint planar = joints::make_joint(
      JointKind::planar, Vector3::UnitZ(), Vector3::UnitX(), parameters);
  EXPECT_THAT(columns_of(planar, Q::coordinate),
              ElementsAre("p.q1 [m]", "p.q2 [m]", "p.q3 [rad]"));
  EXPECT_THAT(columns_of(planar, Q::effort),
              ElementsAre("p.effort1 [N]", "p.effort2 [N]", "p.effort3 [N m]"));
  EXPECT_THAT(columns_of(make_hinge(), Q::coordinate_rate),
              ElementsAre("p.qdot [rad/s]"));
  EXPECT_THAT(columns_of(make_hinge(), Q::moment),
              ElementsAre("p.tx [N m]", "p.ty [N m]", "p.tz [N m]"));
  EXPECT_THAT(columns_of(make_hinge(), Q::power), ElementsAre("p.power [W]"));
}

TEST(CouplerProbe, RefusesWhatIsNotThere) {
  const SystemModel model = make_system(joints::Bushing({}));
  EXPECT_THAT(input_error([&] {
                (void)make_coupler_probe({"d", Q::force}, model);
              }),
              HasSubstr("unknown coupler 'd'; did you mean 'c'"));
  EXPECT_THAT(input_error([&] {
                (void)make_coupler_probe({"c", Q::coordinate}, model);
              }),
              HasSubstr("leaves no coordinate free"));
}

}  // namespace
}  // namespace limber::scene::coupler_probe_test
