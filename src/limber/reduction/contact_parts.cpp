// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "limber/common/index.hpp"
#include "limber/reduction/contact_residual.hpp"
#include "limber/reduction/slices/roll_off.hpp"
#include "limber/reduction/slices/slice_motion.hpp"

namespace limber::flexbody {
namespace {

using Vector2 = Eigen::Vector2d;
using Polygon = std::vector<Vector2>;
using Sample = SurfaceSample;

// Difference of a surface's area and that of its hull, or of its parts [-].
constexpr double kConvex = 5e-3;
constexpr double kMostFilled = 2e-2;  // of a surface that is not convex
// Of a convex surface, whose parts follow its deformation alone.
constexpr std::size_t kMostOfConvex = 8;

double find_turn(const Vector2& a, const Vector2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double find_area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    twice += find_turn(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return 0.5 * twice;
}

// Source [@andrew1979]; in order, without points on straight edges.
Polygon find_hull(Polygon points, double size) {
  const double kNone = 1e-9 * size * size;
  std::sort(points.begin(), points.end(),
            [](const Vector2& a, const Vector2& b) {
              return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
            });
  Polygon hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t first = hull.size();
    for (const Vector2& point : points) {
      while (hull.size() >= first + 2 &&
             find_turn(hull.back() - hull[hull.size() - 2],
                       point - hull.back()) <= kNone) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// What is on the side n . x <= h.
Polygon cut(const Polygon& polygon, const Vector2& n, double h) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& a = polygon[i];
    const Vector2& b = polygon[(i + 1) % polygon.size()];
    const double over_a = n.dot(a) - h;
    const double over_b = n.dot(b) - h;
    if (over_a <= 0.0) kept.push_back(a);
    if ((over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0)) {
      kept.push_back(a + over_a / (over_a - over_b) * (b - a));
    }
  }
  return kept;
}

/// Axes within the surface, the first along the hull's longest edge.
struct Frame {
  Vector3 origin;
  Vector3 normal;
  Vector3 along;
  Vector3 across;

  [[nodiscard]] Vector2 find(const Vector3& x) const {
    return {along.dot(x - origin), across.dot(x - origin)};
  }
  [[nodiscard]] Vector3 find(const Vector2& x) const {
    return origin + x[0] * along + x[1] * across;
  }
};

Polygon project(const fem::Surface& surface, const Frame& frame) {
  Polygon points;
  for (const fem::SurfacePoint& point : surface.points) {
    points.push_back(frame.find(point.x));
  }
  return points;
}

Vector2 find_longest_edge(const Polygon& hull) {
  Vector2 longest = Vector2::Zero();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2 edge = hull[(i + 1) % hull.size()] - hull[i];
    if (edge.norm() > (1.0 + 1e-6) * longest.norm()) longest = edge;
  }
  return longest;
}

struct Outline {
  Frame frame;
  Polygon hull;
  double size = 0.0;           // [m]
  double area = 0.0;           // of the surface [m^2]
  std::vector<Polygon> faces;  // none of a convex surface
};

// At most kMostCorners: without those that cut off least, at the same area.
Polygon simplify(Polygon hull) {
  constexpr std::size_t kMostCorners = 12;
  const double area = find_area(hull);
  const auto find_loss = [&hull](std::size_t i) {
    const Vector2& last = hull[(i + hull.size() - 1) % hull.size()];
    return find_turn(hull[i] - last, hull[(i + 1) % hull.size()] - last);
  };
  while (hull.size() > kMostCorners) {
    std::size_t least = 0;
    for (std::size_t i = 1; i < hull.size(); ++i) {
      if (find_loss(i) < (1.0 - 1e-6) * find_loss(least)) least = i;
    }
    hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(least));
  }
  Vector2 middle = Vector2::Zero();
  for (const Vector2& x : hull) middle += x / static_cast<double>(hull.size());
  const double scale = std::sqrt(area / find_area(hull));
  for (Vector2& x : hull) x = middle + scale * (x - middle);
  return hull;
}

// Along both halves of each edge.
std::vector<Polygon> list_faces(const fem::Surface& surface,
                                const Frame& frame) {
  std::vector<Polygon> faces;
  for (const auto& nodes : surface.triangles) {
    Polygon& face = faces.emplace_back();
    for (const std::size_t k : {0, 3, 1, 4, 2, 5}) {
      if (nodes[k] < 0) continue;
      face.push_back(frame.find(surface.points[index(nodes[k])].x));
    }
  }
  return faces;
}

Outline find_outline(const fem::Surface& surface, const Vector3& normal,
                     double area) {
  const Vector3 first = normal.unitOrthogonal();
  Frame frame{surface.points.front().x, normal, first, normal.cross(first)};
  Polygon points = project(surface, frame);
  double size = 0.0;
  for (const Vector2& point : points) size = std::max(size, point.norm());
  const Vector2 edge = find_longest_edge(find_hull(points, size)).normalized();
  frame.along = edge[0] * frame.along + edge[1] * frame.across;
  frame.across = normal.cross(frame.along);
  Outline outline{frame,
                  simplify(find_hull(project(surface, frame), size)),
                  size,
                  area,
                  {}};
  const double hull_area = find_area(outline.hull);
  if (std::abs(hull_area - area) > kConvex * hull_area) {
    outline.hull = find_hull(project(surface, frame), size);
    outline.faces = list_faces(surface, frame);
  }
  return outline;
}

/// A rectangle of the surface.
struct Cell {
  Vector2 low;
  Vector2 high;

