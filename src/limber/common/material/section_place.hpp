// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limber {

/// Where in the section of a shell or beam its stress is taken, or that it is
/// of a solid. "Top" is the side to which the normal of the element points.
enum class SectionFace : int {
  bottom = 0,  ///< of the shell, and of its lowest ply
  ply_bottom,  ///< of a ply inside a laminate
  middle,      ///< halfway through a shell of one material
  ply_top,     ///< of a ply inside a laminate
  top,         ///< of the shell, and of its highest ply
  outline,     ///< of a beam
  solid,       ///< at a node of solids beside shells or beams
  inner,       ///< of a beam, inside of its outline
};
inline constexpr int kSectionFaces = 8;

/// "top", "middle", "ply 2 bottom", "outline 3", "inner 1",
/// "solid". @param ply from 1, of a beam
/// the number of the point; 0: of a shell without plies
[[nodiscard]] std::string name_section_place(SectionFace face, int ply);

}  // namespace limber
