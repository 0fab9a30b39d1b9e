// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "limber/dynamics/simulation/simulator.hpp"
#include "limber/results/history.hpp"
#include "limber/runs/world_start.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::runs {

/// How a batch is stepped.
struct BatchOptions {
  /// Controllers of the scenario whose outputs the caller sets, in place of
  /// their laws; all by default.
  std::optional<std::vector<std::string>> inputs = {};
  /// Time between two control inputs [s]; by default that of these controllers.
  std::optional<double> period = {};
  std::size_t threads = 0;  ///< 0: as many as the machine runs at once
};

/// Many worlds of one scene, each a simulation of its own, that the caller
/// steps from one control input to the next. They share the model, and with it
/// the tables of its bodies.
///
/// A world moves as a run of its scene whose controllers write the same inputs
/// at the same times, to the bit, whatever other worlds and threads there are.
/// A world in which a computation cannot continue has failed: its observations
/// are NaN until it is reset; the others continue.
///
/// Limits     all modes are integrated, none solved in closed form; a tolerance
///            is met by one pass
class Batch {
 public:
  /// All worlds are at their start.
  /// @param worlds n > 0
  /// @throws InputError for no worlds, an unknown controller, controllers that
  /// differ in period or begin later than the run, a law with hidden memory,
  /// verified passes to a tolerance; as Simulator does.
  Batch(const scene::Scene& scene, scene::BuiltScene built, std::size_t worlds,
        const BatchOptions& options);
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;
  ~Batch();

  /// Number n of worlds.
  [[nodiscard]] std::size_t size() const;
  /// Names of the inputs, m.
  [[nodiscard]] const std::vector<std::string>& inputs() const;
  /// Of the observations, k.
  [[nodiscard]] const std::vector<results::ProbeColumn>& columns() const;
  [[nodiscard]] double period() const;  ///< between control inputs [s]
  [[nodiscard]] std::size_t threads() const;

  /// Puts worlds back to their start.
  /// @param selected n, nonzero: is put back
  /// @param starts n, or empty: as the scene starts
  /// @returns notices of bodies that overlap there
  /// @throws InputError for other sizes, as find_start() and Simulator do; all
  /// worlds are then unchanged.
  std::vector<std::string> reset(std::span<const unsigned char> selected,
                                 std::span<const WorldStart> starts = {});

  /// Advances worlds by control periods, the inputs constant (or linear, see
  /// dynamics::InputHold) in each; the last period ends with the scene. Failed
  /// worlds are left out.
  /// @param controls n x m by rows [units of the inputs]; a number that is not
  /// finite fails its world
  /// @param selected n, nonzero: is advanced
  /// @param stops called by this thread between steps; worlds that have not
  /// finished when it returns true have failed
  /// @returns whether it was not stopped
  /// @throws InputError for other sizes, no period, a world that is at its end;
  /// all worlds are then unchanged.
  bool step(std::span<const double> controls, long periods,
            std::span<const unsigned char> selected,
            const std::function<bool()>& stops = {});

  /// Values of the probes' columns, n x k by rows: those at the end of the last
  /// period, before inputs change; NaN where undefined, and of failed worlds.
  /// The storage stays where it is.
  [[nodiscard]] std::span<const double> observations() const;
  [[nodiscard]] std::span<const double> times() const;  ///< n [s]
  /// n, 1: failed, until it is reset.
  [[nodiscard]] std::span<const unsigned char> failed() const;
  /// n, 1: at the end of its scene.
  [[nodiscard]] std::span<const unsigned char> ended() const;
  /// Why a world failed; empty: it has not.
  [[nodiscard]] const std::string& failure(std::size_t world) const;
  /// A world's simulation. @throws std::out_of_range
  [[nodiscard]] const dynamics::Simulator& world(std::size_t world) const;
  /// Of building the scene, and of its first world's start.
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace limber::runs
