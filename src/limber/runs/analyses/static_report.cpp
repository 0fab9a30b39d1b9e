// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/analyses/static_report.hpp"

#include <cmath>

#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/node_motion.hpp"

namespace limber::runs {
namespace {

using dynamics::BodyIndex;
using dynamics::SystemModel;
using dynamics::SystemState;

/// Limit of the stability analysis, whose matrix is dense.
constexpr int kMostUnknowns = 600;

double find_deformation(const SystemModel& model, BodyIndex b,
                        const SystemState& state) {
  const auto& rows = model.bodies[static_cast<std::size_t>(b)].reduced->rows;
  MatrixX u(rows.x_B.size(), 1);
  calc_node_deformations(model, b, {&state, 1}, u);
  return std::sqrt(
      u.reshaped(3, rows.x_B.cols()).colwise().squaredNorm().maxCoeff());
}

StaticBody describe_static_body(const SystemModel& model, BodyIndex b,
                                const SystemState& start,
                                const SystemState& state,
                                const dynamics::SystemTerms& terms) {
  const auto i = static_cast<std::size_t>(b);
  const dynamics::BodyModel& body = model.bodies[i];
  StaticBody out;
  out.name = body.name;
  out.moved = (state.bodies[i].p_WB - start.bodies[i].p_WB).norm();
  out.turned = state.bodies[i].quat_WB.angularDistance(start.bodies[i].quat_WB);
  if (!body.reduced) return out;
  out.static_stiffness = body.maxwell.scale;
  out.size = body.reduced->size.maxCoeff();
  if (body.reduced->rows.x_B.cols() > 0) {
    out.deformation = find_deformation(model, b, state);
  }
  const auto eta = state.eta.segment(body.offset, body.modes);
  out.strain_energy =
      body.full >= 0
          ? terms.full[static_cast<std::size_t>(body.full)].strain_energy
          : flexbody::calc_elastic_energy(body.elasticity, eta);
  return out;
}

std::optional<double> find_lowest(const SystemModel& model,
                                  const SystemState& state) {
  const auto unknowns =
      6 * static_cast<int>(model.bodies.size()) + model.modal_count;
  if (!model.full_bodies.empty() || unknowns > kMostUnknowns) return {};
  const VectorX all = find_natural_frequencies(model, state);
  if (all.size() == 0) return {};
  return all[0];
}

}  // namespace

StaticReport report_equilibrium(const scene::BuiltScene& built,
                                const dynamics::Equilibrium& found) {
  const SystemModel& model = built.model;
  dynamics::SystemTerms terms = make_terms(model);
  calc_terms(model, found.state, Side::right, terms);
  StaticReport report;
  for (BodyIndex b(0); b < std::ssize(model.bodies); ++b) {
    report.bodies.push_back(
        describe_static_body(model, b, built.initial, found.state, terms));
  }
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const Vector6& wrench = terms.couplers[c].response.wrench;
    report.couplers.push_back({model.couplers[c].name, wrench.head<3>().norm(),
                               wrench.tail<3>().norm()});
  }
  for (std::size_t i = 0; i < model.transmissions.size(); ++i) {
    report.couplers.push_back({model.transmissions[i].name,
                               std::abs(terms.transmissions[i].response.force),
                               0.0});
  }
  report.coupler_energy = calc_energy(model, found.state).coupler;
  report.lowest_frequency = find_lowest(model, found.state);
  return report;
}

}  // namespace limber::runs
