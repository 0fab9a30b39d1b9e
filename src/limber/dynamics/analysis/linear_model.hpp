// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::dynamics {

/// An input, output or state of a linear model.
struct LinearSignal {
  std::string name;
  std::string unit;
  double value = 0.0;  ///< at the reference, from which the model counts [unit]
};

/// A linear, time-invariant model of small deviations.
///
/// Equation   z' = A z + B du,   dy = C z + D du,   du = u - value of u, dy
///            likewise; z = 0 on the reference motion
struct LinearModel {
  MatrixX A;  ///< n x n [1/s]
  MatrixX B;  ///< n x inputs [unit of the state per second / input's]
  MatrixX C;  ///< outputs x n [output's / unit of the state]
  MatrixX D;  ///< outputs x inputs [output's / input's]
  std::vector<LinearSignal> states;  ///< n
  std::vector<LinearSignal> inputs;
  std::vector<LinearSignal> outputs;
};

}  // namespace limber::dynamics
