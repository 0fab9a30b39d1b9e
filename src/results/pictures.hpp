// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/followed.hpp"
#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"
#include "results/history.hpp"

/// Pictures for people who would rather look than read. Drawn as PNG by
/// gnuplot; without it the data are all there, and the answer says what to
/// install. Each function returns an empty string, or why there is no picture.
namespace limber::results {

/// One named line in time.
struct Series {
  std::string name;
  std::vector<double> times;  ///< [s]
  std::vector<double> values;
  /// Marked and labelled; it may be between two times.
  std::optional<dynamics::Extreme> peak = {};
};

/// One panel: lines that share an axis.
struct Panel {
  std::string label;  ///< of the vertical axis, with its unit
  std::vector<Series> series;
};

/// A thin vertical line at a time, with what happened then.
struct Mark {
  double time = 0.0;  ///< [s]
  std::string label;
};

/// Panels one above the other with a common time axis, each with all marks.
[[nodiscard]] std::string draw_overlay(const std::filesystem::path& file,
                                       const std::string& title,
                                       const std::vector<Panel>& panels,
                                       const std::vector<Mark>& marks = {});

/// Energies over time: what each part holds, work and dissipation.
[[nodiscard]] std::string draw_energy(const std::filesystem::path& file,
                                      const std::string& title,
                                      const History& history);

/// The surfaces of all flexible bodies (and the frames of rigid ones) at the
/// given states.
[[nodiscard]] std::string draw_scene(
    const std::filesystem::path& file, const std::string& title,
    const dynamics::SystemModel& model,
    const std::vector<dynamics::SystemState>& states);

/// The same of an equilibrium and the start from which it was found; the way
/// between them is drawn `exaggeration` times, so that joints stay together.
[[nodiscard]] std::string draw_displacement(const std::filesystem::path& file,
                                            const std::string& title,
                                            const dynamics::SystemModel& model,
                                            const dynamics::SystemState& start,
                                            const dynamics::SystemState& state,
                                            double exaggeration);

/// Points and the triangles between them.
struct Surface {
  Matrix3X points;  ///< 3 x n [m]
  std::vector<std::array<std::size_t, 3>> triangles;
};
/// One body, undeformed and with displacements u (3 x n [m]), drawn
/// `exaggeration` times.
[[nodiscard]] std::string draw_deformation(const std::filesystem::path& file,
                                           const std::string& title,
                                           const Surface& surface,
                                           const Matrix3X& u,
                                           double exaggeration);

}  // namespace limber::results
