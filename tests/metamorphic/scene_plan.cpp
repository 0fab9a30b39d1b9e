// SPDX-License-Identifier: BSD-3-Clause
#include "metamorphic/scene_plan.hpp"

#include <cstddef>
#include <map>
#include <utility>

#include "metamorphic/second_order.hpp"
#include "support/point_mass_body.hpp"

namespace limber::metamorphic {
namespace {

using dynamics::AttachmentIndex;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

void reflect(const Matrix3& M, testing::PointMassBody& body) {
  flexbody::ReducedBody& r = body.reduced;
  r.rows.x_B = M * r.rows.x_B;
  for (Eigen::Index i = 0; i < r.rows.x_B.cols(); ++i) {
    r.rows.Phi_B.middleRows<3>(3 * i) = M * r.rows.Phi_B.middleRows<3>(3 * i);
  }
  flexbody::InertiaShapeIntegrals& s = r.integrals;
  s.S0 = M * s.S0 * M;
  for (Matrix3& S : s.S1) S = M * S * M;
  for (Matrix3& S : s.S2) S = M * S * M;
  s.P = M * s.P;
}

std::shared_ptr<const flexbody::ReducedBody> make_points(const BodyPlan& plan,
                                                         const Manner& manner) {
  const double length = manner.length * plan.length;
  testing::PointMassBody points =
      testing::make_point_mass_body(14 + plan.modes, plan.modes, plan.mass,
                                    length, plan.lowest, plan.variant);
  points.reduced.size = {length / 3.0, length / 3.0, length};
  reflect(find_reflection(manner), points);
  const auto add = [&](const char* name, int first, int last) {
    flexbody::InterfaceTable table =
        testing::make_interface(points, first, last);
    table.name = name;
    points.reduced.interfaces.push_back(std::move(table));
  };
  add("near", 0, 5);
  add("far", 5, 10);
  if (plan.level == dynamics::Fidelity::nonlinear) {
    add_second_order(points.reduced, find_reflection(manner), length,
                     plan.variant);
  }
  return testing::share(points);
}

class Building {
 public:
  explicit Building(const ScenePlan& plan)
      : plan_(plan),
        manner_(plan.manner),
        M_(find_reflection(plan.manner)),
        L_(plan.manner.length) {}

  Scene build() {
    for (const BodyPlan& b : plan_.bodies) add(b);
    for (const CouplerPlan& c : plan_.couplers) add(c);
    for (const PathPlan& p : plan_.paths) add(p);
    for (const GearPlan& g : plan_.gears) add(g);
    for (const LoadPlan& l : plan_.loads) add(l);
    for (const ControllerPlan& c : plan_.controllers) add(c);
    for (const FramePlan& f : plan_.probes) attach("probe", f);
    builder_.set_gravity(L_ * M_ * plan_.gravity_W);
    Scene scene;
    scene.model = builder_.build();
    scene.state = make_start(scene.model);
    scene.settings = make_settings();
    return scene;
  }

 private:
  Pose reflect_pose(const Pose& X) const {
    return {M_ * X.R * M_, L_ * M_ * X.p};
  }

  void add(const BodyPlan& plan) {
    reduced_.emplace_back();
    if (plan.modes == 0) {
      const double l = L_ * plan.length;
      Vector3 square(0.09, 0.08, 0.02);  // of the radii of gyration
      if (plan.half != 0) square.head<2>().array() -= kHalfArm * kHalfArm;
      const Matrix3 J = (plan.mass * l * l * square).asDiagonal();
      bodies_.push_back(builder_.add_rigid_body(plan.name, {plan.mass, J}));
      return;
    }
    reduced_.back() = make_points(plan, manner_);
    dynamics::ModalDamping damping;
    damping.ratios = {plan.damping};
    bodies_.push_back(builder_.add_flexible_body(plan.name, reduced_.back(),
                                                 plan.level, damping));
  }

  AttachmentIndex attach(const std::string& name, const FramePlan& frame) {
    Pose X = reflect_pose(frame.X);
    if (frame.body < 0) return builder_.attach_world(name, X);
    const dynamics::BodyIndex body = bodies_[index(frame.body)];
    if (frame.interface.empty()) return builder_.attach_frame(name, body, X);
    const flexbody::ReducedBody& reduced = *reduced_[index(frame.body)];
    const flexbody::InterfaceTable& table =
        reduced.interfaces[frame.interface == "near" ? 0 : 1];
    X.p = table.p_B;
    return builder_.attach_interface(name, body, table, X);
  }

