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
/// @param share of peak force, impulse and duration by which they may differ
/// @param restitution by which its value may differ
inline void expect_same_impact(const nlohmann::json& run,
                               const nlohmann::json& reference, double share,
                               double restitution) {
  ASSERT_EQ(run["contacts"].size(), 1U);
  ASSERT_EQ(reference["contacts"].size(), 1U);
  const nlohmann::json& impact = run["contacts"][0];
  const nlohmann::json& expected = reference["contacts"][0];
  for (const char* key : {"peak_force", "impulse", "duration"}) {
    EXPECT_NEAR(impact[key].get<double>() / expected[key].get<double>(), 1.0,
                share)
        << key;
  }
  EXPECT_NEAR(impact["restitution"].get<double>(),
              expected["restitution"].get<double>(), restitution);
}

}  // namespace limber::test
