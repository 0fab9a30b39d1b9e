// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/progress.hpp"
#include "dynamics/energy.hpp"
#include "reference/witness.hpp"
#include "scene/scene.hpp"

namespace limber::reference {

/// Magnitudes of differences, or of motions, over a run.
struct Magnitudes {
  double position = 0.0;          ///< of the centre of mass [m]
  double rotation = 0.0;          ///< angle [rad]
  double velocity = 0.0;          ///< [m/s]
  double angular_velocity = 0.0;  ///< [rad/s]
};

/// Ours against the witness at the outputs of one run.
struct Agreement {
  std::vector<Magnitudes> bodies;  ///< largest differences, one a body
  Magnitudes largest;              ///< of all bodies
  double energy = 0.0;             ///< largest difference [J]
  double step = 0.0;               ///< our longest step [s]
};

struct Verification {
  std::vector<std::string> bodies;
  /// How much moves, in the witness's run: largest displacement and rotation
  /// from the start, largest speeds, of all bodies.
  Magnitudes motion;
  /// Largest kinetic energy plus energy in couplers in the witness's run [J].
  double energy = 0.0;
  std::vector<Agreement> runs;  ///< each with half the step of the one before
  long witness_steps = 0;
};

struct VerificationOptions {
  WitnessOptions witness;
  int refinements = 0;  ///< how often our step is halved, >= 0
};

/// Largest share of `difference` in `motion` over the four quantities [-];
/// what does not move is left out.
[[nodiscard]] double find_relative(const Magnitudes& difference,
                                   const Magnitudes& motion);

/// Compares states and energies at the same times.
[[nodiscard]] Agreement compare(
    const std::vector<Snapshot>& witness,
    const std::vector<dynamics::SystemState>& states,
    const std::vector<dynamics::EnergyBalance>& energies);

/// Runs the scene with the witness once and with us at its settings' step, a
/// half of it, and so on.
/// @throws InputError if a link is not at level `rigid`; NumericalError as
/// both simulations do.
[[nodiscard]] Verification verify(const scene::Scene& scene,
                                  const scene::BuiltScene& built,
                                  const VerificationOptions& options,
                                  const Progress& progress = {});

struct StiffenedVerification {
  std::vector<Verification> results;  ///< one a factor, as far as ours got
  std::string ended;  ///< why there is none for the next factor; else empty
};

/// The same with joints `factors` times as stiff (stiffen_joints), one after
/// the other, against the witness's ideal joints, which it simulates once.
/// Where ours fails for the third factor or a later one, that is the end.
/// @throws InputError if the factors are not two or more, positive and
/// increasing, or other joints than ideal ones are asked for; else as verify.
[[nodiscard]] StiffenedVerification verify_stiffened(
    const scene::Scene& scene, const scene::BuiltScene& built,
    const std::vector<double>& factors, const VerificationOptions& options,
    const Progress& progress = {});

}  // namespace limber::reference
