// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/contact_probe.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "limber/common/records/manifest.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/scene/probes/followed_probes.hpp"
#include "limber/scene/probes/probe_fields.hpp"
#include "unit/scene/scene_folder.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::contact_probe_test {
namespace {

using test::input_error;
using test::kWorld;
using test::SceneFolder;
using test::simulate_probes;
using test::time_table;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 0.1;
constexpr double kMass = 2.0;
constexpr double kYoungs = 1e9;
constexpr double kPoisson = 0.3;
constexpr double kDepth = 1e-3;
// Of a sphere on a rigid plane: 4/3 E/(1 - nu^2) sqrt(R).
const double kHertz =
    4.0 / 3.0 * kYoungs / (1.0 - kPoisson * kPoisson) * std::sqrt(kRadius);
const double kForce = kHertz * std::pow(kDepth, 1.5);

const std::string kFloor =
    "[[obstacle]]\nname = 'floor'\nshape = 'plane'\nnormal = [0.0, 0.0, 1.0]\n"
    "position = [0.0, 0.0, 0.0]\n";
const std::string kContact =
    "[[contact]]\nbetween = ['ball', 'floor']\nfriction = 0.3\n"
    "restitution = 1.0\n";

std::string ball_at(double x, double z, const std::string& more = "") {
  return fmt::format(
      "[[projectile]]\nname = 'ball'\nradius = {}\nmass = {}\nposition = "
      "[{}, 0.0, {:.12f}]\nyoungs_modulus = {}\npoisson_ratio = {}\n{}",
      kRadius, kMass, x, z, kYoungs, kPoisson, more);
}

std::string probe(const std::string& quantity,
                  const std::string& first = "floor",
                  const std::string& second = "ball") {
  return fmt::format(
      "[[probe]]\nname = '{0}{1}{2}'\ncontact = ['{1}', '{2}']\nquantity = "
      "'{0}'\n",
      quantity, first, second);
}

/// A ball that overlaps with the floor by a depth, or is above it.
BuiltScene build_ball(const SceneFolder& folder, double depth,
                      const std::string& probes, const std::string& more = "") {
  return folder.build(kWorld, time_table(1.5e-3, 5e-6) + kFloor + kContact +
                                  ball_at(0.4, kRadius - depth, more) + probes);
}

std::vector<double> evaluate(const BuiltScene& built) {
  return evaluate_all(built.probes, built.model, built.initial);
}

std::vector<double> read_ball(double depth, const std::string& probes) {
  const SceneFolder folder;
  return evaluate(build_ball(folder, depth, probes));
}

/// Two spheres 1 m apart on a rigid link, without material.
const std::string kDumbbell =
    "<link name='bell'><inertial><origin xyz='0.5 0 0'/><mass value='2'/>"
    "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
    "<collision><geometry><sphere radius='0.1'/></geometry></collision>"
    "<collision><origin xyz='1 0 0'/><geometry><sphere radius='0.1'/>"
    "</geometry></collision></link>\n";
const std::string kHard =
    "stiffness = 1e8\nfriction = 0.0\nrestitution = 1.0\n";

BuiltScene build_bell(const SceneFolder& folder, double z, double pitch,
                      const std::string& probes) {
  return folder.build(
      kDumbbell,
      time_table(0.01, 1e-5) + kFloor +
          fmt::format("[initial.base]\nposition = [0.0, 0.0, {:.12f}]\n"
                      "orientation_rpy = [0.0, {:.12f}, 0.0]\n",
                      z, pitch) +
          "[[contact]]\nbetween = ['bell', 'floor']\n" + kHard + probes);
}

TEST(ContactProbe, HasTheForceOfHertzOnTheBodyThatItNamesSecond) {
  const auto on_ball = read_ball(kDepth, probe("force"));
  ASSERT_EQ(on_ball.size(), 3U);
  EXPECT_NEAR(on_ball[2], kForce, 1e-9 * kForce);
  EXPECT_EQ(on_ball[0], 0.0);
  const auto on_floor = read_ball(kDepth, probe("force", "ball", "floor"));
  EXPECT_NEAR(on_floor[2], -kForce, 1e-9 * kForce);
}

TEST(ContactProbe, HasTheAreaAndEnergyOfHertz) {
  const auto values =
      read_ball(kDepth, probe("normal_force") + probe("area") +
                            probe("energy") + probe("friction_force"));
  EXPECT_NEAR(values[0], kForce, 1e-9 * kForce);
  EXPECT_NEAR(values[1], kPi * kRadius * kDepth, 1e-9 * kRadius * kDepth);
  EXPECT_NEAR(values[2], 0.4 * kForce * kDepth, 1e-9 * kForce * kDepth);
  EXPECT_EQ(values[3], 0.0);
}

TEST(ContactProbe, IsWhereTheBodiesOverlap) {
  const auto values =
      read_ball(kDepth, probe("place") + probe("depth") + probe("touching"));
  EXPECT_NEAR(values[0], 0.4, 1e-12);
  EXPECT_NEAR(values[1], 0.0, 1e-12);
  EXPECT_NEAR(values[2], -0.5 * kDepth, 1e-12);
  EXPECT_NEAR(values[3], kDepth, 1e-12);
  EXPECT_EQ(values[4], 1.0);
}

TEST(ContactProbe, IsZeroWhileApartAndTheDepthMinusTheDistance) {
  const std::string all = probe("force") + probe("normal_force") +
                          probe("friction_force") + probe("place") +
                          probe("area") + probe("energy") + probe("touching") +
                          probe("slipping");
  EXPECT_THAT(read_ball(-0.25, all), Each(0.0));
  EXPECT_NEAR(read_ball(-0.25, probe("depth")).at(0), -0.25, 1e-12);
}

TEST(ContactProbe, AddsUpAllShapesOfBothBodies) {
  const SceneFolder folder;
  const double pitch = 1e-3;
  // The second sphere is lower by sin(pitch), and so deeper.
  const double first = 1e-3;
  const double second = first + std::sin(pitch);
  const auto values = evaluate(build_bell(
      folder, kRadius - first, pitch,
      probe("force", "floor", "bell") + probe("normal_force", "floor", "bell") +
          probe("depth", "floor", "bell") + probe("place", "floor", "bell") +
          probe("energy", "floor", "bell") + probe("area", "floor", "bell")));
  const double f1 = 1e8 * std::pow(first, 1.5);
  const double f2 = 1e8 * std::pow(second, 1.5);
  EXPECT_NEAR(values[2], f1 + f2, 1e-9 * f2);
  EXPECT_NEAR(values[3], f1 + f2, 1e-9 * f2);
  EXPECT_NEAR(values[4], second, 1e-12);
  EXPECT_NEAR(values[5], std::cos(pitch), 1e-12);
  EXPECT_NEAR(values[7], -0.5 * second, 1e-12);
  EXPECT_NEAR(values[8], 0.4 * (f1 * first + f2 * second), 1e-9 * f2 * second);
  EXPECT_NEAR(values[9], kPi * kRadius * (first + second), 1e-12);
}

TEST(ContactProbe, TouchesIfOneShapeDoes) {
  const SceneFolder folder;
  const auto values = evaluate(build_bell(
      folder, kRadius + 1e-3, 2e-3,
      probe("touching", "bell", "floor") + probe("depth", "bell", "floor")));
  EXPECT_EQ(values[0], 1.0);
  EXPECT_NEAR(values[1], std::sin(2e-3) - 1e-3, 1e-12);
}

// Both links are one body to the system.
TEST(ContactProbe, TellsLinksOnFixedJointsApart) {
  const SceneFolder folder;
  const std::string mount =
      "<link name='mount'><collision><geometry><sphere radius='0.1'/>"
      "</geometry></collision></link>\n"
      "<joint name='m' type='fixed'><parent link='bell'/><child link='mount'/>"
      "<origin xyz='0 2 -0.002'/></joint>\n";
  const auto values = evaluate(folder.build(
      kDumbbell + mount,
      time_table(0.01, 1e-5) + kFloor +
          "[initial.base]\nposition = [0.0, 0.0, 0.101]\n[[contact]]\nbetween "
          "= ['*', 'floor']\n" +
          kHard + probe("depth", "bell", "floor") +
          probe("depth", "mount", "floor") + probe("force", "floor", "mount")));
  EXPECT_NEAR(values[0], -1e-3, 1e-12);
  EXPECT_NEAR(values[1], 1e-3, 1e-12);
  EXPECT_NEAR(values[4], 1e8 * std::pow(1e-3, 1.5), 1e-3);
}

// Newton's second law over one step: the impulse of the mean of both ends'
// forces, of second order in the step.
TEST(ContactProbe, ForceIsWhatChangesTheMomentum) {
  const SceneFolder folder;
  const BuiltScene built = build_bell(
      folder, kRadius - 1e-3, 1e-3,
      probe("force", "floor", "bell") +
          "[[probe]]\nname = 'v'\nlink = 'bell'\nquantity = 'velocity'\n"
          "point = [0.5, 0.0, 0.0]\n");
  dynamics::SimulationSettings settings = built.settings;
  settings.end_time = settings.step;
  dynamics::SystemState state = built.initial;
  dynamics::simulate(built.model, state, settings, {});
  const auto before = evaluate(built);
  const auto after = evaluate_all(built.probes, built.model, state);
  const double impulse = kMass * (after[5] - before[5]);
  const double force = 0.5 * (before[2] + after[2]);
  EXPECT_NEAR(impulse / settings.step, force, 1e-3 * force);
}

// Coulomb: mu of the normal force against the motion.
TEST(ContactProbe, SlidingBallHasCoulombsFriction) {
  const SceneFolder folder;
  const auto values = simulate_probes(folder.build(
      kWorld,
      time_table(2e-4, 1e-5) + kFloor + kContact +
          ball_at(0.4, kRadius - kDepth, "velocity = [20.0, 0.0, 0.0]") + "\n" +
          probe("force") + probe("normal_force") + probe("friction_force") +
          probe("slipping")));
  ASSERT_GT(values[3], 0.0);
  EXPECT_NEAR(values[4], 0.3 * values[3], 1e-9 * values[3]);
  EXPECT_NEAR(values[0], -0.3 * values[3], 1e-9 * values[3]);
  EXPECT_NEAR(values[2], values[3], 1e-9 * values[3]);
  EXPECT_EQ(values[5], 1.0);
}

// A face with 2 E* sqrt(S / pi) = 2.7e7 N/m touches for 0.43 ms.
TEST(ContactProbe, SlidingBoxHasCoulombsFriction) {
  const SceneFolder folder;
  const auto values = simulate_probes(folder.build(
      "<link name='box'><inertial><mass value='2'/><inertia ixx='1' iyy='1' "
      "izz='1' ixy='0' ixz='0' iyz='0'/></inertial><collision><geometry><box "
      "size='1 1 0.2'/></geometry></collision></link>\n",
      time_table(2e-4, 1e-5) + kFloor +
          "[initial.base]\nposition = [0.0, 0.0, 0.09999]\nvelocity = [3.0, "
          "0.0, 0.0]\n[[contact]]\nbetween = ['box', 'floor']\nstiffness = "
          "1e7\nfriction = 0.3\nrestitution = 1.0\n" +
          probe("normal_force", "floor", "box") +
          probe("friction_force", "floor", "box") +
          probe("force", "floor", "box")));
  ASSERT_GT(values[0], 0.0);
  EXPECT_NEAR(values[1], 0.3 * values[0], 1e-9 * values[0]);
  EXPECT_NEAR(values[2], -0.3 * values[0], 1e-9 * values[0]);
}

// Hertz's impact, d_p^(5/2) = 5 m v^2 / (4 k); 0.1 % is the integrator's. What
// jumps when both touch has no peak beyond its values.
TEST(ContactProbe, PeaksAreThoseOfHertzsImpact) {
  const SceneFolder folder;
  const BuiltScene built = build_ball(
      folder, -1e-4,
      probe("force") + probe("depth") + probe("touching") + probe("place"),
      "velocity = [0.0, 0.0, -1.0]\n");
  dynamics::SystemState state = built.initial;
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;
  dynamics::simulate(built.model, state, built.settings, {}, {}, statistics, {},
                     follow(built.probes, built.model), record);
  ASSERT_EQ(record.peaks.size(), 8U);
  const double depth = std::pow(1.25 * kMass / kHertz, 0.4);
  const double force = kHertz * std::pow(depth, 1.5);
  EXPECT_NEAR(record.peaks[2].value, force, 1e-3 * force);
  EXPECT_NEAR(record.peaks[3].value, depth, 1e-3 * depth);
  EXPECT_EQ(record.peaks[4].value, 1.0);
  EXPECT_NEAR(record.peaks[5].value, 0.4, 1e-9);
  EXPECT_NEAR(record.peaks[7].value, -0.5 * depth, 1e-3 * depth);
}

std::vector<std::string> columns_of(const std::string& quantity) {
  const SceneFolder folder;
  const BuiltScene built = build_ball(
      folder, -1.0,
      fmt::format("[[probe]]\nname = 'p'\ncontact = ['ball', 'floor']\n"
                  "quantity = '{}'\n",
                  quantity));
  std::vector<std::string> columns;
  for (const auto& [name, unit] : column_names(built.probes.at(0))) {
    columns.push_back(fmt::format("{} [{}]", name, unit));
  }
  return columns;
}

TEST(ContactProbe, NamesColumnsWithTheirUnits) {
  EXPECT_THAT(columns_of("force"),
              ElementsAre("p.fx [N]", "p.fy [N]", "p.fz [N]"));
  EXPECT_THAT(columns_of("place"),
              ElementsAre("p.px [m]", "p.py [m]", "p.pz [m]"));
  EXPECT_THAT(columns_of("normal_force"), ElementsAre("p.normal_force [N]"));
  EXPECT_THAT(columns_of("friction_force"),
              ElementsAre("p.friction_force [N]"));
  EXPECT_THAT(columns_of("depth"), ElementsAre("p.depth [m]"));
  EXPECT_THAT(columns_of("area"), ElementsAre("p.area [m^2]"));
  EXPECT_THAT(columns_of("energy"), ElementsAre("p.energy [J]"));
  EXPECT_THAT(columns_of("touching"), ElementsAre("p.touching [-]"));
  EXPECT_THAT(columns_of("slipping"), ElementsAre("p.slipping [-]"));
}

// What a run that goes on compares.
TEST(ContactProbe, IsInTheManifestWithItsBodiesAndQuantity) {
  const auto describe_probe = [](const std::string& quantity,
                                 const std::string& first,
                                 const std::string& second) {
    const SceneFolder folder;
    const BuiltScene built =
        build_ball(folder, -1.0,
                   fmt::format("[[probe]]\nname = 'p'\ncontact = ['{}', '{}']\n"
                               "quantity = '{}'\n",
                               first, second, quantity));
    Manifest manifest;
    describe(manifest, "probes", built.probes);
    return manifest.text();
  };
  const std::set<std::string> texts = {
      describe_probe("force", "ball", "floor"),
      describe_probe("force", "floor", "ball"),
      describe_probe("depth", "ball", "floor")};
  EXPECT_EQ(texts.size(), 3U);
  EXPECT_EQ(texts.count(describe_probe("depth", "ball", "floor")), 1U);
}

std::string error_of(const std::string& probes,
                     const std::string& contact = kContact) {
  const SceneFolder folder;
  return input_error([&] {
    (void)folder.load(kDumbbell, time_table(0.01, 1e-5) + kFloor + contact +
                                     ball_at(0.0, 1.0) + probes);
  });
}

TEST(ContactProbe, RefusesBodiesThatAreNotThere) {
  EXPECT_THAT(error_of(probe("force", "bal", "floor")),
              AllOf(HasSubstr("probe 'forcebalfloor'"),
                    HasSubstr("unknown body 'bal'; did you mean 'ball'")));
  EXPECT_THAT(error_of(probe("force", "ball", "flor")),
              HasSubstr("unknown body 'flor'; did you mean 'floor'"));
  EXPECT_THAT(error_of(probe("force", "b*", "floor")),
              HasSubstr("a probe takes no patterns"));
  EXPECT_THAT(error_of(probe("force", "ball", "ball")),
              HasSubstr("names 'ball' twice"));
}

TEST(ContactProbe, RefusesBodiesThatNoContactLetsTouch) {
  EXPECT_THAT(
      error_of(probe("force", "bell", "floor")),
      HasSubstr("no [[contact]] allows contact of 'bell' and 'floor'; those "
                "that may are 'ball' and 'floor'"));
  EXPECT_THAT(
      error_of(probe("force", "bell", "floor"), ""),
      HasSubstr("no [[contact]] allows contact of 'bell' and 'floor'; there "
                "is none"));
}

}  // namespace
}  // namespace limber::scene::contact_probe_test
