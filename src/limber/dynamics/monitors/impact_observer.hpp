// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/refined_peak.hpp"
#include "limber/dynamics/integrators/integrator_kind.hpp"
#include "limber/dynamics/monitors/contact_record.hpp"
#include "limber/dynamics/monitors/contact_start_observer.hpp"
#include "limber/dynamics/monitors/step_observer.hpp"

namespace limber::dynamics {

/// The impulse of a contact's normal force on B, and where it acts: its line
/// does not change if both bodies share a common velocity.
struct NormalImpulse {
  double sum = 0.0;                     ///< of the forces' sizes [N s]
  Vector3 impulse_W = Vector3::Zero();  ///< [N s]
  Vector3 arm_A_W = Vector3::Zero();    ///< from A, times the sizes [N s m]
  Vector3 arm_B_W = Vector3::Zero();    ///< likewise
};

constexpr auto fields_of(const NormalImpulse*) {
  return list_fields("normal impulse", "sum [N s]", "impulse [N s]",
                     "arm of A [N s m]", "arm of B [N s m]");
}

/// Of both bodies' rigid motions.
struct PairVelocities {
  Vector3 v_WB_W = Vector3::Zero();  ///< of B's origin against A's [m/s]
  Vector3 w_A_W = Vector3::Zero();   ///< [rad/s]
  Vector3 w_B_W = Vector3::Zero();   ///< [rad/s]
};

constexpr auto fields_of(const PairVelocities*) {
  return list_fields("velocities of a pair", "relative [m/s]", "A [rad/s]",
                     "B [rad/s]");
}

/// A contact of a pair, from its beginning to its end.
struct OngoingContact {
  bool is_touching = false;
  double left = 0.0;          ///< time of the last leave [s]
  RefinedPeak most_force;     ///< of this record, normal [N]
  RefinedPeak most_depth;     ///< of this record [m]
  ContactRecord record = {};  ///< of no touches: there is none
  NormalImpulse load;         ///< its rates, at the last state
  NormalImpulse impulse;      ///< of this record
  PairVelocities at_touch;    ///< when it began
  ImpactEnergy before;  ///< at the first touch, since the start of the run
  /// Errors in the steps of this record (EnergyObserver::PairStep) [J].
  double own_error = 0.0;
  double group_error = 0.0;
  /// Largest part of the stored energy, and when, that is in flexibility in
  /// series with the surfaces [-].
  double series_fraction = 0.0;
  double series_time = 0.0;  ///< [s]
};

constexpr auto fields_of(const OngoingContact*) {
  return list_fields("ongoing contact", "is touching", "left [s]",
                     "largest force [N]", "largest depth [m]", "record", "load",
                     "impulse", "velocities at touch", "energies before",
                     "own error [J]", "error of the group [J]",
                     "fraction in series", "its time [s]");
}

/// Records every impact from the ends of all accepted steps.
///
/// Equation   impulse by the trapezoidal rule; peaks of parabolas through three
///            steps' ends. A contact at rest approaches at no more than
///            max(|g| h, 1e-9 m/s), h the step of the run: bounces that end
///            within two steps
class ImpactObserver {
 public:
  /// @param h step of the run, 0 with a tolerance [s]
  ImpactObserver(const SystemModel& model, IntegratorKind scheme, double h);

  /// To be called at the start, and then after every accepted step.
  /// @param step_observer that includes the step @param flows sums since the
  /// start
  void include(const SystemState& state, ContactStartObserver& touches,
               const StepObserver& step_observer, const EnergyFlows& flows);

  /// In the order of time; contacts that have not ended last until the last
  /// state.
  [[nodiscard]] std::vector<ContactRecord> find_records() const;
  /// Warns of steps too long for their impacts, of bases too small for them
  /// (ImpactSpectrum), of joints too soft (JointResponse), of contacts deeper
  /// than kDeepest, of bases that leave out most of the deformation, of impacts
  /// whose energy does not balance, of touches of
  /// surfaces that do not face each other, and of the stable step of an
  /// explicit scheme where the force was largest.
  void add_warnings(std::vector<std::string>& warnings) const;
  /// Depth over the radius of curvature, or over the smaller body's extent
  /// (areas shared by corners of a mesh define no radius), that gives a
  /// warning: the area's radius is then 0.3 of it, while Hertz's paraboloid on
  /// a half space assumes that it is small [@johnson1985] [-].
  static constexpr double kDeepest = 0.1;
  /// Fraction of the stored energy in flexibility that the modes leave out that
  /// gives a warning: it is then three times as soft as the surfaces, and
  /// determines force and duration [-].
  static constexpr double kSoftest = 0.75;

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  void include(std::size_t index, const SystemState& state,
               ContactStartObserver& touches, double h);
  void begin(std::size_t index, const SystemState& state,
             ContactStartObserver& touches);
  void balance(std::size_t index, std::size_t pair, bool touched, double t,
               const StepObserver& step_observer, const EnergyFlows& flows);
  void keep_stiffest(const SystemState& state, const ContactRecord& record);
  void add_stable_step(std::vector<std::string>& warnings) const;
  void add_deep(const std::vector<ContactRecord>& records,
                std::vector<std::string>& warnings) const;
  void add_soft(std::vector<std::string>& warnings) const;
  void add_unbalanced(const std::vector<ContactRecord>& records,
                      std::vector<std::string>& warnings) const;
  void add_unmet(const std::vector<ContactRecord>& records,
                 std::vector<std::string>& warnings) const;
  [[nodiscard]] double find_extent(const std::string& pair) const;

  const SystemModel& model_;
  IntegratorKind scheme_;
  double rest_speed_;  // [m/s]
  // For explicit schemes, the state with the largest force.
  SystemState stiffest_;
  ContactRecord strongest_;
  std::vector<OngoingContact> pairs_;  // in the order of ContactStartObserver
  std::vector<ContactRecord> finished_;
  double time_ = 0.0;  // of the last state [s]
};

}  // namespace limber::dynamics
