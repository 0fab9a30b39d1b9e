// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/command.hpp"
#include "places.hpp"

/// `limber static`, and runs that start from an equilibrium.
namespace limber::test::static_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kBadInput = 2;

/// The report's beam clamped at its root, pulled sideways at its tip.
void write_clamped_beam(const Workspace& place, const std::string& force) {
  place.write("beam.urdf",
              "<robot name='beam'><link name='beam'/><flexible link='beam'>"
              "<mesh file='" LIMBER_SOURCE_DIR
              "/tests/data/beam/beam579_v41.msh'/><material "
              "youngs_modulus='200e9' poisson_ratio='0' density='8000'/>"
              "<clamp group='root'/><basis eigenmodes='10'/>"
              "<interface name='tip' group='tip'/></flexible></robot>\n");
  place.write("s.toml",
              "robot = 'beam.urdf'\n[time]\nduration = 1.0\nstep = 0.01\n"
              "[[load]]\nname = 'tip'\nlink = 'beam'\ninterface = 'tip'\n"
              "force = [" +
                  force +
                  ", 0, 0]\nframe = 'world'\n"
                  "[[probe]]\nname = 'tip'\nlink = 'beam'\ninterface = 'tip'\n"
                  "quantity = 'deformation'\n");
}

json read_summary(const Workspace& place) {
  return json::parse(read_text(place.folder() / "o/summary.json"));
}

double probe(const json& summary, const std::string& name) {
  return summary.at("probes").at(name).at("value").get<double>();
}

// tests/data/beam/static.csv: beam579, "own SVK 4pt" with 12 digits; another
// independent program has 0.98598972 and -0.11822246 with 8.
TEST(Static, BeamBentByAFifthAtLevelFullIsTheIndependentProgramsAnswer) {
  const Workspace place;
  write_clamped_beam(place, "4e8");
  const CommandResult r =
      place.limber("static s.toml --out o --fidelity full --cache c");
  ASSERT_EQ(r.status, 0) << r.errors;
  const json summary = read_summary(place);
  EXPECT_NEAR(probe(summary, "tip.dx"), 0.985989683796, 1e-9);
  EXPECT_NEAR(probe(summary, "tip.dz"), -0.118222457447, 1e-9);
  EXPECT_TRUE(summary.at("warnings").empty()) << summary.at("warnings");
  EXPECT_TRUE(std::filesystem::exists(place.folder() / "o/results.h5"));
  EXPECT_TRUE(std::filesystem::exists(place.folder() / "o/equilibrium.png"));
}

TEST(Static, BeamBentByAFifthAtLevelCoupledIsTooFarForIt) {
  const Workspace place;
  write_clamped_beam(place, "4e8");
  const CommandResult r = place.limber("static s.toml --out o --cache c");
  ASSERT_EQ(r.status, 0) << r.errors;
  EXPECT_THAT(
      r.errors,
      AllOf(HasSubstr(
                "link 'beam' was coupled; nonlinear is needed: it deforms by"),
            HasSubstr("beyond the linear limit")));
}

// The same, lin at 500 N: the static-deformation mode of the load is exact.
TEST(Static, SmallLoadHasTheLinearAnswer) {
  const Workspace place;
  write_clamped_beam(place, "500");
  const CommandResult r = place.limber("static s.toml --out o --cache c");
  ASSERT_EQ(r.status, 0) << r.errors;
  EXPECT_EQ(r.errors, "");
  EXPECT_NEAR(probe(read_summary(place), "tip.dx"), 1.27901468831e-06,
              1e-9 * 1.279e-6);
}

/// The same beam on a joint at the middle of its root.
void write_held_beam(const Workspace& place, const std::string& force) {
  write_clamped_beam(place, force);
  place.write("beam.urdf",
              "<robot name='beam'><link name='world'/><link name='beam'/>"
              "<joint name='mount' type='fixed'><parent link='world'/>"
              "<child link='beam'/></joint><flexible link='beam'>"
              "<mesh file='" LIMBER_SOURCE_DIR
              "/tests/data/beam/beam579_v41.msh'/><origin xyz='-0.5 -0.5 0'/>"
              "<material youngs_modulus='200e9' poisson_ratio='0' "
              "density='8000'/><attach joint='mount' interface='root'/>"
              "<basis eigenmodes='10'/><interface name='root' group='root'/>"
              "<interface name='tip' group='tip'/></flexible></robot>\n");
  std::string scenario = read_text(place.folder() / "s.toml");
  const std::string quantity = "quantity = 'deformation'\n";
  scenario.erase(scenario.find(quantity), quantity.size());
  place.write("s.toml", scenario);
}

