// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/dense/exponential.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/flexbody/modal/modal_response_oscillator.hpp"

namespace limber::dynamics {

/// All modes of a model on their own springs, dampers and Maxwell elements,
/// moved exactly over a time that all share. Nothing is allocated but in the
/// constructor.
///
/// Equation   q'' + c q' + lambda (q + sum_j g_j d_j) = f, f constant,
///            d_j' = q' - d_j / tau_j: without elements by the closed form of
///            an oscillator, with them by the exponential of their matrix
class FreeVibration {
 public:
  /// @param model outlives it
  explicit FreeVibration(const SystemModel& model);

  /// @param time over which modes are moved [s]
  void set_time(double time);
  [[nodiscard]] double time() const { return time_; }  ///< [s]

  /// Moves modes and elements without a load, and adds the energy that each
  /// body loses. @param losses of at least all bodies [J]
  void move(SystemState& state, VectorX& losses);
  /// The same with constant loads. @param loads f of modes, in the rows of all
  /// unknowns [kg^-1/2 N]
  void move(const VectorX& loads, SystemState& state);

  /// Adds c q' + lambda (q + sum_j g_j d_j), which makes the acceleration of a
  /// mode the load on it. @param accelerations of all unknowns
  void add_own_forces(const SystemState& state, VectorX& accelerations) const;

 private:
  struct Mode {
    flexbody::ModalOscillator oscillator;
    const flexbody::MaxwellElements* elements;
    Eigen::Index body;
    Eigen::Index index;   // in SystemState::eta
    Eigen::Index row;     // in all unknowns
    Eigen::Index first;   // in SystemState::maxwell, of its first element
    Eigen::Index stride;  // there, to its next element
    flexbody::FreeResponse response{};  // over time_, without elements
    // With J elements: from (q, q', d, f) to (q, q', d), 2+J x 3+J.
    MatrixX flow{};
  };
  /// Matrices of modes with one number of elements.
  struct Workspace {
    explicit Workspace(Eigen::Index elements);
    MatrixX rates;  // of (s q, q', s d, f), s = sqrt(lambda) [1/s]
    VectorX begin;  // q, q', d, f
    VectorX end;    // q, q', d
    dense::Exponential exponential;
  };
  void add_body(const BodyModel& body, Eigen::Index index);
  Workspace& workspace_of(const Mode& mode);
  void set_flow(Mode& mode);
  void move(Mode& mode, double load, SystemState& state);
  void move_with_elements(const Mode& mode, double load, SystemState& state);

  std::vector<Mode> modes_;
  std::vector<Workspace> workspaces_;  // by number of elements
  double time_ = 0.0;
};

}  // namespace limber::dynamics
