// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "limber/dynamics/analysis/axial_load.hpp"
#include "limber/dynamics/equations/displacement_measure.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/refined_peak.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/flexbody/modal/decision_boundary.hpp"

namespace limber::dynamics {

/// One time in the plane of the decision boundary.
struct RotationPoint {
  double alpha = 0.0;  ///< [rad/s^2]
  double Omega = 0.0;  ///< [rad/s]
};

/// A sudden load drives a mode to twice its static response [-].
inline constexpr double kSudden = 2.0;

/// Peaks of one flexible body's motion. Displacements are the largest anywhere
/// by DisplacementMeasure, unless stated otherwise. All are magnitudes.
struct BodyPeaks {
  BodyIndex body;
  Peak alpha;          ///< [rad/s^2]
  Peak Omega;          ///< [rad/s]
  Peak report;         ///< |alpha| + |Omega|^2 [1/s^2], [@morrison2023, eq. 31]
  Peak force;          ///< bound on nodal inertial forces [N]
  double angle = 0.0;  ///< integral of |Omega| [rad]
  /// Largest magnitude of each component of Omega, body frame [rad/s].
  Vector3 Omega_B = Vector3::Zero();
  Peak inertial;     ///< of inertial forces, static [m]
  Peak loads;        ///< of loads, couplers and gravity, static [m]
  Peak total;        ///< of all, including oscillation [m]
  Peak deformation;  ///< of the body's own nodes, as `total` [m]
  /// Displacement of the body and all it carries relative to the rotation with
  /// the undeformed inertia [m].
  double turned_aside = 0.0;
  /// Amplitudes of oscillation at the modes' own frequencies, largest
  /// |etadot_k| / omega_k [kg^1/2 m].
  VectorX oscillation;
  VectorX modes;       ///< largest |eta_k|, as `total` [kg^1/2 m]
  VectorX mode_sizes;  ///< of the measure [kg^-1/2]
  /// Axial load over that at which the body buckles (AxialLoad), its mean over
  /// 1 / frequency [-].
  Peak tension;
  Peak compression;
  /// From AxialLoad: whether a joint holds the body, and its lowest frequency.
  bool is_held = false;
  double frequency = 0.0;  ///< [rad/s]
  /// Integral of the fraction's magnitude [s].
  double axial_time = 0.0;
  Peak strain;               ///< magnitude of the mean along the body [-]
  double strain_time = 0.0;  ///< its integral [s]
  /// Amplitudes of axial oscillation for a suddenly applied force [kg^1/2
  /// m].
  VectorX stretch;
  /// Largest rotations of interfaces, relative to the body's mean axes and to
  /// one another [rad].
  Peak rotation;
  Peak relative_rotation;
};

/// Observes a motion and estimates, for each flexible body, the response of its
/// modes and what each level of fidelity would neglect.
/// docs/theory/choosing.md.
///
/// Limits     Static responses, doubled where an oscillation is expected:
///            valid for loads that grow from zero and stay or end, too small
///            near resonance. Peaks are refined by a parabola where states are
///            close in time; displacements are at most 0.1 % low.
class LevelObserver {
 public:
  /// @param model every flexible body at Fidelity::uncoupled. Stored by
  /// reference.
  /// @throws InputError naming a body whose elasticity couples its modes.
  explicit LevelObserver(const SystemModel& model);

  /// A state of a run of `source`, in order of time: the same bodies, couplers
  /// and loads, the bodies at any level. A deformation that source computes is
  /// used in place of the static estimate.
  void include(const SystemModel& source, const SystemState& state);

  /// One entry per flexible body, in the model's order.
  [[nodiscard]] std::vector<BodyPeaks> find_peaks() const;
  /// The trajectory in the plane, evenly thinned, one entry per flexible body.
  [[nodiscard]] std::vector<std::vector<RotationPoint>> tracks() const;

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  struct Observed {
    Observed(const SystemModel& model, BodyIndex body,
             const std::shared_ptr<const MovedNodes>& nodes,
             const std::vector<double>& reaches);
    BodyIndex body;
    Matrix3 J0_inverse;  ///< [1/(kg m^2)]
    /// Inverse of the inertia that resists slip [1/(kg m^2)].
    Matrix3 compliance = Matrix3::Zero();
    Vector3 half_size = Vector3::Zero();  ///< of the bounding box [m]
    double reach = 0.0;                   ///< of the bodies that it carries [m]
    VectorX flexibility;                  ///< 1 / lambda [s^2/rad^2]
    VectorX omega;                        ///< sqrt(lambda) [rad/s]
    std::shared_ptr<const DisplacementMeasure> own;
    std::shared_ptr<const DisplacementMeasure> anywhere;
    flexbody::InertialForceBound force_bound;
    PeakDisplacement inertial;
    PeakDisplacement loads;
    PeakDisplacement total;
    PeakDisplacement deformation;
    AxialLoad axial;
    std::vector<const Attachment*> interfaces;
    double last_fraction = 0.0;    ///< of the buckling load [-]
    double last_strain = 0.0;      ///< magnitude of the mean strain [-]
    bool is_observed = false;      ///< source computes its modes
    bool misses_inertial = false;  ///< but without inertial forces on them
    bool is_unreduced = false;     ///< source has its nodes and other forces
    RefinedPeak alpha;
    RefinedPeak Omega;
    RefinedPeak report;
    RefinedPeak force;
    bool has_begun = false;
    double last_time = 0.0;               ///< [s]
    double last_Omega = 0.0;              ///< [rad/s]
    VectorX last_eta;                     ///< static response [kg^1/2 m]
    Vector3 last_slip = Vector3::Zero();  ///< J0^-1 (J1 eta) w [rad/s]
    Vector3 slipped = Vector3::Zero();    ///< its integral [rad]
    // Static responses, workspace.
    VectorX eta_inertial;  ///< [kg^1/2 m]
    VectorX eta_loads;     ///< [kg^1/2 m]
    VectorX eta;           ///< [kg^1/2 m]
    VectorX swings;        ///< amplitudes of oscillation [kg^1/2 m]
    BodyPeaks peaks;
    std::vector<RotationPoint> track;
  };
  static void exchange_memory(Archive& archive, Observed& observed);
  void include(const SystemState& state, Side side);
  void include_rotation(const SystemState& state, const BodyTerms& terms,
                        Observed& observed);
  static void add_oscillation(const Observed& observed, const VectorX& eta,
                              double t, VectorX& swings);
  void include_deformation(const SystemState& state, const BodyTerms& terms,
                           Observed& observed);
  void include_axial_load(const SystemState& state, Side side,
                          Observed& observed) const;
  static void include_slip(const BodyModel& body, const VectorX& eta,
                           const SystemState& state, Observed& observed);
  void thin_tracks();

  const SystemModel& model_;
  SystemTerms terms_;
  SystemState state_;
  std::vector<double> jumps_;  ///< times at which a load may jump [s]
  std::vector<Observed> observed_;
  /// Whether contacts of the model have the memory of those of its source;
  /// found at the first state.
  std::optional<bool> shares_memory_;
  PairMemory no_memory_;  ///< of the model's contacts, all zero
  long count_ = 0;
  long stride_ = 1;
};

}  // namespace limber::dynamics
