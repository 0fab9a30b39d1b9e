// SPDX-License-Identifier: BSD-3-Clause
#include "maps.hpp"

#include <algorithm>
#include <cmath>

namespace limber::bench {
namespace {

using dynamics::IntegratorKind;

// Powers of ten, `stride` apart [decades].
std::vector<double> make_decades(double first, double last, double stride) {
  std::vector<double> values;
  const int count = static_cast<int>(std::lround((last - first) / stride));
  for (int i = 0; i <= count; ++i) {
    values.push_back(std::pow(10.0, first + i * stride));
  }
  return values;
}

// Longer chains take fewer steps.
void set_bodies(Cell& cell, double bodies) {
  cell.bodies = static_cast<int>(std::lround(bodies));
  cell.most_steps = std::min(1e5, 3e5 / bodies);
}

// Hinges as stiff beside a beam of any size.
void set_length(Cell& cell, double length) {
  cell.stiffness *= length / cell.length;
  cell.length = length;
}

Axis make_stiffness_axis(bool full) {
  return {"stiffness of hinges [N/m]", make_decades(2, 14, full ? 1 : 2),
          [](Cell& cell, double k) { cell.stiffness = k; }};
}

Axis make_step_axis(bool full) {
  return {"step [s]", make_decades(-6, -1, full ? 0.5 : 1),
          [](Cell& cell, double h) { cell.step = h; }};
}

std::vector<IntegratorKind> list_integrators() {
  std::vector<IntegratorKind> kinds;
  for (const std::string& name : dynamics::integrator_names()) {
    kinds.push_back(dynamics::parse_integrator(name));
  }
  return kinds;
}

}  // namespace

std::vector<Map> make_maps(bool full) {
  const Axis step = make_step_axis(full);
  const Axis stiffness = make_stiffness_axis(full);
  const std::vector<IntegratorKind> all = list_integrators();
  const std::vector<IntegratorKind> chosen =
      full ? all : std::vector{IntegratorKind::generalized_alpha};
  const auto set_spin = [](Cell& cell, double spin) { cell.spin = spin; };
  const auto set_damping = [](Cell& cell, double z) { cell.damping = z; };
  Cell still;
  still.spin = 0.0;
  Cell middle;
  middle.step = 1e-4;
  return {
      {"stiffness", "Stiffness of hinges and step", stiffness, step, all, {}},
      {"spin",
       "Spin and step",
       {"spin / critical speed [-]",
        full ? std::vector{0.0, 1e-3, 0.01, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 0.99,
                           1.01, 1.1, 1.5, 2.0, 3.0}
             : std::vector{0.0, 0.01, 0.1, 0.5, 0.9, 1.1, 2.0, 3.0},
        set_spin},
       step,
       chosen,
       {}},
      {"mass",
       "Masses of neighbours and stiffness, steps of 0.1 ms",
       {"mass ratio of neighbours [-]", make_decades(-6, 6, full ? 1 : 2),
        [](Cell& cell, double ratio) { cell.mass_ratio = ratio; }},
       stiffness,
       chosen,
       middle},
      {"size",
       "Size of bodies and step",
       {"length of each body [m]", make_decades(-3, 3, full ? 0.5 : 1),
        set_length},
       step,
       chosen,
       {}},
      {"damping",
       "Damping and step",
       {"damping ratio of modes and hinges [-]",
        full ? std::vector{0.0, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 1.0, 10.0, 100.0,
                           1e3, 1e4, 1e6}
             : std::vector{0.0, 1e-4, 0.01, 1.0, 100.0, 1e4},
        set_damping},
       step,
       chosen,
       {}},
      {"slenderness",
       "Slenderness and step",
       {"length / width [-]",
        full ? make_decades(0, 3, 0.25)
             : std::vector{1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0},
        [](Cell& cell, double s) { cell.slenderness = s; }},
       step,
       chosen,
       {}},
      {"bodies",
       "Number of bodies and step",
       {"bodies",
        full ? std::vector{1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 30.0, 50.0, 100.0,
                           200.0, 300.0, 500.0, 1000.0}
             : std::vector{1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0},
        set_bodies},
       step,
       chosen,
       {}},
      {"pulse",
       "Length of the pulse and step, without spin",
       {"pulse [s]", make_decades(-6, 1, full ? 0.5 : 1),
        [](Cell& cell, double length) { cell.pulse = length; }},
       step,
       chosen,
       still},
  };
}

Cell make_cell(const Map& map, dynamics::IntegratorKind integrator, double x,
               double y) {
  Cell cell = map.base;
  cell.integrator = integrator;
  map.x.set(cell, x);
  map.y.set(cell, y);
  return cell;
}

}  // namespace limber::bench
