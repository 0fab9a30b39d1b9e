// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reference/simbody_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"

namespace limber::reference {
namespace {

using SimTK::Inertia;
using SimTK::MassProperties;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Transform;
using SimTK::Vec3;
using SimTK::Vec6;

SimTK::Body::Rigid make_rigid(const MechanismBody& part) {
  const Vec3 p = to_simtk(part.p_LBcm);
  const Matrix3& I = part.inertia;
  const Inertia central(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  return SimTK::Body::Rigid(
      MassProperties(part.mass, p, central.shiftFromMassCenter(-p, part.mass)));
}

/// Simbody's sliders run along x, ours along z.
Rotation find_slide(const MechanismBody& part) {
  if (part.mobilizer != Mobilizer::slider) return {};
  return {-SimTK::Pi / 2, SimTK::YAxis};
}

MobilizedBody make_mobilized(MobilizedBody& parent, const MechanismBody& part) {
  const SimTK::Body::Rigid rigid = make_rigid(part);
  const Rotation slide = find_slide(part);
  const Transform F = to_simtk(part.X_PF) * Transform(slide);
  const Transform M = to_simtk(part.X_LM) * Transform(slide);
  switch (part.mobilizer) {
    case Mobilizer::pin:
      return MobilizedBody::Pin(parent, F, rigid, M);
    case Mobilizer::slider:
      return MobilizedBody::Slider(parent, F, rigid, M);
    case Mobilizer::planar:
      return MobilizedBody::Planar(parent, F, rigid, M);
    case Mobilizer::universal:
      return MobilizedBody::Universal(parent, F, rigid, M);
    case Mobilizer::ball:
      return MobilizedBody::Ball(parent, F, rigid, M);
    case Mobilizer::free:
      return MobilizedBody::Free(parent, F, rigid, M);
    case Mobilizer::weld:
      break;
  }
  return MobilizedBody::Weld(parent, F, rigid, M);
}

std::size_t count_coordinates(Mobilizer mobilizer) {
  switch (mobilizer) {
    case Mobilizer::weld:
      return 0;
    case Mobilizer::pin:
    case Mobilizer::slider:
      return 1;
    case Mobilizer::universal:
      return 2;
    case Mobilizer::planar:
    case Mobilizer::ball:
      return 3;
    case Mobilizer::free:
      break;
  }
  return 6;
}

std::vector<double> take_coordinates(const std::vector<double>& given,
                                     Mobilizer mobilizer) {
  const std::size_t count = count_coordinates(mobilizer);
  LIMBER_EXPECT(given.empty() || given.size() == count);
  return given.empty() ? std::vector<double>(count, 0.0) : given;
}

/// Roll, pitch, yaw: about the x, then y, then z axis of F.
Rotation rotation_rpy(double roll, double pitch, double yaw) {
  return {SimTK::SpaceRotationSequence,
          roll,
          SimTK::XAxis,
          pitch,
          SimTK::YAxis,
          yaw,
          SimTK::ZAxis};
}

/// Pose of M in F at the start.
Transform find_start_pose(const MechanismBody& part) {
  const std::vector<double> q = take_coordinates(part.position, part.mobilizer);
  switch (part.mobilizer) {
    case Mobilizer::weld:
      break;
    case Mobilizer::pin:
      return Rotation(q[0], SimTK::ZAxis);
    case Mobilizer::slider:
      return Vec3(0, 0, q[0]);
    case Mobilizer::planar:
      return {Rotation(q[2], SimTK::ZAxis), Vec3(q[0], q[1], 0)};
    case Mobilizer::universal:
      return Rotation(q[0], SimTK::XAxis) * Rotation(q[1], SimTK::YAxis);
    case Mobilizer::ball:
      return rotation_rpy(q[0], q[1], q[2]);
    case Mobilizer::free:
      return {rotation_rpy(q[3], q[4], q[5]), Vec3(q[0], q[1], q[2])};
  }
  return {};
}

/// Angular and linear velocity of M in F at the start.
SpatialVec find_start_velocity(const MechanismBody& part) {
  const std::vector<double> u = take_coordinates(part.velocity, part.mobilizer);
  switch (part.mobilizer) {
    case Mobilizer::weld:
      break;
    case Mobilizer::pin:
      return {Vec3(0, 0, u[0]), Vec3(0)};
    case Mobilizer::slider:
      return {Vec3(0), Vec3(0, 0, u[0])};
    case Mobilizer::planar:
      return {Vec3(0, 0, u[2]), Vec3(u[0], u[1], 0)};
    case Mobilizer::universal: {
      const Rotation first(take_coordinates(part.position, part.mobilizer)[0],
                           SimTK::XAxis);
      return {Vec3(u[0], 0, 0) + first * Vec3(0, u[1], 0), Vec3(0)};
    }
    case Mobilizer::ball:
      return {Vec3(u[0], u[1], u[2]), Vec3(0)};
    case Mobilizer::free:
      return {Vec3(u[3], u[4], u[5]), Vec3(u[0], u[1], u[2])};
  }
  return SpatialVec(Vec3(0));
}

bool stands_for_joint(const Mechanism& mechanism, int body) {
  const auto stands = [&](const auto& b) { return b.joint_of == body; };
  return std::any_of(mechanism.bushings.begin(), mechanism.bushings.end(),
                     stands) ||
         std::any_of(mechanism.universals.begin(), mechanism.universals.end(),
                     stands);
}

/// Part of a joint's bushing that acts with a mobilizer: damping of its free
/// motion, along or about z of D; of a ball, all rotation.
joints::Bushing::Parameters keep_free_damping(const BushingElement& element,
                                              Mobilizer mobilizer) {
  const Vector3 z = element.R_FD.col(2);
  const Matrix3 along = z * z.transpose();
  const Matrix3 across = Matrix3::Identity() - along;
  const bool slides = mobilizer == Mobilizer::slider;
  const bool rotates =
      mobilizer == Mobilizer::pin || mobilizer == Mobilizer::planar;
  joints::Bushing::Parameters left;
  const Matrix3& Ct = element.law.translational_damping;
  if (slides) left.translational_damping = along * Ct * along;
  if (mobilizer == Mobilizer::planar) {
    left.translational_damping = across * Ct * across;
  }
  if (rotates) {
    left.rotational_damping = along * element.law.rotational_damping * along;
  }
  if (mobilizer == Mobilizer::ball) {
    left.rotational_damping = element.law.rotational_damping;
  }
  return left;
}

/// Whether the rest is round-off of the constrained damping.
bool is_inert(const joints::Bushing::Parameters& left,
              const joints::Bushing::Parameters& law) {
  constexpr double kRoundOff = 1e-14;
  return left.translational_damping.norm() <=
             kRoundOff * law.translational_damping.norm() &&
         left.rotational_damping.norm() <=
             kRoundOff * law.rotational_damping.norm();
}

/// Rotations first, as in Simbody.
Vec6 diagonal_along(const Matrix3& R_FD, const Matrix3& rotational,
                    const Matrix3& translational) {
  const Vector3 r = (R_FD.transpose() * rotational * R_FD).diagonal();
  const Vector3 t = (R_FD.transpose() * translational * R_FD).diagonal();
  return {r[0], r[1], r[2], t[0], t[1], t[2]};
}

SimTK::Force make_linear_bushing(SimTK::GeneralForceSubsystem& forces,
                                 const SimbodyFrame& F, const SimbodyFrame& M,
                                 const BushingElement& element) {
  const joints::Bushing::Parameters& law = element.law;
  const Transform axes = to_simtk(Pose{element.R_FD, Vector3::Zero()});
  return SimTK::Force::LinearBushing(
      forces, F.body, F.X_LF * axes, M.body, M.X_LF * axes,
      diagonal_along(element.R_FD, law.rotational_stiffness,
                     law.translational_stiffness),
      diagonal_along(element.R_FD, law.rotational_damping,
                     law.translational_damping));
}

}  // namespace

SimbodyModel::SimbodyModel(const Mechanism& mechanism, JointModel joints)
    : mechanism_(mechanism),
      joints_(joints),
      matter_(system_),
      forces_(system_) {
  // The system owns the element; this is a handle.
  const SimTK::Force::UniformGravity gravity(forces_, matter_,
                                             to_simtk(mechanism.gravity_W));
  for (int i = 0; i < std::ssize(mechanism.bodies); ++i) {
    const bool is_free =
        joints != JointModel::ideal && stands_for_joint(mechanism, i);
    add_body(mechanism.bodies[static_cast<std::size_t>(i)], is_free);
  }
  for (const auto& element : mechanism.bushings) add_bushing(element);
  for (const auto& element : mechanism.universals) add_universal(element);
  for (const auto& element : mechanism.coordinates) add_coordinate(element);
  for (const auto& element : mechanism.springs) add_spring(element);
  add_loads();
  system_.realizeTopology();
}

const MobilizedBody& SimbodyModel::body(int index) const {
  if (index == kGround) return matter_.getGround();
  return bodies_.at(static_cast<std::size_t>(index));
}

MobilizedBody& SimbodyModel::body(int index) {
  if (index == kGround) return matter_.updGround();
  return bodies_.at(static_cast<std::size_t>(index));
}

SimbodyFrame SimbodyModel::frame(const MechanismFrame& frame) const {
  return {body(frame.body), to_simtk(frame.X_LF)};
}

void SimbodyModel::add_body(const MechanismBody& part, bool is_free) {
  bodies_.push_back(
      is_free ? MobilizedBody::Free(matter_.updGround(), make_rigid(part))
              : make_mobilized(body(part.parent), part));
}

void SimbodyModel::add_bushing(const BushingElement& element) {
  const SimbodyFrame F = frame(element.F);
  const SimbodyFrame M = frame(element.M);
  const bool is_joint = element.joint_of != kGround;
  if (joints_ == JointModel::linear_bushings) {
    couplers_.push_back(make_linear_bushing(forces_, F, M, element));
    return;
  }
  joints::Bushing::Parameters law = element.law;
  if (is_joint && joints_ == JointModel::ideal) {
    law = keep_free_damping(
        element, mechanism_.bodies[static_cast<std::size_t>(element.joint_of)]
                     .mobilizer);
    if (is_inert(law, element.law)) return;
  }
  couplers_.push_back(
      SimTK::Force::Custom(forces_, new ChordalBushing(F, M, law)));
}

void SimbodyModel::add_universal(const UniversalElement& element) {
  if (joints_ == JointModel::ideal) return;
  if (joints_ == JointModel::linear_bushings) {
    throw InputError(
        fmt::format("universal joint '{}' has no linear bushing: the body "
                    "between its axes rotates with both of its sides; compare "
                    "with --joints bushings or ideal",
                    element.name));
  }
  couplers_.push_back(SimTK::Force::Custom(
      forces_,
      new CrossBushing(frame(element.F), frame(element.M), element.law)));
}

void SimbodyModel::add_coordinate(const CoordinateElement& element) {
  couplers_.push_back(SimTK::Force::Custom(
      forces_,
      new CoordinateSpring(frame(element.F), frame(element.M), element)));
}

void SimbodyModel::add_spring(const SpringElement& element) {
  const SimbodyFrame F = frame(element.F);
  const SimbodyFrame M = frame(element.M);
  const joints::PointSpring::Parameters& law = element.law;
  couplers_.push_back(SimTK::Force::TwoPointLinearSpring(
      forces_, F.body, F.X_LF.p(), M.body, M.X_LF.p(), law.stiffness,
      law.free_length));
  const SimTK::Force::TwoPointLinearDamper damper(
      forces_, F.body, F.X_LF.p(), M.body, M.X_LF.p(), law.damping);
}

void SimbodyModel::add_loads() {
  for (const LoadElement& load : mechanism_.loads) {
    const SimTK::Force::Custom element(
        forces_, new TimedLoad(body(load.body), load, interval_));
  }
  for (const HistoryElement& load : mechanism_.histories) {
    const SimTK::Force::Custom element(
        forces_, new SteppedLoad(frame(load.B), load.history, interval_));
  }
}

State SimbodyModel::make_joint_start() const {
  State state = system_.getDefaultState();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const MechanismBody& part = mechanism_.bodies[i];
    if (joints_ != JointModel::ideal &&
        stands_for_joint(mechanism_, static_cast<int>(i))) {
      continue;
    }
    const Rotation slide = find_slide(part);
    bodies_[i].setQToFitTransform(
        state, Transform(~slide) * find_start_pose(part) * Transform(slide));
    const SpatialVec V = find_start_velocity(part);
    system_.realize(state, SimTK::Stage::Position);
    bodies_[i].setUToFitVelocity(state,
                                 SpatialVec(~slide * V[0], ~slide * V[1]));
  }
  return state;
}

State SimbodyModel::make_start() const {
  State state = make_joint_start();
  if (joints_ == JointModel::ideal) return state;
  const SimbodyModel jointed(mechanism_, JointModel::ideal);
  const State start = jointed.make_joint_start();
  jointed.system_.realize(start, SimTK::Stage::Velocity);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!stands_for_joint(mechanism_, static_cast<int>(i))) continue;
    const MobilizedBody& source = jointed.bodies_[i];
    bodies_[i].setQToFitTransform(state, source.getBodyTransform(start));
    system_.realize(state, SimTK::Stage::Position);
    bodies_[i].setUToFitVelocity(state, source.getBodyVelocity(start));
  }
  return state;
}

Snapshot SimbodyModel::observe(const State& state) const {
  system_.realize(state, SimTK::Stage::Velocity);
  Snapshot snapshot;
  snapshot.time = state.getTime();
  for (const MechanismFrame& observed : mechanism_.observed) {
    const SimbodyFrame B = frame(observed);
    const Rotation R_WB = B.body.getBodyRotation(state) * B.X_LF.R();
    dynamics::BodyState motion;
    motion.p_WB =
        from_simtk(B.body.findStationLocationInGround(state, B.X_LF.p()));
    motion.quat_WB = Quaternion(from_simtk(SimTK::Mat33(R_WB))).normalized();
    motion.v_WB_W =
        from_simtk(B.body.findStationVelocityInGround(state, B.X_LF.p()));
    motion.w_WB_B = from_simtk(~R_WB * B.body.getBodyAngularVelocity(state));
    snapshot.frames.push_back(motion);
  }
  snapshot.kinetic = system_.calcKineticEnergy(state);
  for (const SimTK::Force& element : couplers_) {
    snapshot.coupler += element.calcPotentialEnergyContribution(state);
  }
  return snapshot;
}

}  // namespace limber::reference
