// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/shape_properties.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"
#include "unit/contact/shapes/surfaces.hpp"

namespace limber::contact::shape_properties_test {
namespace {

using ::testing::HasSubstr;

constexpr double kInf = std::numeric_limits<double>::infinity();

void expect_refused(const Shape& shape, const std::string& words) {
  try {
    check_shape(shape);
    ADD_FAILURE() << "no error: " << words;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}

std::shared_ptr<const MeshSurface> make_mesh_surface() {
  auto surface = test::make_ball_surface(0.8, 0, true);
  test::set_modes(surface, test::make_fields());
  surface.residual.setConstant(2e-9);
  return std::make_shared<const MeshSurface>(surface);
}

TEST(ShapeProperties, WrongSizesAndPosesAreRefused) {
  expect_refused({Sphere{0.0}, {}}, "sphere's radius [m] is 0");
  expect_refused({Sphere{kInf}, {}}, "sphere's radius");
  expect_refused({Capsule{-1.0, 1.0}, {}}, "capsule's radius [m] is -1");
  expect_refused({Capsule{1.0, 0.0}, {}}, "capsule's half length");
  expect_refused({Cylinder{std::nan(""), 1.0}, {}}, "cylinder's radius");
  expect_refused({Cone{1.0, 0.0}, {}}, "cone's half length");
  expect_refused({Cone{0.0, 1.0}, {}}, "cone's radius");
  expect_refused({Ellipsoid{Vector3(1.0, -1.0, 1.0)}, {}},
                 "ellipsoid's radius [m] is -1");
  expect_refused({Cylinder{1.0, -2.0}, {}}, "cylinder's half length");
  expect_refused({Box{{1.0, 0.0, 1.0}}, {}}, "box's half size [m] is 0");
  expect_refused({std::shared_ptr<const MeshSurface>(), {}},
                 "surface is missing");
  expect_refused({HalfSpace{}, {2.0 * Matrix3::Identity(), Vector3::Zero()}},
                 "pose of its half space");
  expect_refused({HalfSpace{}, {-Matrix3::Identity(), Vector3::Zero()}},
                 "pose of its half space");
  expect_refused({Sphere{1.0}, {Matrix3::Identity(), Vector3(0, 0, kInf)}},
                 "pose of its sphere");
  expect_refused({make_mesh_surface(), {Matrix3::Identity(), Vector3(0, 0, 1)}},
                 "surface has its own pose");
}

TEST(ShapeProperties, ExtentReachesItsFarthestPoint) {
  const joints::PairBody body;
  const auto away = [](const ShapeKind& kind) {
    return Shape{kind, {Matrix3::Identity(), Vector3(0, 3, 4)}};
  };
  EXPECT_DOUBLE_EQ(find_extent(away(Sphere{2.0}), body), 7.0);
  EXPECT_DOUBLE_EQ(find_extent(away(Capsule{2.0, 1.0}), body), 8.0);
  EXPECT_DOUBLE_EQ(find_extent(away(Cone{3.0, 4.0}), body), 10.0);
  EXPECT_DOUBLE_EQ(find_extent(away(Ellipsoid{Vector3(1, 3, 2)}), body), 8.0);
  EXPECT_DOUBLE_EQ(find_extent(away(Cylinder{3.0, 4.0}), body), 10.0);
  EXPECT_DOUBLE_EQ(find_extent(away(Box{{2.0, 3.0, 6.0}}), body), 12.0);
  EXPECT_EQ(find_extent(away(HalfSpace{}), body), kInf);
}

TEST(ShapeProperties, KindsHaveNames) {
  EXPECT_EQ(name_kind({HalfSpace{}, {}}), "half space");
  EXPECT_EQ(name_kind({make_mesh_surface(), {}}), "skin");
}

}  // namespace
}  // namespace limber::contact::shape_properties_test
