// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/random_scene.hpp"

namespace limber::testing {

/// Bodies for random scenes, reduced from meshes with the tables of level
/// `nonlinear`: by variant a slender bar, one bent by 90 degrees, or a block of
/// tetrahedra, scaled to the drawn length, mass and frequency; with up to 12
/// static modes besides the drawn eigenmodes. Reduces them now (10 s).
/// @throws InputError without a mesher.
[[nodiscard]] BodyMaker make_meshed_bodies();

}  // namespace limber::testing
