// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/command.hpp"
#include "places.hpp"

/// `limber frequencies`.
namespace limber::test::frequencies_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kBadInput = 2;

/// A bar of 2 kg and 0.3 kg m^2 that hangs on a hinge 0.6 m above its centre.
void write_pendulum(const Workspace& place, const std::string& initial) {
  place.write("robot.urdf",
              "<robot name='r'><link name='world'/><link name='bar'><inertial>"
              "<origin xyz='0 0 -0.6'/><mass value='2'/><inertia ixx='0.3' "
              "iyy='0.3' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial></link>"
              "<joint name='hinge' type='continuous'><parent link='world'/>"
              "<child link='bar'/><axis xyz='1 0 0'/></joint></robot>\n");
  place.write("s.toml",
              "robot = 'robot.urdf'\n[time]\nduration = 1.0\nstep = 0.01\n"
              "[gravity]\nacceleration = [0, 0, -9.81]\n" +
                  initial);
}

TEST(Frequencies, OfAPendulumOnADefaultHingeAreItsClosedForm) {
  const Workspace place;
  write_pendulum(place, "[initial]\nequilibrium = true\n");
  const CommandResult r = place.limber("frequencies s.toml --json");
  ASSERT_EQ(r.status, 0) << r.errors;
  const json modes = json::parse(r.out).at("modes");
  const double w = std::sqrt(2.0 * 9.81 * 0.6 / (0.3 + 2.0 * 0.36));
  EXPECT_NEAR(modes.at(0).at("frequency").get<double>(),
              w / (2.0 * std::numbers::pi), 1e-3);
  EXPECT_FALSE(modes.at(0).at("moves_freely").get<bool>());
  EXPECT_TRUE(json::parse(r.out).at("warnings").empty());
}

// A rigid body has six, of which the request for the lowest two is met.
TEST(Frequencies, FewerThanAskedForAreCounted) {
  const Workspace place;
  write_pendulum(place, "[initial]\nequilibrium = true\n");
  const CommandResult many =
      place.limber("frequencies s.toml --count 7 --json");
  ASSERT_EQ(many.status, 0) << many.errors;
  EXPECT_EQ(json::parse(many.out).at("modes").size(), 6U);
  EXPECT_THAT(many.errors, HasSubstr("--count 7: there are 6"));
  const CommandResult few = place.limber("frequencies s.toml --count 2");
  EXPECT_EQ(few.status, 0);
  EXPECT_EQ(few.errors, "");
}

TEST(Frequencies, OfFreeMotionsAreOneRow) {
  const Workspace place;
  place.write("robot.urdf",
              "<robot name='r'><link name='bar'><inertial><mass value='2'/>"
              "<inertia ixx='0.3' iyy='0.3' izz='0.1' ixy='0' ixz='0' iyz='0'/>"
              "</inertial></link></robot>\n");
  place.write("s.toml",
              "robot = 'robot.urdf'\n[time]\nduration = 1.0\nstep = 0.01\n");
  const CommandResult result = place.limber("frequencies s.toml");
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.out, HasSubstr("1-6"));
  EXPECT_THAT(result.out, HasSubstr("6 free motions\n"));
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3);
}

TEST(Frequencies, SayThatAStartIsNoEquilibriumAndByHowMuch) {
  const Workspace place;
  write_pendulum(place, "");
  const CommandResult r = place.limber("frequencies s.toml --json");
  ASSERT_EQ(r.status, 0) << r.errors;
  EXPECT_THAT(r.errors,
              AllOf(HasSubstr("not an equilibrium"),
                    HasSubstr("forces accelerate body 'bar' (mass times root "
                              "mean square acceleration: 19.62 N)")));
  EXPECT_NEAR(json::parse(r.out).at("residual_force").get<double>(), 19.62,
              1e-3);
}

TEST(Frequencies, OfAMovingStartAreAboutItsMotion) {
  const Workspace place;
  place.write("robot.urdf",
              "<robot name='r'><link name='top'><inertial><mass value='3'/>"
              "<inertia ixx='1.0' iyy='2.0' izz='2.5' ixy='0' ixz='0' iyz='0'/>"
              "</inertial></link></robot>\n");
  place.write("s.toml",
              "robot = 'robot.urdf'\n[time]\nduration = 1.0\nstep = 0.01\n"
              "[initial.base]\nangular_velocity = [0, 7, 0]\n");
  const CommandResult r = place.limber("frequencies s.toml");
  ASSERT_EQ(r.status, 0) << r.errors;
  // Euler: 7 sqrt((2.5 - 2) (2 - 1) / 2.5)
  EXPECT_THAT(r.out, AllOf(HasSubstr("about the motion at the start"),
                           HasSubstr("unstable, grows as exp(3.13 t)")));
}

TEST(Frequencies, OfAWholeMeshAreRefusedWithTheTrueReason) {
  const Workspace place;
  place.write("beam.urdf",
              "<robot name='beam'><link name='beam'/><flexible link='beam'>"
              "<mesh file='" LIMBER_SOURCE_DIR
              "/tests/data/beam/beam579_v41.msh'/><material "
              "youngs_modulus='200e9' poisson_ratio='0' density='8000'/>"
              "<basis eigenmodes='2'/></flexible></robot>\n");
  place.write("s.toml",
              "robot = 'beam.urdf'\n[time]\nduration = 1.0\nstep = 0.01\n");
  const CommandResult r = place.limber("frequencies s.toml --fidelity full");
  EXPECT_EQ(r.status, kBadInput);
  EXPECT_THAT(r.errors, AllOf(HasSubstr("1737 coordinates"),
                              HasSubstr("--fidelity coupled"),
                              Not(HasSubstr("built without"))));
}

}  // namespace
}  // namespace limber::test::frequencies_test
