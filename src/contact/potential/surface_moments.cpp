// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/surface_moments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "limber/common/stack_array.hpp"
#include "limber/contact/potential/line_rule.hpp"

namespace limber::contact {
namespace {

using Weights10 = Eigen::Matrix<double, 10, 1>;
using Slopes = Eigen::Matrix<double, 10, 6>;

// 1, r and r r': xx, yy, zz, xy, xz, yz
Weights10 find_powers(const Vector3& r) {
  Weights10 powers;
  powers << 1.0, r, r.cwiseAbs2(), r.x() * r.y(), r.x() * r.z(), r.y() * r.z();
  return powers;
}

Matrix3 unfold(const Eigen::Matrix<double, 6, 1>& s) {
  Matrix3 square;
  square << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
  return square;
}

/// Of one line, whose normal is n, or of all, by components of n: with p the
/// powers of r about o
struct LineSums {
  Weights10 cubed = Weights10::Zero();  ///< int 4 t^3 p
  Slopes by_motion = Slopes::Zero();    ///< int 12 t^2 p g'
  Vector3 flux = Vector3::Zero();       ///< int phi grad t

  void add(const Depth& depth, const Vector3& r, double weight) {
    const double t2 = depth.t * depth.t;
    const Weights10 powers = find_powers(r);
    flux += weight * depth.flux * depth.gradient;
    cubed += (4.0 * weight * t2 * depth.t) * powers;
    Vector6 g;
    g << depth.gradient, r.cross(depth.gradient);
    by_motion += ((12.0 * weight * t2) * powers) * g.transpose();
  }
};

/// Sums over the surface of `hard`.
struct SurfaceSums {
  double flux = 0.0;
  std::array<Weights10, 3> cubed;   // int 4 t^3 n_k p dS
  std::array<Slopes, 3> by_motion;  // int 12 t^2 n_k p g' dS

  SurfaceSums() {
    cubed.fill(Weights10::Zero());
    by_motion.fill(Slopes::Zero());
  }

  [[nodiscard]] static LineSums begin_line() { return {}; }
  void add(const LineSums& line, const Vector3& area) {
    flux += line.flux.dot(area);
    for (std::size_t k = 0; k < 3; ++k) {
      const double n = area[static_cast<Eigen::Index>(k)];
      if (n == 0.0) continue;
      cubed[k] += n * line.cubed;
      by_motion[k] += n * line.by_motion;
    }
  }

  [[nodiscard]] Vector6 find_wrench() const {
    Matrix3 first;  // by rows n r'
    Vector6 wrench;
    for (int k = 0; k < 3; ++k) {
      const Weights10& sums = cubed[static_cast<std::size_t>(k)];
      wrench[k] = sums[0];
      first.row(k) = sums.segment<3>(1).transpose();
    }
    wrench.tail<3>() = find_moment(first);
    return wrench;
  }

  // int 12 t^2 (n, r x n) g' dS
  [[nodiscard]] Matrix6 find_stiffness() const {
    Matrix6 all;
    for (int i = 0; i < 6; ++i) {
      Matrix3 first;
      for (int k = 0; k < 3; ++k) {
        const Slopes& sums = by_motion[static_cast<std::size_t>(k)];
        all(k, i) = sums(0, i);
        first.row(k) = sums.block<3, 1>(1, i).transpose();
      }
      all.col(i).tail<3>() = find_moment(first);
    }
    return all;
  }

  // r x n of n r'
  [[nodiscard]] static Vector3 find_moment(const Matrix3& first) {
    return {first(2, 1) - first(1, 2), first(0, 2) - first(2, 0),
            first(1, 0) - first(0, 1)};
  }
};

/// SurfaceSums that keep their points, up to a number, for sums of them again.
class KeptSums {
 public:
  struct Point {
    Depth depth;
    Vector3 r = Vector3::Zero();
    double weight = 0.0;             // along its line
    Vector3 area = Vector3::Zero();  // that it stands for
  };
  struct Line {
    KeptSums& all;
    std::size_t first;  // point
    LineSums sums = {};

