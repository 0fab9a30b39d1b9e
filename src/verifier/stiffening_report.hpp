// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef LIMBER_HAS_REFERENCE

#include <filesystem>
#include <string>
#include <vector>

#include "app/json.hpp"
#include "app/verification_report.hpp"
#include "reference/stiffening.hpp"

namespace limber::app {

/// What `limber verify --stiffen` tells.
struct StiffeningReport {
  VerificationReport common;    ///< its result is not used
  std::vector<double> factors;  ///< of the joints' stiffness [-]
  reference::StiffenedVerification study;
};

[[nodiscard]] Json to_json(const StiffeningReport& report);
/// A table of differences and orders by factor, each at the smallest step; then
/// in words where they fall at first order, and the floor.
[[nodiscard]] std::string to_text(const StiffeningReport& report);
/// Differences over stiffness. @returns an empty string, or why there is none.
[[nodiscard]] std::string draw(const StiffeningReport& report,
                               const std::filesystem::path& file);

}  // namespace limber::app

#endif
