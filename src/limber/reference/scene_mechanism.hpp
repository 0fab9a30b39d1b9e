// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/reference/mechanism.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::reference {

/// The scene as a mechanism, link by link: masses, joints, initial coordinates
/// and loads on rigid links come directly from the robot and the scenario, so
/// that merged links, centres of mass and initial poses of `built` are tested.
/// The parameters of couplers, the mass properties of flexible links and the
/// positions of their interfaces come from `built`. The observed frames are the
/// body frames of `built`, in its order.
/// @throws InputError if a link is not at level `rigid`.
[[nodiscard]] Mechanism make_mechanism(const scene::Scene& scene,
                                       const scene::BuiltScene& built);

}  // namespace limber::reference
