// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "limber/common/errors.hpp"
#include "limber/reduction/reduce.hpp"
#include "verification/body_reference.hpp"

/// Which rows a reduced body stores must not affect anything else.
namespace limber::body_rows {
namespace {

flexbody::ReducedBody reduce_with(const std::vector<std::string>& rows) {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
  recipe.basis.eigenmodes = 4;
  recipe.interfaces = {{"near", flexbody::NearestNode{Vector3(0, 0, 5)}}};
  recipe.rows = flexbody::parse_rows(rows);
  return flexbody::reduce(recipe);
}

std::vector<std::string> group_names(const flexbody::ReducedBody& body) {
  std::vector<std::string> names;
  for (const auto& group : body.groups) names.push_back(group.name);
  return names;
}

// Counts of tests/data/beam/README.md; a face of the box has 1 m x 1 m.
TEST(BodyRows, AreThoseAskedFor) {
  EXPECT_EQ(reduce_with({"all"}).rows.tags.size(), 579U);
  EXPECT_EQ(reduce_with({"boundary"}).rows.tags.size(), 426U);
  EXPECT_EQ(reduce_with({"interfaces"}).rows.tags.size(), 1U);
  const auto root = reduce_with({"root"});
  EXPECT_EQ(group_names(root), std::vector<std::string>{"root"});
  EXPECT_EQ(root.rows.tags.size(), root.groups[0].tags.size() + 1);
  for (const std::size_t tag : root.groups[0].tags) {
    const auto row = static_cast<Eigen::Index>(flexbody::find_row(root, tag));
    EXPECT_NEAR(root.rows.x_B(2, row), -2.5, 1e-9);
  }
}

TEST(BodyRows, ChangeNothingElse) {
  const auto all = reduce_with({"all"});
  const auto few = reduce_with({"root", "tip"});
  EXPECT_EQ(all.lambda, few.lambda);
  EXPECT_EQ(all.integrals.S0, few.integrals.S0);
  EXPECT_EQ(all.interfaces[0].Phi_B, few.interfaces[0].Phi_B);
  for (std::size_t i = 0; i < few.rows.tags.size(); ++i) {
    const auto row =
        static_cast<Eigen::Index>(flexbody::find_row(all, few.rows.tags[i]));
    EXPECT_EQ(all.rows.Phi_B.middleRows<3>(3 * row),
              few.rows.Phi_B.middleRows<3>(3 * static_cast<Eigen::Index>(i)));
  }
}

TEST(BodyRows, OfAnUnknownGroupAreRefused) {
  EXPECT_THROW(reduce_with({"roof"}), InputError);
}

}  // namespace
}  // namespace limber::body_rows
