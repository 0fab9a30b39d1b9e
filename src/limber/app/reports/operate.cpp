// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/operate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "limber/app/options/reducer.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#ifdef LIMBER_HAS_REDUCTION
#include "limber/fem/mesh/node_weights.hpp"
#include "limber/fem/solid/stress_recovery.hpp"
#include "limber/flexbody/model/stress_modes.hpp"
#include "limber/reduction/matrices/reduce_matrices.hpp"
#include "limber/reduction/operating_states.hpp"
#endif

namespace limber::app {
namespace {

bool is_spin(OperatingKind kind) {
  return kind == OperatingKind::spinning || kind == OperatingKind::driven_spin;
}

void check(const OperatingRequest& request) {
  std::vector<std::string> problems;
  const std::string& kind =
      operating_kind_names()[static_cast<std::size_t>(request.kind)];
  const auto refuse = [&](bool wrong, const char* text) {
    if (wrong) problems.push_back(fmt::format("--state {}: {}", kind, text));
  };
  const bool has_friction =
      request.drag_rate != 0.0 || request.surface_drag != 0.0;
  const bool rubs = request.kind == OperatingKind::drifting ||
                    request.kind == OperatingKind::driven_spin;
  const bool is_free_spin = request.kind == OperatingKind::spinning;
  refuse(is_spin(request.kind) && request.axis.isZero(0.0),
         "needs --axis, the direction to spin about, other than 0");
  refuse(!is_spin(request.kind) && !request.axis.isZero(0.0),
         "--axis goes with spinning and driven-spin");
  refuse(!is_spin(request.kind) && !request.point.isZero(0.0),
         "--through goes with spinning and driven-spin");
  refuse(is_free_spin && request.speed == 0.0, "needs --speed, other than 0");
  refuse(!is_free_spin && request.speed != 0.0, "--speed goes with spinning");
  refuse(is_free_spin && !request.loads.empty(),
         "--load goes with driven-spin, where friction balances it");
  refuse(!rubs && has_friction,
         "--drag-rate and --surface-drag go with drifting and driven-spin");
  refuse(request.after && request.kind != OperatingKind::drifting,
         "--after goes with drifting");
  refuse(request.after && !(*request.after >= 0.0),
         "--after is a time of 0 or more");
  if (!problems.empty()) throw InputError(problems);
}

#ifdef LIMBER_HAS_REDUCTION

using flexbody::MeshedBody;
using flexbody::OperatingState;

Matrix3X spread_loads(const MeshedBody& body,
                      const std::vector<GroupLoad>& loads) {
  Matrix3X nodal = Matrix3X::Zero(3, body.mesh.x.cols());
  for (const GroupLoad& load : loads) {
    const fem::WeightedNodes nodes = fem::weigh_group(
        body.mesh, body.mesh.groups[fem::find_group(body.mesh, load.group)]);
    for (std::size_t i = 0; i < nodes.nodes.size(); ++i) {
      nodal.col(nodes.nodes[i]) +=
          nodes.weights[static_cast<Eigen::Index>(i)] * load.force;
    }
  }
  return nodal;
}

OperatingState solve(const MeshedBody& body, const OperatingRequest& request) {
  const Matrix3X load = spread_loads(body, request.loads);
  const flexbody::Friction friction{.mass_rate = request.drag_rate,
                                    .surface = request.surface_drag};
  const flexbody::SpinAxis axis{request.axis, request.point};
  switch (request.kind) {
    case OperatingKind::drifting:
      return request.after ? find_slow_change(body, load, friction)
                                 .at(*request.after, body)
                           : find_drifting_state(body, load, friction);
    case OperatingKind::spinning:
      return find_spinning_state(body, axis, request.speed);
    case OperatingKind::driven_spin:
      return find_driven_spin_state(body, axis, load, friction);
    case OperatingKind::accelerating:
      break;
  }
  return find_accelerating_state(body, load);
}

Json list(const Vector3& v) { return Json{v[0], v[1], v[2]}; }

Json describe_motion(const OperatingState& state) {
  Json motion = Json::object();
  const auto add = [&](const char* name, const Vector3& value) {
    if (!value.isZero(0.0)) motion[name] = list(value);
  };
  add("acceleration", state.acceleration);
  add("angular_acceleration", state.angular_acceleration);
  add("velocity", state.velocity);
  add("angular_velocity", state.angular_velocity);
  if (state.critical_speed) motion["critical_speed"] = *state.critical_speed;
  return motion;
}

Json describe_figures(const OperatingState& state) {
  const double largest = std::sqrt(state.u.colwise().squaredNorm().maxCoeff());
  return Json{{"deformation", largest},
              {"strain_energy", state.strain_energy},
              {"motion", describe_motion(state)},
              {"support_force", list(state.support_force)},
              {"support_moment", list(state.support_moment)},
              {"linear",
               {{"holds", state.trust.is_linear()},
                {"displacement", state.trust.displacement},
                {"strain", state.trust.strain},
                {"rotation", state.trust.rotation}}}};
}

// The largest von Mises stress of all nodes.
Json describe_largest(const fem::Mesh& mesh, const fem::NodalStress& nodal,
                      double strain_energy) {
  double largest = -1.0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < nodal.nodes.size(); ++i) {
    const double value = flexbody::calc_von_mises(
        nodal.stress.col(static_cast<Eigen::Index>(i)));
    if (value > largest) {
      largest = value;
      at = i;
    }
  }
  const double error =
      std::sqrt(std::max(0.0, nodal.averaging(0, 0)) / (2.0 * strain_energy));
  const auto node = static_cast<std::size_t>(nodal.nodes[at]);
  return Json{{"von_mises", largest},
              {"node", mesh.tags[node]},
              {"place", list(mesh.x.col(nodal.nodes[at]))},
              {"averaging_error", strain_energy > 0.0 ? error : 0.0}};
}

void add_stress(const MeshedBody& body, const flexbody::Recipe& recipe,
                const OperatingState& state, OperatingAnswer& answer) {
  const fem::NodalStress nodal =
      fem::recover_stress(body.mesh, find_materials(body.mesh, recipe),
                          MatrixX(state.u.reshaped()));
  for (const int node : nodal.nodes) {
    answer.stress_tags.push_back(
        body.mesh.tags[static_cast<std::size_t>(node)]);
  }
  answer.stress = nodal.stress;
  answer.figures["stress"] =
      describe_largest(body.mesh, nodal, state.strain_energy);
}

#endif

}  // namespace

