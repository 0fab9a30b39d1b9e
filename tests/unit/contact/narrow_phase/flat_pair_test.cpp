// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/contact/narrow_phase/shape_pair.hpp"
#include "limber/contact/shapes/skin.hpp"
#include "unit/contact/shapes/surfaces.hpp"

/// Pads of a square sheet that looks up, |x|, |y| <= 10 mm, and what is above.
namespace limber::contact::flat_pair_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHalf = 0.01;  // [m]
constexpr int kCells = 2;       // a pad on each of 3 x 3 nodes

Shape make_sheet(double half = kHalf) {
  auto sheet = test::make_sheet_surface(half, kCells, false,
                                        [](double, double) { return 0.0; });
  const Eigen::Index n = sheet.x_B.cols();
  sheet.pads.normal_B = Vector3::UnitZ();
  sheet.pads.x_B = sheet.x_B;
  sheet.pads.Phi_B = MatrixX::Zero(3 * n, 0);
  sheet.pads.flexibility = MatrixX::Identity(n, n);
  sheet.pads.area.resize(n);
  const double cell = 2.0 * half / kCells;
  for (Eigen::Index i = 0; i < n; ++i) {
    double area = cell * cell;
    for (int axis = 0; axis < 2; ++axis) {
      if (std::abs(sheet.x_B(axis, i)) > 0.9 * half) area *= 0.5;
    }
    sheet.pads.area[i] = area;
  }
  sheet.youngs_modulus = 1e9;
  return {std::make_shared<const Skin>(sheet), {}};
}

struct Placed {
  Matrix3 R = Matrix3::Identity();
  Vector3 p = Vector3::Zero();
  [[nodiscard]] joints::PairBody body() const { return {.R_WB = R, .p_WB = p}; }
};

std::vector<Meeting> meet(const ShapePair& pair, const Placed& above) {
  std::vector<Meeting> out(pair.most_points());
  pair.find({joints::PairBody{}, above.body()}, kInfinity, out);
  return out;
}

const Shape kBox{Box{{0.03, 0.03, 0.02}}, {}};

TEST(FlatPair, MeetsAFaceWithItsPadsAsItsPlane) {
  const ShapePair on_box(make_sheet(), kBox);
  ASSERT_EQ(on_box.pad_count(), 9U);
  const Pose down{exp_rotation(Vector3(std::numbers::pi, 0.0, 0.0)),
                  {0.0, 0.0, -0.02}};
  const ShapePair on_plane(make_sheet(), Shape{HalfSpace{}, down});
  const Placed above{exp_rotation(Vector3(0.003, -0.002, 0.4)),
                     {0.002, 0.001, 0.0199}};
  const auto box = meet(on_box, above);
  const auto plane = meet(on_plane, above);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(box[i].depth, plane[i].depth, 1e-15);
    EXPECT_LT((box[i].normal_W - plane[i].normal_W).norm(), 1e-14);
    EXPECT_LT((box[i].p_W - plane[i].p_W).norm(), 1e-15);
    EXPECT_LT((box[i].on_B.x_B - plane[i].on_B.x_B).norm(), 1e-15);
    EXPECT_NEAR(box[i].share, 1.0, 1e-12);
  }
  // All others are where pads are.
  for (std::size_t i = 9; i < box.size(); ++i) {
    EXPECT_LE(box[i].depth, 0.0);
  }
}

TEST(FlatPair, IsTheSameInBothOrders) {
  const Placed above{exp_rotation(Vector3(0.003, -0.002, 0.4)),
                     {0.002, 0.001, 0.0199}};
  const auto forward = meet(ShapePair(make_sheet(), kBox), above);
  const ShapePair swapped(kBox, make_sheet());
  EXPECT_FALSE(swapped.has_pads_on_A());
  std::vector<Meeting> back(swapped.most_points());
  swapped.find({above.body(), joints::PairBody{}}, kInfinity, back);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(back[i].depth, forward[i].depth);
    EXPECT_EQ(back[i].normal_W, -forward[i].normal_W);
    EXPECT_EQ(back[i].on_A.x_B, forward[i].on_B.x_B);
  }
}

