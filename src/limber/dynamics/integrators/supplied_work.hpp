// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/energy_flows.hpp"
#include "limber/dynamics/equations/placed_drive.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Work over a step of drives, of forces and moments in the world's axes, of
/// moments in a rigid body's axes and of gravity, along the path of the point
/// or axis of action. The trapezoidal rule of their powers is wrong by any
/// amount where a saturated drive's command, or a body, moves back and forth
/// within a step.
///
/// Equation   W = (f_0 + f_1) / 2 (s_1 - s_0) + (f_1 - f_0) (s'_1 - s'_0) h /
/// 12
///            along a path s: a drive's command (joints::find_supply), or a
///            force's direction times the place that it acts at. Exact for a
///            constant f, and for f linear in time along a cubic s. Of a moment
///            s is its direction times the integral of the angular velocity
///            (rotation_path.hpp).
/// Limits     forces in body axes, moments in those of a flexible body, loads
/// on
///            uncoupled or unreduced bodies, and velocity drives that follow an
///            input keep the trapezoidal rule; so do moments in a step whose
///            rotation_path.hpp does not know, and a difference within the
///            round-off of the places. Powers are those of the last iterate, so
///            that the work of loads and weight has the error of Newton's
///            method.
class SuppliedWork {
 public:
  explicit SuppliedWork(const SystemModel& model);

  /// Sets the beginning of the next step.
  /// @param terms at `state`
  void start(const SystemState& state, const SystemTerms& terms);
  /// Accounts for a step of `h` [s] that ends at `to`, where `terms` apply; the
  /// next step begins there.
  /// @param work by the trapezoidal rule, in the rows of EnergyRows, to which
  /// corrections are added [J]
  void advance(const SystemState& to, const SystemTerms& terms, double h,
               VectorX& work);
  /// Reverts the last advance().
  void undo() {
    now_.swap(before_);
    turned_.swap(turned_before_);
  }

  /// Saves or restores the history.
  void exchange_memory(Archive& archive) { archive(now_, turned_); }

 private:
  struct Path {
    double force = 0.0;  // [N, N m]
    double place = 0.0;  // [m, rad]
    double rate = 0.0;   // [m/s, rad/s]
    double size = 0.0;   // of the terms that the place is a sum of [m, rad]
  };
  friend void exchange(Archive& archive, Path& path) {
    archive(path.force, path.place, path.rate, path.size);
  }
  /// Of what a moment acts on.
  struct Turned {
    Matrix3 R_WF = Matrix3::Identity();  // of the body if `in_world` is false
    Vector3 w = Vector3::Zero();         // in the moment's axes [rad/s]
  };
  friend void exchange(Archive& archive, Turned& turned) {
    archive(turned.R_WF, turned.w);
  }
  void list_loads();
  void list_rows();
  void read(const SystemState& state, const SystemTerms& terms, Side side);
  void read_moments(const SystemTerms& terms, const EvaluationTime& now);
  void set_moment_paths(double h);
  static double find_correction(const Path& first, const Path& last, double h);

  const SystemModel& model_;
  std::vector<PlacedDrive> drives_;
  std::vector<std::size_t> loads_;    // indices
  std::vector<std::size_t> moments_;  // indices of loads
  std::vector<std::size_t> bodies_;   // with weight
  std::vector<Eigen::Index> row_of_;  // of drives, loads, bodies, moments
  std::vector<Path> now_;             // likewise
  std::vector<Path> before_;
  std::vector<Turned> turned_;  // one per moment
  std::vector<Turned> turned_before_;
};

}  // namespace limber::dynamics
