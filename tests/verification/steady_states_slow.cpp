// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "limber/app/options/reducer.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/runs/analyses/static_run.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/text/setting.hpp"
#include "places.hpp"
#include "support/temporary_folder.hpp"

/// Equilibria and steady rotations of flexible links against closed forms.
namespace limber::steady_states_slow {
namespace {

const std::filesystem::path kScenes =
    std::filesystem::path(LIMBER_SOURCE_DIR) / "tests/data/steady";

const std::filesystem::path& cache() {
  static const test::TemporaryFolder folder;  // reduces once
  return folder.path();
}

struct Blade {
  double speed;  ///< all in units of sqrt(E I / (rho A L^4))
  double flap;
  double lag;
};

TEST(SteadyStates, OfABladeHaveItsFlapAndLagFrequenciesAtHighSpeed) {
  const double unit = std::sqrt(14000.0 / (1.2 * 1e4));
  for (const Blade& blade :
       {Blade{8.0, 13.50739, 10.88345}, Blade{10.0, 16.60636, 13.25788},
        Blade{12.0, 19.72154, 15.65053}}) {
    SCOPED_TRACE(blade.speed);
    const std::string speed = std::to_string(blade.speed * unit);
    scene::Overrides overrides;
    overrides.settings = {
        scene::parse_setting("initial.joints.axle.velocity=" + speed),
        scene::parse_setting("drive.axle.signal.value=" + speed)};
    const scene::BuiltScene built = scene::build_system(
        scene::load_scene(kScenes / "blade.toml", overrides),
        app::make_reducer({}), cache());
    const auto modes =
        dynamics::find_natural_modes(built.model, built.initial).modes;
    const auto in_units = [&](std::size_t mode) {
      return 2.0 * std::numbers::pi * modes.at(mode).frequency() / unit;
    };
    EXPECT_NEAR(in_units(1), blade.lag, 1e-3 * blade.lag);
    EXPECT_NEAR(in_units(2), blade.flap, 1e-3 * blade.flap);
  }
}

TEST(SteadyStates, OfAFreeBarPulledInItsOwnAxesIsHookesLaw) {
  for (const char* frame : {"body", "world"}) {
    SCOPED_TRACE(frame);
    scene::Overrides overrides;
    for (const char* end : {"L", "R"}) {
      overrides.settings.push_back(
          scene::parse_setting(std::string("load.") + end + ".frame=" + frame));
    }
    const runs::StaticRun run = runs::find_static(
        scene::load_scene(kScenes / "bar_body.toml", overrides),
        dynamics::EquilibriumMethod::newton, app::make_reductions(cache(), {}),
        {});
    EXPECT_NEAR(run.history.probe_rows[0].at(0), 3.57143e-6, 1e-10);
  }
}

}  // namespace
}  // namespace limber::steady_states_slow
