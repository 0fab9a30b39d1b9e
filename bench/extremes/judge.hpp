// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cell.hpp"
#include "isolated.hpp"

namespace limber::bench {

/// A run that has converged, of a scene and a span.
struct Reference {
  /// Positions at the outputs; none if there is no such run.
  std::vector<dynamics::SystemState> states;
  double range = 0.0;  ///< farthest from its start [m]
  double error = 0.0;  ///< estimated, of `range` [-]
  std::string method;
  std::string trouble;  ///< why there is none

  [[nodiscard]] bool exists() const { return !states.empty(); }
};

/// Name of the reference of a cell: cells that differ in steps and integrators
/// only share it.
[[nodiscard]] std::string name_reference(const Cell& cell);

/// Runs it to a thousandth of the range, or with two short steps until they
/// agree as well. For a separate process; read_reference reads the result.
[[nodiscard]] std::string run_reference(const Cell& cell, const Beams& beams);
[[nodiscard]] Reference read_reference(const Ending& ending);

enum class Class {
  accurate,    ///< below 1 % of the range from the reference
  inaccurate,  ///< stable, or without a reference
  refused,     ///< with a message
  failed,      ///< not a number or garbage called a success, crash, hang
};
[[nodiscard]] const char* to_string(Class kind);

struct Verdict {
  Class kind = Class::failed;
  double error = -1.0;   ///< of the range [-]; < 0: not known
  std::string text;      ///< why, unless accurate
  double seconds = 0.0;  ///< wall time
};

/// For a separate process; read_verdict reads the result.
[[nodiscard]] std::string judge(const Cell& cell, const Beams& beams,
                                const Reference& reference);
[[nodiscard]] Verdict read_verdict(const Ending& ending);

}  // namespace limber::bench
