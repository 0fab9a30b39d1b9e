// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/drawing/scene_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "limber/results/solids.hpp"
#include "unit/results/png_pixels.hpp"
#include "unit/results/temporary_folder.hpp"

namespace limber::results::scene_drawing_test {
namespace {

Surface make_box(const Vector3& size, const Vector3& place) {
  const Solid solid = make_solid({"box", size, {}, {}}, 1.0);
  Surface surface{solid.x.colwise() + place, {}};
  for (std::size_t i = 0; i < solid.corners.size(); i += 3) {
    surface.triangles.push_back(
        {solid.corners[i], solid.corners[i + 1], solid.corners[i + 2]});
  }
  return surface;
}

test::Pixels draw(const DrawnScene& scene) {
  const test::TemporaryFolder folder;
  write_scene(folder.path() / "s.png", scene);
  return test::read_png(folder.path() / "s.png");
}

// Colours in the middle of the picture, without title, key and axes, that more
// pixels have than edges do; not white.
int count_faces(const test::Pixels& pixels) {
  std::map<int, int> counts;
  for (std::size_t y = 150; y < pixels.height - 150; ++y) {
    for (std::size_t x = 0; x < pixels.width; ++x) {
      const std::uint8_t* rgb = &pixels.values[3 * (y * pixels.width + x)];
      ++counts[rgb[0] << 16 | rgb[1] << 8 | rgb[2]];
    }
  }
  counts.erase(0xffffff);
  return static_cast<int>(
      std::count_if(counts.begin(), counts.end(),
                    [](const auto& colour) { return colour.second > 2000; }));
}

TEST(SceneDrawing, ShowsThreeFacesOfABoxFromAnyCorner) {
  for (const double z : {20.0, 70.0, 115.0, 200.0, 250.0, 340.0}) {
    DrawnScene scene;
    scene.shots = {{"start", {make_box({1.0, 0.8, 0.6}, {0.1, 0.2, 0.3})}}};
    scene.view = {60.0, z};
    EXPECT_EQ(count_faces(draw(scene)), 3) << z;
  }
}

// The nearer box is in front, whichever is listed first, also where their
// centres say otherwise.
TEST(SceneDrawing, HidesWhatIsBehind) {
  const Surface wall = make_box({10.0, 0.1, 4.0}, {4.0, 0.0, 0.0});
  const Surface ball = make_box({0.5, 0.5, 0.5}, {0.0, 0.6, 0.0});
  DrawnScene with;
  with.view = {75.0, 0.0};  // along +y
  with.shots = {{"a", {wall, ball}}};
  DrawnScene turned = with;
  turned.shots = {{"a", {ball, wall}}};
  DrawnScene alone = with;
  alone.shots = {{"a", {wall}}};
  EXPECT_EQ(test::find_different_fraction(draw(with), draw(turned)), 0.0);
  EXPECT_EQ(test::find_different_fraction(draw(with), draw(alone)), 0.0);
  turned.shots = {{"a", {wall, make_box({0.5, 0.5, 0.5}, {0.0, -0.6, 0.0})}}};
  // The faces towards the eye have one colour; the top of the smaller box, 54
  // pixels wide and seen from 15 degrees above, is another.
  const double top = 54.0 * 54.0 * std::sin(15.0 * 3.14159 / 180.0);
  EXPECT_GT(test::find_different_fraction(draw(turned), draw(alone)),
            0.9 * top / (1200.0 * 1000.0));
}

TEST(SceneDrawing, IsTheSameInOtherUnitsButForTheScale) {
  const auto at = [](double factor) {
    DrawnScene scene;
    scene.shots = {
        {"start",
         {make_box(factor * Vector3(1.0, 0.8, 0.6), Vector3::Zero())}}};
    return draw(scene);
  };
  EXPECT_EQ(test::find_different_fraction(at(1.0), at(10.0)) > 0.0, true);
  EXPECT_LT(test::find_different_fraction(at(1.0), at(10.0)), 1e-3);
  EXPECT_LT(test::find_different_fraction(at(1.0), at(1e-3)), 1e-3);
}

TEST(SceneDrawing, DrawsPlanesBelowAndNotAbove) {
  DrawnScene scene;
  scene.shots = {{"start", {make_box({1.0, 1.0, 1.0}, Vector3::Zero())}}};
  scene.planes = {{Vector3(0.0, 0.0, -0.5), Vector3::UnitZ()}};
  EXPECT_EQ(count_faces(draw(scene)), 4);
  scene.planes[0].normal = -Vector3::UnitZ();
  EXPECT_EQ(count_faces(draw(scene)), 3);
}

TEST(SceneDrawing, IsNotEmptyOfAPointAndDoesNotFailWithoutOne) {
  DrawnScene scene;
  scene.title = "none";
  EXPECT_EQ(draw(scene).width, 1200U);
  scene.shots = {{"a",
                  {{Matrix3X::Constant(3, 3, std::nan("")),
                    {{std::size_t{0}, std::size_t{1}, std::size_t{2}}}}}}};
  EXPECT_EQ(draw(scene).width, 1200U);
}

TEST(ScaleBar, IsOneTwoOrFiveAtAnySize) {
  EXPECT_EQ(choose_bar(1.0), 1.0);
  EXPECT_EQ(choose_bar(1.9), 1.0);
  EXPECT_EQ(choose_bar(2.0), 2.0);
  EXPECT_EQ(choose_bar(7.0), 5.0);
  EXPECT_NEAR(choose_bar(0.0034), 0.002, 1e-15);
  for (double longest = 1e-9; longest < 1e9; longest *= 1.7) {
    EXPECT_LE(choose_bar(longest), longest);
    EXPECT_GT(choose_bar(longest), 0.39 * longest);
  }
}

}  // namespace
}  // namespace limber::results::scene_drawing_test
