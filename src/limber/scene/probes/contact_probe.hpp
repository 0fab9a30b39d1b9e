// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"
#include "limber/scene/contacts/touching_pairs.hpp"
#include "limber/scene/probes/probe_column.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// A probe of the contact between two bodies.
///
/// Equation   over all points of all pairs of their shapes: sums of forces,
///            areas and energies, the largest depth, and the place of the
///            largest normal force; the force on the second body is that on B
///            of a pair, or the opposite if `is_turned`
/// Limits     forces are those at a state; over a step, a scheme may use a
///            mean. Not thread-safe: copy it for each thread
struct ContactProbe {
  /// A pair of shapes.
  struct Part {
    dynamics::PairIndex pair;
    mutable joints::PairResponse scratch;  ///< for evaluations
  };
  ContactProbeSpec spec;
  bool is_turned = false;  ///< the first body is B of the pairs
  std::vector<Part> parts;
};

/// The two bodies of a contact probe.
struct ProbedContact {
  std::size_t touching = 0;  ///< index of the pair of bodies
  bool is_turned = false;    ///< the probe's first body is its B
};

/// @param touching the pairs of bodies that may touch
/// @param robot with the projectiles
/// @throws InputError for an unknown body, with the nearest name, the same body
/// twice, and bodies without a contact.
[[nodiscard]] ProbedContact check_contact_probe(
    const ContactProbeSpec& spec, const std::vector<TouchingPair>& touching,
    const Robot& robot, const Scenario& scenario);

/// @param pairs contacts of `model` between shapes of both bodies
[[nodiscard]] ContactProbe make_contact_probe(
    const ContactProbeSpec& spec, bool is_turned,
    const std::vector<dynamics::PairIndex>& pairs,
    const dynamics::SystemModel& model);

/// Name and unit of each column: "NAME.fx" [N], "NAME.depth" [m], ...
[[nodiscard]] std::vector<ProbeColumnName> column_names(
    const ContactProbe& probe, const std::string& name);

/// Appends the value of each column in `state`, in the units of column_names().
/// @throws NumericalError as the pairs' laws do.
void append_values(const ContactProbe& probe,
                   const dynamics::SystemModel& model,
                   const dynamics::SystemState& state,
                   std::vector<double>& values);

}  // namespace limber::scene
