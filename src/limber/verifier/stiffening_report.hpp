// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/reference/stiffening.hpp"
#include "limber/verifier/verification_report.hpp"

namespace limber::app {

/// Report of `limber verify --stiffen`.
struct StiffeningReport {
  VerificationReport common;    ///< its result is not used
  std::vector<double> factors;  ///< of the joints' stiffness [-]
  reference::StiffenedVerification study;
};

[[nodiscard]] Json to_json(const StiffeningReport& report);
/// A table of differences and orders by factor, each at the smallest step; then
/// text on where they decrease at first order, and the floor.
[[nodiscard]] std::string to_text(const StiffeningReport& report);
/// Differences over stiffness. @returns an empty string, or why there is none.
[[nodiscard]] std::string draw(const StiffeningReport& report,
                               const std::filesystem::path& file);

}  // namespace limber::app
