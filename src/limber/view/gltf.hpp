// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/view/recording.hpp"

namespace limber::view {

/// Writes results as a binary glTF 2.0 scene (.glb), single precision: a node a
/// body, whose translation, rotation and, as weights of morph targets, modal
/// coordinates are animated. The root turns z up into glTF's y up. Loads,
/// couplers and contacts are left out.
///
/// Equation   p = R_WB (x_B + magnification sum_k eta_k phi_k) + p_WB
/// Source     Khronos Group, glTF 2.0 specification
/// Limits     between outputs, viewers interpolate linearly. Outputs whose
///            times are equal in single precision are merged.
/// @param magnification of the deformation, > 0 [-]
/// @throws InputError if the file cannot be written.
void write_gltf(const std::filesystem::path& file, const Recording& recording,
                double magnification);

}  // namespace limber::view
