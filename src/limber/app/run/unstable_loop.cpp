// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/unstable_loop.hpp"

#include "limber/app/console/terminal.hpp"
#include "limber/scene/control/closed_loop.hpp"

namespace limber::app {

std::optional<std::string> find_unstable_loop(const scene::Scene& scene,
                                              const scene::BuiltScene& built,
                                              const Progress& progress) {
  return scene::describe_unstable_loop(
      scene.scenario, built.model, built.initial, built.probes, built.settings,
      delay_progress(progress));
}

}  // namespace limber::app
