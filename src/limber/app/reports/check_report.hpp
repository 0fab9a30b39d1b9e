// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/common/types.hpp"
#include "limber/dynamics/integrators/simulation_settings.hpp"
#include "limber/dynamics/system/fidelity.hpp"

namespace limber::app {

struct BodyCheck {
  std::string name;
  dynamics::Fidelity level = dynamics::Fidelity::rigid;
  double mass = 0.0;  ///< [kg]
  int modes = 0;      ///< number that move in the run
  /// Lowest and highest natural frequency of its modes alone [Hz].
  std::optional<std::pair<double, double>> frequencies;
};

struct JointCheck {
  std::string name;         ///< of a coupler or transmission
  double fastest_hz = 0.0;  ///< dynamics::find_coupler_frequencies [Hz]
};

/// Two bodies that may be in contact, at the start.
struct ContactCheck {
  std::string pair;
  double gap = 0.0;  ///< negative where they overlap [m]
};

struct ControllerCheck {
  std::string name;
  double period = 0.0;  ///< of its samples, at each of which a step ends [s]
};

/// Wall time of a run, predicted from its first steps.
struct Pace {
  long steps = 0;        ///< measured
  double time = 0.0;     ///< simulated in them [s]
  double seconds = 0.0;  ///< wall time of them [s]
  std::string failure;   ///< why they ended early; empty: they did not
  std::optional<double> run_seconds;  ///< wall time of all steps of the run [s]
  /// Fraction of the motion that a coarse pass covered, if there was one [-].
  std::optional<double> scouted;
  bool is_verified = false;  ///< by several passes, mostly three
};

/// Cost of a run.
struct CostCheck {
  Pace pace;
  std::size_t memory_bytes = 0;  ///< largest use of this process until now
  std::size_t file_bytes = 0;    ///< of results.h5
};

/// Properties of a scene that are known before it is run.
struct SceneCheck {
  std::string scenario;                   ///< its file
  dynamics::SimulationSettings settings;  ///< as given, or chosen
  double start = 0.0;                     ///< [s]
  bool is_tolerance_chosen = false;
  double mass = 0.0;  ///< of all bodies [kg]
  std::vector<BodyCheck> bodies;
  std::vector<JointCheck> joints;  ///< none at level `full`
  /// Natural frequencies of the whole system about its start, ascending; none
  /// at level `full`, nor of more than kMostUnknowns [Hz].
  VectorX frequencies;
  /// Longest step at which an explicit scheme is stable [s].
  std::optional<double> stable_step;
  std::vector<ContactCheck> contacts;
  std::vector<ControllerCheck> controllers;
  std::vector<std::string> silent;    ///< parts without effect
  std::vector<std::string> problems;  ///< that end the run
  std::vector<std::string> warnings;
  std::vector<std::string> choices;  ///< defaults, and why
  CostCheck cost;

  /// Steps in a period from which motion counts as resolved.
  static constexpr double kStepsAPeriod = 10.0;
  /// Of the dense eigenvalues, which take the cube of their number.
  static constexpr Eigen::Index kMostUnknowns = 1500;

  /// Highest frequency that the step resolves [Hz].
  [[nodiscard]] double resolved_hz() const {
    return 1.0 / (kStepsAPeriod * settings.step);
  }
};

[[nodiscard]] Json to_json(const SceneCheck& check);
/// At most one screen: of many bodies, joints and contacts the most important
/// ones.
[[nodiscard]] std::string to_text(const SceneCheck& check);

}  // namespace limber::app
