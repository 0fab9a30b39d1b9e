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
#include "limber/results/band.hpp"
#include "limber/results/gnuplot.hpp"
#include "limber/results/history.hpp"
#include "limber/results/scenery.hpp"

/// PNG pictures: curves by gnuplot, without which they are missing, and scenes
/// by a rasteriser of our own (results/drawing/). Each function returns an
/// empty string, or why there is no picture (such as what to install).
namespace limber::results {

/// One named curve over time.
struct Series {
  std::string name;
  std::vector<double> times;   ///< [s]
  std::vector<double> values;  ///< [unit of the panel's label]
  /// Marked and labelled; may lie between two times.
  std::optional<dynamics::Extreme> peak = {};
  /// Drawn behind the curve, in its colour.
  std::optional<Band> band = {};
  /// Half the height of a pale band about the curve [as `values`].
  std::optional<double> error = {};
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

/// The script of panels one above the other with a common time axis, each with
/// all marks; draw_overlay() runs it.
[[nodiscard]] GnuplotScript write_overlay(const std::filesystem::path& file,
                                          const std::string& title,
                                          const std::vector<Panel>& panels,
                                          const std::vector<Mark>& marks = {});
[[nodiscard]] inline std::string draw_overlay(
    const std::filesystem::path& file, const std::string& title,
    const std::vector<Panel>& panels, const std::vector<Mark>& marks = {}) {
  return write_overlay(file, title, panels, marks).run();
}

/// That of energies over time: stored energy by kind, work and dissipation.
[[nodiscard]] GnuplotScript write_energy(const std::filesystem::path& file,
                                         const std::string& title,
                                         const History& history);
[[nodiscard]] inline std::string draw_energy(const std::filesystem::path& file,
                                             const std::string& title,
                                             const History& history) {
  return write_energy(file, title, history).run();
}

/// Points and the triangles between them.
struct Surface {
  Matrix3X points;                                    ///< 3 x n [m]
  std::vector<std::array<std::size_t, 3>> triangles;  ///< indices of points
};

/// The surfaces of all bodies at the start, at the output with the largest
/// deformation and at the end, from the side of the motion. A deformation that
/// could not be seen is magnified by the factor that the title states; rigid
/// motion is not, so that magnified links part at their joints.
/// @param scenery shapes of rigid bodies, which are their ellipsoid of inertia
/// without one
[[nodiscard]] std::string draw_scene(const std::filesystem::path& file,
                                     const std::string& title,
                                     const dynamics::SystemModel& model,
                                     const History& history,
                                     const Scenery& scenery);

/// The same for an equilibrium and the start; the displacement between them is
/// magnified by the factor `exaggeration` [-], for all bodies alike, so that
/// joints stay together.
[[nodiscard]] std::string draw_displacement(const std::filesystem::path& file,
                                            const std::string& title,
                                            const dynamics::SystemModel& model,
                                            const dynamics::SystemState& start,
                                            const dynamics::SystemState& state,
                                            double exaggeration,
                                            const Scenery& scenery);

/// One body, undeformed and with displacements u (3 x n [m]) magnified by
/// `exaggeration`.
[[nodiscard]] std::string draw_deformation(const std::filesystem::path& file,
                                           const std::string& title,
                                           const Surface& surface,
                                           const Matrix3X& u,
                                           double exaggeration);

}  // namespace limber::results
