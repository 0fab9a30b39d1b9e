// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::results {

struct Colour {
  double red = 0.0;  ///< 0 to 1, as green and blue
  double green = 0.0;
  double blue = 0.0;
};

/// 0xRRGGBB.
[[nodiscard]] Colour to_colour(std::uint32_t rgb);

/// A point of a picture: right and down from the upper left corner [pixels].
using Spot = Eigen::Vector2d;

/// A picture with a depth buffer, of several samples a pixel.
///
/// Equation   A sample has the colour of the nearest triangle that covers it;
///            of triangles at the same depth, that of the first. A pixel is the
///            mean of its samples.
class Canvas {
 public:
  /// White, and infinitely far. @param width, height > 0 [pixels]
  Canvas(int width, int height);

  [[nodiscard]] int width() const { return width_; }    ///< [pixels]
  [[nodiscard]] int height() const { return height_; }  ///< [pixels]

  /// @param corners right and down [pixels], and depth away from the eye
  /// [any unit]; nothing is drawn if one is not finite
  void fill_triangle(const std::array<Vector3, 3>& corners,
                     const Colour& colour);

  /// Lays the triangles of another canvas of the same size over this one, where
  /// they are nearer. @param opacity 0 to 1
  void blend(const Canvas& other, double opacity);

  /// A line with round ends, in front of everything. @param thickness [pixels]
  void draw_line(const Spot& from, const Spot& to, double thickness,
                 const Colour& colour);

  /// A rectangle in front of everything. @param corner upper left
  void fill_rectangle(const Spot& corner, const Spot& size,
                      const Colour& colour);

  /// A line of text, in front of everything, from its lower left corner.
  /// @param size height of capitals [pixels]
  void draw_text(const Spot& start, const std::string& text, double size,
                 const Colour& colour);

  /// Rows from the top, three bytes a pixel: red, green and blue.
  [[nodiscard]] std::vector<std::uint8_t> find_pixels() const;

 private:
  struct Sample {
    float depth;
    std::array<std::uint8_t, 3> rgb;
  };

  [[nodiscard]] Sample& sample(int column, int row) {
    return samples_[static_cast<std::size_t>(row) * columns_ +
                    static_cast<std::size_t>(column)];
  }

  int width_;
  int height_;
  std::size_t columns_;  // of samples
  std::vector<Sample> samples_;
};

}  // namespace limber::results
