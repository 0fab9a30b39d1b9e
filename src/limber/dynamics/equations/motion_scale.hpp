// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Displacement of points of the bodies by small motions of all coordinates.
///
/// Equation   d^2 = |translation|^2 + (reach |rotation|)^2
///                  + sum_k (size_k eta_k)^2,
///            with the distance `reach` of the body's farthest point from Bo,
///            and size_k the largest displacement of a point by mode k; for an
///            unreduced body the largest nodal displacement
/// Limits     a measure, not a bound: different motions are assumed
///            perpendicular
class MotionScale {
 public:
  explicit MotionScale(const SystemModel& model);

  struct Largest {
    double displacement = 0.0;  ///< [m]
    std::size_t body = 0;       ///< its index
  };
  /// Of the increments `factor` (b - a) of accelerations, which mode k's own
  /// stiffness reduces to 1 / (1 + filter lambda_k) of it: a vibration that a
  /// step does not resolve can err by its amplitude, not by the acceleration
  /// times h^2 [@hairer1996, eq. IV.8.19].
  /// @param factor [s^2] @param filter beta h^2 of the scheme [s^2]
  [[nodiscard]] Largest measure_change(const VectorX& a, const VectorX& b,
                                       double factor, double filter) const;
  /// Of the difference of two states at the same time.
  [[nodiscard]] Largest measure_distance(const SystemState& a,
                                         const SystemState& b) const;

 private:
  struct Body {
    bool moves = false;    // a frame of its own
    int offset = 0;        // of its modes in the state
    Eigen::Index row = 0;  // of its first unknown
    double reach = 0.0;    // [m]
    VectorX sizes;         // of modes [kg^-1/2]
    VectorX lambda;        // of modes [rad^2/s^2]
  };
  struct Nodes {
    std::size_t body = 0;
    Eigen::Index first = 0;
    Eigen::Index dofs = 0;
  };
  Eigen::Index first_node_;  // row of the first node
  std::vector<Body> bodies_;
  std::vector<Nodes> nodes_;
};

/// Largest distance of a known point of a body (kept nodes and attachments)
/// from its frame's origin, at least the radius of gyration [m].
[[nodiscard]] double find_reach(const SystemModel& model, BodyIndex body);

}  // namespace limber::dynamics
