// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/analysis/linear_system.hpp"
#include "limber/scene/probes/probe.hpp"

namespace limber::scene {

/// One column of a probe as a function of a linear system's states and inputs.
struct LinearOutput {
  dynamics::LinearSignal signal;
  Eigen::RowVectorXd by_state;  ///< [its unit / unit of the state]
  Eigen::RowVectorXd by_input;  ///< [its unit / unit of the input]
  std::string why_none;         ///< why it has no derivative there; else empty
};

/// Frames that outputs of point and coupler probes need, added to a copy of the
/// model as attachments.
struct ObservedModel {
  dynamics::SystemModel model;
  std::vector<dynamics::AttachmentIndex> frames;
  /// For each probe its first frame, the base before the point; -1: none.
  std::vector<int> first_frame;
};
[[nodiscard]] ObservedModel observe(const dynamics::SystemModel& model,
                                    const std::vector<Probe>& probes);

/// All columns of all probes, in order, except those of `[output] stress`.
///
/// Equation   derivatives of what point_probe.hpp, coupler_probe.hpp and
///            stress_probe.hpp state, by the motion of links and frames; of
///            efforts and wrenches by stiffness and damping of the laws, and by
///            the inputs
/// Limits     energies, powers and contact forces have none, nor does the
///            largest of several stresses
/// @param system linearised with `observed.frames`
[[nodiscard]] std::vector<LinearOutput> find_linear_outputs(
    const std::vector<Probe>& probes, const ObservedModel& observed,
    const dynamics::SystemState& state, const dynamics::LinearSystem& system);

}  // namespace limber::scene
