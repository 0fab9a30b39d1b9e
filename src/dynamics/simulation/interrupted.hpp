// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/errors.hpp"

namespace limber::dynamics {

/// Thrown by a Progress that wants the run that it watches to end. The run then
/// keeps a checkpoint and passes it on, at once or within a second: after as
/// many steps as make one that goes on from there the same to the bit. Like a
/// run that cannot go on it leaves what was computed.
class Interrupted : public NumericalError {
 public:
  using NumericalError::NumericalError;
};

}  // namespace limber::dynamics
