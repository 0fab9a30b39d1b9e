// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "limber/app/options/reducer.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/dynamics/monitors/energy_verdict.hpp"
#include "limber/results/energy_error.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "places.hpp"
#include "unit/results/temporary_folder.hpp"

/// The energy of every scenario in examples/, each in full and at its own
/// level: initial + work of loads and drives = final + dissipated.
namespace limber::verification {

inline std::vector<std::filesystem::path> find_examples() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(LIMBER_SOURCE_DIR "/examples")) {
    const std::string name = entry.path().filename();
    if (name.ends_with(".toml") && !name.ends_with("_study.toml")) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

struct Audit {
  double drift = 0.0;  ///< the largest at any output over the throughput [-]
  double drift_of_all_steps = 0.0;  ///< the largest at any step likewise [-]
  bool has_latched = false;
};

inline Audit audit_scene(const scene::Scene& scene) {
  static const results::test::TemporaryFolder cache;  // reduces once
  const runs::Run run = runs::simulate_scene(
      scene, {.reductions = app::make_reductions(cache.path(), {})});
  EXPECT_FALSE(run.failure);
  const auto& events = run.history.events;
  const dynamics::EnergyRecord& energy = run.record.energy;
  return {
      results::find_energy_error(run.history).relative_largest().value_or(1.0),
      std::abs(energy.worst.drift.value) / energy.worst.throughput,
      std::any_of(events.begin(), events.end(), [](const dynamics::Event& e) {
        return e.what == "latched";
      })};
}

}  // namespace limber::verification
