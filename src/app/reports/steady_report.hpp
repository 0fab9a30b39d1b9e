// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/dynamics/analysis/steady_motion.hpp"

/// What limits a linearisation, in words.
namespace limber::app {

/// Where the system is linearised, and what the linearisation gives.
struct LinearisedAt {
  std::string where = "the start";  ///< "the start", "the state at 1 s"
  std::string result =
      "frequencies are";  ///< "frequencies are", "the model is"
};

/// Of forces that are not balanced.
[[nodiscard]] std::string describe_imbalance(
    const dynamics::Imbalance& imbalance, bool is_moving,
    const LinearisedAt& at = {});

/// Of coefficients that change by a fraction while the system rotates by 1 rad.
/// @param change [-]
[[nodiscard]] std::string describe_change(double change,
                                          const LinearisedAt& at = {});

/// Changes beyond this are told [-].
inline constexpr double kTellChange = 1e-6;

}  // namespace limber::app
