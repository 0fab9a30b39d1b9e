// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "limber/common/types.hpp"

namespace limber::scene {

/// A COLLADA file as the text of an OBJ file: all geometry of its scene, in
/// metres, its triangles as faces, its lines and points as such.
///
/// The program `assimp` of the Open Asset Import Library reads it in a
/// separate process with limits of time and memory, since the file may not be
/// trusted.
/// @throws InputError if the program is not installed, or cannot read the file.
[[nodiscard]] std::string convert_dae(const std::filesystem::path& file);

/// Rotation from the axes of convert_dae, which has y up, to the file's own, as
/// in other robot software, whatever its up axis is. @param text of the file
[[nodiscard]] Matrix3 find_dae_axes(const std::string& text);

}  // namespace limber::scene
