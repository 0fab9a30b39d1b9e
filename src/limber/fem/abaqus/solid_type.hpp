// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace limber::fem {

/// A face of an element: its number (S1, S2, ...), and the places of its
/// corners, then of the nodes between them, in the element's order.
struct SolidFace {
  int type = 0;  ///< Gmsh's number
  std::vector<int> places;
};

/// A solid element of Abaqus and CalculiX.
struct SolidType {
  std::string_view name;  ///< beginning of those with another integration
  int nodes = 0;
  int gmsh_type = 0;
  /// Its node at each of Gmsh's places. Corners agree; here nodes between them
  /// go around the first face, around the opposite one, then from one to the
  /// other, in Gmsh's order by ascending corners.
  std::vector<int> order;
  std::vector<SolidFace> faces;
};

/// By the name that a *ELEMENT states; none: it is no solid that is read.
/// Source: CalculiX 2.20 User's Manual, ch. 6.2; Gmsh reference manual, "Node
/// ordering"
[[nodiscard]] const SolidType* find_solid_type(std::string_view name);

}  // namespace limber::fem
