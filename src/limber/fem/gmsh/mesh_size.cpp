// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/gmsh/mesh_size.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/common/types.hpp"

namespace limber::fem {
namespace {

Vector3 find_extent() {
  Vector3 low;
  Vector3 high;
  gmsh::model::getBoundingBox(-1, -1, low.x(), low.y(), low.z(), high.x(),
                              high.y(), high.z());
  return high - low;
}

}  // namespace

void check_element_size(const std::filesystem::path& file, double size) {
  constexpr double kMost = 1000.0;
  if (size <= 0.0) return;
  const double extent = find_extent().maxCoeff();
  if (!(extent > kMost * size)) return;
  constexpr double kUsual = 50.0;
  throw InputError(fmt::format(
      "{}: the element size {:g} is {:.0f} times smaller than the part, which "
      "is {:g} long in its mesh unit; expected at most {:.0f} times. A size of "
      "{:.2g} is usual.",
      file.string(), size, extent / size, extent, kMost, extent / kUsual));
}

double estimate_element_count(double size) {
  if (size <= 0.0) return 0.0;
  return find_extent().prod() * 6.0 * std::numbers::sqrt2 /
         (size * size * size);
}

}  // namespace limber::fem
