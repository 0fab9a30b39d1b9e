// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/residual.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// How far small motions of all kinds move points of the bodies.
///
/// Equation   d^2 = |translation|^2 + (reach |rotation|)^2
///                  + sum_k (size_k eta_k)^2,
///            reach that of the body's farthest point from Bo, size_k the
///            largest displacement that mode k makes of a point; of an
///            unreduced body its largest nodal displacement
/// Limits     a measure, not a bound: independent motions are taken to be
///            perpendicular
class MotionScale {
 public:
  explicit MotionScale(const SystemModel& model);

  struct Largest {
    double displacement = 0.0;  ///< [m]
    std::size_t body = 0;
  };
  /// Of `factor` times (b - a).
  [[nodiscard]] Largest measure_change(const Rates& a, const Rates& b,
                                       double factor) const;
  /// Between two states of the same time.
  [[nodiscard]] Largest measure_distance(const SystemState& a,
                                         const SystemState& b) const;

 private:
  struct Body {
    bool moves = false;  // a frame of its own
    int offset = 0;      // of its modes
    double reach = 0.0;
    VectorX sizes;  // m [kg^-1/2]
  };
  struct Nodes {
    std::size_t body = 0;
    Eigen::Index first = 0;
    Eigen::Index dofs = 0;
  };
  std::vector<Body> bodies_;
  std::vector<Nodes> full_;
};

/// Distance of the farthest point of a body from its frame's origin that is
/// known: kept nodes and attachments, at least its radius of gyration [m].
[[nodiscard]] double find_reach(const SystemModel& model, BodyIndex body);

}  // namespace limber::dynamics
