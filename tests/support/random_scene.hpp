// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/fidelity.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::testing {

/// A scene drawn at random, over the ranges of bench/extremes.
struct RandomScene {
  dynamics::SystemModel model;
  dynamics::SystemState state;
  dynamics::SimulationSettings settings;
};

/// What is drawn of a flexible body.
struct BodyDraw {
  int modes = 0;         ///< 1 to 8
  double mass = 0.0;     ///< [kg]
  double length = 0.0;   ///< [m]
  double lowest = 0.0;   ///< eigenfrequency [rad/s]
  unsigned variant = 0;  ///< of shapes, 0 to 6
};

/// Makes a free body with interfaces "near" and "far".
using BodyMaker = std::function<std::shared_ptr<const flexbody::ReducedBody>(
    const BodyDraw&)>;

struct RandomSceneOptions {
  BodyMaker make_body;  ///< by default point masses with made-up shapes
  std::optional<dynamics::Fidelity> level;  ///< of all flexible bodies; else
                                            ///< drawn
};

/// A tree of bodies, hinged, on springs or free, that rotate, are loaded and
/// reach stops. The same seed gives the same scene on every machine with the
/// same standard library.
RandomScene draw_scene(unsigned seed, const RandomSceneOptions& options = {});

}  // namespace limber::testing
