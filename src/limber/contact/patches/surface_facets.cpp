// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/surface_facets.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "limber/common/index.hpp"

namespace limber::contact {
namespace {

const double kSharp = std::cos(20.0 / 180.0 * std::numbers::pi);
const double kInPlane = std::cos(1e-3);
// Of a middle node from its edge, over the edge's length [-].
constexpr double kStraight = 1e-6;

// Left of each edge.
std::map<std::pair<int, int>, std::size_t> list_edges(
    const std::vector<SurfaceFacet>& facets) {
  std::map<std::pair<int, int>, std::size_t> owners;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      owners[{facets[f].nodes[k], facets[f].nodes[(k + 1) % 3]}] = f;
    }
  }
  return owners;
}

// Cosine of the angle between two facets.
double find_cosine(const SurfaceFacet& a, const SurfaceFacet& b) {
  return a.area.normalized().dot(b.area.normalized());
}

void number_patches(std::vector<SurfaceFacet>& facets) {
  std::vector<std::size_t> parent(facets.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&parent](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto owners = list_edges(facets);
  for (const auto& [edge, f] : owners) {
    const auto other = owners.find({edge.second, edge.first});
    if (other == owners.end()) continue;
    if (find_cosine(facets[f], facets[other->second]) < kSharp) continue;
    parent[find(f)] = find(other->second);
  }
  for (std::size_t f = 0; f < facets.size(); ++f) {
    facets[f].patch = static_cast<int>(find(f));
  }
}

}  // namespace

std::vector<SurfaceFacet> find_facets(const flexbody::ContactSurface& surface) {
  std::vector<SurfaceFacet> facets;
  const auto add = [&](int a, int b, int c) {
    const Vector3 x = surface.x_B.col(a);
    const Vector3 y = surface.x_B.col(b);
    const Vector3 z = surface.x_B.col(c);
    facets.push_back(
        {{a, b, c}, 0.5 * (y - x).cross(z - x), (x + y + z) / 3.0});
  };
  for (const auto& n : surface.faces) {
    if (n[3] < 0) {
      add(n[0], n[1], n[2]);
      continue;
    }
    add(n[0], n[3], n[5]);
    add(n[3], n[1], n[4]);
    add(n[5], n[4], n[2]);
    add(n[3], n[4], n[5]);
  }
  number_patches(facets);
  return facets;
}

bool is_polyhedral(const std::vector<SurfaceFacet>& facets) {
  const auto owners = list_edges(facets);
  return std::ranges::all_of(owners, [&](const auto& entry) {
    const auto& [edge, f] = entry;
    const auto other = owners.find({edge.second, edge.first});
    if (other == owners.end()) return false;
    const double cosine = find_cosine(facets[f], facets[other->second]);
    return cosine > kInPlane || cosine < kSharp;
  });
}

std::vector<bool> find_exact_nodes(const flexbody::ContactSurface& surface) {
  std::vector<bool> is_exact(static_cast<std::size_t>(surface.x_B.cols()),
                             true);
  for (const auto& n : surface.faces) {
    if (n[3] < 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 a = surface.x_B.col(n[k]);
      const Vector3 b = surface.x_B.col(n[(k + 1) % 3]);
      const Vector3 off = Vector3(surface.x_B.col(n[3 + k])) - 0.5 * (a + b);
      if (off.norm() <= kStraight * (b - a).norm()) {
        is_exact[index(n[3 + k])] = false;
      }
    }
  }
  return is_exact;
}

}  // namespace limber::contact
