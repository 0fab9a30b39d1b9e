// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/stress_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/scene/probes/section_points.hpp"

namespace limber::scene {
namespace {

using dynamics::Fidelity;
using flexbody::ReducedBody;

// All rows of the surface.
std::set<std::size_t> find_surface(const ReducedBody& body) {
  const flexbody::StressModes& modes = *body.stress;
  std::set<std::size_t> rows;
  for (std::size_t i = 0; i < modes.rows.size(); ++i) {
    if (modes.on_surface[i] != 0) rows.insert(modes.rows[i]);
  }
  if (rows.size() < body.mesh_boundary_nodes) {
    throw InputError(
        fmt::format("its body keeps {} of the {} nodes of its surface, and the "
                    "largest stress may be at the others; keep them by "
                    "rows=\"boundary\" (or 'limber reduce --rows boundary'), "
                    "or select the location by 'group', 'node', 'nearest', ...",
                    rows.size(), body.mesh_boundary_nodes));
  }
  return rows;
}

// Rows of selections that need no interface; else none.
std::set<std::size_t> select_rows(const ReducedBody& body,
                                  const StressPlace& place) {
  const auto select = [&](const auto& one) -> std::set<std::size_t> {
    using Selection = std::decay_t<decltype(one)>;
    if constexpr (std::is_same_v<Selection, flexbody::TaggedNode>) {
      return {find_row(body, one.tag)};
    } else if constexpr (std::is_same_v<Selection, flexbody::NearestNode>) {
      return {find_nearest_row(body, one.point)};
    } else if constexpr (std::is_same_v<Selection, flexbody::GroupNodes>) {
      for (const flexbody::NodeGroup& group : body.groups) {
        if (group.name != one.group) continue;
        std::set<std::size_t> rows;
        for (const std::size_t tag : group.tags) {
          rows.insert(find_row(body, tag));
        }
        return rows;
      }
    }
    return {};
  };
  if (!place.nodes) return {};
  return std::visit(select, *place.nodes);
}

std::set<std::size_t> find_rows(const ReducedBody& body,
                                StressQuantity quantity,
                                const StressPlace& place) {
  if (place.interface.empty()) {
    return body.stress->sections.exist() ? find_section_rows(body, quantity)
                                         : find_surface(body);
  }
  for (std::size_t i = 0; i < body.interfaces.size(); ++i) {
    if (body.interfaces[i].name != place.interface) continue;
    const auto& rows = body.stress->interface_rows[i];
    return {rows.begin(), rows.end()};
  }
  std::set<std::size_t> rows = select_rows(body, place);
  if (!rows.empty()) return rows;
  static_cast<void>(find_interface(body, place.interface));  // throws
  return {};
}

// Nodes of the whole mesh, which are the rows of the body.
std::set<std::size_t> find_full_rows(const ReducedBody& body,
                                     const flexbody::FullBody& full,
                                     const StressPlace& place) {
  std::set<std::size_t> rows;
  if (place.interface.empty()) {
    for (const auto& triangle : body.triangles) {
      rows.insert(triangle.begin(), triangle.end());
    }
    return rows;
  }
  for (const flexbody::NodeSet& set : full.interfaces) {
    if (set.name != place.interface) continue;
    return {set.nodes.begin(), set.nodes.end()};
  }
  rows = select_rows(body, place);
  if (rows.empty()) {
    static_cast<void>(find_node_set(full, place.interface));  // throws
  }
  return rows;
}

// Of the body's coordinates at a level.
Eigen::Index count_columns(const ReducedBody& body, Fidelity level) {
  Eigen::Index products = 0;
  if (level == Fidelity::nonlinear && body.manifold) {
    products = flexbody::count_pairs(std::ssize(body.manifold->paired));
  }
  return body.mode_count() + products;
}

Eigen::Index find_row_of(const flexbody::StressModes& modes,
                         Eigen::Index point) {
  return static_cast<Eigen::Index>(modes.rows[static_cast<std::size_t>(point)]);
}

// Of the node that a point belongs to.
Eigen::Index find_node_row(const flexbody::StressModes& modes,
                           Eigen::Index point) {
  if (!modes.sections.exist()) return find_row_of(modes, point);
  return static_cast<Eigen::Index>(
      modes.sections.nodes[static_cast<std::size_t>(point)]);
}

std::vector<Eigen::Index> select_points(const flexbody::StressModes& modes,
                                        const std::set<std::size_t>& rows) {
  std::vector<Eigen::Index> points;
  for (std::size_t i = 0; i < modes.rows.size(); ++i) {
    if (rows.count(modes.rows[i]) > 0) {
      points.push_back(static_cast<Eigen::Index>(i));
    }
  }
  return points;
}

bool has_own_axes(StressQuantity quantity, const SectionSelection& section) {
  return section.axes != StressAxes::link || is_index(quantity);
}

void require_material_axes(const flexbody::StressModes& modes) {
  if (modes.axes.cols() > 0) return;
  throw InputError(
      "axes = 'material' needs a material whose elasticity depends on "
      "direction; its solids are isotropic, or its body was saved without "
      "their axes, in which case reduce it again");
}

/// Those of materials with axes of their own, of which each node has one.
std::vector<Eigen::Index> select_with_axes(
    const flexbody::ReducedBody& body,
    const std::vector<Eigen::Index>& points) {
  const flexbody::StressModes& modes = *body.stress;
  require_material_axes(modes);
  std::vector<Eigen::Index> with_axes;
  std::set<Eigen::Index> covered;
  for (const Eigen::Index point : points)
    if (!modes.axes.col(point).isZero(0.0)) {
      with_axes.push_back(point);
      covered.insert(find_row_of(modes, point));
    }
  for (const Eigen::Index point : points)
    if (const Eigen::Index row = find_row_of(modes, point);
        !covered.contains(row))
      throw InputError(fmt::format(
          "axes = 'material': the material at node {} is isotropic and has no "
          "axes. Expected nodes of materials whose elasticity depends on "
          "direction (nearest, or a group of them)",
          body.rows.tags[index(row)]));
  return with_axes;
}

}  // namespace

bool has_stress(Fidelity level) { return level != Fidelity::rigid; }

std::string explain_no_stress() {
  return "it is rigid in this run, and a rigid link has no stress; choose "
         "another level";
}

bool needs_stress_modes(const Scenario& scenario, const std::string& link) {
  return scenario.level_of(link) != Fidelity::full &&
         wants_stress(scenario, link);
}

bool wants_stress(const Scenario& scenario, const std::string& link) {
  if (!has_stress(scenario.level_of(link))) return false;
  if (scenario.output.stress) return true;
  return std::any_of(scenario.probes.begin(), scenario.probes.end(),
                     [&](const ProbeSpec& probe) {
                       const auto* of = std::get_if<StressProbeSpec>(&probe.of);
                       return of != nullptr && of->where.link == link;
                     });
}

bool leave_out_stress(Scenario& scenario) {
  const bool is_of_links = std::exchange(scenario.output.stress, false);
  const auto count = std::erase_if(scenario.probes, [](const ProbeSpec& probe) {
    return std::holds_alternative<StressProbeSpec>(probe.of);
  });
  return is_of_links || count > 0;
}

void require_stress(const ReducedBody& body, Fidelity level) {
  if (!body.stress) {
    throw InputError(
        "stress is requested, but its saved body has no stress modes; reduce "
        "it again by 'limber reduce --stress'");
  }
  if (body.stress->Sigma_B.cols() >= count_columns(body, level)) return;
  throw InputError(
      "stress is requested at level nonlinear, but its saved body has only "
      "that of linear modes; reduce it again by 'limber reduce --second-order "
      "--stress'");
}

StressProbe make_stress_probe(StressQuantity quantity, const ReducedBody& body,
                              Fidelity level, const StressPlace& place,
                              const Pose& X_BL) {
  require_stress(body, level);
  const flexbody::StressModes& modes = *body.stress;
  const flexbody::SectionModes& sections = modes.sections;
  if (!sections.exist()) refuse_sections(quantity, place.section);
  const std::set<std::size_t> rows = find_rows(body, quantity, place);
  if (quantity == StressQuantity::section_force) {
    return make_section_force_probe(body, rows, place.section, X_BL);
  }
  std::vector<Eigen::Index> points =
      sections.exist()
          ? select_section_points(body, rows, quantity, place.section)
          : select_points(modes, rows);
  if (!sections.exist() && place.section.axes == StressAxes::material)
    points = select_with_axes(body, points);
  const bool has_axes = has_own_axes(quantity, place.section);
  if (has_axes) require_material_axes(modes);
  const auto count = static_cast<Eigen::Index>(points.size());
  const Pose X_LB = X_BL.inverse();
  Matrix3X p_L(3, count);
  MatrixX Sigma_L(6 * count, count_columns(body, level));
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index point = points[static_cast<std::size_t>(i)];
    const Eigen::Index row = find_row_of(modes, point);
    p_L.col(i) = X_LB * Vector3(body.rows.x_B.col(row));
    for (Eigen::Index k = 0; k < Sigma_L.cols(); ++k) {
      Sigma_L.block<6, 1>(6 * i, k) = flexbody::rotate_stress(
          modes.Sigma_B.block<6, 1>(6 * point, k),
          has_axes ? Matrix3(modes.axes.col(point).reshaped(3, 3)) : X_BL.R);
    }
  }
  StressProbe probe;
  probe.quantity = quantity;
  probe.clusters = StressClusters(p_L, Sigma_L);
  const std::vector<int>& order = probe.clusters.order();
  probe.p_L = p_L(Eigen::all, order);
  probe.Sigma_L.resize(Sigma_L.rows(), Sigma_L.cols());
  probe.has_own_axes = has_axes;
  if (is_index(quantity)) probe.strengths.resize(6, count);
  for (std::size_t i = 0; i < order.size(); ++i) {
    probe.Sigma_L.middleRows<6>(6 * static_cast<Eigen::Index>(i)) =
        Sigma_L.middleRows<6>(6 * Eigen::Index{order[i]});
    const Eigen::Index point = points[index(order[i])];
    const Eigen::Index row = find_node_row(modes, point);
    if (sections.exist()) {
      probe.layers.push_back(
          name_section_point(sections, static_cast<std::size_t>(point)));
    }
    if (is_index(quantity)) {
      probe.strengths.col(static_cast<Eigen::Index>(i)) =
          sections.strengths.col(point);
    }
    probe.tags.push_back(body.rows.tags[static_cast<std::size_t>(row)]);
  }
  return probe;
}

StressProbe make_full_stress_probe(StressQuantity quantity,
                                   const ReducedBody& body,
                                   const flexbody::FullBody& full,
                                   const StressPlace& place, const Pose& X_BL) {
  LIMBER_EXPECT(std::ssize(body.rows.tags) == full.node_count());
  const std::set<std::size_t> rows = find_full_rows(body, full, place);
  StressProbe probe;
  probe.quantity = quantity;
  probe.R_BL = X_BL.R;
  refuse_sections(quantity, place.section);
  if (place.section.axes == StressAxes::material) {
    throw InputError(
        "axes = 'material' is not available at level full, whose stress is in "
        "the link's axes; use another level");
  }
  probe.full = make_full_stress(full, {rows.begin(), rows.end()});
  LIMBER_EXPECT(probe.full != nullptr);
  const std::vector<int>& nodes = probe.full->nodes();
  const Pose X_LB = X_BL.inverse();
  probe.p_L.resize(3, std::ssize(nodes));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    probe.tags.push_back(body.rows.tags[index(nodes[i])]);
    probe.p_L.col(static_cast<Eigen::Index>(i)) =
        X_LB * Vector3(body.rows.x_B.col(nodes[i]));
  }
  return probe;
}

}  // namespace limber::scene