  void add(const CouplerPlan& plan) {
    const AttachmentIndex F = attach(plan.name + ".F", plan.F);
    const AttachmentIndex M = attach(plan.name + ".M", plan.M);
    couplers_[plan.name] =
        builder_.add_coupler(plan.name, plan.law(manner_), F, M);
  }

  void add(const PathPlan& plan) {
    std::vector<AttachmentIndex> points;
    for (const FramePlan& f : plan.points) {
      points.push_back(attach(plan.name, f));
    }
    builder_.add_path(plan.name, points, {plan.law(manner_)});
  }

  void add(const GearPlan& plan) {
    dynamics::JointSum sum;
    for (std::size_t i = 0; i < plan.joints.size(); ++i) {
      sum.terms.push_back({couplers_.at(plan.joints[i]), 0, plan.factors[i]});
    }
    builder_.add_joint_sum(plan.name, sum, {plan.law(manner_)});
  }

  void add(const LoadPlan& plan) {
    const double turn = M_.determinant();  // moments are axial vectors
    builder_.add_load(plan.name, attach(plan.name, plan.where),
                      L_ * M_ * plan.force, turn * L_ * L_ * M_ * plan.moment,
                      plan.frame, plan.function(manner_.delay));
  }

  void add(const ControllerPlan& plan) {
    const Vector3 axis = M_.determinant() * M_ * plan.axis;
    const auto input =
        static_cast<int>(builder_.add_input(plan.name, 0.0, plan.hold));
    const BodyPlan& body = plan_.bodies[index(plan.where.body)];
    const double l = L_ * body.length;
    builder_.add_load(plan.name, attach(plan.name, plan.where), Vector3::Zero(),
                      plan.gain * body.mass * l * l * axis,
                      dynamics::LoadFrame::body,
                      dynamics::InputFunction{input});
    const auto b = index(plan.where.body);
    dynamics::ControllerModel controller;
    controller.name = plan.name;
    controller.period = plan.period;
    controller.offset = manner_.delay;
    controller.writes = {input};
    controller.measures.push_back(
        {"spin", plan.name,
         [=](const dynamics::SystemModel&, const dynamics::SystemState& state) {
           return axis.dot(state.bodies[b].w_WB_B);
         }});
    controller.memory = {0.0};
    controller.law = std::make_shared<dynamics::FunctionController>(
        "proportional and filtered",
        [](const dynamics::ControllerView& view, std::span<double> memory,
           std::span<double> written) {
          memory[0] += 0.2 * (view.measured[0] - memory[0]);
          written[0] = -view.measured[0] - 0.5 * memory[0];
        });
    builder_.add_controller(controller);
  }

  dynamics::SystemState make_start(const dynamics::SystemModel& model) const {
    dynamics::SystemState state = dynamics::make_state(model);
    state.t = manner_.delay;
    for (std::size_t b = 0; b < plan_.bodies.size(); ++b) {
      const BodyPlan& plan = plan_.bodies[b];
      dynamics::BodyState& body = state.bodies[b];
      const Pose X = reflect_pose(plan.X_WB);
      body.p_WB = X.p;
      body.quat_WB = Quaternion(X.R);
      body.v_WB_W = L_ * M_ * plan.v_WB_W;
      body.w_WB_B = M_.determinant() * M_ * plan.w_WB_B;
      const int modes = model.bodies[b].modes;
      const int first = model.bodies[b].offset;
      state.eta.segment(first, modes) = L_ * plan.eta.head(modes);
      state.etadot.segment(first, modes) = L_ * plan.etadot.head(modes);
    }
    return state;
  }

  dynamics::SimulationSettings make_settings() const {
    dynamics::SimulationSettings settings = plan_.settings;
    settings.end_time += manner_.delay;
    for (double& t : settings.output_times) t += manner_.delay;
    settings.tolerance *= L_;
    return settings;
  }

  const ScenePlan& plan_;
  Manner manner_;
  Matrix3 M_;
  double L_;
  dynamics::SystemBuilder builder_;
  std::vector<dynamics::BodyIndex> bodies_;
  std::vector<std::shared_ptr<const flexbody::ReducedBody>> reduced_;
  std::map<std::string, dynamics::CouplerIndex> couplers_;
};

}  // namespace

Matrix3 find_reflection(const Manner& manner) {
  return Vector3(1.0, manner.is_mirrored ? -1.0 : 1.0, 1.0).asDiagonal();
}

Scene build(const ScenePlan& plan) { return Building(plan).build(); }

bool is_held(const ScenePlan& plan) {
  bool is = false;
  ScenePlan copy = plan;
  for_each_frame(copy, [&](const FramePlan& f) { is = is || f.body < 0; });
  return is;
}

}  // namespace limber::metamorphic
