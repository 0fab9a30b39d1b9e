// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "limber/common/types.hpp"
#include "support/draw_vector.hpp"

namespace limber::metamorphic {

/// Random values of a seed, the same with every standard library.
class RandomDraw {
 public:
  explicit RandomDraw(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  bool chance(double fraction) { return uniform(0.0, 1.0) < fraction; }
  int integer(int low, int high) {
    return low + static_cast<int>(uniform(0.0, 1.0) * (high - low + 1));
  }
  /// Of components in [-1, 1].
  Vector3 vector() {
    return testing::draw_vector([&] { return uniform(-1.0, 1.0); });
  }
  Vector3 direction() {
    const Vector3 v = vector();
    return v.norm() > 0.1 ? Vector3(v.normalized()) : Vector3::UnitX();
  }
  Matrix3 rotation() {
    const double angle = uniform(0.0, 3.0);
    return Eigen::AngleAxisd(angle, direction()).toRotationMatrix();
  }

 private:
  std::mt19937 random_;
};

}  // namespace limber::metamorphic
