// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patch_slip.hpp"

#include <Eigen/Geometry>

namespace limber::contact {

using joints::PairBodies;
using joints::PairBody;

Vector6 find_twist(const PairBodies& parts, const Vector3& about_W) {
  const auto spin = [](const PairBody& body) -> Vector3 {
    return body.R_WB * body.w_WB_B;
  };
  const auto speed = [&](const PairBody& body) -> Vector3 {
    return body.v_WB_W + spin(body).cross(about_W - body.p_WB);
  };
  Vector6 twist;
  twist << speed(parts.B) - speed(parts.A), spin(parts.B) - spin(parts.A);
  return twist;
}

PatchSlip find_slip(const PairBodies& parts, const PatchMemory& memory,
                    const Vector3& normal_W) {
  PatchSlip slip;
  if (!memory.is_touching) return slip;
  const auto place = [](const PairBody& body, const Vector3& x) -> Vector3 {
    return body.p_WB + body.R_WB * x;
  };
  slip.way_W = place(parts.B, memory.x_B) - place(parts.A, memory.x_A);
  const Matrix3 turn_A = parts.A.R_WB.transpose() * parts.B.R_WB *
                         memory.turn_AB.toRotationMatrix().transpose();
  const Eigen::AngleAxisd turn(turn_A);
  slip.turn = normal_W.dot(parts.A.R_WB * (turn.angle() * turn.axis()));
  // In the mean of both bodies' rotations since then.
  slip.spring_W =
      0.5 * (parts.A.R_WB * memory.spring_A + parts.B.R_WB * memory.spring_B);
  slip.spin = memory.spin;
  slip.stiffness = memory.stiffness;
  return slip;
}

PatchMemory remember(const PairBodies& parts, const Vector3& p_W, double t,
                     const PatchSlip& slip) {
  PatchMemory memory;
  memory.is_touching = true;
  memory.time = t;
  memory.x_A = parts.A.R_WB.transpose() * (p_W - parts.A.p_WB);
  memory.x_B = parts.B.R_WB.transpose() * (p_W - parts.B.p_WB);
  memory.turn_AB = Quaternion(Matrix3(parts.A.R_WB.transpose() * parts.B.R_WB));
  memory.spring_A = parts.A.R_WB.transpose() * slip.spring_W;
  memory.spring_B = parts.B.R_WB.transpose() * slip.spring_W;
  memory.spin = slip.spin;
  memory.stiffness = slip.stiffness;
  return memory;
}

double find_spring_energy(const PatchMemory& memory) {
  if (!(memory.stiffness > 0.0)) return 0.0;
  return 0.5 * (memory.spring_A.squaredNorm() + memory.spin * memory.spin) /
         memory.stiffness;
}

}  // namespace limber::contact