  [[nodiscard]] Polygon cut_out(const Polygon& polygon) const {
    Polygon part = polygon;
    for (int k = 0; k < 2; ++k) {
      const Vector2 axis = Vector2::Unit(k);
      part = cut(cut(part, axis, high[k]), -axis, -low[k]);
    }
    return part;
  }
  // Of a place, < 0 beyond it.
  [[nodiscard]] double find_depth(const Vector2& x) const {
    return std::min((x - low).minCoeff(), (high - x).minCoeff());
  }
  [[nodiscard]] std::array<Cell, 2> halve() const {
    const Vector2 extent = high - low;
    const int k = extent[1] > (1.0 + 1e-6) * extent[0] ? 1 : 0;
    std::array<Cell, 2> halves{*this, *this};
    halves[0].high[k] = halves[1].low[k] = 0.5 * (low[k] + high[k]);
    return halves;
  }
};

using Cells = std::vector<Cell>;

Cell find_bounds(const Polygon& hull) {
  Cell bounds{hull.front(), hull.front()};
  for (const Vector2& x : hull) {
    bounds.low = bounds.low.cwiseMin(x);
    bounds.high = bounds.high.cwiseMax(x);
  }
  return bounds;
}

std::vector<std::vector<const Sample*>> sort_samples(
    const std::vector<Sample>& samples, const Frame& frame,
    const Cells& cells) {
  std::vector<std::vector<const Sample*>> sorted(cells.size());
  for (const Sample& s : samples) {
    const Vector2 x = frame.find(s.x);
    const auto in = std::ranges::max_element(
        cells, {}, [&](const Cell& cell) { return cell.find_depth(x); });
    sorted[index(in - cells.begin())].push_back(&s);
  }
  return sorted;
}

// Fraction of the flexibility that is the parts' own deformation.
double find_deformation(const std::vector<std::vector<const Sample*>>& cells,
                        const VectorX& lambda, const MatrixX& Phi,
                        const Vector3& normal) {
  const Eigen::Index modes = lambda.size();
  double own = 0.0;
  double all = 0.0;
  for (const auto& cell : cells) {
    if (cell.empty()) continue;
    const SliceMotion fit(cell);
    const MatrixX motion = fit.find_motion(Phi.leftCols(modes));
    for (const Sample* s : cell) {
      const VectorX u = find_heights(*s, Phi, modes, normal);
      const Vector3 r = s->x - fit.centre();
      const VectorX rigid =
          motion.topRows<3>().transpose() * normal +
          motion.bottomRows<3>().transpose() * r.cross(normal);
      own += s->area * (u - rigid).cwiseAbs2().cwiseQuotient(lambda).sum();
      all += s->area * u.cwiseAbs2().cwiseQuotient(lambda).sum();
    }
  }
  return all > 0.0 ? own / all : 0.0;
}

/// The convex part in a cell.
struct CellPart {
  Polygon polygon;
  double filled = 0.0;  // what it has more than the surface [m^2]
};

// Of a surface that is not convex, the hull of what its faces have there.
CellPart find_part(const Outline& outline, const Cell& cell) {
  if (outline.faces.empty()) return {cell.cut_out(outline.hull)};
  Polygon points;
  double area = 0.0;
  for (const Polygon& face : outline.faces) {
    const Polygon within = cell.cut_out(face);
    if (within.size() < 3) continue;
    area += find_area(within);
    points.insert(points.end(), within.begin(), within.end());
  }
  if (points.empty()) return {};
  CellPart part{find_hull(points, outline.size)};
  part.filled = find_area(part.polygon) - area;
  return part;
}

double find_filled(const Outline& outline, const Cells& cells) {
  double filled = 0.0;
  for (const Cell& cell : cells) filled += find_part(outline, cell).filled;
  return filled / outline.area;
}

Cells halve_all(const Cells& cells) {
  Cells next;
  for (const Cell& cell : cells) {
    for (const Cell& half : cell.halve()) next.push_back(half);
  }
  return next;
}

// Halves the cells that fill at least half as much as the worst one.
Cells halve_filled(const Outline& outline, const Cells& cells) {
  double worst = 0.0;
  for (const Cell& cell : cells) {
    worst = std::max(worst, find_part(outline, cell).filled);
  }
  Cells next;
  for (const Cell& cell : cells) {
    if (find_part(outline, cell).filled < 0.5 * worst) {
      next.push_back(cell);
      continue;
    }
    for (const Cell& half : cell.halve()) {
      if (find_part(outline, half).polygon.size() > 2) next.push_back(half);
    }
  }
  return next;
}

Cells choose_cells(const std::vector<Sample>& samples, const Outline& outline,
                   const VectorX& lambda, const MatrixX& Phi,
                   const Vector3& normal) {
  Cells cells{find_bounds(outline.hull)};
  while (2 * cells.size() <= kMostOfConvex &&
         find_deformation(sort_samples(samples, outline.frame, cells), lambda,
                          Phi, normal) > kMostDeformation) {
    cells = halve_all(cells);
  }
  while (find_filled(outline, cells) > kConvex) {
    Cells next = halve_filled(outline, cells);
    if (next.size() > kMostParts) break;
    cells = std::move(next);
  }
  return cells;
}

void roll_off(const VectorX& lambda, ContactPart& part) {
  const VectorX along =
      part.motion_B.topLeftCorner(3, lambda.size()).transpose() * part.normal_B;
  const VectorX flexibility = along.cwiseAbs2().cwiseQuotient(lambda);
  const VectorX squares = find_roll_off(flexibility, lambda);
  part.flexibility =
      part.residual + (VectorX::Ones(lambda.size()) - squares).dot(flexibility);
  for (Eigen::Index k = 0; k < lambda.size(); ++k) {
    part.motion_B.col(k) *= std::sqrt(squares[k]);
  }
}

// Edges of a part that are not on the border to another cell.
std::vector<std::size_t> find_rim(const Polygon& part, const Cell& cell,
                                  const Cell& bounds) {
  constexpr double kOn = 1e-6;
  const double near = kOn * (bounds.high - bounds.low).norm();
  const auto is_between = [&](const Vector2& x) {
    for (int k = 0; k < 2; ++k) {
      const bool is_low = std::abs(x[k] - cell.low[k]) < near &&
                          cell.low[k] > bounds.low[k] + near;
      const bool is_high = std::abs(x[k] - cell.high[k]) < near &&
                           cell.high[k] < bounds.high[k] - near;
      if (is_low || is_high) return true;
    }
    return false;
  };
  std::vector<std::size_t> rim;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Vector2 middle = 0.5 * (part[i] + part[(i + 1) % part.size()]);
    if (!is_between(middle)) rim.push_back(i);
  }
  return rim;
}

