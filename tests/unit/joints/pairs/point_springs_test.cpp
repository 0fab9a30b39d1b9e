// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/pairs/point_springs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::joints::point_springs_test {
namespace {

// A body with one mode that turns, moves and vibrates at constant rates.
struct Moving {
  Vector3 p, v, turn, w;
  double eta, etadot;
  double eta_now = 0.0;

  // After `t` seconds: exact to second order in t.
  PairBody at(double t) {
    eta_now = eta + t * etadot;
    PairBody body;
    body.R_WB = exp_rotation(turn) * exp_rotation(t * w);
    body.p_WB = p + t * v;
    body.v_WB_W = v;
    body.w_WB_B = w;
    body.modes = 1;
    body.eta = &eta_now;
    body.etadot = &etadot;
    return body;
  }
};

PairPlace make_place(const Vector3& x, const Vector3& phi) {
  PairPlace place;
  place.x_B = x;
  place.Phi_B = phi;
  return place;
}

class PointSpringsTest : public ::testing::Test {
 protected:
  static PointSprings::Line make_line(const PointSpring::Parameters& spring) {
    return {make_place({0.3, -0.2, 0.5}, {0.1, 0.4, -0.3}),
            make_place({-0.1, 0.6, 0.2}, {-0.5, 0.2, 0.6}),
            PointSpring(spring)};
  }

