// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "dynamics/refined_peak.hpp"
#include "dynamics/system_model.hpp"

/// How far modal coordinates move things: the yardstick of level_advice.hpp.
namespace limber::dynamics {

/// How far what hangs on each coupler's end reaches: the sum of the diameters
/// of the bodies along the longest path that starts with that coupler. Holds in
/// every posture. A flexible body's diameter is that of its bounding box, a
/// rigid body's twice its farthest attachment from the centre of mass.
/// @returns one entry an attachment [m]; zero where no coupler ends, or where
/// it leads to the world.
[[nodiscard]] std::vector<double> find_reaches(const SystemModel& model);

/// Largest displacement that modal coordinates of one body cause.
///
/// Equation   max over kept nodes |Phi_n eta|, and over the ends of couplers
///            |Phi_F eta| + reach |Psi_F eta|
/// Limits     the second is what a bent body does to those that it carries: a
///            bound, as if every joint passed on every rotation
class DisplacementMeasure {
 public:
  /// Of the body's own nodes.
  explicit DisplacementMeasure(const BodyModel& body);
  /// Of its own nodes and of all that its couplers carry.
  DisplacementMeasure(const SystemModel& model, BodyIndex body,
                      const std::vector<double>& reaches);

  /// [m] @param eta m modal coordinates [kg^1/2 m]
  [[nodiscard]] double calc_displacement(const VectorX& eta) const;
  /// Displacement per unit of each mode alone, m [kg^-1/2].
  [[nodiscard]] const VectorX& mode_sizes() const { return mode_sizes_; }

 private:
  struct Carried {
    Matrix3X Phi_B;
    Matrix3X Psi_B;
    double reach = 0.0;
  };
  void find_mode_sizes();

  std::shared_ptr<const flexbody::ReducedBody> reduced_;
  std::vector<Carried> carried_;
  VectorX mode_sizes_;
  VectorX node_sizes_;  ///< the same of own nodes
};

/// Peak of a DisplacementMeasure over many modal coordinates. Most are passed
/// over after m operations: |u(eta)| <= |u(eta_0)| + sum_k size_k |eta -
/// eta_0|. Between them it is that of a parabola (RefinedPeak).
///
/// Limits     low by at most 0.1 %, where steps resolve the motion
class PeakDisplacement {
 public:
  explicit PeakDisplacement(const DisplacementMeasure& measure);

  /// @param t increasing [s]
  void include(const VectorX& eta, double t);
  [[nodiscard]] const Peak& peak() const { return peak_; }  ///< [m]

  void exchange_memory(Archive& archive);

 private:
  [[nodiscard]] bool is_record(const VectorX& eta, double t);

  const DisplacementMeasure* measure_;
  VectorX eta_0_;     ///< the last one that was measured
  double u_0_ = 0.0;  ///< its displacement [m]
  Peak peak_;
  // The last two, and whether the last one is the largest.
  VectorX eta_a_;
  VectorX eta_b_;
  double t_a_ = 0.0;  // [s]
  double t_b_ = 0.0;  // [s]
  int count_ = 0;     // of them
  bool was_record_ = false;
};

}  // namespace limber::dynamics
