// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/material/section_place.hpp"

#include <fmt/format.h>

namespace limber {

std::string name_section_place(SectionFace face, int ply) {
  const auto name = [&](const char* side) {
    return ply > 0 ? fmt::format("ply {} {}", ply, side) : std::string(side);
  };
  switch (face) {
    case SectionFace::bottom:
    case SectionFace::ply_bottom:
      return name("bottom");
    case SectionFace::middle:
      return name("middle");
    case SectionFace::ply_top:
    case SectionFace::top:
      return name("top");
    case SectionFace::solid:
      return "solid";
    case SectionFace::inner:
      return fmt::format("inner {}", ply);
    case SectionFace::outline:
      break;
  }
  return fmt::format("outline {}", ply);
}

}  // namespace limber
