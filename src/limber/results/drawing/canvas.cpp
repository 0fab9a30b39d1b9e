// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/drawing/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/results/drawing/stroke_font.hpp"

namespace limber::results {
namespace {

constexpr int kSamples = 2;  // along each edge of a pixel

std::array<std::uint8_t, 3> to_bytes(const Colour& colour) {
  const auto to_byte = [](double value) {
    return static_cast<std::uint8_t>(
        std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
  };
  return {to_byte(colour.red), to_byte(colour.green), to_byte(colour.blue)};
}

// Samples from `first` to before `last` whose centres may lie between two
// coordinates [samples].
struct SampleRange {
  int first = 0;
  int last = 0;
};

SampleRange find_samples(double least, double most, int count) {
  const double end = count;
  return {static_cast<int>(std::clamp(std::floor(least), 0.0, end)),
          static_cast<int>(std::clamp(std::ceil(most), 0.0, end))};
}

// Twice the area of a triangle, positive or negative by its sense of rotation.
double find_twice_area(const Vector3& a, const Vector3& b, double x, double y) {
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

double find_distance(const Spot& p, const Spot& from, const Spot& to) {
  const Spot along = to - from;
  const double square = along.squaredNorm();
  const double fraction =
      square > 0.0 ? std::clamp((p - from).dot(along) / square, 0.0, 1.0) : 0.0;
  return (p - from - fraction * along).norm();
}

}  // namespace

Colour to_colour(std::uint32_t rgb) {
  const auto part = [&](unsigned shift) {
    return static_cast<double>(rgb >> shift & 0xffU) / 255.0;
  };
  return {part(16), part(8), part(0)};
}

Canvas::Canvas(int width, int height)
    : width_(width),
      height_(height),
      columns_(static_cast<std::size_t>(kSamples) *
               static_cast<std::size_t>(width)),
      samples_(columns_ * static_cast<std::size_t>(kSamples * height),
               {std::numeric_limits<float>::infinity(), {255, 255, 255}}) {
  LIMBER_EXPECT(width > 0 && height > 0);
}

void Canvas::fill_triangle(const std::array<Vector3, 3>& corners,
                           const Colour& colour) {
  Matrix3 p;
  for (int i = 0; i < 3; ++i) p.col(i) = corners[static_cast<std::size_t>(i)];
  if (!p.allFinite()) return;
  p.topRows<2>() *= kSamples;
  const Vector3 a = p.col(0);
  const Vector3 b = p.col(1);
  const Vector3 c = p.col(2);
  const double area = find_twice_area(a, b, c.x(), c.y());
  if (area == 0.0) return;
  const auto x =
      find_samples(p.row(0).minCoeff(), p.row(0).maxCoeff(), kSamples * width_);
  const auto y = find_samples(p.row(1).minCoeff(), p.row(1).maxCoeff(),
                              kSamples * height_);
  const auto rgb = to_bytes(colour);
  for (int row = y.first; row < y.last; ++row) {
    for (int column = x.first; column < x.last; ++column) {
      const double u = column + 0.5;
      const double v = row + 0.5;
      const double fraction_a = find_twice_area(b, c, u, v) / area;
      const double fraction_b = find_twice_area(c, a, u, v) / area;
      const double fraction_c = 1.0 - fraction_a - fraction_b;
      if (fraction_a < 0.0 || fraction_b < 0.0 || fraction_c < 0.0) continue;
      const auto depth = static_cast<float>(
          fraction_a * a.z() + fraction_b * b.z() + fraction_c * c.z());
      Sample& here = sample(column, row);
      if (depth < here.depth) here = {depth, rgb};
    }
  }
}

void Canvas::blend(const Canvas& other, double opacity) {
  LIMBER_EXPECT(other.samples_.size() == samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const Sample& over = other.samples_[i];
    Sample& here = samples_[i];
    if (!(over.depth < here.depth)) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      here.rgb[c] = static_cast<std::uint8_t>(
          std::lround(opacity * over.rgb[c] + (1.0 - opacity) * here.rgb[c]));
    }
  }
}

void Canvas::draw_line(const Spot& from, const Spot& to, double thickness,
                       const Colour& colour) {
  const Spot a = kSamples * from;
  const Spot b = kSamples * to;
  const double radius = 0.5 * kSamples * thickness;
  const auto x =
      find_samples(std::min(a.x(), b.x()) - radius,
                   std::max(a.x(), b.x()) + radius, kSamples * width_);
  const auto y =
      find_samples(std::min(a.y(), b.y()) - radius,
                   std::max(a.y(), b.y()) + radius, kSamples * height_);
  const auto rgb = to_bytes(colour);
  for (int row = y.first; row < y.last; ++row) {
    for (int column = x.first; column < x.last; ++column) {
      if (find_distance({column + 0.5, row + 0.5}, a, b) > radius) continue;
      sample(column, row).rgb = rgb;
    }
  }
}

void Canvas::fill_rectangle(const Spot& corner, const Spot& size,
                            const Colour& colour) {
  const Spot end = corner + size;
  const auto x = find_samples(kSamples * corner.x(), kSamples * end.x(),
                              kSamples * width_);
  const auto y = find_samples(kSamples * corner.y(), kSamples * end.y(),
                              kSamples * height_);
  const auto rgb = to_bytes(colour);
  for (int row = y.first; row < y.last; ++row) {
    for (int column = x.first; column < x.last; ++column) {
      sample(column, row).rgb = rgb;
    }
  }
}

void Canvas::draw_text(const Spot& start, const std::string& text, double size,
                       const Colour& colour) {
  constexpr double kThickness = 0.13;  // of the height of capitals
  for (const Stroke& stroke : find_strokes(text)) {
    const auto place = [&](const Eigen::Vector2d& p) -> Spot {
      return {start.x() + size * p.x(), start.y() - size * p.y()};
    };
    draw_line(place(stroke.from), place(stroke.to), kThickness * size, colour);
  }
}

std::vector<std::uint8_t> Canvas::find_pixels() const {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(static_cast<std::size_t>(width_) *
                 static_cast<std::size_t>(height_) * 3);
  for (std::size_t row = 0; row < samples_.size(); row += kSamples * columns_) {
    for (std::size_t column = 0; column < columns_; column += kSamples) {
      for (std::size_t c = 0; c < 3; ++c) {
        int sum = 0;
        for (std::size_t i = 0; i < kSamples; ++i) {
          for (std::size_t j = 0; j < kSamples; ++j) {
            sum += samples_[row + i * columns_ + column + j].rgb[c];
          }
        }
        constexpr int kCount = kSamples * kSamples;
        pixels.push_back(
            static_cast<std::uint8_t>((sum + kCount / 2) / kCount));
      }
    }
  }
  return pixels;
}

}  // namespace limber::results