  Moving A_{{0.1, 0.2, -0.3},
            {1.0, -2.0, 0.5},
            {0.3, -0.2, 0.7},
            {0.9, 1.1, -0.4},
            0.25,
            -1.5};
  Moving B_{{2.0, -0.4, 0.9},
            {-0.7, 0.3, 1.2},
            {-0.5, 0.4, 0.1},
            {-1.3, 0.6, 0.8},
            -0.35,
            2.2};
  PairResponse out_{4, 1, 1};
};

TEST_F(PointSpringsTest, PlacesMoveWithTheirBodiesAndModes) {
  const PairPlace place = make_place({0.3, -0.2, 0.5}, {0.1, 0.4, -0.3});
  const PairBody now = A_.at(0.0);
  const Vector3 arm = Vector3(0.3, -0.2, 0.5) + 0.25 * Vector3(0.1, 0.4, -0.3);
  EXPECT_LT((find_arm(now, place) - arm).norm(), 1e-15);
  const Vector3 position = A_.p + exp_rotation(A_.turn) * arm;
  EXPECT_LT((find_position(now, place) - position).norm(), 1e-15);
  const double h = 1e-6;
  Moving later = A_;
  Moving earlier = A_;
  const Vector3 difference = (find_position(later.at(h), place) -
                              find_position(earlier.at(-h), place)) /
                             (2.0 * h);
  EXPECT_LT((find_velocity(now, place) - difference).norm(), 1e-8);
}

TEST_F(PointSpringsTest, PullBothEndsTogetherByHookesLaw) {
  const double k = 300.0, c = 7.0, free_length = 0.8;
  const auto line =
      make_line({.stiffness = k, .damping = c, .free_length = free_length});
  const PairBody a = A_.at(0.0);
  const PairBody b = B_.at(0.0);
  PointSprings({line}).evaluate({a, b}, {0.0}, {}, out_);
  const Vector3 d = find_position(b, line.on_B) - find_position(a, line.on_A);
  const Vector3 e = d.normalized();
  const double rate =
      e.dot(find_velocity(b, line.on_B) - find_velocity(a, line.on_A));
  const double stretch = d.norm() - free_length;
  ASSERT_EQ(out_.points().size(), 1);
  EXPECT_LT((out_.points()[0].force_W + (k * stretch + c * rate) * e).norm(),
            1e-11);
  EXPECT_NEAR(out_.energy, 0.5 * k * stretch * stretch, 1e-11);
  EXPECT_NEAR(out_.dissipation, c * rate * rate, 1e-10);
  EXPECT_EQ(out_.points()[0].on_A.x_B, line.on_A.x_B);
  EXPECT_EQ(out_.points()[0].on_B.Phi_B, line.on_B.Phi_B);
}

TEST_F(PointSpringsTest, AddUpAndLeaveOutSlackLines) {
  const auto taut = make_line({.stiffness = 300.0, .damping = 7.0});
  const auto slack = make_line({.stiffness = 300.0,
                                .damping = 7.0,
                                .free_length = 50.0,
                                .tension_only = true});
  const PairBody a = A_.at(0.0);
  const PairBody b = B_.at(0.0);
  PointSprings({taut, slack, taut}).evaluate({a, b}, {0.0}, {}, out_);
  EXPECT_EQ(out_.points().size(), 2);
  const double energy = out_.energy;
  const double dissipation = out_.dissipation;
  out_.clear();
  PointSprings({taut}).evaluate({a, b}, {0.0}, {}, out_);
  EXPECT_NEAR(energy, 2.0 * out_.energy, 1e-11);
  EXPECT_NEAR(dissipation, 2.0 * out_.dissipation, 1e-11);
}

TEST_F(PointSpringsTest, ActHoweverSoftTheyAre) {
  const PairBody a = A_.at(0.0);
  const PairBody b = B_.at(0.0);
  const auto line = make_line({.stiffness = 1e-6, .damping = 1e-9});
  PointSprings({line}).evaluate({a, b}, {0.0}, {}, out_);
  ASSERT_EQ(out_.points().size(), 1);
  EXPECT_GT(out_.points()[0].force_W.norm(), 1e-7);
}

// The force on B follows the motion of the points as its matrices tell.
TEST_F(PointSpringsTest, MatricesAreDerivativesOfTheForce) {
  const auto line =
      make_line({.stiffness = 300.0, .damping = 7.0, .free_length = 0.8});
  const PointSprings springs({line});
  const auto find_force = [&](const Vector3& shift, const Vector3& push) {
    const PairBody a = A_.at(0.0);
    PairBody b = B_.at(0.0);
    b.p_WB += shift;
    b.v_WB_W += push;
    out_.clear();
    springs.evaluate({a, b}, {0.0}, {}, out_);
    return out_.points()[0].force_W;
  };
  const double h = 1e-6;
  Matrix3 stiffness, damping;
  for (int i = 0; i < 3; ++i) {
    const Vector3 step = h * Vector3::Unit(i);
    const Vector3 none = Vector3::Zero();
    stiffness.col(i) =
        (find_force(-step, none) - find_force(step, none)) / (2.0 * h);
    damping.col(i) =
        (find_force(none, -step) - find_force(none, step)) / (2.0 * h);
  }
  find_force(Vector3::Zero(), Vector3::Zero());
  EXPECT_LT((out_.points()[0].stiffness - stiffness).norm(), 1e-5);
  EXPECT_LT((out_.points()[0].damping - damping).norm(), 1e-6);
}

// Over a step the work on both bodies is the change of energy and the loss.
TEST_F(PointSpringsTest, OverAStepDoTheWorkThatTheirEnergyChanges) {
  const auto line =
      make_line({.stiffness = 300.0, .damping = 7.0, .free_length = 0.8});
  const PointSprings springs({line});
  const double h = 0.02;
  Moving A_end = A_, A_middle = A_, B_end = B_, B_middle = B_;
  const PairBody a0 = A_.at(0.0), a1 = A_end.at(h), a = A_middle.at(0.5 * h);
  const PairBody b0 = B_.at(0.0), b1 = B_end.at(h), b = B_middle.at(0.5 * h);
  springs.evaluate({a0, b0}, {0.0}, {}, out_);
  const PairResponse at_begin = out_;
  out_.clear();
  springs.evaluate({a1, b1}, {h}, {}, out_);
  const PairResponse at_end = out_;
  const double gained = at_end.energy - at_begin.energy;
  out_.clear();
  springs.evaluate_over_step({{a0, b0},
                              {a, b},
                              {a1, b1},
                              {.begin = 0.0, .end = h, .h = h},
                              at_begin,
                              at_end},
                             {}, out_);
  const Vector3 moved =
      find_position(b1, line.on_B) - find_position(a1, line.on_A) -
      find_position(b0, line.on_B) + find_position(a0, line.on_A);
  EXPECT_NEAR(-out_.points()[0].force_W.dot(moved),
              gained + h * out_.dissipation, 1e-10 * std::abs(gained));
  EXPECT_GT(out_.dissipation, 0.0);
}

TEST(PointSpringsInput, IsRefusedWithoutLinesOrWithOtherModes) {
  EXPECT_THROW(PointSprings({}), InputError);
  PointSprings::Line line{make_place(Vector3::Zero(), Vector3::UnitX()),
                          make_place(Vector3::UnitY(), Vector3::UnitX()),
                          PointSpring({.stiffness = 1.0})};
  EXPECT_NO_THROW(PointSprings({line}).check(1, 1));
  EXPECT_THROW(PointSprings({line}).check(2, 1), InputError);
  EXPECT_THROW(PointSprings({line}).check(1, 0), InputError);
  line.on_B.x_B[1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(PointSprings({line}), InputError);
}

TEST(PairResponseOfCoupledPoints, HasATermForEachTwo) {
  PairResponse response(3, 0, 0, true);
  for (int i = 0; i < 3; ++i) response.add();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      response.coupling(i, j).setConstant(10.0 * i + j);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(response.coupling(i, j)(2, 1), 10.0 * i + j);
    }
  }
}

TEST(PairResponseOfCoupledPoints, BoundsItsStiffnessAfterGershgorin) {
  PairResponse response(3, 0, 0, true);
  response.add().stiffness = 10.0 * Matrix3::Identity();
  response.add();
  response.add();
  response.coupling(0, 1) = Vector3(3.0, 0.0, 4.0).asDiagonal();
  response.coupling(0, 2)(1, 2) = -2.0;
  const Matrix3 expected = (10.0 + 5.0 + 2.0) * Matrix3::Identity();
  EXPECT_LT((response.find_stiffness_bound(0) - expected).norm(), 1e-14);
  EXPECT_THROW(static_cast<void>(response.coupling(0, 3)), ContractError);
  response.uncouple();
  EXPECT_LT(
      (response.find_stiffness_bound(0) - 10.0 * Matrix3::Identity()).norm(),
      1e-14);
}

}  // namespace
}  // namespace limber::joints::point_springs_test