    void add(const Depth& depth, const Vector3& r, double weight) {
      sums.add(depth, r, weight);
      all.keep({.depth = depth, .r = r, .weight = weight});
    }
  };

  [[nodiscard]] Line begin_line() { return {*this, points_.all().size()}; }
  void add(const Line& line, const Vector3& area) {
    sums_.add(line.sums, area);
    for (Point& point : points_.all().subspan(line.first)) {
      point.area = point.weight * area;
    }
  }

  [[nodiscard]] const SurfaceSums& sums() const { return sums_; }
  [[nodiscard]] bool has_all_points() const { return has_all_; }
  [[nodiscard]] std::span<const Point> points() const { return points_.all(); }

 private:
  static constexpr std::size_t kMost = 2048;

  void keep(const Point& point) {
    has_all_ = has_all_ && points_.all().size() < kMost;
    if (has_all_) points_.add() = point;
  }

  SurfaceSums sums_;
  bool has_all_ = true;
  StackArray<Point, kMost> points_;
};

/// int 24 t (a . p) g g' dS, with the area along n.
class BendSums {
 public:
  BendSums(const Weights10& a, const Vector3& n) : a_(a), n_(n) {}

  struct Line {
    Weights10 a;
    Matrix6 bend = Matrix6::Zero();

    void add(const Depth& depth, const Vector3& r, double weight) {
      Vector6 g;
      g << depth.gradient, r.cross(depth.gradient);
      const double by = 24.0 * weight * depth.t * a.dot(find_powers(r));
      bend += (by * g) * g.transpose();
    }
  };

  [[nodiscard]] Line begin_line() const { return {a_}; }
  void add(const Line& line, const Vector3& area) {
    bend_ += n_.dot(area) * line.bend;
  }
  void add(std::span<const KeptSums::Point> points) {
    for (const KeptSums::Point& point : points) {
      Line line = begin_line();
      line.add(point.depth, point.r, 1.0);
      add(line, point.area);
    }
  }
  [[nodiscard]] const Matrix6& bend() const { return bend_; }

 private:
  Weights10 a_;
  Vector3 n_;
  Matrix6 bend_ = Matrix6::Zero();
};

/// The quadrature of one part of a surface.
template <typename Sums>
class PartQuadrature {
 public:
  PartQuadrature(const RuledSurface& surface, const DepthField& soft,
                 const Vector3& o)
      : surface_(surface), soft_(soft), o_(o) {}

  void integrate(const Span& part, Sums& sums) const {
    Cuts cuts;
    find_cuts(surface_, soft_, part, cuts);
    const auto ends = cuts.all();
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      add_lines({ends[i], ends[i + 1]}, sums);
    }
  }

 private:
  [[nodiscard]] double find_depth(double u) const {
    const StraightLine line = surface_.find_line(u);
    return soft_.find_t(line.at(soft_.find_deepest(line)));
  }

  // Whether lines of a flat end at the rim of a round body where that is deep,
  // so that their lengths go with the root of the distance to the last one.
  [[nodiscard]] bool is_blunt(const Span& u) const {
    constexpr double kInside = 1e-3;
    constexpr double kDeep = 0.03;
    if (!surface_.is_flat() || soft_.is_flat()) return false;
    const double least = kDeep * find_depth(u.middle());
    return find_depth(u.first + kInside * u.length()) > least ||
           find_depth(u.last - kInside * u.length()) > least;
  }

  // Of a blunt part by the sine of an angle.
  void add_lines(const Span& u, Sums& sums) const {
    if (u.is_empty()) return;
    const auto& rule = line_rule<12>();
    const bool by_angle = is_blunt(u);
    for (std::size_t i = 0; i < rule.places.size(); ++i) {
      double place = rule.places[i];
      double weight = rule.weights[i] * u.length();
      if (by_angle) {
        const double angle = std::numbers::pi * (place - 0.5);
        place = 0.5 * (1.0 + std::sin(angle));
        weight *= 0.5 * std::numbers::pi * std::cos(angle);
      }
      add_line(u.first + place * u.length(), weight, sums);
    }
  }

