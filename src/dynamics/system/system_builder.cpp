// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/system_builder.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/errors.hpp"
#include "dynamics/body_model.hpp"
#include "dynamics/builder_checks.hpp"

namespace limber::dynamics {
namespace {

MatrixX multiply_mass(const flexbody::FullBody& full, const MatrixX& columns) {
  const auto solver = full.make_solver();
  MatrixX product(columns.rows(), columns.cols());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const ConstNodes from(columns.col(k).data(), 3, full.node_count());
    solver->multiply_mass(from, Nodes(product.col(k).data(), 3, from.cols()));
  }
  return product;
}

}  // namespace

BodyIndex SystemBuilder::add_rigid_body(const std::string& name,
                                        const RigidInertia& inertia) {
  const std::string what = names_.check("body", name);
  check_inertia(what, inertia.mass, inertia.inertia);
  BodyModel body;
  body.mass = inertia.mass;
  body.J0 = inertia.inertia;
  return add_body(name, std::move(body));
}

BodyIndex SystemBuilder::add_body(const std::string& name, BodyModel body) {
  names_.add("body", name);
  body.name = name;
  body.offset = model_.modal_count;
  model_.modal_count += body.modes;
  model_.bodies.push_back(std::move(body));
  return static_cast<BodyIndex>(model_.bodies.size()) - 1;
}

// Bodies keep what they were reduced from, so its address stays its own.
std::shared_ptr<const ModalInertia> SystemBuilder::find_inertia(
    const std::string& what, const flexbody::ReducedBody& reduced) {
  std::shared_ptr<const ModalInertia>& known = inertias_[&reduced];
  if (!known) {
    check_integrals(what, reduced);
    known =
        std::make_shared<const ModalInertia>(pack_inertia(reduced.integrals));
  }
  return known;
}

BodyIndex SystemBuilder::add_flexible_body(
    const std::string& name,
    std::shared_ptr<const flexbody::ReducedBody> reduced, Fidelity fidelity,
    const ModalDamping& damping) {
  LIMBER_EXPECT(reduced != nullptr);
  const std::string what = names_.check("body", name);
  if (fidelity < Fidelity::rigid || fidelity >= Fidelity::full) {
    throw ContractError(what +
                        ": its level has no reduced basis; add_full_body");
  }
  check_reduced(what, *reduced, fidelity != Fidelity::rigid);
  BodyModel body;
  body.fidelity = fidelity;
  body.clamped = reduced->clamped;
  body.mass = reduced->mass;
  body.J0 = reduced->inertia();
  if (fidelity != Fidelity::rigid) {
    body.modes = reduced->mode_count();
    body.lambda = reduced->lambda;
    body.damping = check_damping(what, damping, reduced->lambda);
    if (body.clamped) body.P = reduced->integrals.P;
    body.inertia = find_inertia(what, *reduced);
  }
  body.reduced = std::move(reduced);
  return add_body(name, std::move(body));
}

BodyIndex SystemBuilder::add_full_body(
    const std::string& name,
    std::shared_ptr<const flexbody::ReducedBody> reduced,
    std::shared_ptr<const flexbody::FullBody> full,
    const ModalDamping& damping) {
  LIMBER_EXPECT(reduced != nullptr && full != nullptr);
  const std::string what = names_.check("body", name);
  check_reduced(what, *reduced, true);
  check_same_nodes(what, *reduced, *full);
  FullModel more;
  more.body = static_cast<BodyIndex>(model_.bodies.size());
  more.first = model_.nodal_count;
  more.mesh = full;
  const VectorX rates = check_damping(what, damping, reduced->lambda);
  if (rates.size() > 0 && rates.maxCoeff() > 0.0) {
    more.damping = rates;
    more.damped_modes = multiply_mass(*full, reduced->rows.Phi_B);
    more.needs_frame = true;
  }
  BodyModel body;
  body.fidelity = Fidelity::full;
  body.clamped = reduced->clamped;
  body.mass = reduced->mass;
  body.J0 = reduced->inertia();
  body.reduced = std::move(reduced);
  body.full = static_cast<int>(model_.full_bodies.size());
  model_.nodal_count += more.dofs();
  model_.full_bodies.push_back(std::move(more));
  return add_body(name, std::move(body));
}

