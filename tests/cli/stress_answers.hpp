// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"

/// Probes of stress and what they answer.
namespace limber::test {

/// A probe on link `bar`.
inline std::string probe_text(const std::string& name,
                              const std::string& quantity,
                              const std::string& where) {
  return fmt::format(
      "[[probe]]\nname = '{}'\nlink = 'bar'\nquantity = '{}'\n{}\n", name,
      quantity, where);
}

/// The summary of a command with a cache and results in the workspace.
inline nlohmann::json answer(const Workspace& place,
                             const std::string& arguments) {
  const CommandResult r = place.limber(arguments + " --json --cache c --out o");
  EXPECT_EQ(r.status, 0) << r.errors;
  return nlohmann::json::parse(r.out, nullptr, false);
}

/// Of a column in equilibrium.
inline double value(const nlohmann::json& summary, const std::string& column) {
  return summary.at("probes").at(column).at("value").get<double>();
}

}  // namespace limber::test
