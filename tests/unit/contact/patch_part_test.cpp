// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_part.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "limber/common/rotation.hpp"
#include "limber/contact/patches/patch_pair.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"
#include "unit/contact/flat_rod.hpp"

/// Parts of a flexible surface: their motion against differences, and the work
/// of contact on modes.
namespace limber::contact::patch_part_test {
namespace {

using joints::PairBody;

constexpr int kModes = 4;

flexbody::ContactPart make_part(double x) {
  flexbody::ContactPart part = test::make_end_part(kModes);
  // Not along the normal alone, and with large rotations.
  part.motion_B = 0.05 * MatrixX::Random(6, kModes);
  part.centre_B.y() += x;
  part.corners_B.row(1).array() += x;
  return part;
}

struct Moving {
  VectorX eta = VectorX::Random(kModes);
  VectorX etadot = VectorX::Random(kModes);
  PairBody body{exp_rotation({0.3, -0.2, 0.5}),
                {0.4, 0.1, -0.2},
                {0.7, -0.4, 0.2},
                {0.3, 0.8, -0.6},
                kModes,
                nullptr,
                nullptr};

  [[nodiscard]] PairBody view() const {
    PairBody seen = body;
    seen.eta = eta.data();
    seen.etadot = etadot.data();
    return seen;
  }
  // After a time dt.
  [[nodiscard]] Moving go(double dt) const {
    Moving later = *this;
    later.eta += dt * etadot;
    later.body.p_WB += dt * body.v_WB_W;
    later.body.R_WB = body.R_WB * exp_rotation(dt * body.w_WB_B);
    return later;
  }
};

TEST(PatchPart, MovesAtTheRateOfItsPose) {
  srand(3);
  const Moving now;
  const PatchPart part(make_part(0.0), 0.0);
  const double h = 1e-6;
  const PairBody before = part.find_motion(now.go(-h).view());
  const PairBody at = part.find_motion(now.view());
  const PairBody after = part.find_motion(now.go(h).view());
  EXPECT_LT(((after.p_WB - before.p_WB) / (2.0 * h) - at.v_WB_W).norm(), 1e-8);
  const Vector3 turn =
      log_rotation(Matrix3(before.R_WB.transpose() * after.R_WB));
  EXPECT_LT((turn / (2.0 * h) - at.w_WB_B).norm(), 1e-8);
}

TEST(PatchPart, CarriesItsPlacesAlong) {
  srand(4);
  const Moving now;
  const PatchPart part(make_part(0.0), 0.0);
  const PairBody at = part.find_motion(now.view());
  const Vector3 p_W = at.p_WB + Vector3(0.003, -0.002, 0.004);
  joints::PairPlace place{Vector3::Zero(), Matrix3X::Zero(3, kModes)};
  part.set_place(now.view(), p_W, place);
  EXPECT_LT((find_position(now.view(), place) - p_W).norm(), 1e-15);
  const Vector3 velocity =
      at.v_WB_W + (at.R_WB * at.w_WB_B).cross(p_W - at.p_WB);
  EXPECT_LT((find_velocity(now.view(), place) - velocity).norm(), 1e-14);
}

ContactSide make_side(const std::vector<double>& at) {
  flexbody::ContactSurface end = test::make_end(kModes);
  end.parts.clear();
  for (const double x : at) end.parts.push_back(make_part(x));
  return {Shape{std::make_shared<const MeshSurface>(end), {}},
          SurfaceMaterial{test::kModulus, 0.0}, test::kMass,
          Matrix3::Identity()};
}

void expect_energy_falls(const ShapeKind& shape) {
  for (const auto& parts : {std::vector{0.0}, std::vector{0.0, 0.02}}) {
    srand(5);
    const PatchPair pair(
        {Shape{shape, {}}, std::nullopt, 1e9, 1e9 * Matrix3::Identity()},
        make_side(parts), {});
    VectorX eta = 1e-4 * VectorX::Random(kModes);
    const VectorX etadot = VectorX::Zero(kModes);
    const auto evaluate = [&](joints::PairResponse& out) {
      const PairBody B{exp_rotation({0.0, 2e-4, 1e-4}),
                       {0.1 + 0.5 * test::kLength - 2e-5, 0.0, 0.0},
                       Vector3::Zero(),
                       Vector3::Zero(),
                       kModes,
                       eta.data(),
                       etadot.data()};
      const PairBody A;
      const std::vector<double> memory(pair.memory_size(), 0.0);
      out.clear();
      pair.evaluate({A, B}, {0.0, Side::right}, memory, out);
      VectorX force = VectorX::Zero(kModes);
      for (const joints::PairPoint& point : out.points()) {
        force +=
            point.on_B.Phi_B.transpose() * B.R_WB.transpose() * point.force_W;
      }
      return force;
    };
    joints::PairResponse out(pair.most_points(), 0, kModes, true);
    const VectorX force = evaluate(out);
    // A line of contact lies on one of two parts.
    const std::size_t flats =
        std::holds_alternative<Box>(shape) ? parts.size() : 1;
    EXPECT_EQ(out.points().size(), 3 * flats);
    for (int k = 0; k < kModes; ++k) {
      const double h = 1e-7;
      const double middle = eta[k];
      eta[k] = middle + h;
      (void)evaluate(out);
      const double above = out.energy;
      eta[k] = middle - h;
      (void)evaluate(out);
      const double below = out.energy;
      eta[k] = middle;
      EXPECT_NEAR(-(above - below) / (2.0 * h), force[k], 1e-5 * force.norm())
          << k;
    }
  }
}

// dV = -sum f . d(p_B - p_A) by each modal coordinate, of one part and of two.
TEST(PatchPair, ActsOnModesAsItsEnergyFalls) {
  expect_energy_falls(Box{{0.1, 0.05, 0.04}});
  expect_energy_falls(Cylinder{0.1, 0.04});
  expect_energy_falls(Capsule{0.1, 0.04});
}

}  // namespace
}  // namespace limber::contact::patch_part_test
