// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/pose.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/results/history.hpp"
#include "limber/results/solids.hpp"

/// Data for pictures of a run in addition to its states, so that results.h5 can
/// be drawn without the scenario, the robot and the reduced bodies.
namespace limber::results {

/// Layout of the group `scene`.
inline constexpr int kSceneryVersion = 2;

/// A shape fixed to a body, or to the world.
struct SceneryShape {
  std::string name;  ///< of its link or obstacle
  dynamics::BodyIndex body = dynamics::kWorld;
  Pose X_BS;  ///< of the shape's frame
  SolidShape form;
};

struct SceneryRobot {
  std::string name;  ///< of several; empty: the only one
  std::string text;  ///< of its file
};

struct Scenery {
  std::string name;      ///< of the scenario
  std::string scenario;  ///< text of its file
  std::vector<SceneryRobot> robots;
  std::string settings;  ///< what changed the texts after reading, a line each
  std::vector<SceneryShape> shapes;
  std::vector<std::string> stressed;  ///< links whose stress was requested
};

/// Writes the group `scene`: texts, surfaces of flexible bodies with their
/// shapes, shapes of rigid ones, couplers, lines of tendons, loads over time
/// and contacts at outputs. docs/reference/files.md lists its datasets.
/// @throws InputError if it cannot be written.
void write_scenery(Hdf5File& out, const Scenery& scenery,
                   const dynamics::SystemModel& model, const History& history);

}  // namespace limber::results
