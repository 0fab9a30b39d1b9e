// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::testing {

struct PairedBodiesOptions {
  bool by_pairs = true;  ///< else a coupler a line
  bool is_flexible = true;
  bool is_bent = false;    ///< flexible, at level nonlinear with made-up tables
  double stiffness = 1e2;  ///< of a line [N/m]
  double damping = 0.0;    ///< of a line [N s/m]
  int lines = 20;          ///< between A and B; half as many between B and C
  double spin = 2.0;       ///< of bodies at the start [rad/s]
};

struct PairedBodies {
  dynamics::SystemModel model;
  dynamics::SystemState state;
};

/// Bodies A, B, C and lines with a free length between points of A and B, of B
/// and C, and of A and the world: three pairs, two of which share a body.
PairedBodies make_paired_bodies(const PairedBodiesOptions& options);

/// A linear one-sided spring between spheres, or a sphere (B) and the half
/// space z <= 0 (A).
///
/// Equation   f = k max(0, -g) n, g the gap, n from A to B; E = k g^2 / 2;
///            over a step f = -(E_1 - E_0) / (g_1 - g_0) along the mean of n
class SphereContact final : public joints::PairInteraction {
 public:
  /// @param radius_A 0: A is the half space [m]
  SphereContact(double stiffness, double radius_A, double radius_B)
      : stiffness_(stiffness), radius_A_(radius_A), radius_B_(radius_B) {}

  [[nodiscard]] std::string_view kind() const override {
    return "sphere contact";
  }
  void describe_parameters(Manifest& out) const override;
  [[nodiscard]] std::size_t most_points() const override { return 1; }
  void check(int /*modes_A*/, int /*modes_B*/) const override {}
  void evaluate(const joints::PairBodies& bodies, const EvaluationTime& now,
                std::span<const double> memory,
                joints::PairResponse& out) const override;
  void evaluate_over_step(const joints::PairStep& step,
                          std::span<const double> memory,
                          joints::PairResponse& out) const override;

 private:
  struct Gap {
    double value;
    Vector3 normal_W;
    double distance;  // of the centres; infinite from a plane
  };
  [[nodiscard]] Gap find_gap(const joints::PairBodies& bodies) const;
  void add_point(const joints::PairBodies& bodies, const Gap& gap, double force,
                 double stiffness, joints::PairResponse& out) const;

  double stiffness_;
  double radius_A_;
  double radius_B_;
};

}  // namespace limber::testing
