// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/hold_watch.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/overloaded.hpp"

namespace limber::dynamics {
namespace {

double find_largest(const Matrix3& stiffness) {
  return stiffness.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff();
}

// From an attachment, of the body that it is on [m].
double find_size(const SystemModel& model, AttachmentIndex from) {
  const Attachment& a = model.attachments[static_cast<std::size_t>(from)];
  if (a.body == kWorld) return std::numeric_limits<double>::infinity();
  const BodyModel& body = model.bodies[static_cast<std::size_t>(a.body)];
  double size = std::sqrt(find_largest(body.J0) / body.mass);
  for (const Attachment& other : model.attachments) {
    if (other.body == a.body) {
      size = std::max(size, (other.p_BF - a.p_BF).norm());
    }
  }
  return size;
}

double find_give(const joints::Bushing& hold, double stiffness,
                 const joints::RelativeMotion& motion) {
  const Vector3 force =
      hold.parameters().translational_stiffness * motion.p_FM_F;
  return force.norm() / stiffness;
}

double find_give(const joints::UniversalHold& /*hold*/, double /*stiffness*/,
                 const joints::RelativeMotion& motion) {
  return motion.p_FM_F.norm();
}

// theta^2 / 2 of a rotation by small angles.
double find_turn(const joints::Bushing& hold, double stiffness,
                 const joints::RelativeMotion& motion) {
  const Matrix3& Kr = hold.parameters().rotational_stiffness;
  const Matrix3 D = 0.5 * Kr.trace() * Matrix3::Identity() - Kr;
  const double energy = (D * (Matrix3::Identity() - motion.R_FM)).trace();
  return std::sqrt(2.0 * std::max(energy, 0.0) / stiffness);
}

double find_turn(const joints::UniversalHold& hold, double /*stiffness*/,
                 const joints::RelativeMotion& motion) {
  const auto& p = hold.parameters();
  return std::abs(p.axis_F.dot(motion.R_FM * p.axis_M));
}

const joints::Joint::Hold& hold_of(const SystemModel& model, std::size_t c) {
  return std::get<joints::Joint>(model.couplers[c].law).hold();
}

}  // namespace

HoldWatch::HoldWatch(const SystemModel& model) : model_(model) {
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const Coupler& coupler = model.couplers[c];
    if (!std::holds_alternative<joints::Joint>(coupler.law)) continue;
    Hold hold;
    hold.coupler = c;
    const double size_F = find_size(model, coupler.frame_F);
    const double size_M = find_size(model, coupler.frame_M);
    hold.size = std::min(size_F, size_M);
    const AttachmentIndex frame =
        size_F < size_M ? coupler.frame_F : coupler.frame_M;
    const BodyIndex body =
        model.attachments[static_cast<std::size_t>(frame)].body;
    if (body == kWorld || !(hold.size > 0.0)) continue;
    hold.body = static_cast<std::size_t>(body);
    std::visit(Overloaded{[&](const joints::Bushing& law) {
                            const auto& p = law.parameters();
                            hold.stiffness =
                                find_largest(p.translational_stiffness);
                            hold.turning_stiffness =
                                find_largest(p.rotational_stiffness);
                          },
                          [&](const joints::UniversalHold& law) {
                            const auto& p = law.parameters();
                            hold.stiffness = p.translational_stiffness;
                            hold.turning_stiffness = p.rotational_stiffness;
                          }},
               hold_of(model, c));
    holds_.push_back(hold);
  }
}

void HoldWatch::include(const SystemTerms& terms, double t) {
  for (Hold& hold : holds_) {
    const joints::RelativeMotion& motion = terms.couplers[hold.coupler].motion;
    std::visit(
        [&](const auto& law) {
          const double give = hold.stiffness > 0.0
                                  ? find_give(law, hold.stiffness, motion)
                                  : 0.0;
          if (give > hold.give) {
            hold.give = give;
            hold.give_time = t;
          }
          const double turn =
              hold.turning_stiffness > 0.0
                  ? find_turn(law, hold.turning_stiffness, motion)
                  : 0.0;
          if (turn > hold.turn) {
            hold.turn = turn;
            hold.turn_time = t;
          }
        },
        hold_of(model_, hold.coupler));
  }
}

std::string HoldWatch::describe(const Hold& hold) const {
  const std::string& joint = model_.couplers[hold.coupler].name;
  const std::string& body = model_.bodies[hold.body].name;
  if (hold.give / hold.size >= hold.turn) {
    const double share = hold.give / hold.size;
    return fmt::format(
        "joint '{}' gives way by {:.3g} m at t = {:.6g} s in directions that "
        "it holds, {:.3g} % of the size of body '{}' ({:.3g} m); a "
        "translational stiffness of {:.2g} N/m in place of {:.2g} N/m would "
        "hold it to 0.1 %",
        joint, hold.give, hold.give_time, 100.0 * share, body, hold.size,
        hold.stiffness * share / kLargest, hold.stiffness);
  }
  return fmt::format(
      "joint '{}' gives way by {:.3g} rad at t = {:.6g} s about directions "
      "that it holds, which moves body '{}' ({:.3g} m) by {:.3g} m; a "
      "rotational stiffness of {:.2g} N m/rad in place of {:.2g} N m/rad would "
      "hold it to 0.1 % of the body's size",
      joint, hold.turn, hold.turn_time, body, hold.size, hold.turn * hold.size,
      hold.turning_stiffness * hold.turn / kLargest, hold.turning_stiffness);
}

std::vector<std::string> HoldWatch::find_warnings() const {
  std::vector<std::string> warnings;
  for (const Hold& hold : holds_) {
    if (std::max(hold.give / hold.size, hold.turn) > kLargest) {
      warnings.push_back(describe(hold));
    }
  }
  return warnings;
}

void HoldWatch::exchange_memory(Archive& archive) {
  for (Hold& hold : holds_) {
    archive(hold.give, hold.turn, hold.give_time, hold.turn_time);
  }
}

}  // namespace limber::dynamics