// F L^3 / (3 E I) + F L / (5/6 G A), and what the joint and the root's freedom
// to warp add; the clamped beam of an independent program is the other bound.
TEST(Static, BeamOnAJointAtLevelFullHasTheClosedForm) {
  for (const double force : {1.0, 500.0}) {
    for (const char* method : {"newton", "relaxation"}) {
      const Workspace place;
      write_held_beam(place, fmt::format("{}", force));
      const CommandResult r = place.limber(fmt::format(
          "static s.toml --out o --fidelity full --cache c --method {}",
          method));
      ASSERT_EQ(r.status, 0) << r.errors;
      const double ux = probe(read_summary(place), "tip.ux");
      const double bend = force * 125.0 / (3.0 * 200e9 / 12.0);
      const double shear = force * 5.0 / (5.0 / 6.0 * 100e9);
      EXPECT_NEAR(ux, bend + shear, 0.015 * ux) << method;
      ASSERT_EQ(
          place.limber("static s.toml --out o --fidelity coupled --cache c")
              .status,
          0);
      EXPECT_NEAR(ux, probe(read_summary(place), "tip.ux"), 1e-4 * ux);
    }
  }
}

// CalculiX, nlgeom, clamped: the joint adds a little.
TEST(Static, BeamOnAJointBendsByAFifthAsAnIndependentProgramsClampedOne) {
  const Workspace place;
  write_held_beam(place, "4e8");
  const CommandResult r =
      place.limber("static s.toml --out o --fidelity full --cache c");
  ASSERT_EQ(r.status, 0) << r.errors;
  const json summary = read_summary(place);
  EXPECT_NEAR(probe(summary, "tip.ux"), 0.98598972, 0.02);
  EXPECT_NEAR(probe(summary, "tip.uz"), -0.11822246, 0.005);
}

// Those of a run would be gone.
TEST(Static, WithoutAFolderLeavesTheResultsOfARunAlone) {
  const Workspace place;
  write_clamped_beam(place, "1e6");
  for (const char* command : {"run", "static", "advise"}) {
    const CommandResult r =
        place.limber(fmt::format("{} s.toml --cache c", command));
    ASSERT_EQ(r.status, 0) << r.errors;
  }
  for (const char* file :
       {"s/results.h5", "s-static/results.h5", "s-advise/advice.json"}) {
    EXPECT_TRUE(std::filesystem::exists(place.folder() / "out" / file)) << file;
  }
}

TEST(Static, WithoutALoadSaysThatTheAnswerIsTrivial) {
  const Workspace place;
  write_clamped_beam(place, "0");
  const CommandResult r = place.limber("static s.toml --out o --cache c");
  EXPECT_EQ(r.status, kBadInput);
  EXPECT_THAT(r.errors, AllOf(HasSubstr("s.toml: nothing acts"),
                              HasSubstr("trivial equilibrium")));
}

// Round-off of stiff couplers is no load.
TEST(Static, ExamplesWithoutALoadAtTheirStartAreTrivial) {
  for (const char* name : {"four_bar", "slew"}) {
    const Workspace place;
    const CommandResult r = place.limber(
        fmt::format("static " LIMBER_SOURCE_DIR
                    "/examples/{}.toml --fidelity rigid --out o --cache c",
                    name));
    EXPECT_EQ(r.status, kBadInput) << r.out;
    EXPECT_THAT(r.errors, HasSubstr("trivial equilibrium"));
  }
}

// Four rods of 0.5 m, from along x; their hinges deflect by some um.
TEST(Static, ChainRelaxesUntilItHangs) {
  const Workspace place;
  const CommandResult r = place.limber(
      "static " LIMBER_SOURCE_DIR
      "/examples/pendulum_chain.toml --fidelity rigid --method relaxation "
      "--out o --cache c");
  ASSERT_EQ(r.status, 0) << r.errors;
  EXPECT_NEAR(probe(read_summary(place), "tip.ux"), -2.0, 1e-5);
  EXPECT_NEAR(probe(read_summary(place), "tip.uz"), -2.0, 1e-5);
}

TEST(Static, FreeBodyThatIsTurnedIsRefusedWithTheDirection) {
  const Workspace place;
  place.write("s.toml",
              "robot = '" LIMBER_SOURCE_DIR
              "/models/beam.urdf'\n[time]\nduration = 1.0\nstep = 0.01\n"
              "[[load]]\nname = 'twist'\nlink = 'beam'\ngroup = 'tip'\n"
              "moment = [0, 0, 5]\nframe = 'world'\n"
              "[initial]\nequilibrium = true\n");
  for (const char* command : {"static", "run"}) {
    const CommandResult r =
        place.limber(fmt::format("{} s.toml --out o --cache c", command));
    EXPECT_EQ(r.status, kBadInput);
    EXPECT_THAT(r.errors, AllOf(HasSubstr("body 'beam'"),
                                HasSubstr("moment of 5 N m about (0, 0, 1)")));
  }
}

