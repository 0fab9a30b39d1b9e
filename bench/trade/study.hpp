// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limber/app/run/run_scene.hpp"
#include "limber/results/motion_error.hpp"

/// One scene, simulated in many ways, each held against a reference.
namespace limber::bench::trade {

using dynamics::Fidelity;
using dynamics::IntegratorKind;

/// How to simulate a scene. Unset values are those of the scenario.
struct Choice {
  std::string name;                    ///< in tables
  std::string label = {};              ///< in pictures; empty: as in tables
  Fidelity level = Fidelity::coupled;  ///< of every flexible link
  /// Of single links, over `level`.
  std::map<std::string, Fidelity> links = {};
  scene::BasisChoice basis = {};
  IntegratorKind integrator = IntegratorKind::generalized_alpha;
  double step = 0.0;  ///< 0: the scenario's [s]
  flexbody::FullOptions full = {};
  bool exact_modes = true;
  int repeats = 0;  ///< of which the fastest counts; 0: until they last 0.2 s
  /// What else is changed, of the scene or of its bases.
  std::function<void(scene::Scene&)> change = {};
};

/// One run, its cost and its error relative to the reference.
struct Outcome {
  Choice choice;
  runs::Run run;
  double online = 0.0;  ///< wall time per simulated time, the least found [-]
  /// The same with the displacements of all nodes at all outputs [-].
  double with_nodes = 0.0;
  double offline = 0.0;  ///< wall time of the reductions [s]
  std::optional<results::SystemMotionError> error;  ///< if it was completed
  std::optional<double> drift;                      ///< of energy [-]
  std::string stopped;  ///< why it ended early, or empty

  [[nodiscard]] double displacement() const {
    return error->error.displacement.relative().value_or(0.0);
  }
  [[nodiscard]] double deformation() const {
    return error->error.deformation.relative().value_or(0.0);
  }
};

/// Simulates `choice`. Without a reference, it has no errors.
class Study {
 public:
  /// @param scene file below bench/trade/scenes
  /// @param cache folder of reduced bodies
  Study(const std::string& scene, std::filesystem::path cache);

  /// @returns the outcome, stored in outcomes(), and its index
  const Outcome& add_reference(const Choice& choice);
  const Outcome& add(const Choice& choice);
  [[nodiscard]] const Outcome& reference() const { return *outcomes_.front(); }
  /// Without the reference.
  [[nodiscard]] std::vector<const Outcome*> list() const;
  [[nodiscard]] const Outcome& find(const std::string& name) const;
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::filesystem::path& cache() const { return cache_; }

  /// Without keeping it.
  [[nodiscard]] Outcome simulate(const Choice& choice) const;

 private:
  std::filesystem::path file_;
  std::filesystem::path cache_;
  std::vector<std::unique_ptr<Outcome>> outcomes_;
};

/// Deformation of body `b` at all outputs, body axes, 3n x T [m].
[[nodiscard]] MatrixX find_deformation(const Outcome& outcome, int b = 0);
/// Displacement likewise, world axes, from where the reference's frame starts.
[[nodiscard]] MatrixX find_displacement(const Outcome& outcome, int b = 0);
/// Largest distance of any node of body `b` between two runs [m].
[[nodiscard]] double find_largest_distance(const Outcome& one,
                                           const Outcome& other, int b);

}  // namespace limber::bench::trade
