// SPDX-License-Identifier: BSD-3-Clause
#include "support/lattice_chain.hpp"

#include <cstddef>

#include "limber/flexbody/model/interface_motion.hpp"
#include "limber/joints/joint_kind.hpp"

namespace limber::testing {
namespace {

joints::Bushing make_bushing(double stiffness, double damping) {
  return joints::make_joint_bushing(joints::JointKind::fixed, Vector3::UnitX(),
                                    {.translational_stiffness = stiffness,
                                     .rotational_stiffness = 0.01 * stiffness,
                                     .translational_damping = damping,
                                     .rotational_damping = 0.01 * damping});
}

}  // namespace

LatticeChain::LatticeChain()
    : network_(make_lattice()), full_(make_full(network_)) {}

template <typename Attach>
void LatticeChain::attach(const Attach& at) {
  const auto first = at(first_set);
  ends_.emplace_back(first, at(last_set));
}

void LatticeChain::add(Fidelity fidelity, int modes,
                       const ModalDamping& damping) {
  const std::string name = "link" + std::to_string(ends_.size());
  if (fidelity == Fidelity::full) {
    const auto b = builder.add_full_body(name, make_reduced(network_, modes),
                                         full_, damping);
    attach([&](const std::string& set) {
      return builder.attach_nodes(set, b, find_node_set(*full_, set),
                                  {Matrix3::Identity(), find_mean(set)});
    });
    return;
  }
  const auto reduced = make_reduced(network_, modes);
  const auto b = builder.add_flexible_body(name, reduced, fidelity, damping);
  attach([&](const std::string& set) {
    return builder.attach_interface(set, b, make_table(set, *reduced),
                                    {Matrix3::Identity(), find_mean(set)});
  });
}

void LatticeChain::join(double stiffness, double damping, int count) {
  for (int i = 0; i < count; ++i) {
    builder.add_coupler(
        "joint" + std::to_string(ends_.size()) + "." + std::to_string(i),
        make_bushing(stiffness / count, damping / count),
        ends_[ends_.size() - 2].second, ends_.back().first);
  }
}

void LatticeChain::join_world(double stiffness, double damping) {
  const auto world = builder.attach_world(
      "world", {Matrix3::Identity(), find_mean(first_set)});
  builder.add_coupler("mount", make_bushing(stiffness, damping), world,
                      ends_.front().first);
}

SystemState LatticeChain::place(const SystemModel& model, double gap,
                                const Vector3& spin, double shape) const {
  SystemState state = dynamics::make_state(model);
  VectorX u_B = VectorX::Zero(model.nodal_count);
  const Vector3 pitch = find_mean(last_set) - find_mean(first_set);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const double i = static_cast<double>(b);
    dynamics::BodyState& body = state.bodies[b];
    body.p_WB = i * (pitch + Vector3(0.3 * gap, -gap, gap));
    body.w_WB_B = spin;
    body.v_WB_W = spin.cross(body.p_WB) + Vector3(0.1, 0.2, -0.3);
    const dynamics::BodyModel& m = model.bodies[b];
    if (m.full >= 0) {
      const dynamics::FullModel& full =
          model.full_bodies[static_cast<std::size_t>(m.full)];
      u_B.segment(full.first, full.dofs()) =
          shape * m.reduced->rows.Phi_B.leftCols(3).rowwise().sum();
    } else if (m.modes > 0) {
      state.eta.segment(m.offset, 3).setConstant(shape);
    }
  }
  place_nodes(model, u_B, {}, state);
  return state;
}

Vector3 LatticeChain::find_mean(const std::string& name) const {
  const flexbody::NodeSet& set = find_node_set(*full_, name);
  return full_->x_B(Eigen::all, set.nodes) * set.weights;
}

flexbody::InterfaceTable LatticeChain::make_table(
    const std::string& name, const flexbody::ReducedBody& reduced) const {
  const flexbody::NodeSet& set = find_node_set(*full_, name);
  const flexbody::InterfaceMotion mean(set.nodes, set.weights, set.moments,
                                       network_.x_B, reduced.size.maxCoeff());
  const Matrix6X rows = mean.apply(reduced.rows.Phi_B);
  flexbody::InterfaceTable table;
  table.name = name;
  table.p_B = mean.mean_point();
  table.Phi_B = rows.topRows<3>();
  table.Psi_B = rows.bottomRows<3>();
  return table;
}

}  // namespace limber::testing
