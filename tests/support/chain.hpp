// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/joints/joint_kind.hpp"

namespace limber::testing {

struct ChainOptions {
  int bodies = 10;
  int modes = 6;
  double stiffness = 1e7;  ///< of the couplers [N/m] and [N m/rad]
  double damping = 0.0;    ///< [N s/m] and [N m s/rad]
  joints::JointKind joint = joints::JointKind::fixed;
  dynamics::Fidelity fidelity = dynamics::Fidelity::coupled;
  double lowest = 60.0;  ///< first modal frequency [rad/s]
  dynamics::ModalDamping body_damping = {};
};

/// A model of equal bodies joined end to end along z, and a state of rest in
/// which no coupler is strained.
struct Chain {
  dynamics::SystemBuilder builder;
  dynamics::SystemState state;
  /// Attachment at each body's far end.
  std::vector<dynamics::AttachmentIndex> last_interfaces;
};

Chain make_chain(const ChainOptions& options);
/// The model alone, at level uncoupled.
dynamics::SystemModel make_uncoupled_chain(int bodies);

/// Three flexible bodies on hinges, under gravity and a load that rotates with
/// the last one.
/// @param stiffness, damping of the couplers, as in ChainOptions
Chain make_loaded_chain(double stiffness, double damping,
                        const dynamics::TimeFunction& load);

}  // namespace limber::testing
