// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/results/history.hpp"
#include "support/point_mass_body.hpp"

namespace limber::results::test {

/// Names of the bodies of a small run, in the model's order.
struct BodyNames {
  std::string arm = "arm";
  std::string hand = "hand";
  std::string plate = "plate";
  std::string ball = "ball";
};

/// A short run of a falling, tumbling, damped chain: two flexible bodies, one
/// that has a mesh but is computed as rigid, and one that has no mesh.
struct SmallRun {
  std::vector<testing::PointMassBody> points;  ///< arm, hand, plate
  dynamics::SystemModel model;
  History history;
};

inline constexpr int kOutputs = 5;

[[nodiscard]] SmallRun make_small_run(const BodyNames& names = {});

/// The same system before its first output.
[[nodiscard]] SmallRun make_empty_run();

}  // namespace limber::results::test