TEST(FlatPair, CountsPadsByWhatIsBeyondTheRim) {
  const ShapePair pair(make_sheet(), kBox);
  const double area = kHalf * kHalf / 2.0;  // of the pad at x = 10 mm, y = 0
  const double radius = std::sqrt(area / std::numbers::pi);
  for (const double beyond : {-0.2, 0.0, 0.25, 0.75, 1.5}) {
    // The box ends there at x = 10 mm - beyond.
    const Placed above{Matrix3::Identity(),
                       {kHalf - beyond * radius - 0.03, 0.0, 0.01999}};
    for (const Meeting& meeting : meet(pair, above)) {
      if (meeting.depth == Meeting{}.depth) continue;
      if ((meeting.on_A.x_B - Vector3(kHalf, 0.0, 0.0)).norm() > 1e-12)
        continue;
      EXPECT_LE(beyond, 1.0);
      EXPECT_NEAR(meeting.share, std::min(1.0 - beyond, 1.0), 1e-12);
    }
  }
}

// The box's lower face is on the sheet's middle, where one of the pads is.
void expect_shares(double half_width, double all, double none,
                   std::initializer_list<double> parts) {
  const Shape box{Box{{half_width, half_width, 0.02}}, {}};
  const ShapePair pair(make_sheet(), box);
  const auto cosine = [](double degrees) {
    return std::cos(degrees * std::numbers::pi / 180.0);
  };
  for (const double part : parts) {
    const double degrees = part * none;
    const Matrix3 R =
        exp_rotation(Vector3(degrees * std::numbers::pi / 180.0, 0.0, 0.0));
    const double share =
        (cosine(degrees) - cosine(none)) / (cosine(all) - cosine(none));
    bool is_there = false;
    for (const Meeting& meeting : meet(pair, {R, 0.02 * R.col(2)})) {
      if (meeting.depth == Meeting{}.depth || meeting.on_A.x_B.norm() > 1e-12) {
        continue;
      }
      EXPECT_NEAR(meeting.share, std::min(share, 1.0), 1e-4) << degrees;
      is_there = true;
    }
    EXPECT_TRUE(is_there);
  }
}

TEST(FlatPair, LeavesTiltedFacesToEdgesAndCorners) {
  expect_shares(0.03, 30.0, 45.0, {0.0, 0.65, 0.85, 0.999});
}

TEST(FlatPair, LeavesFacesWithARimOverThePadsToTheseSooner) {
  expect_shares(0.008, 0.5, 1.0, {0.0, 0.45, 0.7, 0.99});
}

// A wedge whose edge is 1 um deep at y = 1 mm, beside the pad in the middle. As
// far as the pad is covered its node on the wedge's plane counts, else the edge
// on the pad's.
TEST(FlatPair, PressesAPadBeyondTheRimByBoth) {
  const ShapePair pair(make_sheet(), kBox);
  const double beyond = 1e-3;
  const double cover = 1.0 - beyond * std::sqrt(std::numbers::pi) / kHalf;
  for (const double degrees : {0.01, 0.1, 0.4}) {
    const double tilt = degrees * std::numbers::pi / 180.0;
    const Matrix3 R = exp_rotation(Vector3(tilt, 0.0, 0.0));
    const Vector3 rim(0.0, beyond, -1e-6);
    bool is_there = false;
    for (const Meeting& meeting :
         meet(pair, {R, rim - R * Vector3(0.0, -0.03, -0.02)})) {
      if (meeting.depth == Meeting{}.depth || meeting.on_A.x_B.norm() > 1e-12) {
        continue;
      }
      EXPECT_NEAR(meeting.share, cover, 1e-5);
      const double of_node = 1e-6 * std::cos(tilt) + beyond * std::sin(tilt);
      EXPECT_NEAR(meeting.depth, cover * of_node + (1.0 - cover) * 1e-6,
                  1e-4 * of_node);
      const Vector3 normal =
          cover * R.col(2) + (1.0 - cover) * Vector3::UnitZ();
      EXPECT_LT((meeting.normal_W - normal.normalized()).norm(), 1e-6);
      is_there = true;
    }
    EXPECT_TRUE(is_there);
  }
}

