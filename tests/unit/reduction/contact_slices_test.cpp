// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "limber/common/rotation.hpp"
#include "limber/flexbody/model/full_contact_surface.hpp"
#include "limber/reduction/contact_groups.hpp"
#include "limber/reduction/full_body_maker.hpp"
#include "limber/reduction/reduce.hpp"
#include "limber/reduction/slices/slice_motion.hpp"
#include "limber/reduction/slices/surface_division.hpp"
#include "unit/reduction/bar.hpp"

/// Slices of whole surfaces: their motion, their loads, and the closed forms of
/// a rod and a beam.
namespace limber::flexbody::contact_slices_test {
namespace {

using testing::Bar;
using testing::make_recipe;

const Bar kRod{
    .size = {1.0, 0.01, 0.01}, .cells = 40, .material = {210e9, 0.0, 7850.0}};
const Bar kFinger{.size = {0.2, 0.02, 0.008},
                  .cells = 20,
                  .material = {70e9, 0.3, 2700.0},
                  .is_clamped = true};

std::vector<ContactSlice> make_slices(const Bar& bar, int modes) {
  Recipe recipe = make_recipe(bar);
  recipe.contact_groups = {"skin"};
  recipe.basis.eigenmodes = modes;
  recipe.basis.interface_modes = false;
  return reduce(recipe).contact_surfaces.at(0).slices;
}

const ContactSlice& find_last(const std::vector<ContactSlice>& slices) {
  const ContactSlice* last = &slices.front();
  for (const ContactSlice& slice : slices) {
    if (slice.centre_B.x() > last->centre_B.x()) last = &slice;
  }
  return *last;
}

TEST(ContactSlices, OfARigidBodyAreOne) {
  const auto slices = make_slices(kRod, 0);
  ASSERT_EQ(slices.size(), 1U);
  EXPECT_EQ(slices[0].heights.size(), 0);
  EXPECT_LT(slices[0].centre_B.norm(), 1e-9);
}

// All that gives way when its end is pressed, inertia relieved: L / (3 E A),
// and what the end's own half space has not, 2 R_res.
TEST(ContactSlices, OfARodGiveWayAtTheirEndAsTheRodDoes) {
  for (const int modes : {3, 20}) {
    Recipe recipe = make_recipe(kRod);
    recipe.contact_groups = {"skin", "tip"};
    recipe.basis.eigenmodes = modes;
    recipe.basis.interface_modes = false;
    const ReducedBody body = reduce(recipe);
    const ContactSlice& end = find_last(body.contact_surfaces.at(0).slices);
    const ContactPart& flat = body.contact_surfaces.at(1).parts.at(0);
    const auto sum = [&](const auto& motion) {
      double all = 0.0;
      for (Eigen::Index k = 0; k < body.lambda.size(); ++k) {
        all += motion(0, k) * motion(0, k) / body.lambda[k];
      }
      return all;
    };
    const double a = std::sqrt(1e-4 / std::acos(-1.0));
    const double own = 1.0 / (2.0 * 210e9 * a);
    const double of_flat = sum(flat.motion_B) + flat.flexibility;
    const double more = std::max(2.0 * flat.residual - own, 0.0);
    EXPECT_NEAR(of_flat * 3.0 * 210e9 * 1e-4, 1.0, 2e-3) << modes;
    EXPECT_NEAR(
        (sum(end.motion_B) + end.flexibility_B(0, 0)) / (of_flat + more), 1.0,
        2e-3)
        << modes;
  }
}

TEST(ContactSlices, OfACompactBodyAreOne) {
  const Bar cube{
      .size = {0.1, 0.1, 0.1}, .cells = 2, .material = {210e9, 0.3, 7850.0}};
  EXPECT_EQ(make_slices(cube, 6).size(), 1U);
}

TEST(ContactSlices, OfABendingFingerAreSeveralAlongIt) {
  const auto slices = make_slices(kFinger, 6);
  EXPECT_GE(slices.size(), 4U);
  EXPECT_LE(slices.size(), kMostSlices);
  for (const ContactSlice& slice : slices) {
    EXPECT_GE(slice.heights.size(), 1);
    EXPECT_LE(slice.heights.size(), 2);
    for (Eigen::Index k = 0; k < slice.heights.size(); ++k) {
      EXPECT_GT(std::abs(slice.normals_B(0, k)), 1.0 - 1e-12);
      EXPECT_LT(slice.normals_B.col(k).dot(slice.centre_B), slice.heights[k]);
    }
    EXPECT_LT((slice.flexibility_B - slice.flexibility_B.transpose()).norm(),
              1e-12 * slice.flexibility_B.norm());
  }
}

/// A free bar's surface and its samples.
struct MeshSurface {
  explicit MeshSurface(const Bar& bar)
      : body(make_recipe(bar), {}),
        surface(fem::make_surface(
            body.mesh,
            find_contact_groups(body.mesh, {"skin"}, {{70e9, 0.3, 2700.0}})
                .front()
                .faces)),
        samples(sample_surface(body.mesh, surface)) {}

