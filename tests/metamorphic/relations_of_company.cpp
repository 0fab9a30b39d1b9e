// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "limber/joints/joint_kind.hpp"
#include "metamorphic/relation.hpp"

namespace limber::metamorphic {
namespace {

template <typename T>
void shuffle(std::vector<T>& list, RandomDraw& draw) {
  for (std::size_t i = list.size(); i > 1; --i) {
    std::swap(list[i - 1], list[static_cast<std::size_t>(
                               draw.integer(0, static_cast<int>(i) - 1))]);
  }
}

std::optional<Changed> reorder(const ScenePlan& plan, RandomDraw& draw) {
  Changed changed{.plan = plan};
  ScenePlan& p = changed.plan;
  std::vector<int> order(p.bodies.size());  // old indices
  std::iota(order.begin(), order.end(), 0);
  shuffle(order, draw);
  std::vector<int> to(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto from = static_cast<std::size_t>(order[i]);
    p.bodies[i] = plan.bodies[from];
    to[from] = static_cast<int>(i);
  }
  for_each_frame(p, [&](FramePlan& f) {
    if (f.body >= 0) f.body = to[static_cast<std::size_t>(f.body)];
  });
  shuffle(p.couplers, draw);
  shuffle(p.loads, draw);
  shuffle(p.controllers, draw);
  return changed;
}

// Of couplers whose law is the same from both sides, and tendons.
std::optional<Changed> swap_frames(const ScenePlan& plan, RandomDraw&) {
  Changed changed{.plan = plan};
  // Implicit schemes take a wrench's mean over a step in the axes of F.
  changed.steps = Changed::Steps::others;
  bool has_any = false;
  for (CouplerPlan& c : changed.plan.couplers) {
    if (!c.is_symmetric) continue;
    std::swap(c.F, c.M);
    has_any = true;
  }
  for (PathPlan& p : changed.plan.paths) {
    std::reverse(p.points.begin(), p.points.end());
    has_any = true;
  }
  if (!has_any) return {};
  return changed;
}

std::optional<Changed> add_twin(const ScenePlan& plan, RandomDraw&) {
  Changed changed{.plan = plan, .energies = Changed::Energies::none};
  changed.steps = Changed::Steps::same_without_events;
  ScenePlan twin = plan;
  const auto count = static_cast<int>(plan.bodies.size());
  const Vector3 aside(0.0, 10.0 * plan.bodies[0].length, 0.0);
  for (BodyPlan& b : twin.bodies) {
    b.name += "_twin";
    b.X_WB.p += aside;
  }
  for_each_frame(twin, [&](FramePlan& f) {
    if (f.body < 0) {
      f.X.p += aside;
    } else {
      f.body += count;
    }
  });
  const auto append = [](auto& list, const auto& more) {
    for (auto item : more) {
      item.name += "_twin";
      list.push_back(std::move(item));
    }
  };
  for (GearPlan& g : twin.gears) {
    for (std::string& joint : g.joints) joint += "_twin";
  }
  ScenePlan& p = changed.plan;
  p.bodies.insert(p.bodies.end(), twin.bodies.begin(), twin.bodies.end());
  append(p.couplers, twin.couplers);
  append(p.paths, twin.paths);
  append(p.gears, twin.gears);
  append(p.loads, twin.loads);
  append(p.controllers, twin.controllers);
  return changed;
}

// A body of 1000 t on a spring, 1 km away.
auto add_stranger(double speed) {
  return
      [=](const ScenePlan& plan, RandomDraw& draw) -> std::optional<Changed> {
        Changed changed{.plan = plan, .energies = Changed::Energies::none};
        changed.steps = Changed::Steps::same_if_fixed;
        BodyPlan body;
        body.name = "stranger";
        body.mass = 1e6;
        body.length = 10.0;
        body.X_WB.p = 1e3 * draw.direction();
        body.v_WB_W = speed * draw.direction();
        const auto index = static_cast<int>(plan.bodies.size());
        CouplerPlan hold;
        hold.name = "stranger_hold";
        hold.F = {-1, "", body.X_WB};
        hold.M = {index, "", {}};
        hold.law = [](const Manner&) -> joints::CouplerLaw {
          return joints::make_joint(
              joints::JointKind::fixed, Vector3::UnitZ(), Vector3::UnitX(),
              {.translational_stiffness = 1e6, .rotational_stiffness = 1e7});
        };
        changed.plan.bodies.push_back(std::move(body));
        changed.plan.couplers.push_back(std::move(hold));
        return changed;
      };
}

std::optional<Changed> add_probes(const ScenePlan& plan, RandomDraw& draw) {
  Changed changed{.plan = plan};
  // Tolerances are of all attachments.
  changed.steps = Changed::Steps::same_if_fixed;
  for (std::size_t b = 0; b < plan.bodies.size(); ++b) {
    const Vector3 place = plan.bodies[b].length * draw.direction();
    changed.plan.probes.push_back(
        {static_cast<int>(b), "", {draw.rotation(), place}});
    if (plan.bodies[b].modes > 0) {
      changed.plan.probes.push_back({static_cast<int>(b), "far", {}});
    }
  }
  return changed;
}

// Every rigid body in two halves on a stiff joint, which have its mass, centre
// and inertia together.
ScenePlan split(const ScenePlan& plan, double stiffness, double step) {
  ScenePlan halves = plan;
  for (std::size_t b = 0; b < plan.bodies.size(); ++b) {
    const BodyPlan& whole = plan.bodies[b];
    if (whole.modes > 0) continue;
    const auto upper = static_cast<int>(halves.bodies.size());
    const double arm = kHalfArm * whole.length;
    const auto make_half = [&](int half) {
      BodyPlan body = whole;
      const Vector3 place(0.0, 0.0, half * arm);
      body.half = half;
      body.mass = 0.5 * whole.mass;
      body.X_WB.p = whole.X_WB * place;
      body.v_WB_W += whole.X_WB.R * whole.w_WB_B.cross(place);
      return body;
    };
    halves.bodies[b] = make_half(-1);
    halves.bodies.push_back(make_half(1));
    halves.bodies.back().name += "_upper";
    for_each_frame(halves, [&](FramePlan& f) {
      if (f.body != static_cast<int>(b)) return;
      const bool is_upper = f.X.p.z() > 0.0;
      if (is_upper) f.body = upper;
      f.X.p.z() += is_upper ? -arm : arm;
    });
    for (ControllerPlan& c : halves.controllers) {
      if (c.where.body == static_cast<int>(b)) c.gain *= 2.0;  // per mass
    }
    CouplerPlan joint;
    joint.name = whole.name + "_joint";
    joint.F = {static_cast<int>(b), "", {Matrix3::Identity(), {0, 0, arm}}};
    joint.M = {upper, "", {Matrix3::Identity(), {0, 0, -arm}}};
    const double k = stiffness * whole.mass;
    const double c = 2.0 * step * k;  // explicit Euler needs as much
    joint.law = [=,
                 l = 0.2 * whole.length](const Manner&) -> joints::CouplerLaw {
      return joints::make_joint(joints::JointKind::fixed, Vector3::UnitZ(),
                                Vector3::UnitX(),
                                {.translational_stiffness = k,
                                 .rotational_stiffness = k * l * l,
                                 .translational_damping = c,
                                 .rotational_damping = c * l * l});
    };
    halves.couplers.push_back(std::move(joint));
  }
  return halves;
}

std::optional<Changed> split_links(const ScenePlan& plan, RandomDraw&) {
  const auto is_rigid = [](const BodyPlan& b) { return b.modes == 0; };
  if (std::none_of(plan.bodies.begin(), plan.bodies.end(), is_rigid)) return {};
  const double step = plan.settings.tolerance > 0.0
                          ? plan.settings.end_time / 96.0
                          : plan.settings.step;
  const double stiffness = 0.1 / (step * step);
  Changed changed{.plan = split(plan, stiffness, step)};
  changed.softer = split(plan, 0.1 * stiffness, step);
  changed.steps = Changed::Steps::others;
  changed.undo = [plan](Output& output) {
    for (std::size_t b = 0; b < plan.bodies.size(); ++b) {
      if (plan.bodies[b].modes > 0) continue;
      BodyMotion& body = output.bodies[b];
      const Vector3 place(0.0, 0.0, kHalfArm * plan.bodies[b].length);
      body.p_WB += body.R_WB * place;
      body.v_WB_W += body.R_WB * body.w_WB_B.cross(place);
    }
  };
  return changed;
}

std::optional<Changed> halve_outputs(const ScenePlan& plan, RandomDraw&) {
  Changed changed{.plan = plan};
  changed.steps = Changed::Steps::same_without_marks;
  std::vector<double>& times = changed.plan.settings.output_times;
  for (std::size_t i = 0; 2 * i < times.size(); ++i) times[i] = times[2 * i];
  times.resize((times.size() + 1) / 2);
  return changed;
}

}  // namespace

std::vector<Relation> relations_of_company() {
  return {{"Reordered", reorder},
          {"SwappedFrames", swap_frames},
          {"Twin", add_twin},
          {"Stranger", add_stranger(10.0)},
          {"FastStranger", add_stranger(5000.0)},
          {"Probed", add_probes},
          {"HalfTheOutputs", halve_outputs},
          {"SplitLinks", split_links}};
}

}  // namespace limber::metamorphic
