// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/modal/static_modes.hpp"

#include <gtest/gtest.h>

#include "unit/reduction/bar.hpp"

namespace limber::flexbody::static_modes_test {
namespace {

class FreeAndClampedBar : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Support, FreeAndClampedBar, ::testing::Bool(),
                         [](const auto& p) {
                           return p.param ? "Clamped" : "Free";
                         });

// The modes that are known beforehand only spare refinement.
TEST_P(FreeAndClampedBar, HasStaticModesWhateverModesAreKnown) {
  Recipe recipe = testing::make_recipe({.cells = 12, .is_clamped = GetParam()});
  recipe.load_patterns = {{"tip", {0.0, 1.0, 2.0}}};
  const MeshedBody body(recipe, {});
  const StaticModes expected = find_static_modes(body, recipe, {});
  ASSERT_GT(expected.vectors.norm(), 0.0);
  const auto every = static_cast<int>(body.inverse.matrices().dof_count() -
                                      body.inverse.rigid_count());
  const fem::Eigenmodes lowest = fem::find_eigenmodes(body.inverse, 12);
  const std::vector<int> some = {1, 4, 5};
  for (const fem::Eigenmodes& known :
       {lowest,
        fem::Eigenmodes{lowest.lambda(some), lowest.Phi(Eigen::all, some)},
        fem::find_eigenmodes(body.inverse, every)}) {
    const StaticModes found = find_static_modes(body, recipe, known);
    ASSERT_EQ(found.vectors.cols(), expected.vectors.cols());
    for (Eigen::Index k = 0; k < found.vectors.cols(); ++k) {
      EXPECT_LE((found.vectors.col(k) - expected.vectors.col(k)).norm(),
                1e-9 * expected.vectors.col(k).norm())
          << "vector " << k;
    }
    for (std::size_t i = 0; i < found.flexibility.size(); ++i) {
      EXPECT_LE((found.flexibility[i] - expected.flexibility[i]).norm(),
                1e-9 * expected.flexibility[i].norm())
          << "interface " << i;
    }
  }
}

}  // namespace
}  // namespace limber::flexbody::static_modes_test
