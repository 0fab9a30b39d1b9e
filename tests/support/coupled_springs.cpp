// SPDX-License-Identifier: BSD-3-Clause
#include "support/coupled_springs.hpp"

#include <random>

namespace limber::testing {
namespace {

Eigen::Index row(std::size_t point) {
  return 3 * static_cast<Eigen::Index>(point);
}

}  // namespace

CoupledSprings::CoupledSprings(int modes_A, int modes_B, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto draw = [&](Eigen::Index rows, Eigen::Index columns) {
    MatrixX all(rows, columns);
    for (double& x : all.reshaped()) x = uniform(random);
    return all;
  };
  for (std::size_t i = 0; i < kPoints; ++i) {
    for (const int modes : {modes_A, modes_B}) {
      const Vector3 x_B = draw(3, 1);
      places_.push_back({x_B, 0.3 * draw(3, modes)});
    }
  }
  stiffness_ = 50.0 * draw(3 * kPoints, 3 * kPoints);
}

void CoupledSprings::evaluate(const joints::PairBodies& bodies,
                              const EvaluationTime& /*now*/,
                              std::span<const double> /*memory*/,
                              joints::PairResponse& out) const {
  VectorX stretch(3 * kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    joints::PairPoint& point = out.add();
    point.on_A = places_[2 * i];
    point.on_B = places_[2 * i + 1];
    stretch.segment<3>(row(i)) = find_position(bodies.B, point.on_B) -
                                 find_position(bodies.A, point.on_A);
  }
  const VectorX force = -stiffness_ * stretch;
  for (std::size_t i = 0; i < kPoints; ++i) {
    joints::PairPoint& point = out.points()[i];
    point.force_W = force.segment<3>(row(i));
    point.stiffness = stiffness_.block<3, 3>(row(i), row(i));
    for (std::size_t j = 0; j < kPoints; ++j) {
      if (j == i) continue;
      out.coupling(i, j) = stiffness_.block<3, 3>(row(i), row(j));
    }
  }
}

}  // namespace limber::testing