const BodyModel& SystemBuilder::find_body(const std::string& what,
                                          BodyIndex body) const {
  check_index(what, "body", body, model_.bodies.size());
  return model_.bodies[static_cast<std::size_t>(body)];
}

AttachmentIndex SystemBuilder::attach_nodes(const std::string& name,
                                            BodyIndex body,
                                            const flexbody::NodeSet& nodes,
                                            const Pose& X_BF) {
  const std::string what = fmt::format("frame '{}'", name);
  const BodyModel& target = find_body(what, body);
  if (target.full < 0) {
    throw ContractError(
        fmt::format("{}: body '{}' is not at level full; attach_interface",
                    what, target.name));
  }
  const flexbody::FullBody& mesh =
      *model_.full_bodies[static_cast<std::size_t>(target.full)].mesh;
  check_nodes(what, nodes, mesh.node_count());
  const AttachmentIndex index = attach_frame(name, body, X_BF);
  model_.attachments.back().nodal =
      std::make_shared<const NodalFrame>(make_nodal_frame(mesh, nodes, X_BF.p));
  return index;
}

AttachmentIndex SystemBuilder::attach_frame(const std::string& name,
                                            BodyIndex body, const Pose& X_BF) {
  const std::string what = fmt::format("frame '{}'", name);
  const int modes = find_body(what, body).modes;
  check_pose(what, X_BF);
  model_.attachments.push_back({.name = name,
                                .body = body,
                                .p_BF = X_BF.p,
                                .R_BF = X_BF.R,
                                .Phi_B = Matrix3X::Zero(3, modes),
                                .Psi_B = Matrix3X::Zero(3, modes)});
  return static_cast<AttachmentIndex>(model_.attachments.size()) - 1;
}

AttachmentIndex SystemBuilder::attach_interface(
    const std::string& name, BodyIndex body,
    const flexbody::InterfaceTable& interface, const Pose& X_BF) {
  const std::string what = fmt::format("frame '{}'", name);
  const BodyModel& target = find_body(what, body);
  if (target.full >= 0) {
    throw ContractError(fmt::format(
        "{}: body '{}' is at level full; attach_nodes", what, target.name));
  }
  if (target.modes > 0) check_interface(what, interface, target.modes);
  const AttachmentIndex index = attach_frame(name, body, X_BF);
  Attachment& attachment = model_.attachments.back();
  if (attachment.Phi_B.cols() == 0) return index;  // a rigid body
  // The frame's origin may sit off the mean point: it follows the rotation.
  const Vector3 arm = X_BF.p - interface.p_B;
  attachment.Psi_B = interface.Psi_B;
  attachment.Phi_B = interface.Phi_B;
  for (Eigen::Index k = 0; k < attachment.Phi_B.cols(); ++k) {
    attachment.Phi_B.col(k) += Vector3(interface.Psi_B.col(k)).cross(arm);
  }
  return index;
}

AttachmentIndex SystemBuilder::attach_world(const std::string& name,
                                            const Pose& X_WF) {
  check_pose(fmt::format("frame '{}'", name), X_WF);
  model_.attachments.push_back({.name = name,
                                .body = kWorld,
                                .p_BF = X_WF.p,
                                .R_BF = X_WF.R,
                                .Phi_B = Matrix3X::Zero(3, 0),
                                .Psi_B = Matrix3X::Zero(3, 0)});
  return static_cast<AttachmentIndex>(model_.attachments.size()) - 1;
}

const Attachment& SystemBuilder::find_frame(const std::string& what,
                                            AttachmentIndex frame) const {
  check_index(what, "frame", frame, model_.attachments.size());
  return model_.attachments[static_cast<std::size_t>(frame)];
}

