// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/offset.hpp"

#include <gtest/gtest.h>

#include "small_run.hpp"

namespace limber::results::offset_test {
namespace {

// A cube of the same edges at a place.
Bounds make_box(const Vector3& centre, double edge) {
  Bounds box;
  box.include(centre, 0.5 * edge);
  return box;
}

TEST(Offset, IsZeroNearTheOrigin) {
  EXPECT_EQ(choose_offset(make_box({0.0, 0.0, 0.0}, 1.0)), Vector3::Zero());
  EXPECT_EQ(choose_offset(make_box({9.0, 9.0, 9.0}, 1.0)), Vector3::Zero());
  EXPECT_EQ(choose_offset(make_box({9e6, 0.0, 0.0}, 1e6)), Vector3::Zero());
}

TEST(Offset, IsZeroWithoutPointsAndOfOnePoint) {
  EXPECT_EQ(choose_offset({}), Vector3::Zero());
  EXPECT_EQ(choose_offset(make_box({1e7, 0.0, 0.0}, 0.0)), Vector3::Zero());
}

TEST(Offset, IsTheCentreToThePowerOfTenOfTheSize) {
  EXPECT_EQ(choose_offset(make_box({12345.678, -0.2, 3.0}, 1.0)),
            Vector3(12346.0, 0.0, 3.0));
  EXPECT_EQ(choose_offset(make_box({12345.678, -0.2, 3.0}, 0.1)),
            Vector3(12345.7, -0.2, 3.0));
  EXPECT_EQ(choose_offset(make_box({-12345.678, 777.0, 3.0}, 200.0)),
            Vector3(-12300.0, 800.0, 0.0));
}

TEST(Offset, OfARunMovesWithItsBodies) {
  test::SmallRun run = test::make_small_run();
  EXPECT_EQ(find_home(run.model, run.history.states).offset, Vector3::Zero());
  const Vector3 place(1e7, 0.0, -2e6);
  test::move_bodies(run.history, place);
  EXPECT_EQ(find_home(run.model, run.history.states).offset, place);
}

TEST(Offset, OfARunWithoutOutputsIsZero) {
  const Home home = find_home(test::make_empty_run().model, {});
  EXPECT_EQ(home.offset, Vector3::Zero());
  EXPECT_FALSE(home.travels);
}

// Balls of radius 0.5 m, 2 m apart, are a scene of 3.3 m.
TEST(Offset, ALongCommonMotionIsAPathOfItsOwn) {
  MatrixX p(3, 3);
  p << 0.0, 0.0, 0.0, 1500.0, 0.0, 0.0, 6000.0, 0.0, 0.0;
  const MatrixX beside = p.rowwise() + Eigen::RowVector3d(0.0, 2.0, 0.0);
  const Home home = find_home({{0.5, p}, {0.5, beside}});
  EXPECT_TRUE(home.travels);
  EXPECT_EQ(home.path, MatrixX(p.rowwise() + Eigen::RowVector3d(0, 1, 0)));
  const MatrixX shorter = 0.5 * p;
  const MatrixX beside_it =
      shorter.rowwise() + Eigen::RowVector3d(0.0, 2.0, 0.0);
  EXPECT_FALSE(find_home({{0.5, shorter}, {0.5, beside_it}}).travels);
  const Home company = find_home({{0.5, p}, {0.5, MatrixX::Zero(3, 3)}});
  EXPECT_FALSE(company.travels);
  EXPECT_EQ(company.path, MatrixX::Zero(3, 3));
}

}  // namespace
}  // namespace limber::results::offset_test
