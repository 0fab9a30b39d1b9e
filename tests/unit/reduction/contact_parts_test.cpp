// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>

#include "limber/common/rotation.hpp"
#include "limber/reduction/contact_groups.hpp"
#include "limber/reduction/contact_patches.hpp"
#include "limber/reduction/contact_surface.hpp"
#include "limber/reduction/reduce.hpp"
#include "unit/reduction/bar.hpp"

/// Parts of flat surfaces: their geometry, their mean motion, and the closed
/// forms of a rod and a beam.
namespace limber::flexbody::contact_parts_test {
namespace {

using testing::Bar;
using testing::make_recipe;

ReducedBody reduce_bar(const Bar& bar, const std::string& group, int modes) {
  Recipe recipe = make_recipe(bar);
  recipe.contact_groups = {group};
  recipe.basis.eigenmodes = modes;
  recipe.basis.interface_modes = false;
  return reduce(recipe);
}

const Bar kRod{
    .size = {1.0, 0.01, 0.01}, .cells = 40, .material = {210e9, 0.0, 7850.0}};
const Bar kFinger{.size = {0.2, 0.02, 0.008},
                  .cells = 20,
                  .material = {70e9, 0.3, 2700.0},
                  .is_clamped = true};

double find_area(const ContactPart& part) {
  Vector3 twice = Vector3::Zero();
  for (Eigen::Index i = 1; i + 1 < part.corners_B.cols(); ++i) {
    const Vector3 first = part.corners_B.col(0);
    twice += (Vector3(part.corners_B.col(i)) - first)
                 .cross(Vector3(part.corners_B.col(i + 1)) - first);
  }
  return 0.5 * twice.dot(part.normal_B);
}

TEST(ContactParts, OfARodsEndAreOneSquare) {
  const ReducedBody body = reduce_bar(kRod, "tip", 3);
  const auto& parts = body.contact_surfaces.at(0).parts;
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(find_area(parts[0]), 1e-4, 1e-12);
  EXPECT_EQ(parts[0].rim.size(), 4U);
  EXPECT_LT((parts[0].normal_B - Vector3::UnitX()).norm(), 1e-9);
  EXPECT_LT((parts[0].centre_B - 0.5 * Vector3::UnitX()).norm(), 1e-9);
}

// All that gives way under a uniform pressure, inertia relieved: L / (3 E A).
TEST(ContactParts, OfARodsEndGiveWayInAllAsTheRodDoes) {
  for (const int modes : {0, 3, 8}) {
    const ReducedBody body = reduce_bar(kRod, "tip", modes);
    const ContactPart& part = body.contact_surfaces.at(0).parts.at(0);
    double sum = part.flexibility;
    double bare = part.residual;
    for (Eigen::Index k = 0; k < body.lambda.size(); ++k) {
      const double along = part.motion_B.col(k).head<3>().dot(part.normal_B);
      sum += along * along / body.lambda[k];
    }
    EXPECT_NEAR(sum * 3.0 * 210e9 * 1e-4, 1.0, 2e-3) << modes;
    EXPECT_GE(part.flexibility, bare);
  }
}

TEST(ContactParts, OfABendingFingerShareItsFaceAndKeepItsRim) {
  const ReducedBody body = reduce_bar(kFinger, "top", 6);
  const auto& parts = body.contact_surfaces.at(0).parts;
  EXPECT_GE(parts.size(), 2U);
  EXPECT_LE(parts.size(), kMostParts);
  double area = 0.0;
  double rim = 0.0;
  for (const ContactPart& part : parts) {
    area += find_area(part);
    for (const std::size_t i : part.rim) {
      const auto next =
          static_cast<Eigen::Index>(i + 1) % part.corners_B.cols();
      rim += (part.corners_B.col(next) -
              part.corners_B.col(static_cast<Eigen::Index>(i)))
                 .norm();
    }
    EXPECT_GT(part.depth, 0.0);
    EXPECT_LT(part.depth, 0.008);
  }
  EXPECT_NEAR(area, 0.2 * 0.02, 1e-12);
  EXPECT_NEAR(rim, 2.0 * (0.2 + 0.02), 1e-9);
}

// The rotation of the last part of a beam under its first mode is the slope
// between the nodes at its ends, to what it bends itself.
TEST(ContactParts, TurnWithTheBeamsSlope) {
  const ReducedBody body = reduce_bar(kFinger, "top", 2);
  const auto& parts = body.contact_surfaces.at(0).parts;
  const auto last = std::max_element(parts.begin(), parts.end(),
                                     [](const auto& a, const auto& b) {
                                       return a.centre_B.x() < b.centre_B.x();
                                     });
  // Of a clamped-free beam at x / L, over the tip's deflection.
  const double k = 1.8751040687;
  const double ratio = 0.7340955;
  const auto shape = [&](double s) {
    return std::cosh(k * s) - std::cos(k * s) -
           ratio * (std::sinh(k * s) - std::sin(k * s));
  };
  const auto slope = [&](double s) {
    return k * (std::sinh(k * s) + std::sin(k * s) -
                ratio * (std::cosh(k * s) - std::cos(k * s)));
  };
  const double s = 0.5 + last->centre_B.x() / 0.2;
  Eigen::Index mode = 0;  // that bends along z
  (void)last->motion_B.row(2).cwiseAbs().maxCoeff(&mode);
  const double w = last->motion_B(2, mode);
  const double turn = -last->motion_B(4, mode);  // dw/dx = -theta_y
  EXPECT_NEAR(turn / w, slope(s) / shape(s) / 0.2, 0.02 * turn / w);
}

TEST(ContactParts, MoveExactlyWithARigidBody) {
  Bar finger = kFinger;
  finger.is_clamped = false;
  const MeshedBody body(make_recipe(finger), {});
  const fem::Surface top = fem::make_surface(
      body.mesh, find_contact_groups(body.mesh, {"top"}, {{70e9, 0.3, 2700.0}})
                     .front()
                     .faces);
  const Vector3 about(0.05, 0.3, -0.1);
  MatrixX Phi(3 * body.mesh.x.cols(), 6);
  for (Eigen::Index n = 0; n < body.mesh.x.cols(); ++n) {
    Phi.middleRows<3>(3 * n).leftCols<3>() = Matrix3::Identity();
    Phi.middleRows<3>(3 * n).rightCols<3>() = -skew(body.mesh.x.col(n) - about);
  }
  const ReducedBasis none{VectorX(0), MatrixX(3 * body.mesh.x.cols(), 0)};
  const auto parts =
      make_contact_parts(body, top, find_normals(body.mesh, top).col(0), none,
                         Phi, Vector3::Zero(), 1e-3);
  ASSERT_EQ(parts.size(), 1U);
  Matrix6 expected = Matrix6::Identity();
  expected.topRightCorner<3, 3>() = -skew(parts[0].centre_B - about);
  EXPECT_LT((parts[0].motion_B - expected).norm(), 1e-10);
}

// A plate with a corner cut out, or with a round hole, and its face.
Recipe make_plate(const std::string& cut_out) {
  const std::filesystem::path file = limber::test::own_folder() / "plate.geo";
  std::ofstream(file)
      << "SetFactory(\"OpenCASCADE\");\n"
         "Box(1) = {0, 0, 0, 0.04, 0.04, 0.005};\n"
      << cut_out
      << "BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };"
         "\nMeshSize{:} = 0.005;\n"
         "top[] = Surface In BoundingBox {-1, -1, 0.0049, 1, 1, 0.0051};\n"
         "Physical Surface(\"top\") = {top[]};\n"
         "Physical Volume(\"plate\") = {3};\n";
  Recipe recipe;
  recipe.name = "plate";
  recipe.mesh.file = file;
  recipe.mesh.order = 2;
  recipe.materials = {{"", {70e9, 0.3, 2700.0}}};
  recipe.contact_groups = {"top"};
  recipe.basis.eigenmodes = 2;
  recipe.basis.interface_modes = false;
  return recipe;
}

// Each is convex, and all fill no more than 2 % beyond the face.
TEST(ContactParts, OfAFaceThatIsNotConvexFillIt) {
  const double square = 0.04 * 0.04;
  const double hole = std::numbers::pi * 0.01 * 0.01;
  for (const auto& [cut_out, area] :
       {std::pair{"Box(2) = {0.015, 0.025, -1, 1, 1, 2};\n",
                  square - 0.025 * 0.015},
        std::pair{"Cylinder(2) = {0.02, 0.02, -1, 0, 0, 2, 0.01};\n",
                  square - hole}}) {
    const ReducedBody body = reduce(make_plate(cut_out));
    const ContactSurface& top = body.contact_surfaces.at(0);
    EXPECT_TRUE(top.slices.empty());
    ASSERT_GE(top.parts.size(), 2U) << cut_out;
    EXPECT_LE(top.parts.size(), kMostParts);
    double sum = 0.0;
    for (const ContactPart& part : top.parts) sum += find_area(part);
    EXPECT_GT(sum, 0.995 * area) << cut_out;
    EXPECT_LT(sum, 1.02 * area) << cut_out;
  }
}

}  // namespace
}  // namespace limber::flexbody::contact_parts_test
