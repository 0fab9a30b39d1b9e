// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "limber/app/options/reducer.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/common/index.hpp"
#include "limber/runs/analyses/static_run.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "places.hpp"
#include "support/temporary_folder.hpp"

/// Joints without a given stiffness: scenes with answers that rigid joints
/// give, and the default stiffness halved and doubled.
namespace limber::default_joints_slow {
namespace {

namespace fs = std::filesystem;

const fs::path kScenes =
    fs::path(LIMBER_SOURCE_DIR) / "tests/data/default_joints";
const fs::path kExamples = fs::path(LIMBER_SOURCE_DIR) / "examples";

const fs::path& cache() {
  static const test::TemporaryFolder folder;  // reduces once
  return folder.path();
}

runs::Run simulate(const scene::Scene& scene) {
  runs::Run run = runs::simulate_scene(
      scene, {.reductions = app::make_reductions(cache(), {})});
  EXPECT_FALSE(run.failure);
  return run;
}

/// Final value of a column of a scene's equilibrium.
double find_static(const std::string& file, std::size_t column) {
  const runs::StaticRun run = runs::find_static(
      scene::load_scene(kScenes / file), dynamics::EquilibriumMethod::newton,
      app::make_reductions(cache(), {}), {});
  EXPECT_THAT(
      run.warnings,
      ::testing::Not(::testing::Contains(::testing::HasSubstr("joint '"))));
  return run.history.probe_rows[0].at(column);
}

TEST(DefaultJoints, StretchAPulledRodByNoMoreThanAPercent) {
  EXPECT_NEAR(find_static("pull.toml", 0), 4.762e-5, 0.01 * 4.762e-5);
}

TEST(DefaultJoints, LowerTheApexOfATrussByNoMoreThanAPercent) {
  EXPECT_NEAR(find_static("truss.toml", 2), -4.762e-5, 0.01 * 4.762e-5);
}

TEST(DefaultJoints, BendLeesFrameByNoMoreThanAPercent) {
  EXPECT_NEAR(find_static("lee.toml", 1), -0.04498, 0.01 * 0.04498);
}

TEST(DefaultJoints, ReturnARigidBarFromAStopWithItsRestitution) {
  const runs::Run run = simulate(scene::load_scene(kScenes / "stop.toml"));
  EXPECT_NEAR(run.history.probe_rows.back().at(0), -0.6, 0.006);
  EXPECT_THAT(run.statistics.warnings, ::testing::IsEmpty());
}

TEST(DefaultJoints, AreSlowForAnImpactOnlyIfGivenSoAndThenWarn) {
  scene::Scene scene = scene::load_scene(kScenes / "stop.toml");
  scene.robot.joints.at(0).coupler.translational_stiffness = 4e7;  // 1 kHz
  EXPECT_THAT(simulate(scene).statistics.warnings,
              ::testing::Contains(::testing::HasSubstr(
                  "joint 'hinge' is slow relative to the impact")));
}

TEST(DefaultJoints, ThatStoreMoreThanAPercentOfTheEnergyWarn) {
  scene::Scene scene = scene::load_scene(kScenes / "pull.toml");
  scene.robot.joints.at(0).coupler.translational_stiffness = 1e8;
  const runs::StaticRun run =
      runs::find_static(scene, dynamics::EquilibriumMethod::newton,
                        app::make_reductions(cache(), {}), {});
  EXPECT_THAT(run.warnings,
              ::testing::Contains(::testing::HasSubstr(
                  "joint 'root' is soft relative to the bodies")));
}

/// Gives each joint and loop without a stiffness `factor` times its default.
void scale_defaults(const scene::BuiltScene& built, double factor,
                    scene::Robot& robot) {
  const auto scale = [&](const std::string& name,
                         scene::CouplerOptions& options) {
    for (const dynamics::Coupler& coupler : built.model.couplers) {
      if (coupler.name != name) continue;
      const auto constraint = joints::find_constraint_stiffness(coupler.law);
      if (!constraint) continue;
      if (!options.translational_stiffness)
        options.translational_stiffness = factor * constraint->translational;
      if (!options.rotational_stiffness)
        options.rotational_stiffness = factor * constraint->rotational;
    }
  };
  for (scene::Joint& joint : robot.joints) scale(joint.name, joint.coupler);
  for (scene::Loop& loop : robot.loops) scale(loop.name, loop.coupler);
}

/// Largest absolute value of each column of the probes.
std::vector<double> find_peaks(const runs::Run& run) {
  std::vector<double> peaks;
  for (const auto& peak : run.record.peaks)
    peaks.push_back(std::abs(peak.value));
  return peaks;
}

/// "tip" of "tip.ux".
std::string find_probe(const results::ProbeColumn& column) {
  return column.name.substr(0, column.name.find('.'));
}

/// A hundredth of the largest peak of the same probe in the same unit:
/// components that are next to nothing have no accuracy of their own.
double find_allowed(const runs::Run& run, const std::vector<double>& peaks,
                    std::size_t column) {
  const auto& columns = run.history.columns;
  double largest = 0.0;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    if (columns[i].unit == columns[column].unit &&
        find_probe(columns[i]) == find_probe(columns[column])) {
      largest = std::max(largest, peaks[i]);
    }
  }
  return 0.01 * largest;
}

class DefaultStiffness : public ::testing::TestWithParam<fs::path> {};

TEST_P(DefaultStiffness, HalvedOrDoubledChangesNoPeakByMoreThanAPercent) {
  const scene::Scene scene = scene::load_scene(GetParam());
  const runs::Run run = simulate(scene);
  const std::vector<double> peaks = find_peaks(run);
  ASSERT_FALSE(peaks.empty());
  for (const double factor : {0.5, 2.0}) {
    SCOPED_TRACE(factor);
    scene::Scene other = scene;
    scale_defaults(run.built, factor, other.robot);
    const std::vector<double> changed = find_peaks(simulate(other));
    ASSERT_EQ(changed.size(), peaks.size());
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      EXPECT_NEAR(changed[i], peaks[i], find_allowed(run, peaks, i))
          << run.history.columns[i].name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, DefaultStiffness,
    ::testing::Values(
        kScenes / "pull.toml", kScenes / "truss.toml", kScenes / "stop.toml",
        kExamples / "ball_on_link.toml", kExamples / "beam_stress.toml",
        kExamples / "blade.toml", kExamples / "catch.toml",
        kExamples / "claw.toml", kExamples / "damped_slew.toml",
        kExamples / "four_bar.toml", kExamples / "joint_chain.toml",
        kExamples / "pendulum_chain.toml", kExamples / "self_strike.toml",
        kExamples / "slew.toml", kExamples / "spin_up.toml",
        kExamples / "struck_finger.toml"),
    [](const auto& scene) { return scene.param.stem().string(); });

}  // namespace
}  // namespace limber::default_joints_slow
