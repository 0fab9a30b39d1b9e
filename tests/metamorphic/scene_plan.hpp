// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/fidelity.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/system/time_function.hpp"
#include "limber/joints/coupler_law.hpp"

/// Metamorphic tests: random scenes run twice, once changed in a way that
/// cannot matter to their motion. Strikes of two bodies have plans of their own
/// (contact_plan.hpp).
namespace limber::metamorphic {

/// How a plan becomes a system: what cannot be changed once a body or a law is
/// made.
struct Manner {
  double length = 1.0;  ///< the unit of length in which it is built: 1 / [m]
  double delay = 0.0;   ///< added to all times of commands and loads [s]
  bool is_mirrored = false;  ///< y reversed, in the world and in every body
};

/// The reflection of a mirrored manner, y reversed; else the identity.
[[nodiscard]] Matrix3 find_reflection(const Manner& manner);

/// Distance of a half's centre from that of the whole, of its length [-].
inline constexpr double kHalfArm = 0.1;

struct BodyPlan {
  std::string name;
  dynamics::Fidelity level = dynamics::Fidelity::rigid;
  int modes = 0;         ///< 0: made as a rigid body
  double mass = 0.0;     ///< [kg]
  double length = 0.0;   ///< [m]
  double lowest = 0.0;   ///< eigenfrequency [rad/s]
  double damping = 0.0;  ///< ratio of all modes [-]
  unsigned variant = 0;  ///< of shapes
  /// Of a rigid body: -1 and 1 are the halves of a whole of twice the mass,
  /// with their centres `kHalfArm` lengths below and above its own along z.
  int half = 0;
  Pose X_WB = {};
  Vector3 v_WB_W = Vector3::Zero();  ///< [m/s]
  Vector3 w_WB_B = Vector3::Zero();  ///< [rad/s]
  VectorX eta = {};                  ///< [kg^1/2 m]
  VectorX etadot = {};               ///< [kg^1/2 m/s]
};

struct FramePlan {
  int body = -1;          ///< index; -1: the world
  std::string interface;  ///< of a flexible body, whose place counts then
  Pose X = {};            ///< X_BF, in the world X_WF
};

template <typename Law>
using MakeLaw = std::function<Law(const Manner&)>;

struct CouplerPlan {
  std::string name;
  MakeLaw<joints::CouplerLaw> law;
  FramePlan F;
  FramePlan M;
  bool is_hinge = false;         ///< with one angle
  bool has_mirror_image = true;  ///< of its law
  bool is_symmetric = false;     ///< whether F and M may change places
};

struct PathPlan {
  std::string name;
  std::vector<FramePlan> points;
  MakeLaw<joints::ScalarLaw> law;
};

struct GearPlan {
  std::string name;
  std::vector<std::string> joints;
  std::vector<double> factors;  ///< [-]
  MakeLaw<joints::ScalarLaw> law;
};

struct LoadPlan {
  std::string name;
  FramePlan where;
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 moment = Vector3::Zero();  ///< [N m]
  dynamics::LoadFrame frame = dynamics::LoadFrame::body;
  std::function<dynamics::TimeFunction(double delay)> function;
};

/// Brakes a body's spin about an axis by samples of it.
struct ControllerPlan {
  std::string name;
  FramePlan where;
  Vector3 axis = Vector3::UnitZ();  ///< unit, body frame [-]
  double gain = 0.0;                ///< per mass and length^2 [1/s]
  double period = 0.0;              ///< [s]
  dynamics::InputHold hold = dynamics::InputHold::held;
};

/// A scene as data, in metres.
struct ScenePlan {
  std::vector<BodyPlan> bodies;
  std::vector<CouplerPlan> couplers;
  std::vector<PathPlan> paths;
  std::vector<GearPlan> gears;
  std::vector<LoadPlan> loads;
  std::vector<ControllerPlan> controllers;
  std::vector<FramePlan> probes;
  Vector3 gravity_W = Vector3::Zero();  ///< [m/s^2]
  /// Of a run that starts at 0.
  dynamics::SimulationSettings settings;
  Manner manner;
};

struct Scene {
  dynamics::SystemModel model;
  dynamics::SystemState state;
  dynamics::SimulationSettings settings;
};

/// @throws InputError as SystemBuilder does.
[[nodiscard]] Scene build(const ScenePlan& plan);

/// Whether anything in the world holds the bodies.
[[nodiscard]] bool is_held(const ScenePlan& plan);

/// Calls `change` with all frames of couplers, paths, loads, controllers and
/// probes.
template <typename Change>
void for_each_frame(ScenePlan& plan, const Change& change) {
  for (CouplerPlan& c : plan.couplers) {
    change(c.F);
    change(c.M);
  }
  for (PathPlan& p : plan.paths) {
    for (FramePlan& f : p.points) change(f);
  }
  for (LoadPlan& l : plan.loads) change(l.where);
  for (ControllerPlan& c : plan.controllers) change(c.where);
  for (FramePlan& f : plan.probes) change(f);
}

}  // namespace limber::metamorphic
