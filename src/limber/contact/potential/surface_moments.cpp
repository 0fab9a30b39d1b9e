// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/surface_moments.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "limber/contact/potential/line_rule.hpp"
#include "limber/contact/potential/surface_sums.hpp"

namespace limber::contact {
namespace {

/// The quadrature of one part of a surface.
template <typename Sums>
class PartQuadrature {
 public:
  PartQuadrature(const RuledSurface& surface, const DepthField& soft,
                 const Vector3& o, bool by_tip)
      : surface_(surface), soft_(soft), o_(o), by_tip_(by_tip) {}

  void integrate(const Span& part, Sums& sums) const {
    Cuts cuts;
    find_cuts(surface_, soft_, part, cuts);
    if (surface_.has_one_normal()) {
      auto all = sums.begin_line();
      visit_lines(cuts, [&](double u, double weight) {
        add_line(surface_.find_line(u),
                 weight * surface_.find_area(u).dot(surface_.e3), all);
      });
      sums.add(all, surface_.e3);
      return;
    }
    visit_lines(cuts, [&](double u, double weight) {
      auto line = sums.begin_line();
      Vector3 area;
      add_line(surface_.find_line(u, area), 1.0, line);
      sums.add(line, weight * area);
    });
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

  // Between cuts. @param use (u, weight)
  template <typename Use>
  void visit_lines(const Cuts& cuts, const Use& use) const {
    const auto ends = cuts.all();
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      visit_lines(Span{ends[i], ends[i + 1]}, use);
    }
  }
  // Of a blunt part by the sine of an angle.
  template <typename Use>
  void visit_lines(const Span& u, const Use& use) const {
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
      use(u.first + place * u.length(), weight);
    }
  }

  template <typename LineOf>
  void add_line(const StraightLine& line, double weight, LineOf& sums) const {
    const Span part = soft_.cut(line);
    if (part.is_empty()) return;
    LinePieces pieces;
    soft_.divide(line, part, pieces);
    double first = part.first;
    for (const LinePiece& piece : pieces.all()) {
      const Span span{first, piece.last};
      // Polynomials of degree 5 below a flat, 6 where lines meet.
      if (soft_.is_flat() && !surface_.narrows()) {
        add_points<3>(line, span, piece.face, weight, sums);
      } else {
        add_points<6>(line, span, piece.face, weight, sums);
      }
      first = piece.last;
    }
  }

  template <std::size_t count, typename LineOf>
  void add_points(const StraightLine& line, const Span& span, int face,
                  double weight, LineOf& sums) const {
    const auto& rule = line_rule<count>();
    for (std::size_t i = 0; i < count; ++i) {
      const double v = span.first + rule.places[i] * span.length();
      const Vector3 x = line.at(v);
      const Depth depth = soft_.find_depth(x, face, by_tip_);
      if (!(depth.t > 0.0)) continue;
      sums.add(
          depth, x - o_,
          weight * rule.weights[i] * span.length() * surface_.find_width(v));
    }
  }

  const RuledSurface& surface_;
  const DepthField& soft_;
  const Vector3& o_;
  bool by_tip_;
};

// Whether the axis of a soft cone is within `hard`, also below its rim's sheet.
bool is_by_tip(const DepthField& soft, const DepthField& hard,
               const Pose& X_hs) {
  const auto* cone = std::get_if<Cone>(&soft.kind());
  if (cone == nullptr) return false;
  const double half = cone->half_length;
  return !hard.cut({X_hs.p, X_hs.R.col(2), {-half, half}}).is_empty();
}

// Out of both cells, over the part of the sheet within `hard`.
double find_sheet_flux(const RuledSurface& sheet, const DepthField& hard,
                       bool by_tip) {
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
      flux += rule.weights[i] * width * sheet.find_flux(within, by_tip);
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

// `bend` of the sums' second derivatives, except for those of g; 0 if not
// wanted.
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
  by_tip_ = is_by_tip(soft.field(), hard.field(), X_hs_);
}

template <typename Sums>
void SurfaceContact::integrate_parts(const Vector3& o, Sums& sums) const {
  for (const Part& part : parts_.all()) {
    PartQuadrature<Sums>(part.surface, soft_.field(), o, by_tip_)
        .integrate(part.u, sums);
  }
}

DepthMoments SurfaceContact::integrate(const Vector3& o, double sign,
                                       bool has_derivatives) const {
  // Fraction of M next to an edge of `soft`, from which on ln u, whose second
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
    of_sheets += find_sheet_flux(placed, hard_.field(), by_tip_);
  }
  out.M = sums.flux + of_sheets;
  const Vector6 wrench = sums.find_wrench();
  out.m1 = sign * wrench;
  out.depth = soft_.field().is_flat()
                  ? deepest_.depth
                  : soft_.field().find_depth(deepest_.place, 0).t;
  const Vector3 way = wrench.head<3>().normalized();
  Weights10 pressure = Weights10::Zero();
  Slopes slopes = Slopes::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const double fraction = way[static_cast<Eigen::Index>(k)];
    pressure += fraction * sums.cubed[k];
    slopes += fraction * sums.by_motion[k];
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
