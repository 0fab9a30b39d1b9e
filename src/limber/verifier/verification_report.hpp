// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/app/console/json.hpp"
#include "limber/reference/verification.hpp"

namespace limber::app {

/// Report of `limber verify`.
struct VerificationReport {
  std::string scenario;
  dynamics::IntegratorKind integrator =
      dynamics::IntegratorKind::generalized_alpha;
  double tolerance = 0.0;  ///< of our steps [m]; 0: fixed ones
  reference::VerificationOptions options;
  reference::Verification result;
};

[[nodiscard]] Json to_json(const VerificationReport& report);
/// Programs and settings of both runs, two lines and an empty one.
[[nodiscard]] std::string describe_runs(const VerificationReport& report);
/// Tables: differences body by body at the smallest step; and, if the step was
/// halved, the relative difference and its order at each.
[[nodiscard]] std::string to_text(const VerificationReport& report);

}  // namespace limber::app
