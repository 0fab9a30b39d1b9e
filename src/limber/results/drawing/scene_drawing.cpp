// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/drawing/scene_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "limber/results/drawing/canvas.hpp"
#include "limber/results/drawing/png_file.hpp"
#include "limber/results/drawing/stroke_font.hpp"
#include "limber/results/offset.hpp"

namespace limber::results {
namespace {

constexpr int kWidth = 1200;  // [pixels]
constexpr int kHeight = 1000;
constexpr double kSide = 60.0;        // margin left and right [pixels]
constexpr double kTop = 140.0;        // above, for title and key
constexpr double kBottom = 130.0;     // below, for axes and scale
constexpr double kLetters = 11.0;     // height of capitals [pixels]
constexpr double kTranslucent = 0.4;  // opacity of the first shot [-]
constexpr std::array<std::uint32_t, 4> kShotColours = {0x8c8c8c, 0x0072B2,
                                                       0xD55E00, 0x009E73};
constexpr std::uint32_t kFixed = 0xc3c7cd;
constexpr std::uint32_t kPlane = 0xe9ebee;
constexpr std::uint32_t kInk = 0x333333;
constexpr std::array<std::uint32_t, 3> kAxes = {0xc0392b, 0x2e8b57, 0x2c5fa8};

using Corners = std::array<Vector3, 3>;

Corners find_corners(const Surface& surface,
                     const std::array<std::size_t, 3>& triangle) {
  const auto at = [&](std::size_t i) -> Vector3 {
    return surface.points.col(static_cast<Eigen::Index>(triangle[i]));
  };
  return {at(0), at(1), at(2)};
}

double find_size(const Surface& surface) {
  Bounds bounds;
  for (const auto& p : surface.points.colwise()) bounds.include(p);
  return bounds.size();
}

// Where the eye looks from, and what is right and up for it.
struct Camera {
  explicit Camera(const ViewAngles& view)
      : back(find_eye(view)), up(Vector3::Zero()), right(Vector3::Zero()) {
    const double z = view.rot_z * EIGEN_PI / 180.0;
    right = {std::cos(z), std::sin(z), 0.0};
    up = back.cross(right);
  }

  // Right, up and away from the eye [m].
  [[nodiscard]] Vector3 rotate(const Vector3& p) const {
    return {right.dot(p), up.dot(p), -back.dot(p)};
  }

  Vector3 back;
  Vector3 up;
  Vector3 right;
};

class Artist {
 public:
  explicit Artist(const DrawnScene& scene)
      : scene_(scene), camera_(scene.view), canvas_(kWidth, kHeight) {
    fit();
  }

  const Canvas& draw() {
    for (const EndlessPlane& plane : scene_.planes) draw_plane(plane);
    for (const Surface& surface : scene_.fixed) {
      draw_surface(canvas_, surface, kFixed);
    }
    const std::size_t first = scene_.shots.size() > 1 ? 1 : 0;
    for (std::size_t s = first; s < scene_.shots.size(); ++s) {
      draw_shot(canvas_, s);
    }
    if (first == 1) {
      Canvas translucent(kWidth, kHeight);
      draw_shot(translucent, 0);
      canvas_.blend(translucent, kTranslucent);
    }
    draw_title();
    draw_key();
    draw_axes();
    draw_bar();
    return canvas_;
  }

 private:
  // The scale and the middle of what moves, and of fixed things beside it.
  void fit() {
    Bounds seen;
    const auto include = [&](const Surface& surface) {
      for (const auto& triangle : surface.triangles) {
        for (const Vector3& p : find_corners(surface, triangle)) {
          if (!p.allFinite()) continue;
          bounds_.include(p);
          seen.include(camera_.rotate(p));
        }
      }
    };
    for (const Shot& shot : scene_.shots) {
      for (const Surface& surface : shot.surfaces) include(surface);
    }
    // Not what is much larger than the bodies, such as a floor.
    const double most = 2.0 * bounds_.size();
    for (const Surface& surface : scene_.fixed) {
      if (find_size(surface) <= most) include(surface);
    }
    middle_ = 0.5 * (seen.lower + seen.upper);
    const Vector3 size = (seen.upper - seen.lower).cwiseMax(1e-9);
    scale_ = std::min((kWidth - 2.0 * kSide) / size.x(),
                      (kHeight - kTop - kBottom) / size.y());
    if (middle_.allFinite() && std::isfinite(scale_)) return;
    middle_ = Vector3::Zero();
    scale_ = 1.0;
  }

  // Pixels right and down, and depth [m].
  [[nodiscard]] Vector3 project(const Vector3& p) const {
    const Vector3 seen = camera_.rotate(p) - middle_;
    return {0.5 * kWidth + scale_ * seen.x(),
            kTop + 0.5 * (kHeight - kTop - kBottom) - scale_ * seen.y(),
            seen.z()};
  }

  // Light of the sky, and of a sun above the left shoulder of who looks; of a
  // surface seen from inside, as from outside.
  [[nodiscard]] Colour shade(const Vector3& normal, std::uint32_t rgb) const {
    const Vector3 n = normal.dot(camera_.back) < 0.0 ? -normal : normal;
    const Vector3 sun =
        (camera_.back - 0.5 * camera_.right + 0.6 * camera_.up).normalized();
    const double light = 0.45 + 0.12 * n.z() + 0.5 * std::max(0.0, n.dot(sun));
    const Colour colour = to_colour(rgb);
    return {light * colour.red, light * colour.green, light * colour.blue};
  }

