// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/linear_cell.hpp"

namespace limber::fem {

ReferenceElement make_linear_cell(LinearCell cell) {
  ReferenceElement element;
  element.dimension = 3;
  element.order = 1;
  if (cell == LinearCell::hexahedron) {
    element.gmsh_type = 5;
    element.name = "hexahedron";
    element.node_uvw.resize(3, 8);
    element.node_uvw << -1, 1, 1, -1, -1, 1, 1, -1,  //
        -1, -1, 1, 1, -1, -1, 1, 1,                  //
        -1, -1, -1, -1, 1, 1, 1, 1;
    element.faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                     {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  } else {
    element.gmsh_type = 6;
    element.name = "wedge";
    element.node_uvw.resize(3, 6);
    element.node_uvw << 0, 1, 0, 0, 1, 0,  //
        0, 0, 1, 0, 0, 1,                  //
        -1, -1, -1, 1, 1, 1;
    element.faces = {
        {0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  }
  element.node_count = static_cast<int>(element.node_uvw.cols());
  element.corner_count = element.node_count;
  for (const std::vector<int>& face : element.faces)
    element.face_corners.push_back(static_cast<int>(face.size()));
  return element;
}

}  // namespace limber::fem
