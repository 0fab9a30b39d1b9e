// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/mesh_surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <tuple>

#include "limber/common/errors.hpp"
#include "unit/contact/shapes/surfaces.hpp"

namespace limber::contact::mesh_surface_test {
namespace {

using test::view;
using ::testing::HasSubstr;

flexbody::ContactSurface make_flexible_ball() {
  auto surface = test::make_ball_surface(0.8, 1, true);
  test::set_modes(surface, test::make_fields());
  return surface;
}

VectorX make_eta() {
  VectorX eta(4);
  eta << 0.1, -0.2, 0.05, 0.15;
  return eta;
}

TEST(MeshSurface, PlacesOfItsNodesMoveAsTheirRowsOfModes) {
  const auto surface = make_flexible_ball();
  const MeshSurface mesh_surface(surface);
  const VectorX eta = make_eta();
  constexpr std::array<FacePlace, 6> kNodes = {
      {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}};
  Matrix3X Phi(3, 4);
  for (const int f : {0, 7, 79}) {
    for (std::size_t i = 0; i < 6; ++i) {
      const int node = surface.faces[index(f)][i];
      const SurfacePlace place{.face = f, .u = kNodes[i].u, .v = kNodes[i].v};
      mesh_surface.set_shape_functions(place, Phi);
      EXPECT_LT((Phi - surface.Phi_B.middleRows(3 * node, 3)).norm(), 1e-14);
      EXPECT_LT((mesh_surface.find_position(place, view(eta)) -
                 surface.x_B.col(node) - Phi * eta)
                    .norm(),
                1e-14);
    }
  }
}

TEST(MeshSurface, ResidualIsLinearBetweenCorners) {
  auto surface = test::make_ball_surface(1.0, 0, true);
  surface.residual.setConstant(100.0);  // of middle nodes, which do not count
  const auto corners = surface.faces[3];
  surface.residual[corners[0]] = 1.0;
  surface.residual[corners[1]] = 2.0;
  surface.residual[corners[2]] = 5.0;
  const MeshSurface mesh_surface(surface);
  EXPECT_DOUBLE_EQ(mesh_surface.find_residual({.face = 3, .u = 0.5, .v = 0.25}),
                   0.25 * 1.0 + 0.5 * 2.0 + 0.25 * 5.0);
}

TEST(MeshSurface, ExtentHoldsEveryPointHoweverItDeforms) {
  const MeshSurface mesh_surface(make_flexible_ball());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> draw(-0.5, 0.5);
  for (int trial = 0; trial < 20; ++trial) {
    VectorX eta(4);
    for (double& value : eta) value = draw(random);
    double largest = 0.0;
    for (int f = 0; f < 80; ++f) {
      for (const double u : {0.0, 0.3, 0.6}) {
        for (const double v : {0.0, 0.2, 0.4}) {
          const Vector3 x = mesh_surface.find_position(
              {.face = f, .u = u, .v = v}, view(eta));
          largest = std::max(largest, x.norm());
        }
      }
    }
    EXPECT_LE(largest, mesh_surface.find_extent(view(eta)));
    EXPECT_LT(mesh_surface.find_extent(view(eta)), 4.0 * largest);
  }
}

void expect_refused(const flexbody::ContactSurface& surface,
                    const std::string& words) {
  try {
    const MeshSurface mesh_surface(surface);
    ADD_FAILURE() << "no error: " << words;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("surface 'skin'"));
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}

TEST(MeshSurface, WrongSurfacesAreRefusedByName) {
  const auto good = make_flexible_ball();
  auto bad = good;
  bad.faces.clear();
  expect_refused(bad, "no faces");
  bad = good;
  bad.residual.conservativeResize(3);
  expect_refused(bad, "3 residual");
  bad = good;
  bad.Phi_B.conservativeResize(6, 4);
  expect_refused(bad, "6 rows of modes");
  bad = good;
  bad.Phi_B(5, 1) = std::nan("");
  expect_refused(bad, "not finite");
  bad = good;
  bad.faces[3][1] = 1000;
  expect_refused(bad, "node 1000 in face 3");
  bad = good;
  bad.faces[3][4] = -1;
  expect_refused(bad, "node -1 in face 3");
  bad = good;
  bad.x_B.col(bad.faces[0][1]) = bad.x_B.col(bad.faces[0][0]);
  expect_refused(bad, "without area");
  bad = good;
  bad.x_B.conservativeResize(3, bad.x_B.cols() + 1);
  bad.x_B.rightCols(1).setZero();
  bad.residual.setZero(bad.x_B.cols());
  bad.Phi_B.setZero(3 * bad.x_B.cols(), 4);
  expect_refused(bad, "in no face");
}

TEST(MeshSurface, ModesOfTheBodyAreThoseOfTheSurface) {
  const MeshSurface flexible(make_flexible_ball());
  const MeshSurface rigid(test::make_ball_surface(1.0, 0, false));
  const VectorX eta = make_eta();
  const joints::PairBody body{.modes = 4, .eta = eta.data()};
  EXPECT_EQ(find_modal_coordinates(flexible, body), eta);
  EXPECT_EQ(find_modal_coordinates(rigid, body).size(), 0);
  EXPECT_THROW(std::ignore = find_modal_coordinates(flexible, {}),
               ContractError);
}

}  // namespace
}  // namespace limber::contact::mesh_surface_test
