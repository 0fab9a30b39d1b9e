// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_frames.hpp"

namespace limber::contact {

SideFrames::SideFrames(const std::vector<PatchPart>& parts,
                       const joints::PairBody& body)
    : parts_(parts), is_shared_(!parts.front().has_own_frame()) {
  const std::size_t count = is_shared_ ? 1 : parts.size();
  for (std::size_t i = 0; i < count; ++i) {
    frames_.add() = parts[i].find_motion(body);
  }
}

ConvexSolid::Ball SideFrames::find_ball() const {
  ConvexSolid::Ball ball;
  for (std::size_t i = 0; i < count(); ++i) ball.centre += find_centre(i);
  ball.centre /= static_cast<double>(count());
  for (std::size_t i = 0; i < count(); ++i) {
    ball.radius = std::max(ball.radius,
                           (find_centre(i) - ball.centre).norm() + radius(i));
  }
  return ball;
}

void PatchFrames::choose(const SideFrames& side, const ConvexSolid::Ball& other,
                         double reach, Chosen& out) {
  for (std::size_t i = 0; i < side.count(); ++i) {
    const double distance = (side.find_centre(i) - other.centre).norm() -
                            side.radius(i) - other.radius;
    if (distance <= reach) out.add() = i;
  }
}

double PatchFrames::find_distance(std::size_t i, std::size_t j) const {
  return (B.find_centre(j) - A.find_centre(i)).norm() - A.radius(i) -
         B.radius(j);
}

}  // namespace limber::contact
