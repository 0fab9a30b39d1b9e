// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "limber/reduction/reduce.hpp"
#include "verification/body_reference.hpp"

namespace limber::body_eigenvalues_slow {
namespace {

TEST(BodyEigenvaluesLarge, MatchTheIndependentProgramAt30000Nodes) {
  constexpr double kSameMesh = 1e-8;
  for (const bool is_clamped : {false, true}) {
    const auto body =
        flexbody::reduce(test::beam_recipe("beam30k_v41.msh", is_clamped));
    const auto expected = test::reference_eigenvalues(
        "beam30k", is_clamped ? "clamped" : "free", 5);
    ASSERT_EQ(expected.size(), 20U);
    for (Eigen::Index i = 0; i < 20; ++i)
      EXPECT_NEAR(body.lambda[i] / expected[static_cast<std::size_t>(i)], 1.0,
                  kSameMesh);
  }
}

}  // namespace
}  // namespace limber::body_eigenvalues_slow
