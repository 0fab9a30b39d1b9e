// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/scenario_writer.hpp"

#include <gmock/gmock.h>

#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/scenario/scenario_reader.hpp"
#include "places.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::scenario_writer_test {
namespace {

using test::input_error;
using test::TemporaryFile;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

const fs::path kModels = LIMBER_SOURCE_DIR "/models";

Overrides choose(dynamics::Fidelity level, int modes, double step) {
  Overrides overrides;
  overrides.fidelity = level;
  overrides.basis.eigenmodes = modes;
  overrides.basis.loads = true;
  overrides.step = step;
  return overrides;
}

/// The scenario read after it was rewritten to another folder.
Scene rewrite(const fs::path& file, const Overrides& overrides) {
  const fs::path folder =
      fs::temp_directory_path() / ("limber-chosen-" + std::to_string(getpid()));
  fs::create_directories(folder / "deep");
  std::ofstream(folder / "deep" / "chosen.toml")
      << rewrite_scenario(file, overrides, folder / "deep");
  const Scene scene = load_scene(folder / "deep" / "chosen.toml");
  fs::remove_all(folder);
  return scene;
}

TEST(ScenarioWriter, PutsAChoiceIntoAScenarioThatReadsBack) {
  const fs::path example = LIMBER_SOURCE_DIR "/examples/struck_finger.toml";
  const Scene chosen =
      rewrite(example, choose(dynamics::Fidelity::one_way, 4, 5e-4));
  const Scene original = load_scene(example);
  EXPECT_EQ(chosen.scenario.fidelity, dynamics::Fidelity::one_way);
  EXPECT_EQ(chosen.scenario.settings.step, 5e-4);
  EXPECT_EQ(chosen.scenario.settings.output_times,
            original.scenario.settings.output_times);
  ASSERT_EQ(chosen.robot.links.size(), original.robot.links.size());
  for (const Link& link : chosen.robot.links) {
    if (!link.flexible) continue;
    EXPECT_EQ(link.flexible->basis.eigenmodes, 4);
  }
  EXPECT_TRUE(fs::equivalent(chosen.scenario.robot, original.scenario.robot));
  EXPECT_EQ(chosen.scenario.loads.at(0).force,
            original.scenario.loads.at(0).force);
  EXPECT_EQ(chosen.scenario.probes.size(), original.scenario.probes.size());
  EXPECT_EQ(chosen.scenario.joints.at("elbow_3").position,
            original.scenario.joints.at("elbow_3").position);
}

TEST(ScenarioWriter, PutsAnIntegratorInPlaceOfTheFiles) {
  Overrides overrides;
  overrides.integrator = dynamics::IntegratorKind::implicit_euler;
  const Scene chosen =
      rewrite(LIMBER_SOURCE_DIR "/examples/struck_finger.toml", overrides);
  EXPECT_EQ(chosen.scenario.settings.integrator,
            dynamics::IntegratorKind::implicit_euler);
}

TEST(ScenarioWriter, WithoutAChoiceChangesNothingButThePaths) {
  const fs::path example = LIMBER_SOURCE_DIR "/examples/report_beam.toml";
  const Scene same = rewrite(example, {});
  const Scene original = load_scene(example);
  EXPECT_EQ(same.scenario.settings.step, original.scenario.settings.step);
  EXPECT_EQ(same.scenario.settings.output_times,
            original.scenario.settings.output_times);
  EXPECT_EQ(same.scenario.basis, BasisChoice{});
}

TEST(ScenarioWriter, LeadsFromTheNewFolderToEveryFile) {
  const TemporaryFile history("history.txt", "0 1\n1 2\n");
  const fs::path place = history.path().parent_path();
  const TemporaryFile file(
      "paths.toml",
      "robot = '" + fs::proximate(kModels / "beam.urdf", place).string() +
          "'\n[time]\nduration = 1.0\nstep = 0.1\n"
          "[initial.links.beam]\ndisplacement = 'u.txt'\n"
          "[[load]]\nname = 'a'\nlink = 'beam'\nnodal_forces = 'sub/f.txt'\n"
          "[[load]]\nname = 'b'\nlink = 'beam'\nnode = 1\nforce = [1, 0, 0]\n"
          "time = { kind = 'table', file = '" +
          history.path().filename().string() + "' }\n");
  const Scene scene = rewrite(file.path(), {});
  const auto resolve = [](const fs::path& path) {
    return fs::weakly_canonical(path);
  };
  EXPECT_EQ(resolve(scene.scenario.loads.at(0).nodal_forces),
            resolve(place / "sub" / "f.txt"));
  EXPECT_EQ(resolve(scene.scenario.link_starts.at("beam").displacement),
            resolve(place / "u.txt"));
}

TEST(ScenarioWriter, WritesDrivesReleasesAndCouplerProbesBackExactly) {
  const TemporaryFile history("history.txt", "0 0.1\n1 0.3\n");
  const TemporaryFile file(
      "drives.toml",
      "robot = 'r.urdf'\n[time]\nduration = 1.0\nstep = 0.1\n"
      "[[drive]]\njoint = 'j'\nmode = 'position'\nstiffness = 0.1\n"
      "max_effort = 0.3\nsignal = { kind = 'table', file = '" +
          history.path().filename().string() +
          "' }\nshaper = { kind = 'zvd', frequency = 0.7 }\n"
          "[[release]]\nlatch = 'l'\ntime = 0.7\n"
          "[[probe]]\nname = 'p'\ncoupler = 'j'\nquantity = 'moment'\n"
          "side = 'F'\nframe = 'M'\n");
  const fs::path folder =
      fs::temp_directory_path() / ("limber-drives-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "chosen.toml")
      << rewrite_scenario(file.path(), {}, folder);
  const Scenario chosen = read_scenario(folder / "chosen.toml");
  fs::remove_all(folder);
  const DriveSpec& drive = chosen.drives.at(0);
  EXPECT_EQ(drive.name, "j");
  EXPECT_EQ(drive.drive.stiffness, 0.1);
  EXPECT_EQ(drive.drive.max_effort, 0.3);
  EXPECT_EQ(std::get<joints::TableSignal>(drive.drive.signal.base).values,
            (std::vector<double>{0.1, 0.3}));
  ASSERT_EQ(drive.drive.signal.shaper.size(), 3U);
  EXPECT_EQ(drive.drive.signal.shaper[2].delay, 1.0 / 0.7);
  EXPECT_EQ(chosen.releases.at("l"), 0.7);
  const auto& probe = std::get<CouplerProbeSpec>(chosen.probes.at(0).of);
  EXPECT_EQ(probe.quantity, CouplerQuantity::moment);
  EXPECT_EQ(probe.side, ProbeSide::F);
  EXPECT_EQ(probe.axes, ProbeAxes::M);
}

TEST(ScenarioWriter, PutsAChoiceBeforeTheFilesLinkByLinkChoices) {
  const TemporaryFile file(
      "links.toml", "robot = '" + (kModels / "capture_arm.urdf").string() +
                        "'\n[time]\nduration = 1.0\n"
                        "steps = { from = [0, 0.5], size = [0.1, 0.2] }\n"
                        "[fidelity]\nlinks = { upper_1 = 'rigid' }\n"
                        "[basis.links.upper_1]\neigenmodes = 30\n"
                        "static_deformation = { loads = false, "
                        "interfaces = false }\n");
  const Overrides overrides = choose(dynamics::Fidelity::uncoupled, 2, 0.25);
  const Scene chosen = rewrite(file.path(), overrides);
  const Scene direct = load_scene(file.path(), overrides);
  EXPECT_TRUE(chosen.scenario.fidelity_of_link.empty());
  EXPECT_TRUE(chosen.scenario.settings.step_changes.empty());
  ASSERT_EQ(chosen.robot.links.size(), direct.robot.links.size());
  for (std::size_t i = 0; i < direct.robot.links.size(); ++i) {
    if (!direct.robot.links[i].flexible) continue;
    const auto& a = chosen.robot.links[i].flexible->basis;
    const auto& b = direct.robot.links[i].flexible->basis;
    EXPECT_EQ(a.eigenmodes, b.eigenmodes);
    EXPECT_EQ(a.interface_modes, b.interface_modes);
    EXPECT_EQ(a.load_modes, b.load_modes);
  }
}

TEST(ScenarioWriter, MakesRoomForAStepLongerThanTheOutputs) {
  const TemporaryFile file("long.toml",
                           "robot = '" + (kModels / "beam.urdf").string() +
                               "'\n[time]\nduration = 1.0\nstep = 0.1\n");
  Overrides overrides;
  overrides.step = 0.25;
  EXPECT_EQ(
      rewrite(file.path(), overrides).scenario.settings.output_times.size(),
      5U);
}

TEST(ScenarioWriter, NamesAFileThatItCannotRead) {
  EXPECT_THAT(input_error([] { (void)rewrite_scenario("no.toml", {}, "."); }),
              HasSubstr("no.toml"));
}

}  // namespace
}  // namespace limber::scene::scenario_writer_test
