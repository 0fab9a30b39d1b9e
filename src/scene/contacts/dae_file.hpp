// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace limber::scene {

/// A COLLADA file as binary STL: all geometry of its scene, in metres. Axes are
/// the file's own, whatever its up axis, as in other robot software.
///
/// The program `assimp` of the Open Asset Import Library reads it in a
/// separate process with limits of time and memory, since the file may not be
/// trusted.
/// @param text of the file
/// @throws InputError if the program is not installed, or cannot read the file.
[[nodiscard]] std::string convert_dae(const std::filesystem::path& file,
                                      const std::string& text);

}  // namespace limber::scene