  MeshedBody body;
  fem::Surface surface;
  std::vector<SurfaceSample> samples;
};

TEST(ContactSlices, MoveExactlyWithARigidBody) {
  const MeshSurface mesh_surface(kRod);
  const Vector3 about(0.05, 0.3, -0.1);
  const Matrix3X& x = mesh_surface.body.mesh.x;
  MatrixX Phi(3 * x.cols(), 6);
  for (Eigen::Index n = 0; n < x.cols(); ++n) {
    Phi.middleRows<3>(3 * n).leftCols<3>() = Matrix3::Identity();
    Phi.middleRows<3>(3 * n).rightCols<3>() = -skew(x.col(n) - about);
  }
  const VectorX lambda = VectorX::Ones(6);
  const auto division =
      divide_surface(mesh_surface.samples, lambda, Phi, 70e9, kMostSlices);
  ASSERT_EQ(division.slices.size(), 1U);
  const SliceMotion motion(division.slices[0].samples);
  Matrix6 expected = Matrix6::Identity();
  expected.topRightCorner<3, 3>() = -skew(motion.centre() - about);
  EXPECT_LT((motion.find_motion(Phi) - expected).norm(), 1e-9);
}

// A unit load has the force 1 and no moment about the centre.
TEST(ContactSlices, CarryForcesWithoutMoments) {
  const MeshSurface mesh_surface(kRod);
  std::vector<const SurfaceSample*> end;
  for (const SurfaceSample& s : mesh_surface.samples) {
    if (s.x.x() > 0.9) end.push_back(&s);
  }
  const SliceMotion motion(end);
  const Matrix3X& x = mesh_surface.body.mesh.x;
  const MatrixX loads = motion.find_loads(x.cols());
  for (int k = 0; k < 3; ++k) {
    Vector3 force = Vector3::Zero();
    Vector3 moment = Vector3::Zero();
    double on_end = 0.0;
    for (Eigen::Index n = 0; n < x.cols(); ++n) {
      const Vector3 f = loads.col(k).segment<3>(3 * n);
      force += f;
      moment += (x.col(n) - motion.centre()).cross(f);
      if (x(0, n) > 1.0 - 1e-9) on_end += f.x();
    }
    EXPECT_LT((force - Vector3::Unit(k)).norm(), 1e-9);
    EXPECT_LT(moment.norm(), 1e-9);
    if (k == 0) {
      EXPECT_NEAR(on_end, 1.0, 1e-3);
    }
  }
}

// At level full the nodes move parts and slices as the modes' rows do.
TEST(ContactSlices, OfAWholeMeshMoveAsThoseOfTheModes) {
  Recipe recipe = make_recipe(kFinger);
  recipe.contact_groups = {"skin", "top"};
  recipe.basis.eigenmodes = 6;
  recipe.basis.interface_modes = false;
  const ReducedBody reduced = reduce(recipe);
  const auto surfaces =
      find_contact_surfaces(*make_full_body(recipe, {}, {}, &reduced));
  ASSERT_EQ(surfaces.size(), 2U);
  srand(5);
  const MeshedBody body(recipe, {});
  for (const FullContactSurface& full : surfaces) {
    const std::size_t count =
        full.surface.parts.size() + full.surface.slices.size();
    ASSERT_EQ(full.pieces.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const NodalPiece& piece = full.pieces[i];
      const Vector3 centre = full.surface.parts.empty()
                                 ? full.surface.slices[i].centre_B
                                 : full.surface.parts[i].centre_B;
      const Vector3 turn = Vector3::Random();
      Vector6 moved = Vector6::Zero();
      for (std::size_t k = 0; k < piece.nodes.size(); ++k) {
        const auto at = static_cast<Eigen::Index>(k);
        const Vector3 x = Vector3(body.mesh.x.col(piece.nodes[k])) -
                          Vector3(0.1, 0.01, 0.004);  // of mass
        EXPECT_LT((Vector3(piece.x_P.col(at)) - (x - centre)).norm(), 1e-6);
        moved += piece.motion.middleCols<3>(3 * at) * turn.cross(x - centre);
      }
      EXPECT_LT(moved.head<3>().norm(), 1e-6);
      EXPECT_LT((Vector3(moved.tail<3>()) - turn).norm(), 1e-4);
    }
  }
}

}  // namespace
}  // namespace limber::flexbody::contact_slices_test
