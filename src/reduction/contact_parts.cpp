// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_parts.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/reduction/contact_residual.hpp"
#include "limber/reduction/slices/roll_off.hpp"

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

/// The mean motion of samples as sums over nodes.
///
/// Equation   u = sum a u / A, theta = J^-1 sum a r x u, J = sum a (r^2 1 -
///            r r'), r from the centre of area
struct Fit {
  struct Share {
    double area = 0.0;
    Vector3 moment = Vector3::Zero();  // times r
  };
  double area = 0.0;
  Vector3 centre = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();
  std::map<int, Share> nodes;

  explicit Fit(const std::vector<const Sample*>& samples) {
    for (const Sample* s : samples) {
      area += s->area;
      centre += s->area * s->x;
    }
    centre /= area;
    for (const Sample* s : samples) {
      const Vector3 r = s->x - centre;
      const Matrix3 cross = skew(r);
      inertia += s->area * cross.transpose() * cross;
      for (std::size_t k = 0; k < s->face->nodes.size(); ++k) {
        Share& share = nodes[s->face->nodes[k]];
        const double part = s->area * s->shape[static_cast<Eigen::Index>(k)];
        share.area += part;
        share.moment += part * r;
      }
    }
  }

  [[nodiscard]] MatrixX find_motion(const MatrixX& Phi) const {
    MatrixX motion = MatrixX::Zero(6, Phi.cols());
    for (const auto& [node, share] : nodes) {
      const auto rows = Phi.middleRows<3>(3 * node);
      motion.topRows<3>() += share.area / area * rows;
      motion.bottomRows<3>() += skew(share.moment) * rows;
    }
    motion.bottomRows<3>() = inertia.inverse() * motion.bottomRows<3>();
    return motion;
  }

  [[nodiscard]] ContactPatch make_patch(const Vector3& normal) const {
    ContactPatch patch{normal, 0.0, {}, VectorX(std::ssize(nodes))};
    for (const auto& [node, share] : nodes) {
      patch.weights[std::ssize(patch.nodes)] = share.area / area;
      patch.nodes.push_back(node);
    }
    return patch;
  }
};

// One after another along the first axis, then along the second.
struct Grid {
  std::array<int, 2> count = {1, 1};
  Vector2 low;
  Vector2 high;

  [[nodiscard]] Vector2 step() const {
    return (high - low).cwiseQuotient(Vector2(count[0], count[1]));
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(count[0]) *
           static_cast<std::size_t>(count[1]);
  }
  [[nodiscard]] std::size_t find(const Vector2& x) const {
    std::array<int, 2> at{};
    for (int k = 0; k < 2; ++k) {
      const double steps = (x[k] - low[k]) / step()[k];
      at[index(k)] = std::clamp(static_cast<int>(std::floor(steps)), 0,
                                count[index(k)] - 1);
    }
    return static_cast<std::size_t>(at[1]) *
               static_cast<std::size_t>(count[0]) +
           static_cast<std::size_t>(at[0]);
  }
  [[nodiscard]] Polygon cut_out(const Polygon& hull, std::size_t cell) const {
    const int i = static_cast<int>(cell);
    const Vector2 corner =
        low + Vector2(i % count[0], i / count[0]).cwiseProduct(step());
    const Vector2 opposite = corner + step();
    Polygon part = hull;
    for (int k = 0; k < 2; ++k) {
      const Vector2 axis = Vector2::Unit(k);
      part = cut(cut(part, axis, opposite[k]), -axis, -corner[k]);
    }
    return part;
  }
  // Whether a place is on the line between two cells.
  [[nodiscard]] bool is_between(const Vector2& x) const {
    constexpr double kOn = 1e-6;
    for (int k = 0; k < 2; ++k) {
      const double steps = (x[k] - low[k]) / step()[k];
      const double line = std::round(steps);
      if (std::abs(steps - line) < kOn && line > 0.5 &&
          line < count[index(k)] - 0.5) {
        return true;
      }
    }
    return false;
  }
  void refine() {
    const Vector2 extent = step();
    count[extent[1] > (1.0 + 1e-6) * extent[0] ? 1 : 0] *= 2;
  }
};

Grid make_grid(const Polygon& hull) {
  Grid grid{{1, 1}, hull.front(), hull.front()};
  for (const Vector2& x : hull) {
    grid.low = grid.low.cwiseMin(x);
    grid.high = grid.high.cwiseMax(x);
  }
  return grid;
}

