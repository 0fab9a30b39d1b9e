// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/shell.hpp"
#include "places.hpp"

/// Level `full` from the command line: the report's beam of 579 nodes.
namespace limber::test::full_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

struct SceneText {
  std::string modulus = "200e9";
  std::string duration = "0.001";
  std::string step = "0.0005";
  std::string time_more = {};
  std::string more = {};
  std::string force = "100.0";
};

/// Two beams end to end, "a" and "b"; "a" is struck at its root.
void write_scene(const Workspace& place, const SceneText& text) {
  const auto flexible = [&](const char* link, const char* end) {
    return fmt::format(
        "<flexible link='{}'>{}<basis eigenmodes='2'/>"
        "<interface name='root' group='root'/>"
        "<interface name='tip' group='tip'/>"
        "<attach joint='j' interface='{}'/></flexible>",
        link,
        "<mesh file='" LIMBER_SOURCE_DIR
        "/meshes/beam579.msh'/><material youngs_modulus='" +
            text.modulus + "' poisson_ratio='0' density='8000'/>",
        end);
  };
  place.write("robot.urdf",
              "<robot name='r'><link name='a'/><link name='b'/>"
              "<joint name='j' type='fixed'><parent link='a'/>"
              "<child link='b'/><origin xyz='0 0 5'/></joint>" +
                  flexible("a", "tip") + flexible("b", "root") + "</robot>\n");
  place.write(
      "s.toml",
      fmt::format("robot = 'robot.urdf'\n[time]\nduration = {}\nstep = {}\n{}\n"
                  "{}\n[[load]]\nname = 'push'\nlink = 'a'\ngroup = 'root'\n"
                  "force = [{}, 0.0, 0.0]\nframe = 'world'\n"
                  "time = {{ kind = 'constant' }}\n"
                  "[[probe]]\nname = 'p'\nlink = 'a'\nnode = 1\n",
                  text.duration, text.step, text.time_more, text.more,
                  text.force));
}

json read_summary(const Workspace& place) {
  return json::parse(read_text(place.folder() / "o/summary.json"));
}

// Neither the number of threads nor what else is around changes a bit.
TEST(FullRun, LeavesTheSameBytesWhateverTheThreads) {
  const Workspace place;
  write_scene(place, {.duration = "0.002",
                      .more = "[fidelity]\ndefault = 'full'\n"
                              "[output]\npictures = false\n",
                      .force = "1e5"});
  std::string first;
  for (const char* around :
       {"OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1",
        "OMP_NUM_THREADS=2 OPENBLAS_NUM_THREADS=2",
        "OMP_NUM_THREADS=3 OPENBLAS_NUM_THREADS=1 OMP_SCHEDULE=dynamic,1",
        "OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=4 OMP_DYNAMIC=true",
        "MALLOC_PERTURB_=85 LC_ALL=C TZ=Asia/Tokyo"}) {
    const CommandResult result =
        run_shell(place, std::string(around) + " '" LIMBER_COMMAND
                                               "' run s.toml --out o");
    ASSERT_EQ(result.status, 0) << result.errors;
    const std::string bytes = read_text(place.folder() / "o/results.h5");
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << around;
  }
}

TEST(FullRun, WritesWhatEveryRunWrites) {
  const Workspace place;
  write_scene(place, {.step = "0.00005"});
  const CommandResult result =
      place.limber("run s.toml --out o --fidelity full --xdmf");
  ASSERT_EQ(result.status, 0) << result.errors;
  for (const char* name :
       {"results.h5", "probes.csv", "summary.json", "motion.xdmf", "motion.h5",
        "energy.png", "scene.png"}) {
    EXPECT_TRUE(std::filesystem::exists(place.folder() / "o" / name)) << name;
  }
  const json summary = read_summary(place);
  EXPECT_EQ(summary["completed"], true);
  EXPECT_LT(std::abs(summary["energy"]["drift"].get<double>()),
            1e-2 * summary["energy"]["work"].get<double>());
}

