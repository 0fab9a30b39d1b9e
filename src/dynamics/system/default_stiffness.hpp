// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>

#include "common/types.hpp"
#include "joints/joint_kind.hpp"
#include "scene/robot.hpp"

namespace limber::scene {

/// One side of a coupler.
struct CouplerSide {
  double mass = std::numeric_limits<double>::infinity();  ///< [kg]
  /// Mean moment of inertia about the coupler's frame [kg m^2].
  double inertia = std::numeric_limits<double>::infinity();
  /// Flexibility of the interface, translation first; none if rigid.
  std::optional<Matrix6> flexibility;
};

/// What a coupler may have to carry, of bodies of this size; zero: not known.
struct CarriedLoad {
  double force = 0.0;                                     ///< [N]
  double moment = 0.0;                                    ///< [N m]
  double size = std::numeric_limits<double>::infinity();  ///< [m]
};

/// Stiffness over that of the stiffer side's own interface [-].
inline constexpr double kStiffnessRatio = 100.0;
/// Frequency at which two rigid sides would swing on their coupler [Hz].
inline constexpr double kRigidFrequency = 1000.0;
/// What a coupler of two rigid sides may give way by under what it carries:
/// of the sides' size, and in rotation [-, rad].
inline constexpr double kRigidShare = 1e-4;
/// Share of critical damping of the two masses on their coupler [-].
inline constexpr double kDampingRatio = 0.01;

/// Frequency at which a free body would swing on a stop [Hz]: it touches for
/// 10 ms, at any speed.
inline constexpr double kStopFrequency = 50.0;

/// Parameters of a coupler between two sides: what `options` gives, and for
/// the rest
///   k = kStiffnessRatio / min over the flexible sides of c,
/// where c is the largest principal flexibility of the interface (translation
/// or rotation): the coupler then adds at most 1 % to the flexibility of the
/// stiffer side. If both sides are rigid,
///   k = max(mu (2 pi kRigidFrequency)^2, load / (kRigidShare size)),
///   1/mu = 1/mu_F + 1/mu_M,
/// with mu the mass (or moment of inertia), load the force (or moment) that it
/// carries and size that of the bodies (or 1 rad). The damping is
///   c = 2 kDampingRatio sqrt(k mu).
/// A free direction has no damping unless the URDF gives one. The flexibility
/// counts at every fidelity, so that a change of level changes nothing else.
[[nodiscard]] joints::JointParameters find_joint_parameters(
    const CouplerOptions& options, const CouplerSide& side_F,
    const CouplerSide& side_M, const CarriedLoad& load = {});

/// Of an end stop whose file gives none.
struct StopStiffness {
  double translational = 0.0;  ///< [N/m]
  double rotational = 0.0;     ///< [N m/rad]
};

/// mu (2 pi kStopFrequency)^2 with mu the mass, or the moment of inertia, of
/// both sides as above. A stop is softer than what holds a joint: it is hit.
[[nodiscard]] StopStiffness find_stop_stiffness(const CouplerSide& side_F,
                                                const CouplerSide& side_M);

}  // namespace limber::scene
