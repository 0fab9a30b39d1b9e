// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/results/history.hpp"
#include "limber/results/offset.hpp"
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

/// Changes all states of a run, by `change(state)`.
template <typename Change>
void change_states(History& history, const Change& change) {
  States changed;
  for (dynamics::SystemState state : history.states) {
    change(state);
    changed.push_back(std::move(state));
  }
  history.states = changed;
}

/// Moves all bodies of a run.
inline void move_bodies(History& history, const Vector3& by) {
  change_states(history, [&](dynamics::SystemState& state) {
    state = shift_bodies(std::move(state), -by);
  });
}

/// The same system before its first output.
[[nodiscard]] SmallRun make_empty_run();

}  // namespace limber::results::test
