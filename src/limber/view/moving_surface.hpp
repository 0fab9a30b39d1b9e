// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/results/xdmf_file.hpp"
#include "limber/view/recording.hpp"

namespace limber::view {

/// The flexible bodies' surfaces, one after the other, with their stress where
/// it was recorded.
/// @param recording kept by the caller; with at least one flexible body
/// @throws InputError if there is none.
[[nodiscard]] results::MovingSurface gather_surfaces(
    const Recording& recording);

}  // namespace limber::view
