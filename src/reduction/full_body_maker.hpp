// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "common/progress.hpp"
#include "flexbody/full_body.hpp"
#include "flexbody/recipe.hpp"

namespace limber::flexbody {

/// The body that `recipe` asks for, without reduction: its mesh, materials,
/// clamps and interfaces; the basis is not looked at. Part of
/// limber_reduction.
/// @param key content key of the reduced body that it goes with, if there is
/// one
/// @throws InputError naming the file, group or value, or if the geometry made
/// another mesh than the reduced body's.
[[nodiscard]] std::shared_ptr<const FullBody> make_full_body(
    const Recipe& recipe, const FullOptions& options,
    const Progress& progress = {}, const std::string& key = {});

}  // namespace limber::flexbody
