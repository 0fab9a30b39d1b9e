// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/simulation.hpp"
#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"

namespace limber::testing {

/// A scene drawn at random, over the ranges of bench/extremes.
struct RandomScene {
  dynamics::SystemModel model;
  dynamics::SystemState state;
  dynamics::SimulationSettings settings;
};

/// A tree of bodies, hinged, on springs or free, that turn, are pushed and meet
/// stops. The same seed draws the same one on every machine that has the same
/// standard library.
RandomScene draw_scene(unsigned seed);

}  // namespace limber::testing
