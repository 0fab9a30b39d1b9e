// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/face_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace limber::contact {
namespace {

// The point of the flat triangle a, a + ab, a + ac nearest to p [@ericson2005,
// sec. 5.1.5].
FacePlace find_nearest_of_triangle(const Vector3& a, const Vector3& ab,
                                   const Vector3& ac, const Vector3& p) {
  const Vector3 ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {0.0, 0.0};
  const Vector3 bp = ap - ab;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return {1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {d1 / (d1 - d3), 0.0};
  const Vector3 cp = ap - ac;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {0.0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    const double v = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {1.0 - v, v};
  }
  const double sum = va + vb + vc;
  return {vb / sum, vc / sum};
}

// A function g u + 1/2 H u u of a step (u, v) from a place, H positive
// definite.
struct Parabola {
  double g_u, g_v;
  double h_uu, h_uv, h_vv;

  [[nodiscard]] double evaluate(double u, double v) const {
    return u * (g_u + 0.5 * h_uu * u + h_uv * v) + v * (g_v + 0.5 * h_vv * v);
  }
};

// Its minimum in the triangle, from a place in it.
FacePlace minimise(const Parabola& model, const FacePlace& from) {
  const double determinant = model.h_uu * model.h_vv - model.h_uv * model.h_uv;
  const FacePlace inside{
      from.u - (model.h_vv * model.g_u - model.h_uv * model.g_v) / determinant,
      from.v - (model.h_uu * model.g_v - model.h_uv * model.g_u) / determinant};
  if (inside.u >= 0.0 && inside.v >= 0.0 && inside.u + inside.v <= 1.0) {
    return inside;
  }
  struct Edge {
    double u, v, du, dv;
  };
  constexpr std::array<Edge, 3> kEdges = {
      {{0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, {1.0, 0.0, -1.0, 1.0}}};
  FacePlace best = from;
  double least = std::numeric_limits<double>::infinity();
  for (const Edge& edge : kEdges) {
    const double u = edge.u - from.u;
    const double v = edge.v - from.v;
    const double slope =
        edge.du * (model.g_u + model.h_uu * u + model.h_uv * v) +
        edge.dv * (model.g_v + model.h_uv * u + model.h_vv * v);
    const double bend = edge.du * edge.du * model.h_uu +
                        2.0 * edge.du * edge.dv * model.h_uv +
                        edge.dv * edge.dv * model.h_vv;
    const double t = std::clamp(-slope / bend, 0.0, 1.0);
    const double value = model.evaluate(u + t * edge.du, v + t * edge.dv);
    if (!(value < least)) continue;
    least = value;
    best = {edge.u + t * edge.du, edge.v + t * edge.dv};
  }
  return best;
}

}  // namespace

FacePatch::FacePatch(const std::array<Vector3, 3>& X)
    : x_(X[0]), x_u_(X[1] - X[0]), x_v_(X[2] - X[0]), is_straight_(true) {}

FacePatch::FacePatch(const std::array<Vector3, 6>& X)
    : x_(X[0]),
      x_u_(4.0 * (X[3] - X[0]) - (X[1] - X[0])),
      x_v_(4.0 * (X[5] - X[0]) - (X[2] - X[0])),
      x_uu_(4.0 * ((X[1] - X[3]) - (X[3] - X[0]))),
      x_uv_(4.0 * ((X[4] - X[3]) - (X[5] - X[0]))),
      x_vv_(4.0 * ((X[2] - X[5]) - (X[5] - X[0]))),
      is_straight_(false) {}

double FacePatch::find_mean_curvature(const FacePlace& at) const {
  if (is_straight_) return 0.0;
  const Vector3 x_u = find_tangent_u(at);
  const Vector3 x_v = find_tangent_v(at);
  const Vector3 normal = x_u.cross(x_v);
  const double square = normal.squaredNorm();  // E G - F^2
  if (!(square > 0.0)) return 0.0;
  const double sum = x_u.squaredNorm() * x_vv_.dot(normal) -
                     2.0 * x_u.dot(x_v) * x_uv_.dot(normal) +
                     x_v.squaredNorm() * x_uu_.dot(normal);
  return -0.5 * sum / (square * std::sqrt(square));
}

double FacePatch::find_bulge() const {
  // Between the corners of a flat triangle linear interpolation errs by
  // 1/2 sum_ij w_i w_j x''(e_ij, e_ij) over its edges, and sum_ij w_i w_j is
  // 1/3 at most; its edges are half as long as the patch's.
  const double bend = std::max({x_uu_.squaredNorm(), x_vv_.squaredNorm(),
                                (x_uu_ - 2.0 * x_uv_ + x_vv_).squaredNorm()});
  return std::sqrt(bend) / 24.0;
}

FacePatch::FlatNearest FacePatch::find_nearest_of_flat(const Vector3& p) const {
  // The triangles: origin, and steps in u and v to the other corners.
  struct Part {
    double u, v, side;
  };
  constexpr std::array<Part, 4> kQuarters = {
      {{0.0, 0.0, 0.5}, {0.5, 0.0, 0.5}, {0.0, 0.5, 0.5}, {0.5, 0.5, -0.5}}};
  constexpr std::array<Part, 1> kWhole = {{{0.0, 0.0, 1.0}}};
  const auto parts = is_straight_ ? std::span<const Part>(kWhole)
                                  : std::span<const Part>(kQuarters);
  FlatNearest best{.at = {}, .square = std::numeric_limits<double>::infinity()};
  for (const Part& part : parts) {
    const Vector3 a = find_point({part.u, part.v});
    const Vector3 ab = find_point({part.u + part.side, part.v}) - a;
    const Vector3 ac = find_point({part.u, part.v + part.side}) - a;
    const FacePlace at = find_nearest_of_triangle(a, ab, ac, p);
    const double square = (a + at.u * ab + at.v * ac - p).squaredNorm();
    if (!(square < best.square)) continue;
    best = {{part.u + part.side * at.u, part.v + part.side * at.v}, square};
  }
  return best;
}

FacePlace FacePatch::find_nearest(const Vector3& p,
                                  const FacePlace& start) const {
  if (is_straight_) return start;
  constexpr int kMostSteps = 30;
  constexpr int kMostHalvings = 10;
  // Newton's method converges quadratically: the step after one as small as
  // this is below round-off.
  constexpr double kSmallStep = 1e-8;
  // Differences of distances after steps as small as this are round-off.
  constexpr double kCloseStep = 1e-5;
  FacePlace at = start;
  Vector3 arm = find_point(at) - p;
  for (int i = 0; i < kMostSteps; ++i) {
    const Vector3 x_u = find_tangent_u(at);
    const Vector3 x_v = find_tangent_v(at);
    const double e = x_u.squaredNorm();
    const double f = x_u.dot(x_v);
    const double g = x_v.squaredNorm();
    Parabola model{x_u.dot(arm), x_v.dot(arm), e + x_uu_.dot(arm),
                   f + x_uv_.dot(arm), g + x_vv_.dot(arm)};
    const double determinant =
        model.h_uu * model.h_vv - model.h_uv * model.h_uv;
    if (!(model.h_uu > 0.0) || !(determinant > 1e-3 * (e * g - f * f))) {
      model.h_uu = e;  // Gauss-Newton, which always descends
      model.h_uv = f;
      model.h_vv = g;
    }
    FacePlace next = minimise(model, at);
    double du = next.u - at.u;
    double dv = next.v - at.v;
    const bool is_close = std::abs(du) + std::abs(dv) < kCloseStep;
    Vector3 next_arm = find_point(next) - p;
    const auto is_farther = [&arm, &next_arm] {
      return next_arm.squaredNorm() > arm.squaredNorm();
    };
    for (int k = 0; k < kMostHalvings && !is_close && is_farther(); ++k) {
      du *= 0.5;
      dv *= 0.5;
      next = {at.u + du, at.v + dv};
      next_arm = find_point(next) - p;
    }
    if (!is_close && is_farther()) return at;
    at = next;
    arm = next_arm;
    if (std::abs(du) + std::abs(dv) < kSmallStep) return at;
  }
  return at;
}

std::array<double, 6> find_shape_functions(const FacePlace& at,
                                           bool is_straight) {
  const auto [w, u, v] = at.weights();
  if (is_straight) return {w, u, v, 0.0, 0.0, 0.0};
  return {w * (2.0 * w - 1.0), u * (2.0 * u - 1.0), v * (2.0 * v - 1.0),
          4.0 * w * u,         4.0 * u * v,         4.0 * v * w};
}

}  // namespace limber::contact
