// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/system_terms.hpp"
#include "limber/joints/coordinates/motion.hpp"

namespace limber::dynamics {

/// Monitors the displacement of joints in their constrained directions.
///
/// Equation   d = |Kt p| / kt, theta = sqrt(2 V_r / kr), V_r the energy of the
///            rotation alone; both against the size l of the smaller of the
///            joined bodies: the larger of d / l and theta. And the energy
///            kt d^2 / 2 + kr theta^2 / 2, when it is largest, against the
///            elastic energy of all bodies that are connected to it.
/// Limits     pairs that touch do not connect bodies; a body's size is the
/// distance to the farthest of its other
///            attachments, or its largest radius of gyration.
class DeflectionObserver {
 public:
  explicit DeflectionObserver(const SystemModel& model);

  /// The end of a step. @param terms at `state`
  void include(const SystemState& state, const SystemTerms& terms);
  /// One for each joint displaced by more than kLargest, and one for all whose
  /// fraction of the elastic energy exceeds kLargestFraction, the largest
  /// first.
  [[nodiscard]] std::vector<std::string> find_warnings() const;
  /// Of a body's size, and in rotation [-, rad].
  static constexpr double kLargest = 1e-3;
  /// Of the elastic energy of all bodies that are connected to it [-].
  static constexpr double kLargestFraction = 0.01;
  /// Smaller displacements have no fraction, of a body's size [-].
  static constexpr double kNegligible = 1e-6;

  /// Adds the energy that each joint may lose in vibration that no step
  /// resolves, by displacements up to kNegligible: ten times the largest that
  /// it had. @param losses of couplers [J]
  void add_negligible_energies(Eigen::Ref<VectorX> losses) const;

  /// The joint that was displaced most, if by more than kOverpowered; nothing
  /// if none was.
  [[nodiscard]] std::optional<std::string> find_overpowered() const;
  /// Of a body's size, and in rotation: larger than any displacement of a joint
  /// whose springs hold [-, rad].
  static constexpr double kOverpowered = 0.5;

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  struct Constraint {
    std::size_t coupler = 0;
    std::size_t body = 0;   // the smaller of those joined
    std::size_t group = 0;  // of the connected bodies, index of groups_
    double size = 0.0;      // [m]
    joints::ConstraintStiffness stiffness;
    double deflection = 0.0;       // d at its largest [m]
    double rotation = 0.0;         // theta at its largest [rad]
    double deflection_time = 0.0;  // [s]
    double rotation_time = 0.0;    // [s]
    double energy = 0.0;           // of the joint at its largest [J]
    double elastic = 0.0;          // of the connected bodies then [J]
    double energy_time = 0.0;      // [s]
    // The larger of both, relative to the body's size or in [rad].
    [[nodiscard]] double largest() const {
      return std::max(deflection / size, rotation);
    }
    // Of the elastic energy; none without any.
    [[nodiscard]] double fraction() const {
      return elastic > 0.0 ? energy / elastic : 0.0;
    }
  };
  double find_elastic(std::size_t group, const SystemState& state,
                      const SystemTerms& terms);
  [[nodiscard]] std::string describe(const Constraint& constraint) const;
  [[nodiscard]] std::string describe_fraction(
      const Constraint& constraint) const;
  /// @param soft at least one
  [[nodiscard]] std::string describe_fractions(
      std::vector<const Constraint*> soft) const;

  const SystemModel& model_;
  std::vector<std::vector<BodyIndex>> groups_;
  // Elastic energies of groups at one state, as far as they are needed [J].
  std::vector<std::optional<double>> elastic_;
  std::vector<Constraint> constraints_;
};

/// Warnings of DeflectionObserver at one state, such as an equilibrium.
[[nodiscard]] std::vector<std::string> find_constraint_warnings(
    const SystemModel& model, const SystemState& state);

}  // namespace limber::dynamics
