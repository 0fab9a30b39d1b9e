// SPDX-License-Identifier: BSD-3-Clause
// Peaks, warnings and the energy audit as reported by the command.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::peaks_test {
namespace {

using nlohmann::json;
using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

/// The report's beam under a push that begins at once and stays.
void write_push(const Workspace& place, double output_interval,
                const std::string& level) {
  place.write(
      "push.toml",
      fmt::format("robot = '" LIMBER_SOURCE_DIR
                  "/models/beam.urdf'\n[time]\nduration = 0.1\nstep = 1e-4\n"
                  "output_interval = {}\n[fidelity]\ndefault = '{}'\n"
                  "[output]\npictures = false\n"
                  "[[load]]\nname = 'push'\nlink = 'beam'\ngroup = 'tip'\n"
                  "force = [1e3, 5e2, 0.0]\nframe = 'body'\n"
                  "time = {{ kind = 'constant' }}\n"
                  "[[probe]]\nname = 'bend'\nlink = 'beam'\nnode = 1\n"
                  "quantity = 'deformation'\n",
                  output_interval, level));
}

json run(const Workspace& place, const std::string& arguments) {
  const CommandResult result = place.limber("run " + arguments + " --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out, nullptr, false);
}

class PeaksAtLevel : public ::testing::TestWithParam<const char*> {};

TEST_P(PeaksAtLevel, AreTheSameWhateverTheOutputInterval) {
  const Workspace place;
  json first;
  for (const double interval : {0.0005, 0.002, 0.01, 0.05}) {
    write_push(place, interval, GetParam());
    const json probes = run(place, "push.toml --out o")["probes"];
    const json& bend = probes["bend.dx"];
    if (first.is_null()) first = bend;
    const double peak = first["peak"];
    ASSERT_NE(peak, 0.0);
    EXPECT_NEAR(bend["peak"].get<double>() / peak, 1.0, 0.01) << interval;
    EXPECT_NEAR(bend["peak_time"].get<double>(),
                first["peak_time"].get<double>(), 5e-4)
        << interval;
    EXPECT_GE(std::abs(bend["peak"].get<double>()),
              std::abs(bend["final"].get<double>()));
  }
}

TEST_P(PeaksAtLevel, OfLevelsAreTheSameWhateverTheOutputInterval) {
  const Workspace place;
  json first;
  for (const double interval : {0.0005, 0.002, 0.05}) {
    write_push(place, interval, GetParam());
    const json level = run(place, "push.toml --out o")["levels"][0];
    const json& peaks = level["peaks"];
    if (first.is_null()) first = peaks;
    for (const char* name :
         {"alpha", "omega", "alpha_plus_omega_squared", "nodal_inertial_force",
          "deformation", "displacement", "static_displacement_of_inertia"}) {
      const double peak = first[name]["value"];
      ASSERT_NE(peak, 0.0) << name;
      EXPECT_NEAR(peaks[name]["value"].get<double>() / peak, 1.0, 0.01)
          << name << " at " << interval;
      EXPECT_NEAR(peaks[name]["time"].get<double>(),
                  first[name]["time"].get<double>(), 5e-4)
          << name << " at " << interval;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, PeaksAtLevel,
                         ::testing::Values("uncoupled", "coupled"),
                         [](const auto& level) {
                           return std::string(level.param);
                         });

TEST(Peaks, StandInTheTextWithTheirTime) {
  const Workspace place;
  write_push(place, 0.05, "coupled");
  const json probes = run(place, "push.toml --out o")["probes"];
  const CommandResult text = place.limber("run push.toml --out o");
  EXPECT_THAT(text.out, HasSubstr(fmt::format(
                            "peak {:13.6g} m at {:.6g} s",
                            probes["bend.dx"]["peak"].get<double>(),
                            probes["bend.dx"]["peak_time"].get<double>())));
}

/// One rigid link on a hinge, released horizontally; 0.09 s are long for its
/// swing.
void write_pendulum(const Workspace& place, const std::string& integrator,
                    double step, const std::string& more = "") {
  place.write(
      "pendulum.urdf",
      "<robot name='p'><link name='world'/><link name='arm'><inertial>"
      "<origin xyz='0.5 0 0'/><mass value='1'/><inertia ixx='0.001' "
      "iyy='0.08' izz='0.08' ixy='0' ixz='0' iyz='0'/></inertial></link>"
      "<joint name='pin' type='continuous'><parent link='world'/>"
      "<child link='arm'/><axis xyz='0 1 0'/></joint></robot>");
  place.write("p.toml",
              fmt::format("robot = 'pendulum.urdf'\n[time]\nduration = 20\n"
                          "step = {}\nintegrator = '{}'\noutput_interval = 5\n"
                          "[gravity]\nacceleration = [0, 0, -9.81]\n"
                          "[output]\npictures = false\n{}",
                          step, integrator, more));
}

TEST(EnergyWarning, TellsWhatImplicitEulerTakesFromAPendulum) {
  const Workspace place;
  write_pendulum(place, "implicit-euler", 0.09);
  const CommandResult result = place.limber("run p.toml --out o --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("implicit-euler damps"));
  // A swing of 3.86 rad/s loses 11 % of its energy a step, 1 - 1 / (1 + w^2
  // h^2): after 222 steps nothing of it is left, and no damper took it.
  EXPECT_THAT(result.errors, ContainsRegex("in (body 'arm'|coupler 'pin')"));
  const json summary = json::parse(result.out, nullptr, false);
  EXPECT_GT(summary["energy"]["open_share"], 0.99);
  EXPECT_THAT(summary["energy"]["place"], AnyOf("body 'arm'", "coupler 'pin'"));
  EXPECT_THAT(summary["warnings"].dump(), HasSubstr("energy error: "));
}

// A ton that falls for 20 s 1 km away has 1.9e7 J, the pendulum 5.
TEST(EnergyWarning, IsNotSilencedByABodyThatFallsFarAway) {
  const Workspace place;
  write_pendulum(place, "implicit-euler", 0.09,
                 "[[projectile]]\nname = 'stone'\nradius = 1.0\n"
                 "mass = 1000.0\nposition = [1000.0, 0.0, 0.0]\n");
  const CommandResult result = place.limber("run p.toml --out o --json");
  EXPECT_THAT(result.errors, HasSubstr("energy error: "));
  EXPECT_THAT(result.errors, Not(HasSubstr("stone")));
  const json energy = json::parse(result.out, nullptr, false)["energy"];
  EXPECT_GT(energy["throughput"], 1e7);
  EXPECT_GT(energy["open_share"], 0.99);
  double errors = 0.0;
  for (const json& row : energy["rows"]) {
    if (row["name"] != "body 'stone'") errors += row["error"].get<double>();
  }
  // It hangs at rest, 0.5 m lower.
  EXPECT_NEAR(errors, -0.5 * 9.81, 0.05);
}

TEST(EnergyWarning, IsNotGivenWhereStepsAreShort) {
  const Workspace place;
  write_pendulum(place, "generalized-alpha", 0.002);
  const CommandResult result = place.limber("run p.toml --out o --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
}

TEST(LevelWarning, IsGivenWhereNoLinkIsFlexible) {
  const Workspace place;
  write_pendulum(place, "generalized-alpha", 0.002);
  const CommandResult result =
      place.limber("run p.toml --out o --json --fidelity coupled");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("changes nothing"));
  EXPECT_THAT(place.limber("run p.toml --out o --fidelity rigid").errors,
              Not(HasSubstr("changes nothing")));
}

}  // namespace
}  // namespace limber::test::peaks_test
