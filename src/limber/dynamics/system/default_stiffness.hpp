// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>

#include "limber/common/restitution.hpp"
#include "limber/common/types.hpp"
#include "limber/joints/joint_kind.hpp"

namespace limber::dynamics {

/// Stiffness and damping of a joint; defaults follow from the bodies.
struct CouplerOptions {
  std::optional<double> translational_stiffness{};  ///< [N/m]
  std::optional<double> rotational_stiffness{};     ///< [N m/rad]
  std::optional<double> translational_damping{};    ///< [N s/m]
  std::optional<double> rotational_damping{};       ///< [N m s/rad]
  std::optional<double> free_damping{};             ///< [N s/m or N m s/rad]
  /// Whether constrained directions do not deflect; they then have neither
  /// stiffness nor damping. Default: false.
  std::optional<bool> is_ideal{};

  /// Whether a stiffness or damping of constrained directions is given.
  [[nodiscard]] bool is_elastic() const {
    return translational_stiffness || rotational_stiffness ||
           translational_damping || rotational_damping;
  }
};

/// One side of a coupler.
struct CouplerSide {
  double mass = std::numeric_limits<double>::infinity();  ///< [kg]
  /// Mean moment of inertia about the coupler's frame [kg m^2].
  double inertia = std::numeric_limits<double>::infinity();
  /// Flexibility of the interface, translation first [m/N, rad/(N m)]; none if
  /// rigid.
  std::optional<Matrix6> flexibility;
};

/// A side on a body that moves. @param inertia about its centre of mass
/// [kg m^2] @param p_BF from there to the coupler's frame [m]
[[nodiscard]] CouplerSide make_side(double mass, const Matrix3& inertia,
                                    const Vector3& p_BF);

/// Expected load of a coupler, and size of its bodies; zero: unknown.
struct CarriedLoad {
  double force = 0.0;                                     ///< [N]
  double moment = 0.0;                                    ///< [N m]
  double size = std::numeric_limits<double>::infinity();  ///< [m]
};

/// Stiffness relative to the stiffer side's interface, in the direction in
/// which that is stiffest [-].
inline constexpr double kStiffnessRatio = 200.0;
/// The same of an ideal joint where a stiff one replaces it [-].
inline constexpr double kIdealStiffnessRatio = 2e4;
/// Natural frequency of two rigid sides on their coupler [Hz].
inline constexpr double kRigidFrequency = 2e4;
/// The same where the frequency is bounded by an explicit scheme's step, and
/// the least where it is bounded by rounding [Hz].
inline constexpr double kLeastRigidFrequency = 1e3;
/// Allowed displacement of a coupler of two rigid sides under its load:
/// relative to the sides' size, and in rotation [-, rad].
inline constexpr double kRigidFraction = 1e-4;
/// Fraction of critical damping of the two masses on their coupler [-].
inline constexpr double kDampingRatio = 0.01;
/// The same of two rigid sides with the default stiffness, whose vibration no
/// step resolves: without numerical dissipation only this ends it [-].
inline constexpr double kRigidDampingRatio = 0.1;

/// Natural frequency of a free body on a stop [Hz]: contact lasts 10 ms, at any
/// speed.
inline constexpr double kStopFrequency = 0.5 / kImpactDuration;

/// Parameters of a coupler between two sides: those in `options`, and by
/// default
///   k = kStiffnessRatio / min over the flexible sides of c,
/// where c is the smallest principal flexibility of the interface (translation
/// or rotation): in every direction the coupler then adds at most 0.5 % to the
/// flexibility of the stiffer side. If both sides are rigid,
///   k = max(mu (2 pi f)^2, load / (kRigidFraction size)),
///   1/mu = 1/mu_F + 1/mu_M,
/// with mu the mass (or moment of inertia), f `rigid_frequency`, load the force
/// (or moment) carried and size that of the bodies (or 1 rad). The damping is
///   c = 2 zeta sqrt(k mu)
/// with zeta = kRigidDampingRatio for the latter k, else kDampingRatio.
/// A free direction has no damping unless it is given. The flexibility
/// is used at every fidelity, so that a change of level changes nothing else.
/// An ideal joint has no damping, and a k for analyses that make a stiff joint
/// of it, with kIdealStiffnessRatio in place of kStiffnessRatio.
/// @throws InputError for an ideal joint with a stiffness or damping.
[[nodiscard]] joints::JointParameters find_joint_parameters(
    const CouplerOptions& options, const CouplerSide& side_F,
    const CouplerSide& side_M, const CarriedLoad& load = {},
    double rigid_frequency = kRigidFrequency);

/// Frequency of rigid sides for find_joint_parameters() at a distance from the
/// world's origin [Hz]: kRigidFrequency near it. Positions are rounded to
/// 2^-52 of the distance, which the joint answers to with an acceleration of
/// (2 pi f)^2 times that: it stays below 1e-3 m/s^2 down to
/// kLeastRigidFrequency. @param distance [m]
[[nodiscard]] double find_rigid_frequency(double distance);

/// Default stiffness of an end stop.
struct StopStiffness {
  double translational = 0.0;  ///< [N/m]
  double rotational = 0.0;     ///< [N m/rad]
};

/// mu (2 pi kStopFrequency)^2 with mu the mass, or the moment of inertia, of
/// both sides as above. Softer than a joint's constraints, because of impacts.
[[nodiscard]] StopStiffness find_stop_stiffness(const CouplerSide& side_F,
                                                const CouplerSide& side_M);

}  // namespace limber::dynamics
