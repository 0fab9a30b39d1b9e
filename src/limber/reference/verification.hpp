// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/reference/simbody_reference.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::reference {

/// Magnitudes of differences, or of motions, over a run.
struct Magnitudes {
  double position = 0.0;          ///< of the centre of mass [m]
  double rotation = 0.0;          ///< angle [rad]
  double velocity = 0.0;          ///< [m/s]
  double angular_velocity = 0.0;  ///< [rad/s]
};

/// Differences between Limber and Simbody at the outputs of one run.
struct Agreement {
  std::vector<Magnitudes> bodies;  ///< largest differences, one per body
  Magnitudes largest;              ///< of all bodies
  double energy = 0.0;             ///< largest difference [J]
  double step = 0.0;               ///< our longest step [s]
};

struct Verification {
  std::vector<std::string> bodies;
  /// Extent of the motion in Simbody's run: largest displacement and rotation
  /// from the start, largest speeds, of all bodies.
  Magnitudes motion;
  /// Largest kinetic energy plus energy in couplers in Simbody's run [J].
  double energy = 0.0;
  std::vector<Agreement> runs;  ///< each with half the previous step
  long simbody_steps = 0;       ///< count
};

struct VerificationOptions {
  SimbodyOptions simbody;
  int refinements = 0;  ///< number of halvings of Limber's step, >= 0
};

/// Largest ratio of `difference` to `motion` over the four quantities [-];
/// ignores quantities without motion.
[[nodiscard]] double find_relative(const Magnitudes& difference,
                                   const Magnitudes& motion);

/// Compares states and energies at the same times.
[[nodiscard]] Agreement compare(
    const std::vector<Snapshot>& theirs,
    const std::vector<dynamics::SystemState>& states,
    const std::vector<dynamics::EnergyBalance>& energies);

/// Runs the scene with Simbody once and with Limber at the step of its
/// settings, half of it, and so on.
/// @throws InputError if a link is not at level `rigid`, or a joint is ideal
/// here but not in Simbody; NumericalError as both simulations do.
[[nodiscard]] Verification verify(const scene::Scene& scene,
                                  const scene::BuiltScene& built,
                                  const VerificationOptions& options,
                                  const Progress& progress = {});

struct StiffenedVerification {
  std::vector<Verification> results;  ///< one per factor, until Limber failed
  std::string ended;  ///< why the next factor failed; else empty
};

/// The same with joints `factors` times as stiff (stiffen_joints), one after
/// the other, against one Simbody run with ideal joints. Stops if Limber fails
/// for the third factor or a later one.
/// @throws InputError unless there are at least two factors, positive and
/// increasing, if joints other than ideal ones are requested, or if one is
/// ideal here; else as verify.
[[nodiscard]] StiffenedVerification verify_stiffened(
    const scene::Scene& scene, const scene::BuiltScene& built,
    const std::vector<double>& factors, const VerificationOptions& options,
    const Progress& progress = {});

}  // namespace limber::reference
