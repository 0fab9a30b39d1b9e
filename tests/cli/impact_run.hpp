// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"

namespace limber::test {

/// Summary of `limber run ARGUMENTS --out o --json`, which must succeed.
inline nlohmann::json run_for_summary(const Workspace& place,
                                      const std::string& arguments) {
  const CommandResult result =
      place.limber("run " + arguments + " --out o --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  return nlohmann::json::parse(result.out, nullptr, false);
}

/// Expects of two runs one impact each, the same.
/// @param fraction of peak force and impulse by which they may differ, and of
/// the duration, there and by `step`
/// @param restitution by which its value may differ
/// @param step of both runs, if a touch whose surfaces vibrate towards each
/// other as they part ends with a step, not within it [s]
inline void expect_same_impact(const nlohmann::json& run,
                               const nlohmann::json& reference, double fraction,
                               double restitution, double step = 0.0) {
  ASSERT_EQ(run["contacts"].size(), 1U);
  ASSERT_EQ(reference["contacts"].size(), 1U);
  const nlohmann::json& impact = run["contacts"][0];
  const nlohmann::json& expected = reference["contacts"][0];
  const auto compare = [&](const char* key, double more) {
    const double value = expected[key].get<double>();
    EXPECT_NEAR(impact[key].get<double>(), value, fraction * value + more)
        << key;
  };
  compare("peak_force", 0.0);
  compare("impulse", 0.0);
  compare("duration", step);
  // None where rigid motions do not describe the impact.
  EXPECT_EQ(impact["restitution"].is_null(), expected["restitution"].is_null());
  if (expected["restitution"].is_null()) return;
  EXPECT_NEAR(impact["restitution"].get<double>(),
              expected["restitution"].get<double>(), restitution);
}

}  // namespace limber::test
