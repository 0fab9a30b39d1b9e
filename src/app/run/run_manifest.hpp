// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/manifest.hpp"
#include "scene/scene.hpp"

namespace limber::app {

/// All that a run's results depend on, resolved: this program, the settings,
/// the system with its bodies, couplers and loads, the probes and the start.
[[nodiscard]] Manifest make_manifest(const scene::Scene& scene,
                                     const scene::BuiltScene& built);

}  // namespace limber::app
