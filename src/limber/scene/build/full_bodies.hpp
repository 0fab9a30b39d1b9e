// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "limber/flexbody/model/full_body.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::scene {

/// Makes a body without reduction; usually flexbody::make_full_body.
/// @param reduced the matching reduced body
using FullMaker = std::function<std::shared_ptr<const flexbody::FullBody>(
    const flexbody::Recipe&, const flexbody::FullOptions&,
    const flexbody::ReducedBody& reduced)>;

/// Adds whole meshes to the plans of links at level `full`; links with equal
/// recipes share one.
/// @throws InputError naming a link whose mesh is not available.
void add_full_bodies(const Scene& scene, const FullMaker& make_full,
                     BodyPlans& plans);

}  // namespace limber::scene
