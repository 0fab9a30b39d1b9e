// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/system_builder.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/system/builder_checks.hpp"
#include "limber/dynamics/system/model_check.hpp"
#include "limber/dynamics/system/unknowns.hpp"

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

// All strains are sqrt(scale) times those of the material, so that the
// potential is `scale` times.
flexbody::QuadraticStrain make_quadratic_strain(
    const flexbody::ReducedBody& reduced, double scale) {
  const flexbody::QuadraticManifold& manifold = *reduced.manifold;
  const double root = std::sqrt(scale);
  return flexbody::QuadraticStrain({scale * reduced.lambda, manifold.paired,
                                    root * manifold.Q, root * manifold.self});
}

// Columns of the products behind those of the modes.
Matrix3X join_products(const Attachment& attachment, const BodyModel& body) {
  Matrix3X joined = Matrix3X::Zero(3, count_coordinates(body));
  joined.leftCols(body.modes) = attachment.Phi_B;
  if (!attachment.second) return joined;
  Eigen::Index next = body.modes;
  const auto p = std::ssize(paired_of(body));
  for (Eigen::Index i = 0; i < p; ++i) {
    for (Eigen::Index j = i; j < p; ++j) {
      joined.col(next++) = attachment.second->Phi2.block<3, 1>(3 * i, j);
    }
  }
  return joined;
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
  body.row = first_node_row(model_);
  model_.modal_count += body.modes;
  body.maxwell_offset = model_.maxwell_count;
  model_.maxwell_count += body.modes * static_cast<int>(body.maxwell.size());
  model_.bodies.push_back(std::move(body));
  return BodyIndex(model_.bodies.size() - 1);
}

// Bodies own their reduced body, so its address remains unique.
std::shared_ptr<const ModalInertia> SystemBuilder::find_inertia(
    const std::string& what, const flexbody::ReducedBody& reduced,
    Fidelity fidelity) {
  const bool is_second = fidelity == Fidelity::nonlinear;
  std::shared_ptr<const ModalInertia>& known = inertias_[{&reduced, is_second}];
  if (!known) {
    check_integrals(what, reduced);
    known = std::make_shared<const ModalInertia>(
        is_second ? pack_inertia(reduced.integrals, *reduced.manifold)
                  : pack_inertia(reduced.integrals));
  }
  return known;
}

