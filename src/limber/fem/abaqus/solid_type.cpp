// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/abaqus/solid_type.hpp"

#include <algorithm>

namespace limber::fem {
namespace {

constexpr int kTriangle = 2;
constexpr int kQuadrangle = 3;
constexpr int kTriangle6 = 9;
constexpr int kQuadrangle8 = 16;

const std::vector<SolidType>& list_types() {
  static const std::vector<SolidType> known = {
      {"C3D4",
       4,
       4,
       {0, 1, 2, 3},
       {{kTriangle, {0, 1, 2}},
        {kTriangle, {0, 3, 1}},
        {kTriangle, {1, 3, 2}},
        {kTriangle, {2, 3, 0}}}},
      {"C3D10",
       10,
       11,
       {0, 1, 2, 3, 4, 5, 6, 7, 9, 8},
       {{kTriangle6, {0, 1, 2, 4, 5, 6}},
        {kTriangle6, {0, 3, 1, 7, 8, 4}},
        {kTriangle6, {1, 3, 2, 8, 9, 5}},
        {kTriangle6, {2, 3, 0, 9, 7, 6}}}},
      {"C3D5",
       5,
       7,
       {0, 1, 2, 3, 4},
       {{kQuadrangle, {0, 1, 2, 3}},
        {kTriangle, {0, 4, 1}},
        {kTriangle, {1, 4, 2}},
        {kTriangle, {2, 4, 3}},
        {kTriangle, {3, 4, 0}}}},
      {"C3D6",
       6,
       6,
       {0, 1, 2, 3, 4, 5},
       {{kTriangle, {0, 1, 2}},
        {kTriangle, {3, 5, 4}},
        {kQuadrangle, {0, 3, 4, 1}},
        {kQuadrangle, {1, 4, 5, 2}},
        {kQuadrangle, {2, 5, 3, 0}}}},
      {"C3D15",
       15,
       18,
       {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10},
       {{kTriangle6, {0, 1, 2, 6, 7, 8}},
        {kTriangle6, {3, 5, 4, 11, 10, 9}},
        {kQuadrangle8, {0, 3, 4, 1, 12, 9, 13, 6}},
        {kQuadrangle8, {1, 4, 5, 2, 13, 10, 14, 7}},
        {kQuadrangle8, {2, 5, 3, 0, 14, 11, 12, 8}}}},
      {"C3D8",
       8,
       5,
       {0, 1, 2, 3, 4, 5, 6, 7},
       {{kQuadrangle, {0, 1, 2, 3}},
        {kQuadrangle, {4, 7, 6, 5}},
        {kQuadrangle, {0, 4, 5, 1}},
        {kQuadrangle, {1, 5, 6, 2}},
        {kQuadrangle, {2, 6, 7, 3}},
        {kQuadrangle, {3, 7, 4, 0}}}},
      {"C3D20",
       20,
       17,
       {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14},
       {{kQuadrangle8, {0, 1, 2, 3, 8, 9, 10, 11}},
        {kQuadrangle8, {4, 7, 6, 5, 15, 14, 13, 12}},
        {kQuadrangle8, {0, 4, 5, 1, 16, 12, 17, 8}},
        {kQuadrangle8, {1, 5, 6, 2, 17, 13, 18, 9}},
        {kQuadrangle8, {2, 6, 7, 3, 18, 14, 19, 10}},
        {kQuadrangle8, {3, 7, 4, 0, 19, 15, 16, 11}}}},
  };
  return known;
}

}  // namespace

const SolidType* find_solid_type(std::string_view name) {
  const auto is_it = [name](const SolidType& type) {
    if (!name.starts_with(type.name)) return false;
    const std::string_view rest = name.substr(type.name.size());
    // C3D8R is one, C3D10 no C3D1, and C3D8P has pressures as unknowns.
    return std::ranges::all_of(rest, [](char c) {
      return c == 'R' || c == 'I' || c == 'M' || c == 'H' || c == 'T' ||
             c == 'S';
    });
  };
  const auto found = std::ranges::find_if(list_types(), is_it);
  return found == list_types().end() ? nullptr : &*found;
}

}  // namespace limber::fem
