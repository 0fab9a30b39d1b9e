// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/common/errors.hpp"
#include "limber/common/evaluation_time.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

/// Contributions of couplers and transmissions to the equations of motion;
/// called by dynamics/equations.
namespace limber::dynamics {

/// Adds a force [N] and a moment [N m] at an attachment, world frame. Needs the
/// attachment's motion; ignored on the world.
void add_wrench(const SystemModel& model, AttachmentIndex attachment,
                const Vector3& force_W, const Vector3& moment_W,
                SystemTerms& terms);

/// Adds a coupler's wrench on M at Mo, expressed in F, and its reaction on F,
/// shifted from Mo to Fo. @param p_FM_F Mo from Fo [m]
void add_coupler_wrench(const SystemModel& model, const Coupler& coupler,
                        const Vector6& wrench_F, const Vector3& p_FM_F,
                        SystemTerms& terms);

/// @param t time [s]
/// @throws NumericalError with the coupler's name and the time before the text.
[[noreturn]] void throw_named(const std::string& name, double t,
                              const NumericalError& error);

/// Runs `work`; adds the coupler's name and the time t [s] to a NumericalError.
template <typename Work>
void name_coupler(const std::string& name, double t, const Work& work) {
  try {
    work();
  } catch (const NumericalError& error) {
    throw_named(name, t, error);
  }
}

/// Evaluates all couplers and transmissions at the attachments' motion and
/// adds their wrenches and powers.
/// @throws NumericalError naming the coupler and the time.
void apply_couplers(const SystemModel& model, const SystemState& state,
                    const EvaluationTime& now, WrenchSource source,
                    SystemTerms& terms);

}  // namespace limber::dynamics
