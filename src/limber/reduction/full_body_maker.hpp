// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "limber/common/progress.hpp"
#include "limber/flexbody/model/full_body.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::flexbody {

/// The body of `recipe` without reduction: its mesh, materials, clamps and
/// interfaces; the basis is ignored. Part of limber_reduction.
/// @param reduced the matching reduced body, whose parts and slices its contact
/// surfaces have; null: none
/// @throws InputError naming the file, group or value, or if the geometry gave
/// another mesh than the reduced body's.
[[nodiscard]] std::shared_ptr<const FullBody> make_full_body(
    const Recipe& recipe, const FullOptions& options,
    const Progress& progress = {}, const ReducedBody* reduced = nullptr);

}  // namespace limber::flexbody
