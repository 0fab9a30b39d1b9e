// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::bench {

/// One scene of the sweep: beams of a square section end to end on hinges,
/// free in space, that turn as one and are struck at one end by a half sine.
/// They are of aluminium, except for the density of every other one.
struct Cell {
  int bodies = 3;
  double length = 1.0;      ///< of each [m]
  double slenderness = 10;  ///< length over width [-]
  double mass_ratio = 1.0;  ///< of every other body to its neighbours [-]
  double stiffness = 1e8;   ///< of hinges: k [N/m], k length^2 [N m/rad]
  double damping = 0.01;    ///< ratio, of modes and of hinges [-]
  double spin = 1e-4;       ///< of the critical speed [-]
  double pulse = 0.0;       ///< its length; 0: that of a usual blow [s]
  double step = 1e-5;       ///< [s]
  double most_steps = 1e5;  ///< of the span
  dynamics::IntegratorKind integrator =
      dynamics::IntegratorKind::generalized_alpha;
};

/// Ten periods or so of a beam's first bending [s].
[[nodiscard]] double find_time_scale(const Cell& cell);
/// Ten periods or so, at least ten steps, at most as many as a minute has room
/// for [s].
[[nodiscard]] double find_span(const Cell& cell);
/// Every parameter with its unit.
[[nodiscard]] std::string describe(const Cell& cell);

/// What a beam is reduced from.
struct Shape {
  double length = 0.0;       ///< [m]
  double slenderness = 0.0;  ///< [-]
  double density = 0.0;      ///< [kg/m^3]

  // NOLINTNEXTLINE(modernize-use-nullptr)
  auto operator<=>(const Shape&) const = default;
};

/// Beams, each meshed by hexahedra and reduced once: four eigenmodes and the
/// static-deformation modes of both ends.
class Beams {
 public:
  using Body = std::shared_ptr<const flexbody::ReducedBody>;

  Beams();
  ~Beams();
  Beams(const Beams&) = delete;
  Beams& operator=(const Beams&) = delete;

  /// Reduces the bodies of the cell; an error is stored and thrown by find.
  void prepare(const Cell& cell);
  /// @throws InputError with the message of the reduction.
  [[nodiscard]] Body find(const Shape& shape) const;

 private:
  struct Answer {
    Body body;
    std::string refusal;
  };
  [[nodiscard]] Answer reduce(const Shape& shape) const;

  std::filesystem::path folder_;  // of meshes
  std::map<Shape, Answer> known_;
};

/// A cell as the library is given it.
struct Scene {
  dynamics::SystemModel model;
  dynamics::SystemState state;
  dynamics::SimulationSettings settings;
};

/// @throws InputError if the library refuses it.
[[nodiscard]] Scene make_scene(const Cell& cell, const Beams& beams);

}  // namespace limber::bench