  // @param behind by which it is drawn farther away [m]
  void draw_triangle(Canvas& canvas, const Corners& corners, std::uint32_t rgb,
                     double behind = 0.0) const {
    const Vector3 area =
        (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double size = area.norm();
    if (!(size > 0.0)) return;
    std::array<Vector3, 3> seen;
    for (std::size_t i = 0; i < 3; ++i) {
      seen[i] = project(corners[i]) + behind * Vector3::UnitZ();
    }
    canvas.fill_triangle(seen, shade(area / size, rgb));
  }

  void draw_surface(Canvas& canvas, const Surface& surface, std::uint32_t rgb,
                    double behind = 0.0) const {
    for (const auto& triangle : surface.triangles) {
      draw_triangle(canvas, find_corners(surface, triangle), rgb, behind);
    }
  }

  // A body that hardly moves has the colour of one shot, not stripes of all.
  void draw_shot(Canvas& canvas, std::size_t s) const {
    constexpr double kStill = 0.004;  // of the size [-]
    const double behind = kStill * bounds_.size() * double(s);
    for (const Surface& surface : scene_.shots[s].surfaces) {
      draw_surface(canvas, surface, kShotColours[s % kShotColours.size()],
                   behind);
    }
  }

  void draw_plane(const EndlessPlane& plane) {
    const Vector3 n = plane.normal.normalized();
    if (!(n.dot(camera_.back) > 1e-3)) return;
    const Vector3 centre = 0.5 * (bounds_.lower + bounds_.upper);
    const Vector3 middle = centre - n.dot(centre - plane.point) * n;
    const Vector3 u = 0.6 * bounds_.size() * n.unitOrthogonal();
    const Vector3 v = n.cross(u);
    draw_triangle(canvas_, {middle - u - v, middle + u - v, middle + u + v},
                  kPlane);
    draw_triangle(canvas_, {middle - u - v, middle + u + v, middle - u + v},
                  kPlane);
  }

  void draw_title() {
    const double width = find_text_width(scene_.title);
    const double size =
        std::min(16.0, (kWidth - 2.0 * kSide) / std::max(width, 1.0));
    canvas_.draw_text({0.5 * (kWidth - size * width), 48.0}, scene_.title, size,
                      to_colour(kInk));
    canvas_.draw_text({kSide, kHeight - 18.0}, scene_.note, 0.9 * kLetters,
                      to_colour(kInk));
  }

  // Right below the title, a line a shot.
  void draw_key() {
    constexpr double kSwatch = 26.0;
    constexpr double kLine = 24.0;
    double y = 84.0;
    for (std::size_t s = 0; s < scene_.shots.size(); ++s, y += kLine) {
      const std::string& name = scene_.shots[s].name;
      const double start =
          kWidth - kSide - kSwatch - 12.0 - kLetters * find_text_width(name);
      canvas_.draw_text({start, y}, name, kLetters, to_colour(kInk));
      canvas_.fill_rectangle({kWidth - kSide - kSwatch, y - kLetters},
                             {kSwatch, kLetters},
                             to_colour(kShotColours[s % kShotColours.size()]));
    }
  }

  // The farthest first.
  void draw_axes() {
    constexpr double kLength = 46.0;
    const Spot origin(kSide + 40.0, kHeight - 80.0);
    std::array<int, 3> order = {0, 1, 2};
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return camera_.back[a] < camera_.back[b]; });
    for (const int a : order) {
      const Vector3 along = camera_.rotate(Vector3::Unit(a));
      const Spot arrow(kLength * along.x(), -kLength * along.y());
      const Colour colour = to_colour(kAxes[static_cast<std::size_t>(a)]);
      canvas_.draw_line(origin, origin + arrow, 3.0, colour);
      const Spot label = origin + 1.3 * arrow + Spot(-4.0, 5.0);
      canvas_.draw_text(label, std::string(1, "xyz"[a]), kLetters, colour);
    }
  }

  void draw_bar() {
    const double length = choose_bar(0.22 * kWidth / scale_);
    const Spot end(kWidth - kSide, kHeight - 60.0);
    const Spot start = end - Spot(scale_ * length, 0.0);
    const Colour ink = to_colour(kInk);
    canvas_.draw_line(start, end, 3.0, ink);
    for (const Spot& tick : {start, end}) {
      canvas_.draw_line(tick - Spot(0.0, 6.0), tick + Spot(0.0, 6.0), 3.0, ink);
    }
    const std::string label = length < 0.01
                                  ? fmt::format("{:.12g} mm", 1e3 * length)
                                  : fmt::format("{:.12g} m", length);
    const double width = kLetters * find_text_width(label);
    canvas_.draw_text(0.5 * (start + end) - Spot(0.5 * width, 12.0), label,
                      kLetters, ink);
  }

  const DrawnScene& scene_;
  Camera camera_;
  Canvas canvas_;
  Bounds bounds_;
  Vector3 middle_ = Vector3::Zero();  // of what is seen [m]
  double scale_ = 1.0;                // [pixels/m]
};

}  // namespace

double choose_bar(double longest) {
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= longest) return factor * power;
  }
  return power;
}

void write_scene(const std::filesystem::path& file, const DrawnScene& scene) {
  Artist artist(scene);
  write_png(file, artist.draw());
}

}  // namespace limber::results
