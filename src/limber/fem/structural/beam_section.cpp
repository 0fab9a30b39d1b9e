// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/beam_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace limber::fem {
namespace {

constexpr double kPi = std::numbers::pi;

double calc_rectangle_shear(double nu) {
  return 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
}

/// It = a b^3 (1/3 - 64 b / (pi^5 a) sum_odd tanh(n pi a / 2b) / n^5), a >= b
double calc_rectangle_torsion(double height, double width) {
  constexpr int kTerms = 60;
  const double a = std::max(height, width);
  const double b = std::min(height, width);
  double sum = 0.0;
  for (int n = 1; n < kTerms; n += 2)
    sum += std::tanh(0.5 * n * kPi * a / b) / std::pow(n, 5);
  return a * b * b * b * (1.0 / 3.0 - 64.0 * b / (std::pow(kPi, 5) * a) * sum);
}

/// W_t = It / (b (1 - 8 / pi^2 sum_odd 1 / (n^2 cosh(n pi a / 2b)))), in the
/// middle of the longer side (Timoshenko and Goodier, Theory of Elasticity)
double calc_rectangle_modulus(double height, double width) {
  constexpr int kTerms = 60;
  const double a = std::max(height, width);
  const double b = std::min(height, width);
  double sum = 0.0;
  for (int n = 1; n < kTerms; n += 2)
    sum += 1.0 / (n * n * std::cosh(0.5 * n * kPi * a / b));
  return calc_rectangle_torsion(height, width) /
         (b * (1.0 - 8.0 / (kPi * kPi) * sum));
}

/// Shear along the webs of thin-walled sections: @param m area of the flanges
/// to that of the webs @param n width to height @param rest terms of the kind
double calc_thin_shear(double m, double nu, double rest) {
  const double m2 = m * m;
  const double m3 = m2 * m;
  return 10.0 * (1.0 + nu) * (1.0 + 3.0 * m) * (1.0 + 3.0 * m) /
         (12.0 + 72.0 * m + 150.0 * m2 + 90.0 * m3 +
          nu * (11.0 + 66.0 * m + 135.0 * m2 + 90.0 * m3) + rest);
}

/// @param walls thickness of each wall along the shear, two of them
double calc_box_shear(double height, double width, double walls, double others,
                      double nu) {
  const double h = height - others;
  const double b = width - walls;
  const double m = b * others / (h * walls);
  const double n = b / h;
  return calc_thin_shear(m, nu, 10.0 * n * n * ((3.0 + nu) * m + 3.0 * m * m));
}

double calc_square(double height, double width) {  // int y^2 dA
  return width * height * height * height / 12.0;
}

using Vector2 = Eigen::Vector2d;

/// On the outline, with torsion along it.
SectionPoint make_outline_point(double y, double z, double torsion_modulus) {
  SectionPoint point{y, z};
  point.torsion = Vector2(-z, y) / (std::hypot(y, z) * torsion_modulus);
  return point;
}

/// In list_outline()'s order.
std::vector<SectionPoint> list_corners(const BeamSection& section) {
  const double y = section.half_height;
  const double z = section.half_width;
  std::vector<SectionPoint> points;
  for (const auto& [side, other] :
       {std::array{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
    points.push_back(
        make_outline_point(side * y, other * z, section.torsion_modulus));
  return points;
}

/// Corners and middles of sides. @param shear_y per force along y, in the
/// middle of the sides along it @param shear_z the same along z
std::vector<SectionPoint> list_sides(const BeamSection& section, double shear_y,
                                     double shear_z) {
  std::vector<SectionPoint> points = list_corners(section);
  for (const double side : {-1.0, 1.0}) {
    points.push_back(make_outline_point(0.0, side * section.half_width,
                                        section.torsion_modulus));
    points.back().shear_y = {shear_y, 0.0};
    points.push_back(make_outline_point(side * section.half_height, 0.0,
                                        section.torsion_modulus));
    points.back().shear_z = {0.0, shear_z};
  }
  return points;
}

/// Q / (I t) of a box at its neutral axis. @param walls thickness of each of
/// the two walls along the force @param others of those across it
double calc_box_flow(double height, double width, double walls, double others,
                     double I) {
  const double h = height - 2.0 * others;
  const double b = width - 2.0 * walls;
  return (width * height * height - b * h * h) / 8.0 / (I * 2.0 * walls);
}

/// Points of the web and of the middles of flanges of an I.
void add_web_points(double height, double width, double flange, double web,
                    BeamSection& section) {
  const double arm = 0.5 * (height - flange);
  const double at_flange = width * flange * arm;  // Q
  const double inner = 0.5 * height - flange;
  const double at_middle = at_flange + 0.5 * web * inner * inner;
  const double in_flange = 0.5 * width * arm / section.I_z;
  for (const double side : {-1.0, 1.0}) {
    for (const auto& [y, Q] : {std::array{0.0, at_middle},
                               {-inner, at_flange},
                               {inner, at_flange}}) {
      SectionPoint point{y, 0.5 * side * web};
      point.shear_y = {Q / (section.I_z * web), 0.0};
      point.torsion = {-side / section.torsion_modulus, 0.0};
      point.is_inner = true;
      section.points.push_back(point);
    }
    for (const double flow : {-in_flange, in_flange}) {
      section.points.push_back(make_outline_point(
          side * section.half_height, 0.0, section.torsion_modulus));
      section.points.back().shear_y = {0.0, flow};
      section.points.back().shear_z = {0.0, 1.5 / (2.0 * width * flange)};
    }
  }
}

}  // namespace

BeamSection make_tube(double outer, double inner, double nu) {
  const double a2 = outer * outer;
  const double b2 = inner * inner;
  const double m = inner / outer;
  const double s = (1.0 + m * m) * (1.0 + m * m);
  BeamSection section;
  section.area = kPi * (a2 - b2);
  section.I_y = section.I_z = 0.25 * kPi * (a2 * a2 - b2 * b2);
  section.torsion = 2.0 * section.I_y;
  section.torsion_modulus = section.torsion / outer;
  section.shear_y = section.shear_z =
      6.0 * (1.0 + nu) * s /
      ((7.0 + 6.0 * nu) * s + (20.0 + 12.0 * nu) * m * m);
  section.half_height = section.half_width = outer;
  section.is_round = true;
  const double shear =
      (a2 + outer * inner + b2) / (3.0 * section.I_y);  // at the neutral axis
  for (int i = 0; i < kRoundCorners; ++i) {
    const double angle = 2.0 * kPi * i / kRoundCorners;
    const Vector2 out(std::cos(angle), std::sin(angle));
    const Vector2 along(-out[1], out[0]);
    SectionPoint point = make_outline_point(outer * out[0], outer * out[1],
                                            section.torsion_modulus);
    point.shear_y = -shear * out[1] * along;
    point.shear_z = shear * out[0] * along;
    section.points.push_back(point);
  }
  return section;
}

BeamSection make_rectangle(double height, double width, double nu) {
  BeamSection section;
  section.area = height * width;
  section.I_z = calc_square(height, width);
  section.I_y = calc_square(width, height);
  section.torsion = calc_rectangle_torsion(height, width);
  section.torsion_modulus = calc_rectangle_modulus(height, width);
  section.shear_y = section.shear_z = calc_rectangle_shear(nu);
  section.half_height = 0.5 * height;
  section.half_width = 0.5 * width;
  const double shear = 1.5 / section.area;
  section.points = list_sides(section, shear, shear);
  SectionPoint middle;
  middle.shear_y = {shear, 0.0};
  middle.shear_z = {0.0, shear};
  middle.is_inner = true;
  section.points.push_back(middle);
  return section;
}

BeamSection make_box(double height, double width, double top, double side,
                     double nu) {
  const double h = height - 2.0 * top;
  const double b = width - 2.0 * side;
  BeamSection section;
  section.area = height * width - h * b;
  section.I_z = calc_square(height, width) - calc_square(h, b);
  section.I_y = calc_square(width, height) - calc_square(b, h);
  const double enclosed = (height - top) * (width - side);
  section.torsion = 4.0 * enclosed * enclosed /
                    (2.0 * (width - side) / top + 2.0 * (height - top) / side);
  section.torsion_modulus = 2.0 * enclosed * std::min(top, side);
  section.shear_y = calc_box_shear(height, width, side, top, nu);
  section.shear_z = calc_box_shear(width, height, top, side, nu);
  section.half_height = 0.5 * height;
  section.half_width = 0.5 * width;
  section.points =
      list_sides(section, calc_box_flow(height, width, side, top, section.I_z),
                 calc_box_flow(width, height, top, side, section.I_y));
  // The flow from the middle of a wall across the force to its end.
  const double half = 0.25 * enclosed;
  for (std::size_t k = 0; k < 4; ++k) {
    SectionPoint& corner = section.points[k];
    corner.shear_y = {half * top / (section.I_z * std::min(top, side)), 0.0};
    corner.shear_z = {0.0, half * side / (section.I_y * std::min(top, side))};
  }
  return section;
}

BeamSection make_i_section(double height, double width, double flange,
                           double web, double nu) {
  const double inner = height - 2.0 * flange;
  const double h = height - flange;
  const double m = 2.0 * width * flange / (h * web);
  const double n = width / h;
  BeamSection section;
  section.area = 2.0 * width * flange + inner * web;
  section.I_z = calc_square(height, width) - calc_square(inner, width - web);
  section.I_y = 2.0 * calc_square(width, flange) + calc_square(web, inner);
  section.torsion =
      (2.0 * width * std::pow(flange, 3) + inner * std::pow(web, 3)) / 3.0;
  section.torsion_modulus = section.torsion / std::max(flange, web);
  section.shear_y = calc_thin_shear(
      m, nu,
      30.0 * n * n * (m + m * m) + 5.0 * nu * n * n * (8.0 * m + 9.0 * m * m));
  section.shear_z =
      calc_rectangle_shear(nu) * 2.0 * width * flange / section.area;
  section.half_height = 0.5 * height;
  section.half_width = 0.5 * width;
  section.points = list_corners(section);
  add_web_points(height, width, flange, web, section);
  return section;
}

}  // namespace limber::fem
