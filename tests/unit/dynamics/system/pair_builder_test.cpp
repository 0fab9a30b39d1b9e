// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/dynamics/system/model_fields.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/terms/system_terms.hpp"
#include "limber/joints/pairs/point_springs.hpp"
#include "support/full_lattice.hpp"
#include "support/paired_bodies.hpp"

/// What SystemBuilder refuses of pairs, and that a run's description has them.
namespace limber::dynamics::pair_builder_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::shared_ptr<const joints::PairInteraction> make_touch(double stiffness) {
  return std::make_shared<testing::SphereContact>(stiffness, 0.0, 0.1);
}

template <typename Error>
void expect_refused(const std::function<void()>& call, const std::string& who,
                    const std::string& why) {
  try {
    call();
    ADD_FAILURE() << "taken: " << why;
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(who), HasSubstr(why)));
  }
}

TEST(PairBuilder, RefusesWhatCannotBeAPair) {
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", {1.0, Matrix3::Identity()});
  const auto law = make_touch(1e3);
  const auto refuse = [&](BodyIndex A, BodyIndex B, const std::string& why) {
    expect_refused<InputError>([&] { builder.add_pair("p", A, B, law); },
                               "pair 'p'", why);
  };
  refuse(a, a, "the same");
  refuse(kWorld, kWorld, "the world");
  expect_refused<ContractError>(
      [&] { builder.add_pair("p", a, BodyIndex(5), law); }, "pair 'p'", "body");
  EXPECT_THROW(builder.add_pair("p", a, kWorld, nullptr), ContractError);
  expect_refused<InputError>([&] { builder.add_pair("", a, kWorld, law); },
                             "pair", "name");
  builder.add_pair("p", a, kWorld, law);
  refuse(a, kWorld, "another");
  EXPECT_EQ(builder.build().pairs.size(), 1U);
}

TEST(PairBuilder, RefusesALawOfOtherModes) {
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", {1.0, Matrix3::Identity()});
  joints::PointSprings::Line line{
      {}, {}, joints::PointSpring({.stiffness = 1.0})};
  line.on_B.Phi_B = Matrix3X::Zero(3, 2);
  const auto springs = std::make_shared<joints::PointSprings>(
      std::vector<joints::PointSprings::Line>{line});
  expect_refused<InputError>([&] { builder.add_pair("p", kWorld, a, springs); },
                             "pair 'p'", "line 1 has 2 modes of body B");
}

// Such a body has three columns a node and one more.
TEST(PairBuilder, RefusesALawOfModesForABodyAtLevelFull) {
  testing::Lattice lattice;
  SystemBuilder builder;
  const auto full =
      builder.add_full_body("mesh", lattice.reduced, lattice.full, {});
  joints::PointSprings::Line line{
      {}, {}, joints::PointSpring({.stiffness = 1.0})};
  line.on_B.Phi_B = Matrix3X::Zero(3, 2);
  const auto springs = std::make_shared<joints::PointSprings>(
      std::vector<joints::PointSprings::Line>{line});
  expect_refused<InputError>(
      [&] { builder.add_pair("p", kWorld, full, springs); }, "pair 'p'",
      "line 1 has 2 modes of body B");
}

TEST(PointSprings, RefuseNoLinesAndPlacesThatAreNotFinite) {
  EXPECT_THROW(joints::PointSprings({}), InputError);
  joints::PointSprings::Line line{
      {}, {}, joints::PointSpring({.stiffness = 1.0})};
  line.on_A.x_B.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(joints::PointSprings({line}), InputError);
}

TEST(PairResponse, RefusesMorePointsThanItsLawMayHave) {
  joints::PairResponse response(1, 2, 0);
  EXPECT_EQ(response.add().on_A.Phi_B.cols(), 2);
  EXPECT_THROW(response.add(), ContractError);
  response.clear();
  EXPECT_TRUE(response.points().empty());
}

SystemModel make_model(double stiffness, double place, double spring) {
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", {1.0, Matrix3::Identity()});
  builder.add_pair("touch", kWorld, a, make_touch(stiffness));
  joints::PointSprings::Line line{
      {}, {}, joints::PointSpring({.stiffness = spring})};
  line.on_B.x_B.y() = place;
  builder.add_pair("line", kWorld, a,
                   std::make_shared<joints::PointSprings>(
                       std::vector<joints::PointSprings::Line>{line}));
  return builder.build();
}

// A run that resumes with another law is refused by these lines.
TEST(PairManifest, NamesWhatChanged) {
  const auto list = [](const SystemModel& model) {
    Manifest manifest;
    describe(manifest, "", model);
    return manifest;
  };
  const Manifest before = list(make_model(1.0, 0.5, 3.0));
  EXPECT_TRUE(
      find_differences(before, list(make_model(1.0, 0.5, 3.0))).empty());
  const auto expect = [&](const SystemModel& model, const char* pair) {
    const auto differences = find_differences(before, list(model));
    ASSERT_EQ(differences.size(), 1U);
    EXPECT_THAT(differences[0], HasSubstr(pair));
  };
  expect(make_model(2.0, 0.5, 3.0), "touch");
  expect(make_model(1.0, 0.6, 3.0), "line");
  expect(make_model(1.0, 0.5, 4.0), "line");
}

}  // namespace
}  // namespace limber::dynamics::pair_builder_test