Matrix3X place_corners(const Polygon& polygon, const Frame& frame,
                       const Vector3& center) {
  Matrix3X corners(3, std::ssize(polygon));
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    corners.col(static_cast<Eigen::Index>(i)) = frame.find(polygon[i]) - center;
  }
  return corners;
}

}  // namespace

std::vector<ContactPart> make_contact_parts(
    const BodyWithSurface& body, const fem::Surface& surface,
    const Vector3& normal, const ReducedBasis& basis, const MatrixX& Phi,
    const Vector3& center, double depth) {
  const std::vector<Sample> samples = sample_surface(body.mesh, surface);
  double area = 0.0;
  for (const Sample& s : samples) area += s.area;
  const Outline outline = find_outline(surface, normal, area);
  const Cells cells = choose_cells(samples, outline, basis.lambda, Phi, normal);
  if (find_filled(outline, cells) > kMostFilled) return {};
  const auto sorted = sort_samples(samples, outline.frame, cells);
  const Cell bounds = find_bounds(outline.hull);
  std::vector<ContactPart> parts;
  MatrixX loads(Phi.rows(), 0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Polygon polygon = find_part(outline, cells[i]).polygon;
    if (sorted[i].empty() || polygon.size() < 3) continue;
    const SliceMotion fit(sorted[i]);
    parts.push_back({.normal_B = normal,
                     .centre_B = fit.centre() - center,
                     .corners_B = place_corners(polygon, outline.frame, center),
                     .rim = find_rim(polygon, cells[i], bounds),
                     .motion_B = fit.find_motion(Phi),
                     .depth = depth});
    loads.conservativeResize(Eigen::NoChange, std::ssize(parts));
    loads.rightCols(1) = fit.find_loads(body.mesh.x.cols()) * normal;
  }
  const MatrixX residual = calc_residual_matrix(body, basis, loads);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    parts[i].residual = residual(at, at);
    roll_off(basis.lambda, parts[i]);
  }
  return parts;
}

}  // namespace limber::flexbody
