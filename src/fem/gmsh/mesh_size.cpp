// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/gmsh/mesh_size.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

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

/// Of the triangles of a surface: twice the sum of areas, and six times the
/// volume between them and the origin, positive if their normals point away
/// from it.
struct Measures {
  double areas = 0.0;
  double volumes = 0.0;
  double count = 0.0;
};

using Places = std::unordered_map<std::size_t, Vector3>;

Places find_places() {
  std::vector<std::size_t> tags;
  std::vector<double> x;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters);
  Places places;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    places[tags[i]] = Eigen::Map<const Vector3>(x.data() + 3 * i);
  }
  return places;
}

/// Of the corners of its triangles, of first to third order.
Measures measure(int surface, const Places& places) {
  constexpr std::array<std::pair<int, std::size_t>, 3> kTriangles = {
      {{2, 3}, {9, 6}, {21, 10}}};  // Gmsh's type, nodes
  Measures sum;
  for (const auto& [type, each] : kTriangles) {
    std::vector<std::size_t> elements;
    std::vector<std::size_t> nodes;
    gmsh::model::mesh::getElementsByType(type, elements, nodes, surface);
    for (std::size_t i = 0; i + each <= nodes.size(); i += each) {
      const Vector3& a = places.at(nodes[i]);
      const Vector3& b = places.at(nodes[i + 1]);
      const Vector3& c = places.at(nodes[i + 2]);
      sum.areas += (b - a).cross(c - a).norm();
      sum.volumes += a.dot(b.cross(c));
      sum.count += 1.0;
    }
  }
  return sum;
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

double estimate_element_count() {
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  const Places places = find_places();
  Measures total;
  double volume = 0.0;
  for (const auto& one : volumes) {
    gmsh::vectorpair surfaces;
    gmsh::model::getBoundary({one}, surfaces, false, true, false);
    double enclosed = 0.0;
    for (const auto& [dimension, surface] : surfaces) {
      const Measures part = measure(std::abs(surface), places);
      enclosed += std::copysign(part.volumes, surface);
      total.areas += part.areas;
      total.count += part.count;
    }
    volume += std::abs(enclosed) / 6.0;
  }
  if (total.count == 0.0) return 0.0;
  const double area = 0.5 * total.areas / total.count;
  const double edge = std::sqrt(4.0 * area / std::numbers::sqrt3);
  return volume * 6.0 * std::numbers::sqrt2 / (edge * edge * edge);
}

}  // namespace limber::fem
