// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/system_builder.hpp"
#include "dynamics/system_state.hpp"
#include "joints/joint_kind.hpp"

namespace limber::testing {

struct ChainOptions {
  int bodies = 10;
  int modes = 6;
  double stiffness = 1e7;  ///< of the couplers [N/m] and [N m/rad]
  double damping = 0.0;    ///< [N s/m] and [N m s/rad]
  joints::JointKind joint = joints::JointKind::fixed;
  dynamics::Fidelity fidelity = dynamics::Fidelity::coupled;
  double lowest = 60.0;  ///< first modal frequency [rad/s]
};

/// A model of equal bodies joined end to end along z, and a state of rest in
/// which no coupler is strained.
struct Chain {
  dynamics::SystemBuilder builder;
  dynamics::SystemState state;
  std::vector<int> last_interfaces;  ///< attachment at each body's far end
};

Chain make_chain(const ChainOptions& options);

}  // namespace limber::testing
