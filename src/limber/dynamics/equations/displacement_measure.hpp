// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "limber/dynamics/equations/displacement_tree.hpp"
#include "limber/dynamics/equations/refined_peak.hpp"
#include "limber/dynamics/system/system_model.hpp"

/// Displacement due to modal coordinates: the measure of level_advice.hpp.
namespace limber::dynamics {

/// Reach of the bodies carried at each coupler's end: the sum of their
/// diameters along the longest path that starts with that coupler. Independent
/// of the configuration. A flexible body's diameter is that of its bounding
/// box, a rigid body's is twice the distance of its farthest attachment from
/// the centre of mass. A body does not carry what holds it: bodies beyond a
/// coupler that the world holds, or that have more mass than all others that
/// are joined to the body.
/// @returns one entry an attachment [m]; zero without a coupler, or if it leads
/// to what holds the body.
[[nodiscard]] std::vector<double> find_reaches(const SystemModel& model);

/// The stored nodes of a body in a DisplacementTree, which costs as much as
/// hundreds of steps and is made at first use: not for several threads.
class MovedNodes {
 public:
  explicit MovedNodes(std::shared_ptr<const flexbody::ReducedBody> reduced)
      : reduced_(std::move(reduced)) {}
  [[nodiscard]] const flexbody::ReducedBody& reduced() const {
    return *reduced_;
  }
  [[nodiscard]] const DisplacementTree& tree() const;

 private:
  std::shared_ptr<const flexbody::ReducedBody> reduced_;
  mutable std::optional<DisplacementTree> tree_;
};

/// Largest displacement that modal coordinates of one body cause.
///
/// Equation   max over stored nodes |Phi_n eta|, and over the ends of couplers
///            |Phi_F eta| + reach |Psi_F eta|
/// Limits     the second is the displacement of the bodies that it carries: a
///            bound, as if every joint transmitted every rotation. Not for
///            several threads (MovedNodes)
class DisplacementMeasure {
 public:
  /// Measures the body's own nodes.
  explicit DisplacementMeasure(const BodyModel& body)
      : DisplacementMeasure(std::make_shared<MovedNodes>(body.reduced)) {}
  explicit DisplacementMeasure(std::shared_ptr<const MovedNodes> nodes);
  /// Measures its own nodes and all bodies that its couplers carry.
  /// @param reaches of all bodies, by find_reach [m]
  DisplacementMeasure(std::shared_ptr<const MovedNodes> nodes,
                      const SystemModel& model, BodyIndex body,
                      const std::vector<double>& reaches);

  /// [m] @param eta m modal coordinates [kg^1/2 m]
  [[nodiscard]] double calc_displacement(const VectorX& eta) const {
    int leaf = -1;
    return calc_displacement(eta, leaf);
  }
  /// @param leaf as of DisplacementTree, for a course of coordinates
  [[nodiscard]] double calc_displacement(const VectorX& eta, int& leaf) const;
  /// Displacement per unit of each mode alone, m [kg^-1/2].
  [[nodiscard]] const VectorX& mode_sizes() const { return mode_sizes_; }

 private:
  struct Carried {
    Matrix3X Phi_B;      ///< [kg^-1/2]
    Matrix3X Psi_B;      ///< [kg^-1/2 m^-1]
    double reach = 0.0;  ///< [m]
  };
  void find_mode_sizes();

  std::shared_ptr<const MovedNodes> nodes_;
  std::vector<Carried> carried_;
  VectorX mode_sizes_;
  VectorX node_sizes_;  ///< the same of own nodes
};

/// Peak of a DisplacementMeasure over many modal coordinates. Most are rejected
/// after m operations: |u(eta)| <= |u(eta_0)| + sum_k size_k |eta - eta_0|.
/// Between samples it is that of a parabola (RefinedPeak).
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
  VectorX eta_0_;     ///< the last one measured
  double u_0_ = 0.0;  ///< its displacement [m]
  int leaf_ = -1;     ///< where it was
  Peak peak_;
  // The last two samples, and whether the last one is the largest.
  VectorX eta_a_;
  VectorX eta_b_;
  double t_a_ = 0.0;  // [s]
  double t_b_ = 0.0;  // [s]
  int count_ = 0;     // of them
  bool was_record_ = false;
};

}  // namespace limber::dynamics
