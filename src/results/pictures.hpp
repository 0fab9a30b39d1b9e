// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/monitors/followed.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/results/history.hpp"

/// PNG pictures by gnuplot. Without gnuplot the results are complete except for
/// pictures. Each function returns an empty string, or why there is no picture
/// (such as what to install).
namespace limber::results {

/// One named curve over time.
struct Series {
  std::string name;
  std::vector<double> times;   ///< [s]
  std::vector<double> values;  ///< [unit of the panel's label]
  /// Marked and labelled; may lie between two times.
  std::optional<dynamics::Extreme> peak = {};
};

/// One panel: curves that share an axis.
struct Panel {
  std::string label;  ///< of the vertical axis, with its unit
  std::vector<Series> series;
};

/// A thin vertical line at a time, with a description of the event.
struct Mark {
  double time = 0.0;  ///< [s]
  std::string label;
};

/// Panels one above the other with a common time axis, each with all marks.
[[nodiscard]] std::string draw_overlay(const std::filesystem::path& file,
                                       const std::string& title,
                                       const std::vector<Panel>& panels,
                                       const std::vector<Mark>& marks = {});

/// Energies over time: stored energy by kind, work and dissipation.
[[nodiscard]] std::string draw_energy(const std::filesystem::path& file,
                                      const std::string& title,
                                      const History& history);

/// Points and the triangles between them.
struct Surface {
  Matrix3X points;                                    ///< 3 x n [m]
  std::vector<std::array<std::size_t, 3>> triangles;  ///< indices of points
};
/// What moves with the frame of a body, or stands in the world (kWorld).
struct BodySurface {
  dynamics::BodyIndex body;
  Surface surface;  ///< body frame, or the world's
};

/// The surfaces of all flexible bodies (and the frames of rigid ones) at the
/// given states. @param shapes of rigid bodies and the world, drawn in addition
[[nodiscard]] std::string draw_scene(
    const std::filesystem::path& file, const std::string& title,
    const dynamics::SystemModel& model,
    const std::vector<dynamics::SystemState>& states,
    const std::vector<BodySurface>& shapes = {});

/// The same for an equilibrium and the start; the displacement between them is
/// magnified by the factor `exaggeration` [-], for all bodies alike, so that
/// joints stay together.
[[nodiscard]] std::string draw_displacement(const std::filesystem::path& file,
                                            const std::string& title,
                                            const dynamics::SystemModel& model,
                                            const dynamics::SystemState& start,
                                            const dynamics::SystemState& state,
                                            double exaggeration);

/// One body, undeformed and with displacements u (3 x n [m]) magnified by
/// `exaggeration`.
[[nodiscard]] std::string draw_deformation(const std::filesystem::path& file,
                                           const std::string& title,
                                           const Surface& surface,
                                           const Matrix3X& u,
                                           double exaggeration);

}  // namespace limber::results
