// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/scene/build/full_bodies.hpp"
#include "limber/scene/build/reductions.hpp"

namespace limber::runs {

/// What makes the bodies of meshes.
struct Reductions {
  scene::Reducer reducer;        ///< flexbody::make_reducer
  std::filesystem::path cache;   ///< folder of reduced bodies; empty: default
  scene::FullMaker make_full{};  ///< for bodies at level `full`
};

}  // namespace limber::runs
