// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "limber/reduction/reduce.hpp"
#include "limber/reference/verification.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "places.hpp"
#include "unit/results/temporary_folder.hpp"

/// The shipped models, rigid, struck as in their examples, by Simbody and us.
namespace limber::reference::shipped_models_slow {
namespace {

const std::filesystem::path kExamples = LIMBER_SOURCE_DIR "/examples";

Verification run(const scene::Scene& scene, JointModel joints,
                 int refinements) {
  static const results::test::TemporaryFolder cache;  // reduces once
  return verify(
      scene, scene::build_system(scene, flexbody::make_reducer(), cache.path()),
      {{joints, 1e-12}, refinements});
}

struct Example {
  const char* file;
  double duration;  ///< past the strike and its 10 ms [s]
  double step;      ///< ours [s]
};

void PrintTo(const Example& example, std::ostream* out) {
  *out << example.file;
}

class ShippedModel : public ::testing::TestWithParam<Example> {
 protected:
  static scene::Scene load() {
    const auto& [file, duration, step] = GetParam();
    scene::Scene scene = scene::load_scene(
        kExamples / file, {.fidelity = dynamics::Fidelity::rigid});
    dynamics::SimulationSettings& settings = scene.scenario.settings;
    settings.integrator = dynamics::IntegratorKind::runge_kutta_4;
    settings.step = step;
    settings.step_changes.clear();
    settings.end_time = duration;
    std::erase_if(settings.output_times,
                  [end = duration](double t) { return t > end; });
    return scene;
  }
};

// Both converged: halving our step changes no digit that counts.
TEST_P(ShippedModel, AgreesWithSimbodyOnEqualBushings) {
  const Verification result = run(load(), JointModel::bushings, 1);
  ASSERT_GT(result.motion.position, 0.0);
  for (const Agreement& r : result.runs) {
    EXPECT_LT(find_relative(r.largest, result.motion), 1e-6);
    EXPECT_LT(r.energy, 1e-6 * result.energy);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ShippedModel,
    ::testing::Values(Example{"report_beam.toml", 0.1, 1e-4},
                      Example{"struck_finger.toml", 0.02, 1e-6}));

/// The capture arm with joints of `k` N/m, and N m/rad for every square
/// centimetre, so well damped that the strike leaves no vibration.
scene::Scene load_arm(double k) {
  scene::Scene scene =
      scene::load_scene(kExamples / "struck_finger.toml",
                        {.fidelity = dynamics::Fidelity::rigid});
  for (scene::Joint& joint : scene.robot.joints) {
    joint.coupler.translational_stiffness = k;
    joint.coupler.rotational_stiffness = 1e-4 * k;
    joint.coupler.translational_damping = std::sqrt(k);
    joint.coupler.rotational_damping = 0.5 * std::sqrt(1e-4 * k);
  }
  dynamics::SimulationSettings& settings = scene.scenario.settings;
  settings.step = 1e-5;
  settings.step_changes.clear();
  settings.end_time = 0.03;
  settings.output_times = {0.009, 0.019, 0.03};
  return scene;
}

TEST(CaptureArm, StiffeningConvergesToSimbodysHingesAtFirstOrder) {
  std::vector<Magnitudes> difference;
  for (const double k : {1e10, 1e11, 1e12}) {
    difference.push_back(
        run(load_arm(k), JointModel::ideal, 0).runs[0].largest);
  }
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_NEAR(std::log10(difference[i - 1].position / difference[i].position),
                1.0, 0.1);
    EXPECT_NEAR(std::log10(difference[i - 1].rotation / difference[i].rotation),
                1.0, 0.1);
  }
}

}  // namespace
}  // namespace limber::reference::shipped_models_slow