BodyIndex SystemBuilder::add_flexible_body(
    const std::string& name,
    std::shared_ptr<const flexbody::ReducedBody> reduced, Fidelity fidelity,
    const ModalDamping& damping,
    const std::optional<flexbody::ModalElasticity>& elasticity) {
  LIMBER_EXPECT(reduced != nullptr);
  LIMBER_EXPECT(!elasticity || damping.maxwell.size() == 0);
  const std::string what = names_.check("body", name);
  if (fidelity < Fidelity::rigid || fidelity >= Fidelity::full) {
    throw ContractError(what +
                        ": its level has no reduced basis; add_full_body");
  }
  check_reduced(what, *reduced, fidelity != Fidelity::rigid);
  check_level(what, *reduced, fidelity);
  BodyModel body;
  body.fidelity = fidelity;
  body.clamped = reduced->clamped;
  body.mass = reduced->mass;
  body.J0 = reduced->inertia();
  if (fidelity != Fidelity::rigid) {
    body.modes = reduced->mode_count();
    if (fidelity == Fidelity::nonlinear) {
      check_manifold(what, *reduced, elasticity.has_value());
      body.elasticity = make_quadratic_strain(*reduced, damping.maxwell.scale);
    } else {
      body.elasticity = elasticity.value_or(
          flexbody::DiagonalStiffness(flexbody::DiagonalStiffness::Parameters{
              damping.maxwell.scale * reduced->lambda}));
    }
    check_elasticity(what, body.elasticity, body.modes, damping);
    body.damping =
        check_damping(what, damping, flexbody::rest_stiffness(body.elasticity));
    body.maxwell = damping.maxwell;
    if (body.clamped) {
      body.P = fidelity == Fidelity::nonlinear
                   ? reduced->integrals.P
                   : Matrix3X(reduced->integrals.P.leftCols(body.modes));
    }
    body.inertia = find_inertia(what, *reduced, fidelity);
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
  LIMBER_EXPECT(damping.maxwell.size() == 0);
  const std::string what = names_.check("body", name);
  check_reduced(what, *reduced, true);
  check_same_nodes(what, *reduced, *full);
  FullModel more;
  more.body = BodyIndex(model_.bodies.size());
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
  return AttachmentIndex(model_.attachments.size() - 1);
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
  // An origin away from the mean point follows the rotation.
  const Vector3 arm = X_BF.p - interface.p_B;
  attachment.Psi_B = interface.Psi_B;
  attachment.Phi_B = interface.Phi_B;
  for (Eigen::Index k = 0; k < attachment.Phi_B.cols(); ++k) {
    attachment.Phi_B.col(k) += Vector3(interface.Psi_B.col(k)).cross(arm);
  }
  if (target.fidelity == Fidelity::nonlinear) {
    const std::vector<int>& paired = target.reduced->manifold->paired;
    check_second_order(what, interface, paired.size());
    attachment.second = std::make_shared<const flexbody::QuadraticFrame>(
        flexbody::move_origin(flexbody::make_quadratic_frame(
                                  paired, interface.Phi2_B, interface.Psi2_B),
                              interface.Psi_B, arm));
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
  return AttachmentIndex(model_.attachments.size() - 1);
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
  check_inputs(what, joints::find_inputs(law));
  names_.add("coupler", name);
  model_.couplers.push_back({name, law, frame_F, frame_M});
  return CouplerIndex(model_.couplers.size() - 1);
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
  for (const joints::ScalarLaw& law : laws) {
    check_inputs(what, joints::find_inputs(law));
  }
  names_.add("transmission", name);
  model_.transmissions.push_back({name, PathCoordinate{points}, laws});
  return TransmissionIndex(model_.transmissions.size() - 1);
}

TransmissionIndex SystemBuilder::add_joint_sum(
    const std::string& name, const JointSum& sum,
    const std::vector<joints::ScalarLaw>& laws) {
  const std::string what = names_.check("transmission", name);
  check_joint_sum(what, sum, model_);
  for (const joints::ScalarLaw& law : laws) {
    check_inputs(what, joints::find_inputs(law));
  }
  names_.add("transmission", name);
  model_.transmissions.push_back({name, sum, laws});
  return TransmissionIndex(model_.transmissions.size() - 1);
}

PairIndex SystemBuilder::add_pair(
    const std::string& name, BodyIndex body_A, BodyIndex body_B,
    std::shared_ptr<const joints::PairInteraction> law) {
  const std::string what = names_.check("pair", name);
  LIMBER_EXPECT(law != nullptr);
  const auto coordinates_of = [&](BodyIndex body) {
    if (body == kWorld) return 0;
    (void)find_body(what, body);
    return count_pair_coordinates(model_, body);
  };
  const int modes_A = coordinates_of(body_A);
  const int modes_B = coordinates_of(body_B);
  check_pair_bodies(what, body_A, body_B);
  try {
    law->check(modes_A, modes_B);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", what, error.what()));
  }
  for (const BodyIndex body : {body_A, body_B}) {
    if (body == kWorld) continue;
    const int full = model_.bodies[static_cast<std::size_t>(body)].full;
    if (full < 0) continue;
    model_.full_bodies[static_cast<std::size_t>(full)].needs_frame = true;
  }
  names_.add("pair", name);
  const std::size_t first = model_.pair_memory_size;
  model_.pair_memory_size += law->memory_size();
  model_.pairs.push_back({name, body_A, body_B, std::move(law), first});
  return PairIndex(model_.pairs.size() - 1);
}

joints::PairPlace SystemBuilder::find_place(AttachmentIndex attachment) const {
  const std::string what = fmt::format("place {}", attachment);
  const Attachment& a = find_frame(what, attachment);
  if (a.nodal) {
    throw InputError(
        fmt::format("{}: frame '{}' is on a body at level full, which does not "
                    "support pairs",
                    what, a.name));
  }
  if (a.body == kWorld) return {a.p_BF, a.Phi_B};
  return {a.p_BF, join_products(a, find_body(what, a.body))};
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
  if (const auto* follows = std::get_if<InputFunction>(&function)) {
    check_inputs(what, {follows->input});
  }
  if (attachment.nodal && frame == LoadFrame::body) {
    const int full =
        model_.bodies[static_cast<std::size_t>(attachment.body)].full;
    model_.full_bodies[static_cast<std::size_t>(full)].needs_frame = true;
  }
  names_.add("load", name);
  model_.loads.push_back(
      {name, where, force, moment, frame == LoadFrame::world, function});
  return LoadIndex(model_.loads.size() - 1);
}

void SystemBuilder::add_nodal_load(const std::string& name, BodyIndex body,
                                   const flexbody::NodalLoad& history,
                                   const MatrixX& nodal) {
  const std::string what = names_.check("nodal load", name);
  const BodyModel& target = find_body(what, body);
  check_nodal_load(what, history, count_coordinates(target));
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

void SystemBuilder::check_inputs(const std::string& what,
                                 const std::vector<int>& inputs) const {
  for (const int input : inputs) {
    check_index(what, "input", input, model_.inputs.size());
  }
}

InputIndex SystemBuilder::add_input(const std::string& name, double initial,
                                    InputHold hold) {
  const std::string what = names_.check("input", name);
  if (!std::isfinite(initial)) {
    throw InputError(
        fmt::format("{}: its initial value is {}; expected a finite number",
                    what, initial));
  }
  names_.add("input", name);
  model_.inputs.push_back({name, initial, hold});
  return InputIndex(model_.inputs.size() - 1);
}

ControllerIndex SystemBuilder::add_controller(
    const ControllerModel& controller) {
  const std::string what = names_.check("controller", controller.name);
  check_controller(what, controller, model_);
  names_.add("controller", controller.name);
  model_.controllers.push_back(controller);
  return ControllerIndex(model_.controllers.size() - 1);
}

void SystemBuilder::set_gravity(const Vector3& gravity_W) {
  if (!gravity_W.allFinite()) throw InputError("gravity is not finite");
  model_.gravity_W = gravity_W;
}

SystemModel SystemBuilder::build() const {
  check_model(model_);
  return model_;
}

}  // namespace limber::dynamics