/// An arm of a hub and a flat beam under gravity, held by its motor.
void write_arm(const Workspace& place, const std::string& initial) {
  place.write("s.toml",
              "robot = '" LIMBER_SOURCE_DIR
              "/models/slew_arm.urdf'\n[time]\nduration = 1.0\nstep = 0.001\n"
              "output_interval = 0.1\n"
              "[gravity]\nacceleration = [0, -9.81, 0]\n" +
                  initial +
                  "[[drive]]\njoint = 'shoulder'\nmode = 'position'\n"
                  "stiffness = 2e4\ndamping = 60.0\n"
                  "signal = { kind = 'constant', value = 0.0 }\n"
                  "[[probe]]\nname = 'tip'\nlink = 'beam'\ninterface = 'tip'\n"
                  "quantity = 'velocity'\n"
                  "[[probe]]\nname = 'turn'\nlink = 'beam'\ninterface = 'tip'\n"
                  "quantity = 'angular_velocity'\n");
}

double find_fastest(const Workspace& place) {
  double fastest = 0.0;
  const json summary = read_summary(place);
  for (const auto& [name, value] : summary.at("probes").items()) {
    fastest = std::max(fastest, std::abs(value.at("peak").get<double>()));
  }
  return fastest;
}

TEST(Static, RunFromAnEquilibriumStaysAtRestWhereOneWithoutRings) {
  for (const char* method : {"newton", "relaxation"}) {
    const Workspace place;
    write_arm(place, fmt::format("[initial]\nequilibrium = true\n"
                                 "equilibrium_method = '{}'\n",
                                 method));
    const CommandResult r = place.limber("run s.toml --out o --cache c");
    ASSERT_EQ(r.status, 0) << r.errors;
    EXPECT_LT(find_fastest(place), 1e-8) << method;
  }
  const Workspace place;
  write_arm(place, "");
  ASSERT_EQ(place.limber("run s.toml --out o --cache c").status, 0);
  EXPECT_GT(find_fastest(place), 1e-2);
}

TEST(Static, EquilibriumWithVelocitiesAndGravityAcrossThemIsRefused) {
  const Workspace place;
  write_arm(place,
            "[initial]\nequilibrium = true\n"
            "joints = { shoulder = { velocity = 1.0 } }\n");
  const CommandResult r = place.limber("run s.toml --out o --cache c");
  EXPECT_EQ(r.status, kBadInput);
  EXPECT_THAT(r.errors, HasSubstr("gravity across the axis of rotation"));
}

TEST(Static, EquilibriumOfWhatFliesWithoutTurningIsRefused) {
  const Workspace place;
  place.write("ball.urdf",
              "<robot name='b'><link name='body'><inertial><mass value='1'/>"
              "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
              "</inertial></link></robot>");
  const std::string head =
      "[initial]\nequilibrium = true\n[time]\nduration = 0.5\nstep = "
      "0.001\n";
  for (const std::string& moving :
       {head + "[[robot]]\nname = 'a'\nfile = 'ball.urdf'\n"
               "velocity = [1.0, 0.0, 0.0]\n",
        "robot = 'ball.urdf'\n" + head +
            "[[projectile]]\nname = 'p'\nradius = 0.1\nmass = 1\n"
            "position = [5, 0, 0]\nvelocity = [1, 0, 0]\n"}) {
    place.write("s.toml", moving);
    const CommandResult result = place.limber("run s.toml --out o");
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.errors, HasSubstr("moves without rotation"));
  }
}

TEST(Static, SteadyRotationIsNotFoundByRelaxation) {
  const Workspace place;
  const CommandResult r = place.limber(
      "frequencies '" LIMBER_SOURCE_DIR
      "/examples/blade.toml' --set initial.equilibrium_method=relaxation");
  EXPECT_EQ(r.status, kBadInput);
  EXPECT_THAT(r.errors, HasSubstr("relaxation is for systems at rest"));
}

// Lag and flap of a cantilever that turns as fast as sqrt(E I / (rho A L^4)),
// 3 and 6 times as fast: Wright et al., J. Appl. Mech. 49, 1982.
TEST(Static, BladeInSteadyRotationHasTheClosedFormFrequencies) {
  const Workspace place;
  const double unit = std::sqrt(1.4e4 / 1.2) / 100.0;
  for (const auto& [eta, lag, flap] :
       {std::array{1.0, 3.5432, 3.6817}, std::array{3.0, 3.7435, 4.7973},
        std::array{6.0, 4.2632, 7.3604}}) {
    const CommandResult r = place.limber(
        fmt::format("frequencies '{0}/examples/blade.toml' --json --cache c "
                    "--set initial.joints.axle.velocity={1:.17g} "
                    "--set drive.axle.signal.value={1:.17g}",
                    LIMBER_SOURCE_DIR, eta * unit));
    ASSERT_EQ(r.status, 0) << r.errors;
    EXPECT_EQ(r.errors, "");
    const json modes = json::parse(r.out).at("modes");
    const auto value = [&](std::size_t i) {
      return 2.0 * std::numbers::pi *
             modes.at(i).at("damped_frequency").get<double>() / unit;
    };
    EXPECT_NEAR(value(1), lag, 1e-4 * lag) << eta;  // after the hub's own
    EXPECT_NEAR(value(2), flap, 1e-4 * flap) << eta;
  }
}

}  // namespace
}  // namespace limber::test::static_test
