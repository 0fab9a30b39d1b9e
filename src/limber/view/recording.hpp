// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/common/types.hpp"
#include "limber/results/band.hpp"
#include "limber/results/solids.hpp"

/// The content of results.h5 for pictures, in memory.
namespace limber::view {

/// A surface of a body, with the shapes that move it.
struct Surface {
  std::string body;                   ///< reduced body
  std::string key;                    ///< its content key
  std::vector<std::int64_t> tags;     ///< n Gmsh node tags
  Matrix3X x_B;                       ///< 3 x n undeformed, from the c.m. [m]
  MatrixX Phi_B;                      ///< 3n x m [kg^-1/2]
  MatrixX Sigma_B;                    ///< 6n x m, or none: stress of the shapes
                                      ///< [kg^1/2 m^-2 s^-2]
  std::vector<std::int64_t> corners;  ///< three a triangle: nodes, outward
};

/// A body's motion; T output times.
struct Body {
  std::string name;
  std::string level;
  double mass = 0.0;                  ///< [kg]
  Matrix3 inertia = Matrix3::Zero();  ///< body frame [kg m^2]
  MatrixX p_WB;                       ///< T x 3 [m]
  MatrixX quat_WB;                    ///< T x 4, w x y z [-]
  MatrixX v_WB_W;                     ///< T x 3 [m/s]
  MatrixX w_WB_B;                     ///< T x 3 [rad/s]
  /// T x m, m of its surface's shapes: zero at level `rigid` [kg^1/2 m].
  MatrixX eta;
  MatrixX etadot;           ///< T x m; no columns where it was not recorded
                            ///< [kg^1/2 m/s]
  int surface = -1;         ///< index into Recording::surfaces; -1: rigid
  double truncation = 0.0;  ///< of shapes of level `full` [m]
  /// Stress of a body at level `full` or `nonlinear`, not linear in eta; or
  /// none.
  MatrixX Sigma_B;                 ///< 6n x r shapes at the surface's nodes [-]
  MatrixX zeta;                    ///< T x r, their coordinates [Pa]
  double stress_truncation = 0.0;  ///< von Mises stress left out [Pa]
};

/// A point of a body, or of the world.
struct Anchor {
  int body = -1;                  ///< index; -1: the world
  Vector3 p_B = Vector3::Zero();  ///< undeformed [m]
  MatrixX Phi_B;                  ///< 3 x m; may have no columns [kg^-1/2]
};

struct Shape {
  std::string name;  ///< link or obstacle
  int body = -1;     ///< index; -1: the world
  results::SolidShape form;
  Pose X_BS;  ///< of the shape's frame
};

/// A coupler (two points) or the line of a tendon (two or more).
struct Mark {
  std::string name;
  std::string kind;  ///< "bushing", "spring", "joint", "latch", "tendon"
  std::vector<Anchor> points;
};

struct Load {
  std::string name;
  bool in_world = false;
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 moment = Vector3::Zero();  ///< [N m]
  MatrixX course;                    ///< k x 2: time [s], factor [-]
  Anchor where;
};

struct Contact {
  std::string name;
  MatrixX touch;  ///< T x 6: place [m], force on the second body [N], world
  /// T x 10: half axes of its ellipse [m], friction on the second body [N],
  /// 1 where it slips, world. Empty: not in the file.
  MatrixX patch;
};

struct Event {
  double time = 0.0;  ///< [s]
  std::string source;
  std::string what;
};

/// The value of largest magnitude of all steps, signed.
struct Peak {
  double value = 0.0;  ///< [unit of the probe]
  double time = 0.0;   ///< [s]
};

struct Probe {
  std::string name;
  std::string unit;
  VectorX values;  ///< T [`unit`]
  std::optional<Peak> peak = {};
  /// Where it reaches beyond the values at outputs.
  std::optional<results::Band> band = {};
  std::optional<double> error = {};  ///< of the curve, if it was estimated
};

struct Recording {
  std::string name;          ///< of the scenario
  std::string limber;        ///< version that wrote it
  std::string folder;        ///< where it was read, for labels
  VectorX times;             ///< T [s]
  std::vector<Body> bodies;  ///< in the order of the system
  std::vector<Surface> surfaces;
  std::vector<Shape> shapes;
  std::vector<Mark> marks;
  std::vector<Load> loads;
  std::vector<Contact> contacts;
  std::vector<Event> events;
  std::vector<Probe> probes;
};

/// The file results.h5 of a folder, or the file itself.
/// @throws InputError if it does not exist.
[[nodiscard]] std::filesystem::path find_results(
    const std::filesystem::path& results);

/// @param results results.h5, or the folder that contains it
/// @throws InputError if it does not exist, is not Limber's, lacks data for
/// pictures, or is inconsistent; naming links whose surface was not kept, and
/// how to keep it.
[[nodiscard]] Recording read_recording(const std::filesystem::path& results);

/// Positions of a body's surface nodes at output `i`, from `offset` in axes of
/// the world [m], 3 x n.
///
/// Equation   p_WP - o = (p_WB - o) + R_WB (x_B + Phi_B eta)
[[nodiscard]] Matrix3X calc_positions(const Recording& recording, int body,
                                      Eigen::Index i, const Vector3& offset);

}  // namespace limber::view
