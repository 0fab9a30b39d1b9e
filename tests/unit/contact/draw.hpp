// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>

#include "limber/common/types.hpp"

namespace limber::contact::test {

/// Random numbers that follow from a seed.
class Draw {
 public:
  explicit Draw(unsigned seed) : generator_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  double log_between(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  /// Between powers of ten.
  double in_decades(double low, double high) {
    return std::pow(10.0, between(low, high));
  }
  /// In a cube of edge 2.
  Vector3 vector() {
    return {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)};
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace limber::contact::test
