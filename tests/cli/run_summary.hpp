// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/shell.hpp"

namespace limber::test {

/// What a run's summary says, except for how long it took.
/// @param folder of the run's results
inline nlohmann::json read_summary(const std::filesystem::path& folder) {
  nlohmann::json summary =
      nlohmann::json::parse(read_text(folder / "summary.json"));
  for (const char* cost :
       {"seconds_offline", "seconds_online", "seconds_by_part",
        "bodies_reduced", "bodies_cached"}) {
    EXPECT_EQ(summary.erase(cost), 1U) << cost;
  }
  return summary;
}

}  // namespace limber::test
