// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "limber/common/pose.hpp"
#include "limber/dynamics/system/fidelity.hpp"
#include "limber/flexbody/model/full_body.hpp"
#include "limber/flexbody/model/node_selection.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/scene/probes/stress_probe.hpp"
#include "limber/scene/scenario/scenario.hpp"

/// Links that have stress, and the nodes at which it is requested.
namespace limber::scene {

/// Whether there is stress: at every level but rigid.
[[nodiscard]] bool has_stress(dynamics::Fidelity level);

/// For messages: why there is no stress at level rigid, and the remedy.
[[nodiscard]] std::string explain_no_stress();

/// Whether a probe or [output] requests the stress of this flexible link, at a
/// level that has it.
[[nodiscard]] bool wants_stress(const Scenario& scenario,
                                const std::string& link);

/// The same at a level that needs stress modes for it.
[[nodiscard]] bool needs_stress_modes(const Scenario& scenario,
                                      const std::string& link);

/// Removes probes of stress, and that of [output].
/// @returns whether there was any
bool leave_out_stress(Scenario& scenario);

/// @throws InputError saying how to make stress modes for a body without them,
/// or, at level nonlinear, without those of products
void require_stress(const flexbody::ReducedBody& body,
                    dynamics::Fidelity level);

/// The place of a requested stress.
struct StressPlace {
  std::string interface;                         ///< name, or empty
  std::optional<flexbody::NodeSelection> nodes;  ///< if it is not an interface
  SectionSelection section;                      ///< of a beam or shell
};

/// Makes a probe, without a place for the whole surface.
/// @param level nonlinear, or one with linear stress
/// @param X_BL link frame in the body's
/// @throws InputError for a body without stress modes, an unknown place, and
/// rows that lack part of the surface.
[[nodiscard]] StressProbe make_stress_probe(StressQuantity quantity,
                                            const flexbody::ReducedBody& body,
                                            dynamics::Fidelity level,
                                            const StressPlace& place,
                                            const Pose& X_BL);

/// The same at level `full`. @param body of the same mesh, with rows at all
/// nodes, and its interfaces
[[nodiscard]] StressProbe make_full_stress_probe(
    StressQuantity quantity, const flexbody::ReducedBody& body,
    const flexbody::FullBody& full, const StressPlace& place, const Pose& X_BL);

}  // namespace limber::scene