std::vector<std::vector<const Sample*>> sort_samples(
    const std::vector<Sample>& samples, const Frame& frame, const Grid& grid) {
  std::vector<std::vector<const Sample*>> cells(grid.size());
  for (const Sample& s : samples)
    cells[grid.find(frame.find(s.x))].push_back(&s);
  return cells;
}

// Share of the flexibility that is the parts' own deformation.
double find_deformation(const std::vector<std::vector<const Sample*>>& cells,
                        const VectorX& lambda, const MatrixX& Phi,
                        const Vector3& normal) {
  const Eigen::Index modes = lambda.size();
  double own = 0.0;
  double all = 0.0;
  for (const auto& cell : cells) {
    if (cell.empty()) continue;
    const Fit fit(cell);
    const MatrixX motion = fit.find_motion(Phi.leftCols(modes));
    for (const Sample* s : cell) {
      const VectorX u = find_heights(*s, Phi, modes, normal);
      const Vector3 r = s->x - fit.centre;
      const VectorX rigid =
          motion.topRows<3>().transpose() * normal +
          motion.bottomRows<3>().transpose() * r.cross(normal);
      own += s->area * (u - rigid).cwiseAbs2().cwiseQuotient(lambda).sum();
      all += s->area * u.cwiseAbs2().cwiseQuotient(lambda).sum();
    }
  }
  return all > 0.0 ? own / all : 0.0;
}

// The convex part in a cell: of a surface that is not convex, the hull of what
// its faces have there.
Polygon find_part(const Outline& outline, const Grid& grid, std::size_t cell) {
  if (outline.faces.empty()) return grid.cut_out(outline.hull, cell);
  Polygon points;
  for (const Polygon& face : outline.faces) {
    const Polygon within = grid.cut_out(face, cell);
    points.insert(points.end(), within.begin(), within.end());
  }
  return points.size() < 3 ? Polygon{} : find_hull(points, outline.size);
}

// What the parts have more than the surface, of its area.
double find_filled(const Outline& outline, const Grid& grid) {
  if (outline.faces.empty()) return 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Polygon part = find_part(outline, grid, i);
    if (part.size() > 2) area += find_area(part);
  }
  return area / outline.area - 1.0;
}

Grid choose_grid(const std::vector<Sample>& samples, const Outline& outline,
                 const VectorX& lambda, const MatrixX& Phi,
                 const Vector3& normal) {
  Grid grid = make_grid(outline.hull);
  const auto is_deformed = [&] {
    return 2 * grid.size() <= kMostOfConvex &&
           find_deformation(sort_samples(samples, outline.frame, grid), lambda,
                            Phi, normal) > kMostDeformation;
  };
  while (2 * grid.size() <= kMostParts &&
         (find_filled(outline, grid) > kConvex || is_deformed())) {
    grid.refine();
  }
  return grid;
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

// Edges of a part at which no other part begins.
std::vector<std::size_t> find_rim(const Polygon& part, const Grid& grid) {
  std::vector<std::size_t> rim;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Vector2 middle = 0.5 * (part[i] + part[(i + 1) % part.size()]);
    if (!grid.is_between(middle)) rim.push_back(i);
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
    const MeshedBody& body, const fem::Surface& surface, const Vector3& normal,
    const ReducedBasis& basis, const MatrixX& Phi, const Vector3& center,
    double depth) {
  const std::vector<Sample> samples = sample_surface(body.mesh, surface);
  double area = 0.0;
  for (const Sample& s : samples) area += s.area;
  const Outline outline = find_outline(surface, normal, area);
  const Grid grid = choose_grid(samples, outline, basis.lambda, Phi, normal);
  if (find_filled(outline, grid) > kMostFilled) return {};
  const auto cells = sort_samples(samples, outline.frame, grid);
  std::vector<ContactPart> parts;
  std::vector<ContactPatch> patches;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Polygon polygon = find_part(outline, grid, i);
    if (cells[i].empty() || polygon.size() < 3) continue;
    const Fit fit(cells[i]);
    parts.push_back({.normal_B = normal,
                     .centre_B = fit.centre - center,
                     .corners_B = place_corners(polygon, outline.frame, center),
                     .rim = find_rim(polygon, grid),
                     .motion_B = fit.find_motion(Phi),
                     .depth = depth});
    patches.push_back(fit.make_patch(normal));
  }
  const VectorX residual = calc_residual_flexibility(body, basis, patches);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].residual = residual[static_cast<Eigen::Index>(i)];
    roll_off(basis.lambda, parts[i]);
  }
  return parts;
}

}  // namespace limber::flexbody