// A small box over the middle of four pads, none of which is under it.
TEST(FlatPair, FindsACornerBetweenPads) {
  const ShapePair pair(make_sheet(), Shape{Box{{0.001, 0.001, 0.001}}, {}});
  const Matrix3 R = exp_rotation(Vector3(0.1, 0.15, 0.0));
  const Placed above{R, {0.005, 0.005, 0.00105}};
  // Of its eight corners the lowest.
  double lowest = kInfinity;
  for (const double x : {-1e-3, 1e-3}) {
    for (const double y : {-1e-3, 1e-3}) {
      lowest = std::min(lowest, (above.p + R * Vector3(x, y, -1e-3)).z());
    }
  }
  ASSERT_LT(lowest, 0.0);
  double deepest = -kInfinity;
  double share = 0.0;
  for (const Meeting& meeting : meet(pair, above)) {
    if (!(meeting.depth > deepest)) continue;
    deepest = meeting.depth;
    share = meeting.share;
  }
  EXPECT_NEAR(deepest, -lowest, 1e-3 * std::abs(lowest));
  EXPECT_GT(share, 0.9);
  EXPECT_EQ(pair.find_clearance({joints::PairBody{}, above.body()}), 0.0);
}

// Small tilted boxes over some of the pads, with corners between them.
TEST(FlatPair, OfAHundredTimesTheSizeMeetsAlike) {
  constexpr double kScale = 100.0;
  const Shape sheet = make_sheet();
  const Shape large_sheet = make_sheet(kScale * kHalf);
  std::mt19937 random(3);
  const auto draw = [&] { return test::draw_point(random, 1.0); };
  int partly = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3 half_size = kHalf * (0.5 * Vector3::Ones() + 0.3 * draw());
    const Placed above{exp_rotation(0.1 * draw()),
                       0.8 * kHalf * draw().cwiseProduct(Vector3(1, 1, 0)) +
                           0.98 * half_size.z() * Vector3::UnitZ()};
    const auto small = meet({sheet, Shape{Box{half_size}, {}}}, above);
    const auto large = meet({large_sheet, Shape{Box{kScale * half_size}, {}}},
                            {above.R, kScale * above.p});
    ASSERT_EQ(small.size(), large.size());
    for (std::size_t k = 0; k < small.size(); ++k) {
      EXPECT_NEAR(small[k].share, large[k].share, 1e-9);
      if (small[k].depth == Meeting{}.depth) continue;
      EXPECT_NEAR(kScale * small[k].depth, large[k].depth, 1e-12);
      EXPECT_LT((kScale * small[k].p_W - large[k].p_W).norm(), 1e-12);
      if (k > 9 && small[k].share > 0.0 && small[k].share < 1.0) ++partly;
    }
  }
  EXPECT_GT(partly, 30);
}

TEST(FlatPair, TellsItsClearance) {
  const ShapePair pair(make_sheet(), kBox);
  for (const double gap : {1e-9, 1e-5, 0.3}) {
    const Placed above{Matrix3::Identity(), {0.001, 0.002, 0.02 + gap}};
    EXPECT_NEAR(pair.find_clearance({joints::PairBody{}, above.body()}), gap,
                gap > 0.1 ? 0.5 * gap : 1e-12);
  }
}

TEST(FlatPair, HasTheSmallerSurfacesPads) {
  const auto sheet = make_sheet();
  auto large = std::get<std::shared_ptr<const Skin>>(sheet.kind)->surface();
  large.pads.area *= 2.0;
  const Shape other{std::make_shared<const Skin>(large), {}};
  EXPECT_TRUE(ShapePair(sheet, other).has_pads_on_A());
  EXPECT_FALSE(ShapePair(other, sheet).has_pads_on_A());
  EXPECT_EQ(ShapePair(sheet, kBox, false).pad_count(), 0U);
  EXPECT_EQ(ShapePair(sheet, Shape{Capsule{0.1, 0.2}, {}}).pad_count(), 0U);
  EXPECT_EQ(ShapePair(sheet, Shape{Cylinder{0.1, 0.2}, {}}).pad_count(), 9U);
}

}  // namespace
}  // namespace limber::contact::flat_pair_test
