// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/manifest.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::runs {

/// All inputs of a run's results, resolved: this program, the settings, the
/// system with its bodies, couplers and loads, the probes and the start.
[[nodiscard]] Manifest make_manifest(const scene::Scene& scene,
                                     const scene::BuiltScene& built);

}  // namespace limber::runs
