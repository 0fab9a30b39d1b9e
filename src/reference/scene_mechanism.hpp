// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reference/mechanism.hpp"
#include "scene/scene.hpp"

namespace limber::reference {

/// The scene as a mechanism, link by link: masses, joints, initial coordinates
/// and loads on rigid links come straight from the robot and the scenario, so
/// merged links, centres of mass and initial poses of `built` are put to the
/// test. From `built` come the parameters of its couplers, the mass properties
/// of flexible links and where their interfaces are. Watched are the body
/// frames of `built`, in its order.
/// @throws InputError if a link is not at level `rigid`.
[[nodiscard]] Mechanism make_mechanism(const scene::Scene& scene,
                                       const scene::BuiltScene& built);

}  // namespace limber::reference