CouplerIndex SystemBuilder::add_coupler(const std::string& name,
                                        const joints::CouplerLaw& law,
                                        AttachmentIndex frame_F,
                                        AttachmentIndex frame_M) {
  const std::string what = names_.check("coupler", name);
  if (find_frame(what, frame_F).body == find_frame(what, frame_M).body) {
    throw InputError(what + ": both of its ends are on the same body");
  }
  names_.add("coupler", name);
  model_.couplers.push_back({name, law, frame_F, frame_M});
  return static_cast<CouplerIndex>(model_.couplers.size()) - 1;
}

TransmissionIndex SystemBuilder::add_path(
    const std::string& name, const std::vector<AttachmentIndex>& points,
    const std::vector<joints::ScalarLaw>& laws) {
  static_cast<void>(names_.check("transmission", name));
  const std::string what = fmt::format("tendon '{}'", name);
  bool is_moved = false;
  for (const AttachmentIndex point : points) {
    is_moved |=
        find_frame(what, point).body != find_frame(what, points[0]).body;
  }
  if (points.size() < 2 || !is_moved) {
    throw InputError(fmt::format(
        "{}: it runs through {} point{} of one body; expected two or more, not "
        "all on the same body",
        what, points.size(), points.size() == 1 ? "" : "s"));
  }
  names_.add("transmission", name);
  model_.transmissions.push_back({name, PathCoordinate{points}, laws});
  return static_cast<TransmissionIndex>(model_.transmissions.size()) - 1;
}

TransmissionIndex SystemBuilder::add_joint_sum(
    const std::string& name, const JointSum& sum,
    const std::vector<joints::ScalarLaw>& laws) {
  check_joint_sum(names_.check("transmission", name), sum, model_);
  names_.add("transmission", name);
  model_.transmissions.push_back({name, sum, laws});
  return static_cast<TransmissionIndex>(model_.transmissions.size()) - 1;
}

LoadIndex SystemBuilder::add_load(const std::string& name,
                                  AttachmentIndex where, const Vector3& force,
                                  const Vector3& moment, LoadFrame frame,
                                  const TimeFunction& function) {
  const std::string what = names_.check("load", name);
  const Attachment& attachment = find_frame(what, where);
  if (attachment.body == kWorld) {
    throw InputError(what + ": it acts on the world, which does not move");
  }
  if (!force.allFinite() || !moment.allFinite()) {
    throw InputError(what + ": its force or moment is not finite");
  }
  try {
    check(function);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", what, error.what()));
  }
  if (attachment.nodal && frame == LoadFrame::body) {
    const int full =
        model_.bodies[static_cast<std::size_t>(attachment.body)].full;
    model_.full_bodies[static_cast<std::size_t>(full)].needs_frame = true;
  }
  names_.add("load", name);
  model_.loads.push_back(
      {name, where, force, moment, frame == LoadFrame::world, function});
  return static_cast<LoadIndex>(model_.loads.size()) - 1;
}

void SystemBuilder::add_nodal_load(const std::string& name, BodyIndex body,
                                   const flexbody::NodalLoad& history,
                                   const MatrixX& nodal) {
  const std::string what = names_.check("nodal load", name);
  const BodyModel& target = find_body(what, body);
  check_nodal_load(what, history, target.modes);
  if (target.full >= 0) {
    FullModel& full = model_.full_bodies[static_cast<std::size_t>(target.full)];
    if (nodal.rows() != full.dofs() ||
        nodal.cols() != std::ssize(history.times) || !nodal.allFinite()) {
      throw ContractError(fmt::format(
          "{}: {} x {} nodal forces; expected {} x {}, all finite", what,
          nodal.rows(), nodal.cols(), full.dofs(), history.times.size()));
    }
    full.needs_frame = true;
  }
  names_.add("nodal load", name);
  model_.body_loads.push_back(
      {name, body, history, target.full >= 0 ? nodal : MatrixX()});
}

void SystemBuilder::set_gravity(const Vector3& gravity_W) {
  if (!gravity_W.allFinite()) throw InputError("gravity is not finite");
  model_.gravity_W = gravity_W;
}

SystemModel SystemBuilder::build() const {
  if (model_.bodies.empty()) {
    throw InputError("the system has no body that can move");
  }
  return model_;
}

}  // namespace limber::dynamics
