// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/power.hpp"

#include <fmt/format.h>

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

void check_sizes(const MeshedBody& body, const BodyMotion& motion) {
  const Eigen::Index dofs = body.support.matrices.dof_count();
  for (const VectorX* field :
       {&motion.qdot, &motion.qddot, &motion.x, &motion.xdot, &motion.xddot})
    LIMBER_EXPECT(field->size() == dofs);
}

VectorX multiply_mass(const MeshedBody& body, const VectorX& a) {
  return fem::multiply_mass(body.support.matrices.M_s, a);
}

VectorX multiply_stiffness(const MeshedBody& body, const VectorX& x) {
  return fem::multiply_stiffness(body.support.matrices, x);
}

}  // namespace

LoadSplit split_load(const MeshedBody& body, const MatrixX& F) {
  const Support& support = body.support;
  LIMBER_EXPECT(F.rows() == support.matrices.dof_count());
  if (!F.allFinite())
    throw InputError(
        fmt::format("{}: a nodal force is not finite; expected numbers [N].",
                    body.mesh.source));
  const MatrixX acceleration = support.R * (support.R.transpose() * F);
  LoadSplit split;
  split.parallel = fem::multiply_mass(support.matrices.M_s, acceleration);
  split.perpendicular = F - split.parallel;
  return split;
}

BodyEnergy calc_energy(const MeshedBody& body, const BodyMotion& motion) {
  check_sizes(body, motion);
  return {0.5 * motion.qdot.dot(multiply_mass(body, motion.qdot)),
          0.5 * motion.xdot.dot(multiply_mass(body, motion.xdot)),
          0.5 * motion.x.dot(multiply_stiffness(body, motion.x))};
}

PowerBalance calc_power(const MeshedBody& body, const VectorX& F,
                        const BodyMotion& motion, const Friction& friction) {
  check_sizes(body, motion);
  const LoadSplit split = split_load(body, F);
  const VectorX drag = multiply_damping(body, friction, motion.qdot);
  const VectorX damping = multiply_damping(body, friction, motion.xdot);
  PowerBalance power;
  power.into_motion = split.parallel.col(0).dot(motion.qdot);
  power.into_deformation = split.perpendicular.col(0).dot(motion.xdot);
  power.rigid = motion.qdot.dot(multiply_mass(body, motion.qddot));
  power.swing = motion.xdot.dot(multiply_mass(body, motion.xddot));
  power.elastic = motion.xdot.dot(multiply_stiffness(body, motion.x));
  power.rigid_friction = motion.qdot.dot(drag);
  power.internal_friction =
      motion.xdot.dot(drag + damping) + motion.qdot.dot(damping);
  return power;
}

}  // namespace limber::flexbody
