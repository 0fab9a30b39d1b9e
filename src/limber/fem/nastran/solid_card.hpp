// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>

namespace limber::fem {

/// A solid element's card.
struct SolidCard {
  std::string_view name;
  int corners = 0;
  int nodes = 0;           ///< with mid-side nodes
  int linear_type = 0;     ///< Gmsh's number
  int quadratic_type = 0;  ///< of the serendipity element
  /// Nastran's node at each of Gmsh's places. Corners agree; Nastran's
  /// mid-side nodes go around a face, Gmsh's by ascending corners (Gmsh
  /// reference manual, "Node ordering").
  std::array<int, 20> order;
  /// Corners between which each of Nastran's mid-side nodes is.
  std::array<std::array<int, 2>, 12> edges;
};

inline constexpr std::array<SolidCard, 5> kSolidCards = {{
    {"CTETRA",
     4,
     10,
     4,
     11,
     {0, 1, 2, 3, 4, 5, 6, 7, 9, 8},
     {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}}},
    {"CHEXA",
     8,
     20,
     5,
     17,
     {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 12, 9, 13, 10, 14, 15, 16, 19, 17, 18},
     {{{0, 1},
       {1, 2},
       {2, 3},
       {3, 0},
       {0, 4},
       {1, 5},
       {2, 6},
       {3, 7},
       {4, 5},
       {5, 6},
       {6, 7},
       {7, 4}}}},
    {"CPENTA",
     6,
     15,
     6,
     18,
     {0, 1, 2, 3, 4, 5, 6, 8, 9, 7, 10, 11, 12, 14, 13},
     {{{0, 1},
       {1, 2},
       {2, 0},
       {0, 3},
       {1, 4},
       {2, 5},
       {3, 4},
       {4, 5},
       {5, 3}}}},
    {"CPYRAM",
     5,
     13,
     7,
     19,
     {0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12},
     {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}}},
    {"CPYRA",
     5,
     13,
     7,
     19,
     {0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12},
     {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}}},
}};

}  // namespace limber::fem