TEST(FullRun, MixesWithOtherLevels) {
  const Workspace place;
  write_scene(place, {.more = "[fidelity]\nlinks = { a = 'full' }"});
  const CommandResult result = place.limber("run s.toml --out o");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json levels = read_summary(place)["levels"];
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_EQ(levels[0]["used"], "full");
  EXPECT_EQ(levels[1]["used"], "coupled");
}

TEST(FullRun, TellsItsStableStepAndKeepsBelowIt) {
  const Workspace place;
  write_scene(
      place, {.time_more = "integrator = 'central-differences'",
              .more = "[fidelity]\ndefault = 'full'\n[full]\nmass = 'lumped'"});
  const CommandResult result = place.limber("run s.toml --out o");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json summary = read_summary(place);
  const double stable = summary["stable_step"];
  EXPECT_GT(stable, 5e-7);
  EXPECT_LT(stable, 2e-5);
  EXPECT_GE(summary["steps"].get<double>(), 0.001 / stable);
}

TEST(FullRun, EndsWhereAnElementTurnsInsideOutAndKeepsWhatItHas) {
  for (const char* integrator : {"generalized-alpha", "central-differences"}) {
    const Workspace place;
    write_scene(place, {.modulus = "1e6",
                        .duration = "1.0",
                        .step = "0.001",
                        .time_more = fmt::format("integrator = '{}'\n"
                                                 "output_interval = 0.005",
                                                 integrator),
                        .more = "[fidelity]\ndefault = 'full'",
                        .force = "3e6"});
    const CommandResult result = place.limber("run s.toml --out o");
    EXPECT_EQ(result.status, 3) << integrator << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("'a' at t = 0.")) << integrator;
    EXPECT_THAT(result.errors, HasSubstr("element")) << integrator;
    const json summary = read_summary(place);
    EXPECT_EQ(summary["completed"], false);
    EXPECT_GT(summary["steps"], 0);
    EXPECT_THAT(read_text(place.folder() / "o/probes.csv"), HasSubstr("\n0,"));
    EXPECT_TRUE(std::filesystem::exists(place.folder() / "o/results.h5"));
  }
}

void expect_refused(const Workspace& place, const std::string& culprit) {
  const CommandResult result = place.limber("run s.toml --out o");
  EXPECT_EQ(result.status, 2) << result.errors;
  const std::size_t error = result.errors.find("limber: error: ");
  ASSERT_NE(error, std::string::npos) << result.errors;
  const std::string text = result.errors.substr(error);  // behind warnings
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  EXPECT_THAT(text, HasSubstr(culprit));
}

TEST(FullRun, NamesTheNearestLaw) {
  const Workspace place;
  write_scene(place, {.more = "[full]\nlaw = 'neohookean'"});
  expect_refused(place, "neo-hookean");
}

TEST(FullRun, RefusesIntegratorsThatKnowModesAlone) {
  for (const std::string name :
       {"explicit-euler", "energy-conserving", "splitting"}) {
    const Workspace place;
    write_scene(place, {.time_more = "integrator = '" + name + "'",
                        .more = "[fidelity]\ndefault = 'full'"});
    expect_refused(place, name + " does not integrate");
  }
}

TEST(FullRun, RefusesASavedReducedBody) {
  const Workspace place;
  ASSERT_EQ(place
                .limber("reduce " LIMBER_SOURCE_DIR
                        "/meshes/beam579.msh --youngs-modulus 200e9 "
                        "--poisson-ratio 0 --density 8000 --modes 2 "
                        "--output body.h5")
                .status,
            0);
  place.write("robot.urdf",
              "<robot name='r'><link name='a'/><flexible link='a'>"
              "<reduced file='body.h5'/></flexible></robot>\n");
  place.write("s.toml",
              "robot = 'robot.urdf'\n[time]\nduration = 0.001\nstep = 5e-4\n"
              "[fidelity]\ndefault = 'full'\n");
  expect_refused(place, "link 'a': level full needs its mesh");
}

}  // namespace
}  // namespace limber::test::full_test
