// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_slip.hpp"

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

PatchSlip find_slip(const PairBodies& parts, const PatchMemory& memory) {
  PatchSlip slip{.last = memory.friction,
                 .rotations = {parts.A.R_WB, parts.B.R_WB}};
  if (!memory.is_touching) return slip;
  const auto place = [](const PairBody& body, const Vector3& x) -> Vector3 {
    return body.p_WB + body.R_WB * x;
  };
  slip.way_W = place(parts.B, memory.x_B) - place(parts.A, memory.x_A);
  return slip;
}

PatchMemory remember(const PairBodies& parts, const Vector3& p_W, double t,
                     const FrictionMemory& friction) {
  PatchMemory memory;
  memory.is_touching = true;
  memory.time = t;
  memory.x_A = parts.A.R_WB.transpose() * (p_W - parts.A.p_WB);
  memory.x_B = parts.B.R_WB.transpose() * (p_W - parts.B.p_WB);
  memory.friction = friction;
  return memory;
}

}  // namespace limber::contact
