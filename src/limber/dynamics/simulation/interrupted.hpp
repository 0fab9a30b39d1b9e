// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/errors.hpp"

namespace limber::dynamics {

/// Thrown by a Progress to end a run early. The run then ends after the current
/// step, saves its last checkpoint, from which a resumed run is identical to
/// the bit to one that was not interrupted, and throws the exception again. As
/// for a run that fails, all results until then remain.
class Interrupted : public NumericalError {
 public:
  using NumericalError::NumericalError;
};

}  // namespace limber::dynamics
