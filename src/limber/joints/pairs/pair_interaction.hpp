// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "limber/common/evaluation_time.hpp"
#include "limber/common/records/manifest.hpp"
#include "limber/common/types.hpp"
#include "limber/joints/coordinates/discrete_gradient.hpp"

namespace limber::joints {

/// Motion of one of a pair's bodies; the world is at rest with B its own frame.
struct PairBody {
  Matrix3 R_WB = Matrix3::Identity();  ///< [-]
  Vector3 p_WB = Vector3::Zero();      ///< [m]
  Vector3 v_WB_W = Vector3::Zero();    ///< [m/s]
  Vector3 w_WB_B = Vector3::Zero();    ///< [rad/s]
  int modes = 0;                       ///< 0 if rigid, or the world
  const double* eta = nullptr;         ///< modal coordinates [kg^1/2 m]
  const double* etadot = nullptr;      ///< [kg^1/2 m/s]
};

/// Both bodies at one time.
struct PairBodies {
  const PairBody& A;
  const PairBody& B;
};

/// A material point of a body, or of what its modes carry along: at
/// x_B + Phi_B eta in the body frame.
struct PairPlace {
  Vector3 x_B = Vector3::Zero();          ///< undeformed [m]
  Matrix3X Phi_B = Matrix3X::Zero(3, 0);  ///< 3 x m [kg^-1/2]
};

/// From Bo, body frame [m].
[[nodiscard]] Vector3 find_arm(const PairBody& body, const PairPlace& place);
/// World frame [m].
[[nodiscard]] Vector3 find_position(const PairBody& body,
                                    const PairPlace& place);
/// World frame [m/s].
[[nodiscard]] Vector3 find_velocity(const PairBody& body,
                                    const PairPlace& place);

/// One point of an interaction: a force on B, the opposite force on A.
///
/// Equation   d force_W = -stiffness d(p_B - p_A) - damping d(v_B - v_A), p and
///            v of the material points, all in the world frame
/// Limits     places apart from each other with a force that is not along
///            their line give a net moment: a law keeps angular momentum if it
///            puts both into one position, or acts along the line.
struct PairPoint {
  PairPlace on_A;
  PairPlace on_B;
  Vector3 force_W = Vector3::Zero();    ///< on B [N]
  Matrix3 stiffness = Matrix3::Zero();  ///< any, also unsymmetric [N/m]
  Matrix3 damping = Matrix3::Zero();    ///< [N s/m]

  /// Of both places, body frames; set by the equations of motion, not by laws.
  struct Arms {
    Vector3 A = Vector3::Zero();  ///< [m]
    Vector3 B = Vector3::Zero();  ///< [m]
  };
  Arms acting;  ///< where the force acts
  Arms moving;  ///< where increments of a step's end move it
  /// v_B - v_A, set likewise [m/s].
  Vector3 velocity_W = Vector3::Zero();
};

/// Evaluation of one of the parts by which two bodies are in contact.
struct PairPart {
  std::size_t index = 0;         ///< of the part, by the law
  double elastic_energy = 0.0;   ///< [J]
  double friction_energy = 0.0;  ///< of its springs [J]
  PairBody A;                    ///< the part, as a body without modes
  PairBody B;                    ///< likewise
};

/// Contact points of one evaluation, up to the law's largest number, which may
/// differ from one evaluation to the next. Takes all its memory when it is
/// made.
class PairResponse {
 public:
  PairResponse() = default;
  /// @param is_coupled whether points may depend on each other: see coupling
  PairResponse(std::size_t most_points, int modes_A, int modes_B,
               bool is_coupled = false);

  /// No points, no parts, no energy, no coupling.
  void clear();
  /// A further point, all zero, its tables of modes sized for both bodies.
  /// @throws ContractError beyond the law's number of points.
  PairPoint& add();

  [[nodiscard]] std::span<PairPoint> points() { return {all_.data(), count_}; }
  [[nodiscard]] std::span<const PairPoint> points() const {
    return {all_.data(), count_};
  }

