// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace limber::scene {

/// Binary STL: 80 bytes of text and the number of triangles, in 4; then for
/// each triangle a normal and three corners as floats, and two bytes more.
inline constexpr std::size_t kStlHead = 84;
inline constexpr std::size_t kStlRecord = 50;

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
