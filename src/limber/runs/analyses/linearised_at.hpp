// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/dynamics/analysis/steady_motion.hpp"

/// Texts about the limits of a linearisation.
namespace limber::runs {

/// Texts for the reference state of a linearisation and for its result.
struct LinearisedAt {
  std::string where = "the start";  ///< "the start", "the state at 1 s"
  std::string result =
      "frequencies are";  ///< "frequencies are", "the model is"
};

/// Text on forces that are not balanced.
[[nodiscard]] std::string describe_imbalance(
    const dynamics::Imbalance& imbalance, bool is_moving,
    const LinearisedAt& at = {});

/// Text on coefficients that change while the system rotates by 1 rad.
/// @param change [-]
[[nodiscard]] std::string describe_change(double change,
                                          const LinearisedAt& at = {});

/// Changes beyond this are reported [-].
inline constexpr double kReportedChange = 1e-6;

}  // namespace limber::runs
