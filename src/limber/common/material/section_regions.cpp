// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/material/section_regions.hpp"

namespace limber {

const std::vector<SectionShape>& list_section_shapes() {
  static const std::vector<SectionShape> shapes = {
      {"tube", {"radius", "wall"}, {}},
      {"rectangle", {"height", "width"}, {}},
      {"box", {"height", "width", "flange", "web"}, {}},
      {"i", {"height", "width", "flange", "web"}, {}},
      {"values", {"area", "I_y", "I_z", "torsion"}, {"shear_y", "shear_z"}}};
  return shapes;
}

}  // namespace limber