const std::vector<std::string>& operating_kind_names() {
  static const std::vector<std::string> names = {"accelerating", "drifting",
                                                 "spinning", "driven-spin"};
  return names;
}

OperatingKind parse_operating_kind(const std::string& name) {
  return static_cast<OperatingKind>(
      find_name("state", name, operating_kind_names()));
}

#ifdef LIMBER_HAS_REDUCTION

OperatingAnswer find_operating_state(const flexbody::Recipe& recipe,
                                     const OperatingRequest& request,
                                     const Progress& progress) {
  check(request);
  if (flexbody::is_node_model(recipe.mesh))
    throw InputError(fmt::format(
        "{}: steady motion needs a body of solids, and its beams and shells "
        "are another kind. Expected solids.",
        recipe.mesh.file.string()));
  const MeshedBody body(recipe, progress);
  const OperatingState state = solve(body, request);
  OperatingAnswer answer;
  answer.figures = describe_figures(state);
  answer.notices = body.made->notices;
  answer.tags = body.mesh.tags;
  answer.surface.points = body.mesh.x;
  for (const std::array<int, 3>& t : fem::boundary_triangles(body.mesh)) {
    answer.surface.triangles.push_back({static_cast<std::size_t>(t[0]),
                                        static_cast<std::size_t>(t[1]),
                                        static_cast<std::size_t>(t[2])});
  }
  answer.u = state.u;
  answer.internal_force = state.internal_force;
  add_stress(body, recipe, state, answer);
  answer.size = body.mesh.size().maxCoeff();
  if (!state.trust.is_linear()) answer.trust = flexbody::describe(state.trust);
  return answer;
}

#else

OperatingAnswer find_operating_state(const flexbody::Recipe& recipe,
                                     const OperatingRequest& request,
                                     const Progress& progress) {
  check(request);
  (void)make_reducer(progress).make_mesh(recipe.mesh);  // throws
  return {};
}

#endif

}  // namespace limber::app
