// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/shape_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace limber::scene {
namespace {

/// By the divergence theorem; positive if triangles face outwards [m^3].
double find_volume(const ShapeSurface& surface) {
  double volume = 0.0;
  for (const auto& t : surface.triangles) {
    const auto p = [&](int i) -> Vector3 {
      return surface.points.col(
          static_cast<Eigen::Index>(t[static_cast<std::size_t>(i)]));
    };
    volume += p(0).cross(p(1)).dot(p(2)) / 6.0;
  }
  return volume;
}

/// Whether each edge is that of two triangles, once in each direction.
bool is_closed(const ShapeSurface& surface) {
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (const auto& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (++edges[{t[i], t[(i + 1) % 3]}] > 1) return false;
    }
  }
  for (const auto& [edge, count] : edges) {
    if (edges.count({edge.second, edge.first}) == 0) return false;
  }
  return true;
}

// Of corners on the shape a little less than the shape's.
TEST(ShapeSurface, ClosesAroundTheShapesVolume) {
  constexpr double kPi = std::numbers::pi;
  const std::pair<Geometry, double> shapes[] = {
      {SphereGeometry{0.3}, 4.0 / 3.0 * kPi * 0.027},
      {CapsuleGeometry{0.3, 0.8}, 4.0 / 3.0 * kPi * 0.027 + kPi * 0.09 * 0.8},
      {CylinderGeometry{0.3, 0.8}, kPi * 0.09 * 0.8}};
  for (const auto& [shape, volume] : shapes) {
    const ShapeSurface surface = make_surface(shape);
    EXPECT_TRUE(is_closed(surface));
    EXPECT_LT(find_volume(surface), volume);
    EXPECT_GT(find_volume(surface), 0.9 * volume);
  }
  const ShapeSurface box = make_surface(BoxGeometry{{0.2, 0.3, 0.4}});
  EXPECT_TRUE(is_closed(box));
  EXPECT_NEAR(find_volume(box), 0.024, 1e-15);
}

TEST(ShapeSurface, ReachesTheEndsOfTheShape) {
  const auto reach = [](const Geometry& shape) -> Vector3 {
    return make_surface(shape).points.cwiseAbs().rowwise().maxCoeff();
  };
  EXPECT_LT((reach(SphereGeometry{0.3}) - Vector3(0.3, 0.3, 0.3)).norm(),
            1e-15);
  EXPECT_LT((reach(CapsuleGeometry{0.3, 0.8}) - Vector3(0.3, 0.3, 0.7)).norm(),
            1e-15);
  EXPECT_LT((reach(CylinderGeometry{0.3, 0.8}) - Vector3(0.3, 0.3, 0.4)).norm(),
            1e-15);
}

TEST(ShapeSurface, IsNoneOfAPlane) {
  EXPECT_TRUE(make_surface(PlaneGeometry{}).triangles.empty());
  EXPECT_TRUE(make_surface(OtherGeometry{"mesh"}).triangles.empty());
}

}  // namespace
}  // namespace limber::scene