  void add_line(double u, double weight, Sums& sums) const {
    const StraightLine line = surface_.find_line(u);
    const Span part = soft_.cut(line);
    if (part.is_empty()) return;
    LinePieces pieces;
    soft_.divide(line, part, pieces);
    auto of_line = sums.begin_line();
    double first = part.first;
    for (const LinePiece& piece : pieces.all()) {
      const Span span{first, piece.last};
      // Polynomials of degree 5 below a flat.
      if (soft_.is_flat()) {
        add_points<3>(line, span, piece.face, of_line);
      } else {
        add_points<6>(line, span, piece.face, of_line);
      }
      first = piece.last;
    }
    sums.add(of_line, weight * surface_.find_area(u));
  }

  template <std::size_t count, typename LineOf>
  void add_points(const StraightLine& line, const Span& span, int face,
                  LineOf& sums) const {
    const auto& rule = line_rule<count>();
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3 x = line.at(span.first + rule.places[i] * span.length());
      const Depth depth = soft_.find_depth(x, face);
      if (!(depth.t > 0.0)) continue;
      sums.add(depth, x - o_, rule.weights[i] * span.length());
    }
  }

  const RuledSurface& surface_;
  const DepthField& soft_;
  const Vector3& o_;
};

// Out of both cells, over the part of the sheet within `hard`.
double find_sheet_flux(const RuledSurface& sheet, const DepthField& hard) {
  const auto part = find_touched_part(sheet, hard);
  if (!part) return 0.0;
  Cuts cuts;
  find_cuts(sheet, hard, part->u, cuts);
  const auto ends = cuts.all();
  const auto& rule = line_rule<12>();
  double flux = 0.0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double width = ends[k + 1] - ends[k];
    for (std::size_t i = 0; i < rule.places.size(); ++i) {
      const Span within =
          hard.cut(sheet.find_line(ends[k] + rule.places[i] * width));
      if (within.is_empty()) continue;
      flux += rule.weights[i] * width * sheet.find_flux(within);
    }
  }
  return flux;
}

/// ln u of the second moments of a pressure with the sums q over p, and its
/// derivative by q.
struct Form {
  double u = 1.0;
  Weights10 by_sums = Weights10::Zero();
};

// S = q_rr / q_0 - c c', c = q_r / q_0
Form find_form(const Weights10& q, const Vector3& n) {
  const double load = q[0];
  const Vector3 centre = q.segment<3>(1) / load;
  const Matrix3 square = unfold(q.tail<6>()) / load;
  const Elongation form =
      find_elongation(square - centre * centre.transpose(), n);
  const Matrix3& B = form.by_moments;
  const Vector3 by_centre = B * centre;
  Form out;
  out.u = form.u;
  out.by_sums << 2.0 * centre.dot(by_centre) - B.cwiseProduct(square).sum(),
      -2.0 * by_centre, B.diagonal(), 2.0 * B(0, 1), 2.0 * B(0, 2),
      2.0 * B(1, 2);
  out.by_sums /= load;
  return out;
}

// d (d ln u / d q) by the motion, along the changes of q, by differences.
Matrix6 find_bend_of_form(const Weights10& q, const Slopes& slopes,
                          const Vector3& n, const Form& form) {
  constexpr double kStep = 1e-5;
  const double extent = q.segment<3>(4).sum() / q[0];  // square
  Matrix6 bend;
  for (int i = 0; i < 6; ++i) {
    const Weights10 change = slopes.col(i);
    const double rate = std::abs(change[0]) +
                        change.segment<3>(1).norm() / std::sqrt(extent) +
                        change.tail<6>().norm() / extent;
    const double h = rate > 0.0 ? kStep * q[0] / rate : 0.0;
    const Weights10 next = q + h * change;
    if (!(h > 0.0) || !(next[0] > 0.0)) {
      bend.col(i).setZero();
      continue;
    }
    const Weights10 by_sums = (find_form(next, n).by_sums - form.by_sums) / h;
    bend.col(i) = slopes.transpose() * by_sums;
  }
  return 0.5 * (bend + bend.transpose());
}

