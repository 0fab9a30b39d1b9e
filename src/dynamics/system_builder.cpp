// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/system_builder.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "common/errors.hpp"
#include "dynamics/body_model.hpp"

namespace limber::dynamics {
namespace {

void check_inertia(const std::string& name, double mass,
                   const Matrix3& inertia) {
  if (!(mass > 0.0) || !std::isfinite(mass)) {
    throw InputError(fmt::format(
        "body '{}': mass is {:g} kg; a body that moves needs mass > 0", name,
        mass));
  }
  const Vector3 principal =
      Eigen::SelfAdjointEigenSolver<Matrix3>(inertia, Eigen::EigenvaluesOnly)
          .eigenvalues();
  if (!inertia.allFinite() || !(principal.minCoeff() > 0.0)) {
    throw InputError(fmt::format(
        "body '{}': its inertia has the principal moments ({:g}, {:g}, {:g}) "
        "kg m^2; expected all > 0",
        name, principal[0], principal[1], principal[2]));
  }
}

VectorX modal_damping(const std::string& name, const ModalDamping& damping,
                      const VectorX& lambda) {
  const auto& ratios = damping.ratios;
  const auto modes = static_cast<std::size_t>(lambda.size());
  if (ratios.size() > 1 && ratios.size() != modes) {
    throw InputError(fmt::format(
        "body '{}': {} damping ratios for {} modes; give one for all or one "
        "a mode",
        name, ratios.size(), modes));
  }
  VectorX c(lambda.size());
  for (std::size_t k = 0; k < modes; ++k) {
    const double ratio =
        ratios.empty() ? 0.0 : ratios[ratios.size() == 1 ? 0 : k];
    const auto i = static_cast<Eigen::Index>(k);
    c[i] = 2.0 * ratio * std::sqrt(lambda[i]) + damping.rayleigh_mass +
           damping.rayleigh_stiffness * lambda[i];
  }
  if (c.size() > 0 && !(c.minCoeff() >= 0.0)) {
    throw InputError(fmt::format(
        "body '{}': its damping is negative; it would feed energy in", name));
  }
  return c;
}

// Rows of a full body are its nodes, in the mesh's order.
void check_same_nodes(const std::string& name,
                      const flexbody::ReducedBody& reduced,
                      const flexbody::FullBody& full) {
  constexpr double kSame = 1e-9;  // of the body's size
  const Matrix3X& x = reduced.rows.x_B;
  if (x.cols() != full.node_count()) {
    throw InputError(fmt::format(
        "body '{}': its reduced body keeps {} of {} nodes; level full needs "
        "the rows of all",
        name, x.cols(), full.node_count()));
  }
  if ((x - full.x_B).cwiseAbs().maxCoeff() > kSame * reduced.size.norm()) {
    throw InputError(fmt::format(
        "body '{}': the mesh's nodes are not those of its reduced body; "
        "reduce it again",
        name));
  }
}

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
  check_inertia(name, inertia.mass, inertia.inertia);
  BodyModel body;
  body.name = name;
  body.mass = inertia.mass;
  body.J0 = inertia.inertia;
  body.offset = model_.modal_count;
  model_.bodies.push_back(std::move(body));
  return static_cast<BodyIndex>(model_.bodies.size()) - 1;
}

// Bodies keep what they were reduced from, so its address stays its own.
std::shared_ptr<const ModalInertia> SystemBuilder::find_inertia(
    const flexbody::ReducedBody& reduced) {
  LIMBER_EXPECT(reduced.integrals.S1.size() ==
                static_cast<std::size_t>(reduced.mode_count()));
  std::shared_ptr<const ModalInertia>& known = inertias_[&reduced];
  if (!known) {
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
  check_inertia(name, reduced->mass, reduced->inertia());
  BodyModel body;
  body.name = name;
  body.fidelity = fidelity;
  body.clamped = reduced->clamped;
  body.mass = reduced->mass;
  body.J0 = reduced->inertia();
  body.offset = model_.modal_count;
  if (fidelity != Fidelity::rigid) {
    body.modes = reduced->mode_count();
    body.lambda = reduced->lambda;
    body.damping = modal_damping(name, damping, reduced->lambda);
    if (body.clamped) {
      LIMBER_EXPECT(reduced->integrals.P.cols() == body.modes);
      body.P = reduced->integrals.P;
    }
    body.inertia = find_inertia(*reduced);
  }
  body.reduced = std::move(reduced);
  model_.modal_count += body.modes;
  model_.bodies.push_back(std::move(body));
  return static_cast<BodyIndex>(model_.bodies.size()) - 1;
}

BodyIndex SystemBuilder::add_full_body(
    const std::string& name,
    std::shared_ptr<const flexbody::ReducedBody> reduced,
    std::shared_ptr<const flexbody::FullBody> full,
    const ModalDamping& damping) {
  LIMBER_EXPECT(reduced != nullptr && full != nullptr);
  check_inertia(name, reduced->mass, reduced->inertia());
  check_same_nodes(name, *reduced, *full);
  FullModel more;
  more.body = static_cast<BodyIndex>(model_.bodies.size());
  more.first = model_.nodal_count;
  more.mesh = full;
  const VectorX rates = modal_damping(name, damping, reduced->lambda);
  if (rates.size() > 0 && rates.maxCoeff() > 0.0) {
    more.damping = rates;
    more.damped_modes = multiply_mass(*full, reduced->rows.Phi_B);
    more.needs_frame = true;
  }
  BodyModel body;
  body.name = name;
  body.fidelity = Fidelity::full;
  body.clamped = reduced->clamped;
  body.mass = reduced->mass;
  body.J0 = reduced->inertia();
  body.offset = model_.modal_count;
  body.reduced = std::move(reduced);
  body.full = static_cast<int>(model_.full_bodies.size());
  model_.nodal_count += more.dofs();
  model_.full_bodies.push_back(std::move(more));
  model_.bodies.push_back(std::move(body));
  return static_cast<BodyIndex>(model_.bodies.size()) - 1;
}

AttachmentIndex SystemBuilder::attach_nodes(const std::string& name,
                                            BodyIndex body,
                                            const flexbody::NodeSet& nodes,
                                            const Pose& X_BF) {
  const AttachmentIndex index = attach_frame(name, body, X_BF);
  const int full = model_.bodies[static_cast<std::size_t>(body)].full;
  LIMBER_EXPECT(full >= 0);
  model_.attachments.back().nodal = std::make_shared<const NodalFrame>(
      make_nodal_frame(*model_.full_bodies[static_cast<std::size_t>(full)].mesh,
                       nodes, X_BF.p));
  return index;
}

AttachmentIndex SystemBuilder::attach_frame(const std::string& name,
                                            BodyIndex body, const Pose& X_BF) {
  LIMBER_EXPECT(body >= 0 && body < static_cast<int>(model_.bodies.size()));
  const int modes = model_.bodies[static_cast<std::size_t>(body)].modes;
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
  const AttachmentIndex index = attach_frame(name, body, X_BF);
  Attachment& attachment = model_.attachments.back();
  if (attachment.Phi_B.cols() == 0) return index;  // a rigid body
  LIMBER_EXPECT(interface.Phi_B.cols() == attachment.Phi_B.cols());
  LIMBER_EXPECT(interface.Psi_B.cols() == attachment.Psi_B.cols());
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
  model_.attachments.push_back({.name = name,
                                .body = kWorld,
                                .p_BF = X_WF.p,
                                .R_BF = X_WF.R,
                                .Phi_B = Matrix3X::Zero(3, 0),
                                .Psi_B = Matrix3X::Zero(3, 0)});
  return static_cast<AttachmentIndex>(model_.attachments.size()) - 1;
}

CouplerIndex SystemBuilder::add_coupler(const std::string& name,
                                        const joints::CouplerLaw& law,
                                        AttachmentIndex frame_F,
                                        AttachmentIndex frame_M) {
  const auto count = static_cast<int>(model_.attachments.size());
  LIMBER_EXPECT(frame_F >= 0 && frame_F < count);
  LIMBER_EXPECT(frame_M >= 0 && frame_M < count);
  const auto body_of = [&](AttachmentIndex i) {
    return model_.attachments[static_cast<std::size_t>(i)].body;
  };
  if (body_of(frame_F) == body_of(frame_M)) {
    throw InputError(fmt::format(
        "coupler '{}': both of its ends are on the same body", name));
  }
  model_.couplers.push_back({name, law, frame_F, frame_M});
  return static_cast<CouplerIndex>(model_.couplers.size()) - 1;
}

TransmissionIndex SystemBuilder::add_path(
    const std::string& name, const std::vector<AttachmentIndex>& points,
    const std::vector<joints::ScalarLaw>& laws) {
  const auto count = static_cast<int>(model_.attachments.size());
  bool is_moved = false;
  for (const AttachmentIndex point : points) {
    LIMBER_EXPECT(point >= 0 && point < count);
    const auto i = static_cast<std::size_t>(point);
    is_moved |= model_.attachments[i].body !=
                model_.attachments[static_cast<std::size_t>(points[0])].body;
  }
  if (points.size() < 2 || !is_moved) {
    throw InputError(fmt::format(
        "tendon '{}': it runs through {} point{} of one body; expected two or "
        "more, not all on the same body",
        name, points.size(), points.size() == 1 ? "" : "s"));
  }
  model_.transmissions.push_back({name, PathCoordinate{points}, laws});
  return static_cast<TransmissionIndex>(model_.transmissions.size()) - 1;
}

TransmissionIndex SystemBuilder::add_joint_sum(
    const std::string& name, const JointSum& sum,
    const std::vector<joints::ScalarLaw>& laws) {
  LIMBER_EXPECT(!sum.terms.empty());
  for (const JointSum::Term& term : sum.terms) {
    LIMBER_EXPECT(term.coupler >= 0 &&
                  term.coupler < static_cast<int>(model_.couplers.size()));
    const auto& coordinates = joints::coordinates_of(
        model_.couplers[static_cast<std::size_t>(term.coupler)].law);
    LIMBER_EXPECT(term.coordinate >= 0 &&
                  term.coordinate < std::ssize(coordinates));
    if (term.factor == 0.0 || !std::isfinite(term.factor)) {
      throw InputError(fmt::format(
          "transmission '{}': a factor is {:g}; expected a number other than 0",
          name, term.factor));
    }
  }
  model_.transmissions.push_back({name, sum, laws});
  return static_cast<TransmissionIndex>(model_.transmissions.size()) - 1;
}

LoadIndex SystemBuilder::add_load(const std::string& name,
                                  AttachmentIndex where, const Vector3& force,
                                  const Vector3& moment, LoadFrame frame,
                                  const TimeFunction& function) {
  LIMBER_EXPECT(where >= 0 &&
                where < static_cast<int>(model_.attachments.size()));
  if (!force.allFinite() || !moment.allFinite()) {
    throw InputError(fmt::format("load '{}': not finite", name));
  }
  check(function);
  const Attachment& attachment =
      model_.attachments[static_cast<std::size_t>(where)];
  if (attachment.nodal && frame == LoadFrame::body) {
    const int full =
        model_.bodies[static_cast<std::size_t>(attachment.body)].full;
    model_.full_bodies[static_cast<std::size_t>(full)].needs_frame = true;
  }
  model_.loads.push_back(
      {name, where, force, moment, frame == LoadFrame::world, function});
  return static_cast<LoadIndex>(model_.loads.size()) - 1;
}

void SystemBuilder::add_nodal_load(const std::string& name, BodyIndex body,
                                   const flexbody::NodalLoad& history,
                                   const MatrixX& nodal) {
  LIMBER_EXPECT(body >= 0 && body < static_cast<int>(model_.bodies.size()));
  const BodyModel& target = model_.bodies[static_cast<std::size_t>(body)];
  const auto count = static_cast<Eigen::Index>(history.times.size());
  LIMBER_EXPECT(history.force.cols() == count &&
                history.moment.cols() == count);
  LIMBER_EXPECT(target.modes == 0 ||
                (history.modal.rows() == target.modes &&
                 history.modal.cols() == count &&
                 history.moment_by_mode.cols() == target.modes * count));
  if (target.full >= 0) {
    FullModel& full = model_.full_bodies[static_cast<std::size_t>(target.full)];
    LIMBER_EXPECT(nodal.rows() == full.dofs() && nodal.cols() == count);
    full.needs_frame = true;
  }
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
