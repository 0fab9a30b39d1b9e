// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/drawing/canvas.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "limber/results/drawing/png_file.hpp"
#include "limber/results/drawing/stroke_font.hpp"
#include "unit/results/png_pixels.hpp"
#include "unit/results/temporary_folder.hpp"

namespace limber::results::canvas_test {
namespace {

using ::testing::IsEmpty;

constexpr Colour kRed = {1.0, 0.0, 0.0};
constexpr Colour kBlue = {0.0, 0.0, 1.0};
constexpr Colour kBlack = {};

std::array<int, 3> find_pixel(const Canvas& canvas, int x, int y) {
  const auto pixels = canvas.find_pixels();
  const auto at = 3 * static_cast<std::size_t>(y * canvas.width() + x);
  return {pixels[at], pixels[at + 1], pixels[at + 2]};
}

// Two triangles.
void fill_square(Canvas& canvas, double from, double to, double depth,
                 const Colour& colour) {
  const Vector3 a(from, from, depth);
  const Vector3 b(to, from, depth);
  const Vector3 c(to, to, depth);
  const Vector3 d(from, to, depth);
  canvas.fill_triangle({a, b, c}, colour);
  canvas.fill_triangle({a, c, d}, colour);
}

double find_ink(const Canvas& canvas) {
  double ink = 0.0;
  for (const std::uint8_t value : canvas.find_pixels()) ink += 255 - value;
  return ink / 765.0;
}

TEST(Canvas, ShowsTheNearerTriangleWhateverTheOrder) {
  for (const bool near_first : {true, false}) {
    Canvas canvas(40, 40);
    if (near_first) fill_square(canvas, 10, 30, 1.0, kRed);
    fill_square(canvas, 0, 40, 2.0, kBlue);
    if (!near_first) fill_square(canvas, 10, 30, 1.0, kRed);
    EXPECT_EQ(find_pixel(canvas, 20, 20), (std::array<int, 3>{255, 0, 0}));
    EXPECT_EQ(find_pixel(canvas, 5, 5), (std::array<int, 3>{0, 0, 255}));
  }
}

// Painters who sort triangles cannot draw these.
TEST(Canvas, ShowsTheLineWhereTwoTrianglesCutEachOther) {
  Canvas canvas(100, 100);
  // Depths x and 100 - x are equal at x = 50.
  canvas.fill_triangle(
      {Vector3(0, 0, 0), Vector3(200, 0, 200), Vector3(0, 200, 0)}, kRed);
  canvas.fill_triangle(
      {Vector3(0, 0, 100), Vector3(200, 0, -100), Vector3(0, 200, 100)}, kBlue);
  EXPECT_EQ(find_pixel(canvas, 48, 50), (std::array<int, 3>{255, 0, 0}));
  EXPECT_EQ(find_pixel(canvas, 52, 50), (std::array<int, 3>{0, 0, 255}));
}

TEST(Canvas, CoversTheAreaOfATriangleInBothSensesOfRotation) {
  const Vector3 a(10.3, 12.7, 0.0);
  const Vector3 b(81.9, 30.2, 0.0);
  const Vector3 c(35.5, 90.1, 0.0);
  const double area = 0.5 * (b - a).cross(c - a).z();
  for (const auto& corners : {std::array{a, b, c}, std::array{a, c, b}}) {
    Canvas canvas(100, 100);
    canvas.fill_triangle(corners, kBlack);
    EXPECT_NEAR(find_ink(canvas), area, 0.01 * area);
  }
}

TEST(Canvas, LeavesNoGapBetweenNeighbours) {
  Canvas canvas(60, 60);
  const Vector3 middle(29.37, 31.91, 0.0);
  const auto corner = [](int i) -> Vector3 {
    const double angle = 2.0 * std::numbers::pi * i / 17.0;
    return {30.0 + 25.0 * std::cos(angle), 30.0 + 25.0 * std::sin(angle), 0.0};
  };
  for (int i = 0; i < 17; ++i) {
    canvas.fill_triangle({middle, corner(i), corner(i + 1)}, kBlack);
  }
  for (int y = 15; y < 45; ++y) {
    for (int x = 15; x < 45; ++x) {
      ASSERT_EQ(find_pixel(canvas, x, y), (std::array<int, 3>{0, 0, 0}));
    }
  }
}

TEST(Canvas, BlendsWhatIsNearerAlone) {
  Canvas canvas(20, 20);
  fill_square(canvas, 0, 20, 1.0, kBlue);
  Canvas ghost(20, 20);
  fill_square(ghost, 0, 10, 0.5, kRed);
  fill_square(ghost, 10, 20, 1.5, kRed);
  canvas.blend(ghost, 0.4);
  EXPECT_EQ(find_pixel(canvas, 5, 5), (std::array<int, 3>{102, 0, 153}));
  EXPECT_EQ(find_pixel(canvas, 15, 15), (std::array<int, 3>{0, 0, 255}));
}

TEST(Canvas, IgnoresWhatHasNoPlace) {
  Canvas canvas(20, 20);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const double odd : {kNan, kInfinite, -kInfinite}) {
    canvas.fill_triangle(
        {Vector3(odd, 0, 0), Vector3(20, 0, 0), Vector3(0, 20, 0)}, kRed);
  }
  canvas.fill_triangle(
      {Vector3(1e30, 0, 0), Vector3(2e30, 0, 0), Vector3(1e30, 1e30, 0)}, kRed);
  canvas.fill_triangle({Vector3(1, 1, 0), Vector3(9, 9, 0), Vector3(17, 17, 0)},
                       kRed);
  EXPECT_EQ(find_ink(canvas), 0.0);
}

TEST(Canvas, DrawsLinesOfTheirThickness) {
  Canvas canvas(120, 40);
  canvas.draw_line({10.0, 20.0}, {110.0, 20.0}, 4.0, kBlack);
  const double area = 100.0 * 4.0 + std::numbers::pi * 4.0;
  EXPECT_NEAR(find_ink(canvas), area, 0.02 * area);
}

TEST(Canvas, IsWrittenAsAPngOfItsPixels) {
  const test::TemporaryFolder folder;
  Canvas canvas(37, 23);
  fill_square(canvas, 3.2, 20.7, 0.0, {0.3, 0.7, 0.1});
  canvas.draw_text({2.0, 20.0}, "a b", 8.0, kRed);
  write_png(folder.path() / "c.png", canvas);
  const test::Pixels read = test::read_png(folder.path() / "c.png");
  EXPECT_EQ(read.width, 37U);
  EXPECT_EQ(read.height, 23U);
  EXPECT_EQ(read.channels, 3U);
  EXPECT_EQ(read.values, canvas.find_pixels());
}

TEST(StrokeFont, HasAGlyphForEveryPrintableCharacter) {
  for (char c = '!'; c <= '~'; ++c) {
    const std::string text(1, c);
    EXPECT_THAT(find_strokes(text), ::testing::Not(IsEmpty())) << c;
    for (const Stroke& stroke : find_strokes(text)) {
      for (const auto& p : {stroke.from, stroke.to}) {
        EXPECT_GE(p.x(), 0.0) << c;
        EXPECT_LE(p.x(), find_text_width(text)) << c;
        EXPECT_GE(p.y(), -2.0 / 7.0) << c;
        EXPECT_LE(p.y(), 1.0) << c;
      }
    }
  }
  EXPECT_THAT(find_strokes(" "), IsEmpty());
  EXPECT_THAT(find_strokes(""), IsEmpty());
}

TEST(StrokeFont, DrawsUnknownCharactersAsOneQuestionMark) {
  EXPECT_EQ(find_strokes("\xc3\xa4").size(), find_strokes("?").size());
  EXPECT_EQ(find_text_width("\xe2\x82\xac"), find_text_width("?"));
  EXPECT_EQ(find_text_width("a\nb"), find_text_width("a?b"));
}

}  // namespace
}  // namespace limber::results::canvas_test