  /// How the force at point i follows the motion at another point j, both
  /// added already; zero until it is set.
  ///
  /// Equation   d force_W,i = -coupling(i, j) d(p_B - p_A)_j, besides
  ///            PairPoint's own
  /// @throws ContractError if the law's points are not coupled, or do not exist
  [[nodiscard]] Matrix3& coupling(std::size_t i, std::size_t j) {
    return coupling_[check_coupling(i, j)];
  }
  [[nodiscard]] const Matrix3& coupling(std::size_t i, std::size_t j) const {
    return coupling_[check_coupling(i, j)];
  }
  /// The same by velocities.
  ///
  /// Equation   d force_W,i = -damping_coupling(i, j) d(v_B - v_A)_j
  [[nodiscard]] Matrix3& damping_coupling(std::size_t i, std::size_t j) {
    return damping_coupling_[check_coupling(i, j)];
  }
  [[nodiscard]] const Matrix3& damping_coupling(std::size_t i,
                                                std::size_t j) const {
    return damping_coupling_[check_coupling(i, j)];
  }
  /// For steps that begin or end at this state.
  /// @throws ContractError beyond the law's number of points, and of points
  /// that are not coupled.
  void add_part(const PairPart& part);
  [[nodiscard]] std::span<const PairPart> parts() const {
    return {parts_.data(), part_count_};
  }
  /// Or null.
  [[nodiscard]] const PairPart* find_part(std::size_t index) const;
  [[nodiscard]] bool is_coupled() const { return !coupling_.empty(); }
  /// Sets all of it to zero.
  void uncouple();
  /// A diagonal bound of the stiffness at point i, of itself and of what
  /// couples it to others: sum_j |K_ij|, after Gershgorin [N/m].
  [[nodiscard]] Matrix3 find_stiffness_bound(std::size_t i) const;

  double energy = 0.0;       ///< stored [J]
  double dissipation = 0.0;  ///< power turned to heat, >= 0 [W]
  double rubbed = 0.0;       ///< the part of it by friction [W]
  /// Of friction, besides it: the mean since the last commit [W].
  double slip_power = 0.0;

 private:
  [[nodiscard]] std::size_t check_coupling(std::size_t i, std::size_t j) const;

  std::vector<PairPoint> all_;
  std::vector<Matrix3> coupling_;  // of all pairs of points
  std::vector<Matrix3> damping_coupling_;
  std::vector<PairPart> parts_;
  std::size_t count_ = 0;
  std::size_t part_count_ = 0;
};

/// A step: both ends, and between them the mean of positions and of modal
/// coordinates, the rotation halfway and the velocities that take one end to
/// the other.
struct PairStep {
  PairBodies begin;
  PairBodies middle;
  PairBodies end;
  StepTimes times;
  const PairResponse& at_begin;  ///< the law's, with the same memory
  const PairResponse& at_end;    ///< likewise
};

class Touching;

/// Forces between two bodies, or a body and the world, at points that appear
/// and disappear. Immutable; one virtual call a pair and evaluation.
///
/// Equation   d energy / dt + dissipation = -sum_i force_i . (v_B - v_A)_i
/// Limits     at level `full` eta are displacements of the nodes [m].
class PairInteraction {
 public:
  PairInteraction() = default;
  PairInteraction(const PairInteraction&) = delete;
  PairInteraction& operator=(const PairInteraction&) = delete;
  virtual ~PairInteraction() = default;

  /// Of the law, in lower case, such as "point springs".
  [[nodiscard]] virtual std::string_view kind() const = 0;
  /// Adds every parameter that forces depend on: a run does not resume with
  /// another.
  virtual void describe_parameters(Manifest& out) const = 0;

  /// Points at one time, at most.
  [[nodiscard]] virtual std::size_t most_points() const = 0;
  /// Whether the force at one point follows the motion at others.
  [[nodiscard]] virtual bool couples_points() const { return false; }
  /// Numbers that it remembers from step to step, zero at the start.
  [[nodiscard]] virtual std::size_t memory_size() const { return 0; }

  /// Whether it fits bodies of so many modes, 0 of rigid ones and the world.
  /// @throws InputError, without the pair's name, if it does not.
  virtual void check(int modes_A, int modes_B) const = 0;

  /// Fills `out`, which is clear.
  /// @param memory as the last accepted step left it
  /// @throws NumericalError, without the pair's name.
  virtual void evaluate(const PairBodies& bodies, const EvaluationTime& now,
                        std::span<const double> memory,
                        PairResponse& out) const = 0;

  /// The mean force over a step of the energy-conserving scheme, and the mean
  /// dissipation; `energy` is not read. Points act on the means of their
  /// positions at both ends.
  ///
  /// Equation   unless a law overrides it, the force at the middle: of second
  ///            order. To conserve the energy balance a law returns
  ///            sum_i force_i . (d_1 - d_0)_i = energy_0 - energy_1
  ///            - h dissipation, d = p_B - p_A
  virtual void evaluate_over_step(const PairStep& step,
                                  std::span<const double> memory,
                                  PairResponse& out) const;

  /// Changes the memory at the end of an accepted step; nowhere else.
  /// @param scratch of the law's size
  virtual void commit(const PairBodies& /*bodies*/, double /*t*/,
                      std::span<double> /*memory*/,
                      PairResponse& /*scratch*/) const {}

  /// Its interface for the beginning and end of contact; null: none.
  [[nodiscard]] virtual const Touching* touching() const { return nullptr; }
};

/// Its kind and parameters.
void describe(Manifest& out, std::string_view name, const PairInteraction& law);

}  // namespace limber::joints
