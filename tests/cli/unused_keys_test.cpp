// SPDX-License-Identifier: BSD-3-Clause
// Options without effect give warnings; contradictory ones are errors.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::unused_keys_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string kMaterial =
    " --youngs-modulus 200e9 --poisson-ratio 0.3 --density 8000 ";
const std::string kBeam = LIMBER_SOURCE_DIR "/meshes/beam579.msh";

/// A run of the report's beam with `time` and `more` in its scenario.
CommandResult run_beam(const Workspace& place, const std::string& time,
                       const std::string& more,
                       const std::string& arguments = "") {
  place.write("s.toml", "robot = '" LIMBER_SOURCE_DIR
                        "/models/beam.urdf'\n[time]\nduration = 0.01\n"
                        "step = 1e-3\n" +
                            time + "\n[output]\npictures = false\n" + more);
  return place.limber("run s.toml --out o " + arguments);
}

struct UnusedKey {
  const char* name;
  const char* time;
  const char* more;
  const char* warning;
};

class KeyWithoutEffect : public ::testing::TestWithParam<UnusedKey> {};

TEST_P(KeyWithoutEffect, IsReportedWithTheReasonAndInTheSummary) {
  const Workspace place;
  const CommandResult result =
      run_beam(place, GetParam().time, GetParam().more);
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr(GetParam().warning));
  EXPECT_THAT(result.errors, HasSubstr(" changes nothing: "));
  EXPECT_THAT(read_text(place.folder() / "o/summary.json"),
              HasSubstr(GetParam().warning));
}

INSTANTIATE_TEST_SUITE_P(
    , KeyWithoutEffect,
    ::testing::Values(
        UnusedKey{"RhoInf", "integrator = 'implicit-euler'\nrho_inf = 0.5", "",
                  "[time] rho_inf"},
        UnusedKey{"NewtonTolerance",
                  "integrator = 'runge-kutta-4'\nnewton_tolerance = 1e-9", "",
                  "[time] newton_tolerance"},
        UnusedKey{"NewtonIterations",
                  "integrator = 'splitting'\nnewton_iterations = 9", "",
                  "[time] newton_iterations"},
        UnusedKey{"MostSteps", "most_steps = 100", "", "[time] most_steps"},
        UnusedKey{"ExactModes", "exact_modes = false", "",
                  "[time] exact_modes"},
        UnusedKey{"LawOfFull", "", "[full]\nlaw = 'neo-hookean'\n",
                  "[full] law"},
        UnusedKey{"MassOfFull", "", "[full]\nmass = 'lumped'\n", "[full] mass"},
        UnusedKey{
            "DefaultLevel", "",
            "[fidelity]\ndefault = 'rigid'\nlinks = { beam = 'coupled' }\n",
            "[fidelity] default"},
        UnusedKey{"ZeroLoad", "",
                  "[[load]]\nname = 'none'\nlink = 'beam'\nnode = 1\n"
                  "force = [0, 0, 0]\ntime = { kind = 'constant' }\n",
                  "load 'none'"},
        UnusedKey{"LateLoad", "",
                  "[[load]]\nname = 'late'\nlink = 'beam'\nnode = 1\n"
                  "force = [1, 0, 0]\ntime = { kind = 'pulse', "
                  "shape = 'half-sine', start = 0.01, duration = 1 }\n",
                  "load 'late'"}),
    [](const auto& key) { return std::string(key.param.name); });

TEST(KeyWithAnEffect, IsNotReported) {
  const Workspace place;
  const CommandResult result = run_beam(
      place, "rho_inf = 0.5\nnewton_tolerance = 1e-9\nexact_modes = false",
      "[fidelity]\ndefault = 'uncoupled'\n[advice]\ndisplacement = 1.0\n"
      "[basis]\neigenmodes = 4\n");
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.errors, "");
}

void write_rigid_robot(const Workspace& place) {
  place.write("r.urdf",
              "<robot name='r'><link name='arm'><inertial><mass value='1'/>"
              "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
              "</inertial></link></robot>");
}

