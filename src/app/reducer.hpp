// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress.hpp"
#include "scene/scene.hpp"

namespace limber::app {

/// flexbody::reduce, or a refusal in a build without Gmsh and CHOLMOD.
[[nodiscard]] scene::Reducer make_reducer(const Progress& progress);

}  // namespace limber::app
