// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "metamorphic/relation.hpp"

namespace limber::metamorphic {
namespace {

constexpr double kMillimetre = 1000.0;  // of a metre

// The scene as a whole moved by a pose, and what happens in it moved back.
Changed move(ScenePlan plan, const Pose& X) {
  for (BodyPlan& b : plan.bodies) {
    b.X_WB = X * b.X_WB;
    b.v_WB_W = X.R * b.v_WB_W;
  }
  for_each_frame(plan, [&](FramePlan& f) {
    if (f.body < 0) f.X = X * f.X;
  });
  for (LoadPlan& l : plan.loads) {
    if (l.frame == dynamics::LoadFrame::body) continue;
    l.force = X.R * l.force;
    l.moment = X.R * l.moment;
  }
  plan.gravity_W = X.R * plan.gravity_W;
  Changed changed{.plan = std::move(plan)};
  changed.place = X.p.norm();
  changed.undo = [back = X.inverse()](Output& output) {
    for (BodyMotion& b : output.bodies) {
      b.p_WB = back * b.p_WB;
      b.R_WB = back.R * b.R_WB;
      b.v_WB_W = back.R * b.v_WB_W;
    }
  };
  return changed;
}

std::optional<Changed> rotate(const ScenePlan& plan, RandomDraw& draw) {
  return move(plan, {draw.rotation(), Vector3::Zero()});
}

auto shift_by(double distance) {
  return
      [=](const ScenePlan& plan, RandomDraw& draw) -> std::optional<Changed> {
        return move(plan, {Matrix3::Identity(), distance * draw.direction()});
      };
}

auto boost_by(double speed) {
  return
      [=](const ScenePlan& plan, RandomDraw& draw) -> std::optional<Changed> {
        if (is_held(plan)) return {};
        const Vector3 v = speed * draw.direction();
        Changed changed{.plan = plan};
        for (BodyPlan& b : changed.plan.bodies) b.v_WB_W += v;
        changed.place = speed * plan.settings.end_time;
        changed.speed = speed;
        changed.energies = Changed::Energies::strain;
        changed.undo = [v](Output& output) {
          for (BodyMotion& b : output.bodies) {
            b.p_WB -= output.t * v;
            b.v_WB_W -= v;
          }
        };
        return changed;
      };
}

std::optional<Changed> mirror(const ScenePlan& plan, RandomDraw& /*draw*/) {
  for (const CouplerPlan& c : plan.couplers) {
    if (!c.has_mirror_image) return {};
  }
  Changed changed{.plan = plan};
  changed.plan.manner.is_mirrored = true;
  changed.undo = [M = find_reflection(changed.plan.manner)](Output& output) {
    for (BodyMotion& b : output.bodies) {
      b.p_WB = M * b.p_WB;
      b.R_WB = M * b.R_WB * M;
      b.v_WB_W = M * b.v_WB_W;
      b.w_WB_B = -M * b.w_WB_B;
    }
  };
  return changed;
}

auto delay_by(double time) {
  return [=](const ScenePlan& plan, RandomDraw&) -> std::optional<Changed> {
    Changed changed{.plan = plan};
    changed.plan.manner.delay = time;
    // A rounded time is a place further on, at the speed of the motion.
    const Magnitude size = measure(plan, run(plan));
    changed.place = time * size.speed;
    changed.speed = changed.place / plan.settings.end_time;
    changed.undo = [time](Output& output) { output.t -= time; };
    return changed;
  };
}

std::optional<Changed> use_millimetres(const ScenePlan& plan, RandomDraw&) {
  Changed changed{.plan = plan};
  changed.plan.manner.length = kMillimetre;
  changed.undo = [](Output& output) {
    for (BodyMotion& b : output.bodies) {
      b.p_WB /= kMillimetre;
      b.v_WB_W /= kMillimetre;
      b.eta /= kMillimetre;
      b.etadot /= kMillimetre;
    }
    dynamics::EnergyBalance& e = output.energy;
    for (double* x : {&e.kinetic_rigid, &e.kinetic_modal, &e.elastic,
                      &e.coupler, &e.dissipated, &e.work}) {
      *x /= kMillimetre * kMillimetre;
    }
  };
  return changed;
}

}  // namespace

std::vector<Relation> relations_of_frame() {
  return {{"Rotated", rotate},
          {"ShiftedByAKilometre", shift_by(1e3)},
          {"ShiftedByAThousandKilometres", shift_by(1e6)},
          {"Boosted", boost_by(7500.0)},
          {"Mirrored", mirror},
          {"Delayed", delay_by(1e3)},
          {"InMillimetres", use_millimetres}};
}

}  // namespace limber::metamorphic
