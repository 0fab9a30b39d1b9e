// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/offset.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace limber::results {
namespace {

constexpr double kFar = 10.0;     // of the size of the box
constexpr double kLong = 1000.0;  // of the size of the scene

// To a multiple of 10^power; exact for fractions, too.
double round_to(double value, int power) {
  const double unit = std::pow(10.0, std::abs(power));
  const double rounded = power < 0 ? std::round(value * unit) / unit
                                   : std::round(value / unit) * unit;
  return rounded + 0.0;  // never -0
}

double find_radius(const dynamics::BodyModel& body) {
  if (!body.reduced || body.reduced->rows.x_B.cols() == 0) {
    return estimate_radius(body.mass, body.J0);
  }
  return body.reduced->rows.x_B.colwise().norm().maxCoeff();
}

// Diagonal of a path's box.
double find_length(const MatrixX& path) {
  Bounds box;
  for (const auto& p : path.rowwise()) box.include(p);
  return box.size();
}

// Of the scene at an output, the largest.
double find_size(const std::vector<Course>& courses) {
  double size = 0.0;
  for (Eigen::Index i = 0; i < courses.front().p_WB.rows(); ++i) {
    Bounds box;
    for (const Course& course : courses) {
      box.include(course.p_WB.row(i), course.radius);
    }
    size = std::max(size, box.size());
  }
  return size;
}

}  // namespace

double estimate_radius(double mass, const Matrix3& J) {
  return std::sqrt(J.trace() / mass);
}

Vector3 choose_offset(const Bounds& box) {
  const double size = box.size();
  const Vector3 centre = 0.5 * (box.lower + box.upper);
  if (!(size > 0.0) || !(centre.norm() > kFar * size)) {
    return Vector3::Zero();
  }
  const int power = static_cast<int>(std::floor(std::log10(size)));
  return centre.unaryExpr([power](double c) { return round_to(c, power); });
}

Home find_home(const std::vector<Course>& courses) {
  if (courses.empty()) return {};
  Bounds all;
  MatrixX mean = MatrixX::Zero(courses.front().p_WB.rows(), 3);
  for (const Course& course : courses) {
    for (const auto& p : course.p_WB.rowwise()) all.include(p, course.radius);
    mean += course.p_WB / double(courses.size());
  }
  Home home{choose_offset(all), MatrixX::Zero(mean.rows(), 3), false};
  home.travels = find_length(mean) > kLong * find_size(courses);
  if (home.travels) home.path = mean.rowwise() - home.offset.transpose();
  return home;
}

Home find_home(const dynamics::SystemModel& model,
               std::span<const dynamics::SystemState> states) {
  std::vector<Course> courses;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    Course course{find_radius(model.bodies[b]), MatrixX(std::ssize(states), 3)};
    for (std::size_t i = 0; i < states.size(); ++i) {
      course.p_WB.row(Eigen::Index(i)) = states[i].bodies[b].p_WB;
    }
    courses.push_back(std::move(course));
  }
  return find_home(courses);
}

dynamics::SystemState shift_bodies(dynamics::SystemState state,
                                   const Vector3& offset) {
  for (auto& body : state.bodies) body.p_WB -= offset;
  return state;
}

}  // namespace limber::results