// `bend` of the sums' second derivatives, but for those of g; 0 if not wanted.
Factor find_factor_of_form(const Form& form, const Slopes& slopes,
                           const Matrix6& bend) {
  constexpr double kStep = 1e-4;
  const ShapeFactor factor = find_shape_factor(form.u);
  const double slope_rate =
      (find_shape_factor((1.0 + kStep) * form.u).slope - factor.slope) / kStep;
  const Vector6 log_u = slopes.transpose() * form.by_sums;
  return {factor.phi, factor.slope * log_u,
          factor.slope * bend + (slope_rate + factor.slope * factor.slope) *
                                    log_u * log_u.transpose()};
}

}  // namespace

SurfaceContact::SurfaceContact(const RuledBody& soft, const RuledBody& hard,
                               const Pose& X)
    : soft_(soft), hard_(hard), X_hs_(X.inverse()) {
  hard.visit_surfaces(X, soft, [&](const RuledSurface& surface) {
    const auto part = find_touched_part(surface, soft.field());
    if (!part) return;
    Part& added = parts_.add();
    added.surface = surface;
    added.u = part->u;
    if (part->depth > deepest_.depth) deepest_ = *part;
  });
}

template <typename Sums>
void SurfaceContact::integrate_parts(const Vector3& o, Sums& sums) const {
  for (const Part& part : parts_.all()) {
    PartQuadrature<Sums>(part.surface, soft_.field(), o)
        .integrate(part.u, sums);
  }
}

DepthMoments SurfaceContact::integrate(const Vector3& o, double sign,
                                       bool has_derivatives) const {
  // Share of M next to an edge of `soft`, from which on ln u, whose second
  // derivative jumps there, counts as ln (C / x) of the motion x.
  constexpr double kEdged = 1e-2;
  KeptSums kept;
  integrate_parts(o, kept);
  const SurfaceSums& sums = kept.sums();
  DepthMoments out;
  double of_sheets = 0.0;
  for (const RuledSurface& sheet : soft_.sheets()) {
    const RuledSurface placed = sheet.place(X_hs_);
    if (!hard_.is_reached(placed)) continue;
    of_sheets += find_sheet_flux(placed, hard_.field());
  }
  out.M = sums.flux + of_sheets;
  const Vector6 wrench = sums.find_wrench();
  out.m1 = sign * wrench;
  out.depth = deepest_.depth;
  const Vector3 way = wrench.head<3>().normalized();
  Weights10 pressure = Weights10::Zero();
  Slopes slopes = Slopes::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = way[static_cast<Eigen::Index>(k)];
    pressure += share * sums.cubed[k];
    slopes += share * sums.by_motion[k];
  }
  out.pressure = pressure[0];
  out.first = pressure.segment<3>(1);
  out.second = unfold(pressure.tail<6>());
  const Form form = find_form(pressure, way);
  Matrix6 bend = Matrix6::Zero();
  if (has_derivatives && of_sheets > kEdged * out.M) {
    const Vector6 log_u = slopes.transpose() * form.by_sums;
    bend = log_u * log_u.transpose();
  } else if (has_derivatives) {
    BendSums of_sums(form.by_sums, way);
    kept.has_all_points() ? of_sums.add(kept.points())
                          : integrate_parts(o, of_sums);
    bend = of_sums.bend() + find_bend_of_form(pressure, slopes, way, form);
  }
  out.factor = find_factor_of_form(form, sign * slopes, bend);
  const Matrix6 stiffness = sums.find_stiffness();
  out.m2 = 0.5 * (stiffness + stiffness.transpose());
  return out;
}

DepthMoments rotate(const DepthMoments& moments, const Matrix3& R) {
  Matrix6 T = Matrix6::Zero();
  T.topLeftCorner<3, 3>() = R;
  T.bottomRightCorner<3, 3>() = R;
  DepthMoments out = moments;
  out.factor = moments.factor.transform(T);
  out.m1 = T * moments.m1;
  out.m2 = T * moments.m2 * T.transpose();
  out.first = R * moments.first;
  out.second = R * moments.second * R.transpose();
  return out;
}

}  // namespace limber::contact
