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

// Finds a home from the places of the bodies, output by output.
class HomeFinder {
 public:
  explicit HomeFinder(std::vector<double> radii) : radii_(std::move(radii)) {}

  // @param place of a body [m]
  template <typename Place>
  void add(const Place& place) {
    Bounds now;
    for (std::size_t b = 0; b < radii_.size(); ++b) {
      now.include(place(b), radii_[b]);
      all_.include(place(b), radii_[b]);
    }
    means_.include(find_mean(place));
    size_ = std::max(size_, now.size());
  }

  template <typename Place>
  [[nodiscard]] Vector3 find_mean(const Place& place) const {
    Vector3 mean = Vector3::Zero();
    for (std::size_t b = 0; b < radii_.size(); ++b) {
      mean += place(b) / double(radii_.size());
    }
    return mean;
  }

  // Without its path.
  [[nodiscard]] Home find() const {
    return {choose_offset(all_), MatrixX(0, 3), means_.size() > kLong * size_};
  }

 private:
  std::vector<double> radii_;  // of the bodies [m]
  Bounds all_;
  Bounds means_;
  double size_ = 0.0;  // of the scene at an output, the largest [m]
};

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
  std::vector<double> radii;
  for (const Course& course : courses) radii.push_back(course.radius);
  HomeFinder finder(std::move(radii));
  const Eigen::Index outputs = courses.front().p_WB.rows();
  const auto at = [&](Eigen::Index i) {
    return [&courses, i](std::size_t b) -> Vector3 {
      return courses[b].p_WB.row(i);
    };
  };
  for (Eigen::Index i = 0; i < outputs; ++i) finder.add(at(i));
  Home home = finder.find();
  home.path = MatrixX::Zero(outputs, 3);
  for (Eigen::Index i = 0; home.travels && i < outputs; ++i) {
    home.path.row(i) = finder.find_mean(at(i)) - home.offset;
  }
  return home;
}

Home find_home(const dynamics::SystemModel& model, const States& states) {
  if (model.bodies.empty()) return {};
  std::vector<double> radii;
  for (const dynamics::BodyModel& body : model.bodies) {
    radii.push_back(find_radius(body));
  }
  HomeFinder finder(std::move(radii));
  const auto at = [](const dynamics::SystemState& state) {
    return [&state](std::size_t b) { return state.bodies[b].p_WB; };
  };
  for (const dynamics::SystemState& state : states) finder.add(at(state));
  Home home = finder.find();
  if (!home.travels) return home;
  home.path.resize(std::ssize(states), 3);
  Eigen::Index row = 0;
  for (const dynamics::SystemState& state : states) {
    home.path.row(row++) = finder.find_mean(at(state)) - home.offset;
  }
  return home;
}

dynamics::SystemState shift_bodies(dynamics::SystemState state,
                                   const Vector3& offset) {
  for (auto& body : state.bodies) body.p_WB -= offset;
  return state;
}

}  // namespace limber::results
