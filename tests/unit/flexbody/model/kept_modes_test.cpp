// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/kept_modes.hpp"

#include <gtest/gtest.h>

#include "limber/common/errors.hpp"
#include "unit/flexbody/small_body.hpp"

namespace limber::flexbody::kept_modes_test {
namespace {

/// A body with m modes, whose tables name their modes: entry = function of
/// them.
ReducedBody make_body(int m) {
  ReducedBody body;
  body.name = "arm";
  body.lambda = VectorX::LinSpaced(m, 1.0, m);
  body.rows.tags = {7, 9};
  body.rows.x_B = Matrix3X::Zero(3, 2);
  body.rows.Phi_B = VectorX::Ones(6) * body.lambda.transpose();
  for (int k = 0; k < m; ++k) {
    body.integrals.S1.push_back(Matrix3::Constant(k));
    for (int l = 0; l < m; ++l) {
      body.integrals.S2.push_back(Matrix3::Constant(100.0 * k + l));
    }
  }
  InterfaceTable tip;
  tip.Phi_B = Vector3::Ones() * body.lambda.transpose();
  tip.Psi_B = 2.0 * tip.Phi_B;
  tip.flexibility = Matrix6::Identity();
  body.interfaces = {tip};
  return body;
}

TEST(KeptModes, AreTheLowestInEveryTable) {
  const ReducedBody kept = keep_lowest_modes(make_body(5), 3);
  EXPECT_EQ(kept.mode_count(), 3);
  EXPECT_EQ(kept.lambda, Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(kept.rows.Phi_B, VectorX::Ones(6) * Eigen::RowVector3d(1, 2, 3));
  ASSERT_EQ(kept.integrals.S1.size(), 3U);
  ASSERT_EQ(kept.integrals.S2.size(), 9U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(kept.integrals.S1[k], Matrix3::Constant(double(k)));
    for (std::size_t l = 0; l < 3; ++l) {
      EXPECT_EQ(kept.integrals.S2[3 * k + l],
                Matrix3::Constant(100.0 * double(k) + double(l)));
    }
  }
  EXPECT_EQ(kept.interfaces[0].Phi_B,
            Vector3::Ones() * Eigen::RowVector3d(1, 2, 3));
  EXPECT_EQ(kept.interfaces[0].Psi_B, 2.0 * kept.interfaces[0].Phi_B);
  EXPECT_EQ(kept.interfaces[0].flexibility, Matrix6::Identity());
}

TEST(KeptModes, AreAllOfABodyWithNoMore) {
  const ReducedBody body = make_body(4);
  EXPECT_EQ(test::find_difference(body, keep_lowest_modes(body, 4)), "");
  EXPECT_EQ(test::find_difference(body, keep_lowest_modes(body, 9)), "");
}

TEST(KeptModes, RefuseTablesThatDependOnAllModes) {
  ReducedBody touching = make_body(4);
  touching.contact_surfaces.emplace_back();
  ReducedBody nonlinear = make_body(4);
  nonlinear.manifold.emplace();
  ReducedBody bent = make_body(4);
  bent.initial.displacement.emplace();
  for (const ReducedBody& body : {touching, nonlinear, bent}) {
    EXPECT_FALSE(has_separable_modes(body));
    EXPECT_THROW((void)keep_lowest_modes(body, 2), InputError);
  }
  EXPECT_THROW((void)keep_lowest_modes(make_body(4), 0), InputError);
}

}  // namespace
}  // namespace limber::flexbody::kept_modes_test
