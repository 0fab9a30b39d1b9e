// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "app/reducer.hpp"
#include "app/run_scene.hpp"
#include "results/energy_audit.hpp"
#include "unit/results/temporary_folder.hpp"

/// The energy of every scenario in examples/, each in full and at its own
/// level: initial + work of loads and drives = final + dissipated.
namespace limber {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> find_examples() {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::directory_iterator(LIMBER_SOURCE_DIR "/examples")) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

struct Audit {
  double drift = 0.0;  ///< the largest at any output over the throughput [-]
  bool has_latched = false;
};

/// Steps are `share` of the scenario's.
Audit audit(const fs::path& file, double share) {
  static const results::test::TemporaryFolder cache;  // reduces once
  scene::Scene scene = scene::load_scene(file);
  dynamics::SimulationSettings& settings = scene.scenario.settings;
  settings.step *= share;
  for (dynamics::StepChange& change : settings.step_changes) {
    change.step *= share;
  }
  const app::Run run =
      app::simulate_scene(scene, app::make_reducer({}), cache.path(), {});
  EXPECT_FALSE(run.failure);
  const auto& events = run.history.events;
  return {
      results::audit_energy(run.history).relative_largest().value_or(1.0),
      std::any_of(events.begin(), events.end(), [](const dynamics::Event& e) {
        return e.what == "latched";
      })};
}

// Half the step leaves a quarter of the drift where dampers or large rotations
// count, an eighth where only the default rho_inf = 0.9 takes energy from
// vibration, as of the report's beam: its damping ratio is of third order. A
// latch's damper begins with a jump in mid-step: first order at least, over two
// halvings, as what it leaves depends on where in its step the jump falls.
TEST(ExampleAudit, ClosesToAMillionthAtEveryScenariosStepAndAtSecondOrder) {
  constexpr double kRoundOff = 1e-10;
  const std::vector<fs::path> files = find_examples();
  ASSERT_GE(files.size(), 6U);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename());
    const auto [drift, has_latched] = audit(file, 1.0);
    EXPECT_LE(drift, 1e-6);
    if (drift < kRoundOff) continue;
    if (has_latched) {
      EXPECT_GE(drift / audit(file, 0.25).drift, 1.8 * 1.8);
      continue;
    }
    const double ratio = drift / audit(file, 0.5).drift;
    EXPECT_GE(ratio, 3.0);
    EXPECT_LE(ratio, 9.0);
  }
}

}  // namespace
}  // namespace limber
