// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/errors.hpp"

namespace limber::dynamics {

/// Thrown by a Progress to end a run early. The run then saves a checkpoint,
/// within a second, at a step from which a resumed run is identical to the bit,
/// and throws the exception again. As for a run that fails, all results until
/// then remain.
class Interrupted : public NumericalError {
 public:
  using NumericalError::NumericalError;
};

}  // namespace limber::dynamics
