// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/body_plan.hpp"
#include "scene/scene.hpp"

namespace limber::scene {

/// Gives the plans of links at level `full` their whole meshes; links with
/// equal recipes share one.
/// @throws InputError naming a link whose mesh is not at hand.
void add_full_bodies(const Scene& scene, const FullMaker& make_full,
                     BodyPlans& plans);

}  // namespace limber::scene