TEST(FolderOfReducedBodies, IsReportedToHaveNoEffectWithoutMeshes) {
  const Workspace place;
  write_rigid_robot(place);
  place.write("s.toml",
              "robot = 'r.urdf'\n[time]\nduration = 0.01\nstep = 1e-3\n"
              "[output]\npictures = false\n");
  const CommandResult asked = place.limber("run s.toml --out o --cache c");
  EXPECT_EQ(asked.status, 0) << asked.errors;
  EXPECT_THAT(asked.errors,
              HasSubstr("--cache 'c' changes nothing: no link has a mesh"));
  EXPECT_EQ(place.limber("run s.toml --out o").errors, "");
  EXPECT_EQ(run_beam(place, "", "", "--cache c").errors, "");
}

TEST(KeysOfFlexibleLinks, AreReportedWhereNoLinkIsFlexible) {
  const Workspace place;
  write_rigid_robot(place);
  place.write("s.toml",
              "robot = 'r.urdf'\n[time]\nduration = 0.01\nstep = 1e-3\n"
              "[fidelity]\ndefault = 'coupled'\n[basis]\neigenmodes = 3\n"
              "[advice]\ndisplacement = 1e-3\n[output]\npictures = false\n");
  const CommandResult result = place.limber("run s.toml --out o");
  EXPECT_EQ(result.status, 0) << result.errors;
  for (const char* key : {"[fidelity] default", "[basis]", "[advice]"}) {
    EXPECT_THAT(result.errors,
                HasSubstr(std::string(key) +
                          " changes nothing: no link of 'r.urdf' is flexible"));
  }
}

// Only modes move, which are known in closed form.
TEST(CheckpointInterval, IsReportedToHaveNoEffectWithoutSteps) {
  const Workspace place;
  place.write("r.urdf",
              "<robot name='r'><link name='beam'/><flexible link='beam'>"
              "<mesh file='" +
                  kBeam +
                  "'/><material youngs_modulus='200e9' poisson_ratio='0' "
                  "density='8000'/><basis eigenmodes='2'/>"
                  "<clamp group='root'/></flexible></robot>");
  place.write("s.toml",
              "robot = 'r.urdf'\n[time]\nduration = 0.01\nstep = 1e-3\n"
              "[fidelity]\ndefault = 'uncoupled'\n"
              "[output]\npictures = false\n");
  const std::string warning = "--checkpoint-interval changes nothing";
  const CommandResult asked =
      place.limber("run s.toml --out o --checkpoint-interval 5");
  EXPECT_EQ(asked.status, 0) << asked.errors;
  EXPECT_THAT(asked.errors, HasSubstr(warning));
  EXPECT_THAT(place.limber("run s.toml --out o").errors,
              Not(HasSubstr(warning)));
}

TEST(ContradictoryOptions, AreRefused) {
  const Workspace place;
  ASSERT_EQ(run_beam(place, "", "").status, 0);
  const auto expect_refused = [&](const std::string& arguments,
                                  const std::string& culprit) {
    const CommandResult result = place.limber(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.errors, HasSubstr(culprit));
  };
  expect_refused("compare s.toml --measure both", "--tolerance");
  expect_refused("info s.toml --unit 0.001", "--unit");
  expect_refused("operate " + kBeam + kMaterial + "--through 1 0 0",
                 "--through goes with");
  expect_refused("reduce " + kBeam + kMaterial + "-o b.h5 --rows interfaces",
                 "--interface");
#ifdef LIMBER_HAS_REFERENCE
  expect_refused("verify s.toml --refine 1 --stiffen 1,10", "--stiffen");
  place.write("t.toml", "robot = '" LIMBER_SOURCE_DIR
                        "/models/beam.urdf'\n[time]\nduration = 0.01\n"
                        "tolerance = 1e-6\n");
  expect_refused("verify t.toml --refine 1", "give --step");
#endif
}

}  // namespace
}  // namespace limber::test::unused_keys_test
