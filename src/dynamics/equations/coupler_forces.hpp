// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/errors.hpp"
#include "common/instant.hpp"
#include "dynamics/workspace.hpp"

/// What couplers and transmissions put into the equations of motion; called by
/// dynamics/equations.
namespace limber::dynamics {

/// Adds a force [N] and a moment [N m] at an attachment, world axes. Needs the
/// attachment's motion; does nothing to the world.
void add_wrench(const SystemModel& model, AttachmentIndex attachment,
                const Vector3& force_W, const Vector3& moment_W,
                SystemTerms& terms);

/// @throws NumericalError with the coupler's name and the time before the text.
[[noreturn]] void throw_named(const std::string& name, double t,
                              const NumericalError& error);

/// Runs `work`; a NumericalError is told with the coupler's name and the time.
template <typename Work>
void name_coupler(const std::string& name, double t, const Work& work) {
  try {
    work();
  } catch (const NumericalError& error) {
    throw_named(name, t, error);
  }
}

/// Evaluates all couplers and transmissions at the attachments' motion and
/// adds what they exert and their powers.
/// @throws NumericalError naming the coupler and the time.
void apply_couplers(const SystemModel& model, const SystemState& state,
                    const Instant& now, WrenchSource source,
                    SystemTerms& terms);

}  // namespace limber::dynamics
