// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::testing {

/// A scene drawn at random, over the ranges of bench/extremes.
struct RandomScene {
  dynamics::SystemModel model;
  dynamics::SystemState state;
  dynamics::SimulationSettings settings;
};

/// A tree of bodies, hinged, on springs or free, that rotate, are loaded and
/// reach stops. The same seed gives the same scene on every machine with the
/// same standard library.
RandomScene draw_scene(unsigned seed);

}  // namespace limber::testing
