// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "dynamics/displacement_measure.hpp"
#include "dynamics/equations.hpp"
#include "dynamics/refined_peak.hpp"
#include "dynamics/system_state.hpp"
#include "flexbody/decision_boundary.hpp"

namespace limber::dynamics {

/// One instant in the plane of the decision boundary.
struct RotationPoint {
  double alpha = 0.0;  ///< [rad/s^2]
  double Omega = 0.0;  ///< [rad/s]
};

/// What one flexible body went through. Displacements are the largest ones
/// anywhere, DisplacementMeasure's, unless they say otherwise. All are
/// magnitudes, without a sign.
struct BodyPeaks {
  BodyIndex body = 0;
  Peak alpha;          ///< [rad/s^2]
  Peak Omega;          ///< [rad/s]
  Peak report;         ///< |alpha| + |Omega|^2 [1/s^2], [@morrison2023, eq. 31]
  Peak force;          ///< bound on nodal inertial forces [N]
  double angle = 0.0;  ///< turned, integral of |Omega| [rad]
  /// Largest size of each component of Omega, axes of the body [rad/s].
  Vector3 Omega_B = Vector3::Zero();
  Peak inertial;     ///< of inertial forces, static [m]
  Peak loads;        ///< of loads, couplers and gravity, static [m]
  Peak total;        ///< of all, with what oscillation adds [m]
  Peak deformation;  ///< of the body's own nodes, as `total` [m]
  /// Where rotation gets the body and what it carries beside where it would
  /// get them with the undeformed inertia [m].
  double turned_aside = 0.0;
  /// Amplitudes of oscillation at the modes' own frequencies, largest
  /// |etadot_k| / omega_k [kg^1/2 m].
  VectorX oscillation;
  VectorX modes;       ///< largest |eta_k|, as `total` [kg^1/2 m]
  VectorX mode_sizes;  ///< of the measure [kg^-1/2]
};

/// Watches a motion and tells, for each flexible body, what its modes would do
/// and what each level of fidelity would leave out. docs/theory/choosing.md.
///
/// Limits     Static answers, doubled where an oscillation is to be expected:
///            right for loads that grow from zero and stay or end, too small
///            near resonance. Peaks are those of a parabola where states
///            follow one another closely; displacements at most 0.1 % low.
class LevelSurvey {
 public:
  /// @param model every flexible body at Fidelity::uncoupled. Kept by
  /// reference.
  explicit LevelSurvey(const SystemModel& model);

  /// A state of a run of the same bodies, couplers and loads, in the order of
  /// time: of `source`, whose bodies may be at any level. What source's body
  /// knows of its own deformation is used in place of the static estimate.
  void include(const SystemModel& source, const SystemState& state);

  /// One entry a flexible body, in the model's order.
  [[nodiscard]] std::vector<BodyPeaks> find_peaks() const;
  /// The way through the plane, evenly thinned, one entry a flexible body.
  [[nodiscard]] std::vector<std::vector<RotationPoint>> tracks() const;

  /// What it knows between states.
  void exchange_memory(Archive& archive);

 private:
  struct Watch {
    Watch(const SystemModel& model, BodyIndex body,
          const std::vector<double>& reaches);
    BodyIndex body;
    Matrix3 J0_inverse;
    Matrix3 compliance = Matrix3::Zero();  ///< what resists slip, inverted
    Vector3 half_size = Vector3::Zero();   ///< of the bounding box [m]
    double reach = 0.0;                    ///< of what it carries [m]
    VectorX flexibility;                   ///< 1 / lambda
    VectorX omega;                         ///< sqrt(lambda) [rad/s]
    std::shared_ptr<const DisplacementMeasure> own;
    std::shared_ptr<const DisplacementMeasure> anywhere;
    flexbody::InertialForceBound force_bound;
    PeakDisplacement inertial;
    PeakDisplacement loads;
    PeakDisplacement total;
    PeakDisplacement deformation;
    bool is_observed = false;      ///< source computes its modes
    bool misses_inertial = false;  ///< but not the inertial forces on them
    RefinedPeak alpha;
    RefinedPeak Omega;
    RefinedPeak report;
    RefinedPeak force;
    bool has_begun = false;
    double last_time = 0.0;  ///< [s]
    double last_Omega = 0.0;
    VectorX last_eta;                     ///< static answer
    Vector3 last_slip = Vector3::Zero();  ///< J0^-1 (J1 eta) w [rad/s]
    Vector3 slipped = Vector3::Zero();    ///< its integral [rad]
    VectorX eta_inertial;                 ///< static answers, working memory
    VectorX eta_loads;
    VectorX eta;
    VectorX swings;
    BodyPeaks peaks;
    std::vector<RotationPoint> track;
  };
  static void exchange_memory(Archive& archive, Watch& watch);
  void include(const SystemState& state, Side side);
  void include_rotation(const SystemState& state, const BodyTerms& terms,
                        Watch& watch);
  static void add_oscillation(const Watch& watch, const VectorX& eta, double t,
                              VectorX& swings);
  void include_deformation(const SystemState& state, const BodyTerms& terms,
                           Watch& watch);
  static void include_slip(const BodyModel& body, const VectorX& eta,
                           const SystemState& state, Watch& watch);
  void thin_tracks();

  const SystemModel& model_;
  SystemTerms terms_;
  SystemState state_;
  std::vector<double> jumps_;  ///< times at which a load may jump [s]
  std::vector<Watch> watches_;
  long count_ = 0;
  long stride_ = 1;
};

}  // namespace limber::dynamics
