// SPDX-License-Identifier: BSD-3-Clause
#include "support/random_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"
#include "support/draw_vector.hpp"
#include "support/point_mass_body.hpp"

namespace limber::testing {
namespace {

using dynamics::AttachmentIndex;

std::shared_ptr<const flexbody::ReducedBody> make_points(const BodyDraw& draw) {
  PointMassBody points =
      make_point_mass_body(14 + draw.modes, draw.modes, draw.mass, draw.length,
                           draw.lowest, draw.variant);
  points.reduced.size = {draw.length / 3.0, draw.length / 3.0, draw.length};
  const auto add = [&](const char* name, int first, int last) {
    flexbody::InterfaceTable table = make_interface(points, first, last);
    table.name = name;
    points.reduced.interfaces.push_back(std::move(table));
  };
  add("near", 0, 5);
  add("far", 5, 10);
  return share(points);
}

class SceneDraw {
 public:
  SceneDraw(unsigned seed, const RandomSceneOptions& options)
      : random_(seed), options_(options) {
    if (!options_.make_body) options_.make_body = make_points;
  }

  RandomScene draw() {
    const int bodies = draw_body_count();
    size_ = log_uniform(1e-3, 1e3);
    mass_ = log_uniform(1e-6, 1e6) * size_;
    frequency_ = log_uniform(1.0, 1e5);
    spin_ = chance(0.5) ? 0.0 : uniform(0.0, 3.0) * frequency_;
    push_fraction_ = std::min(0.4, 8.0 / bodies);  // each adds steps
    RandomScene scene;
    for (int b = 0; b < bodies; ++b) add_body(b);
    if (chance(0.5)) {
      const double g = log_uniform(1e-3, 1e2);
      builder_.set_gravity({0.0, 0.0, -g});
    }
    scene.model = builder_.build();
    scene.state = make_start(scene.model);
    scene.settings = draw_settings(bodies);
    return scene;
  }

 private:
  double uniform(double low, double high) {
    // Not std::uniform_real_distribution, which differs between libraries.
    return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  bool chance(double fraction) { return uniform(0.0, 1.0) < fraction; }
  int draw_int(int low, int high) {
    return low + static_cast<int>(uniform(0.0, 1.0) * (high - low + 1));
  }
  Vector3 draw_direction() {
    const Vector3 v = draw_vector([&] { return uniform(-1.0, 1.0); });
    return v.norm() > 0.1 ? Vector3(v.normalized()) : Vector3::UnitX();
  }

  int draw_body_count() {
    if (chance(0.02)) return draw_int(100, 1000);
    return static_cast<int>(log_uniform(1.0, 30.0));
  }

  void add_body(int b) {
    const std::string name = "body" + std::to_string(b);
    const double mass = mass_ * log_uniform(1e-3, 1e3);
    const double length = size_ * log_uniform(0.1, 10.0);
    const bool is_rigid = chance(0.3);
    dynamics::BodyIndex body;
    AttachmentIndex near;
    AttachmentIndex far;
    if (is_rigid) {
      const Matrix3 J = mass * length * length *
                        Vector3(0.09, 0.08, 0.02).asDiagonal().toDenseMatrix();
      body = builder_.add_rigid_body(name, {mass, J});
      near = builder_.attach_frame(
          name + "_near", body, {Matrix3::Identity(), {0, 0, -0.5 * length}});
      far = builder_.attach_frame(name + "_far", body,
                                  {Matrix3::Identity(), {0, 0, 0.5 * length}});
      near_.emplace_back(0.0, 0.0, -0.5 * length);
      far_.emplace_back(0.0, 0.0, 0.5 * length);
    } else {
      const int modes = draw_int(1, 8);
      const auto reduced = options_.make_body(
          {modes, mass, length, frequency_ * log_uniform(0.3, 3.0),
           static_cast<unsigned>(b % 7)});
      using dynamics::Fidelity;
      const Fidelity drawn = chance(0.6)   ? Fidelity::coupled
                             : chance(0.5) ? Fidelity::one_way
                                           : Fidelity::uncoupled;
      dynamics::ModalDamping damping;
      if (chance(0.5)) damping.ratios = {log_uniform(1e-4, 1e2)};
      body = builder_.add_flexible_body(
          name, reduced, options_.level.value_or(drawn), damping);
      const auto attach = [&](const char* end, std::vector<Vector3>& places) {
        const flexbody::InterfaceTable& table =
            reduced->interfaces[find_interface(*reduced, end)];
        places.push_back(table.p_B);
        return builder_.attach_interface(name + "_" + end, body, table,
                                         {Matrix3::Identity(), table.p_B});
      };
      near = attach("near", near_);
      far = attach("far", far_);
    }
    place(b);
    join(b, name, near);
    ends_.push_back(far);
    if (chance(push_fraction_)) push(name, far, mass);
  }

  // Its near end at its parent's far end.
  void place(int b) {
    parents_.push_back(b == 0 || chance(0.8) ? b - 1 : draw_int(0, b - 1));
    const int parent = parents_.back();
    const Vector3 at =
        parent < 0 ? Vector3(Vector3::Zero())
                   : Vector3(p_WB_[index(parent)] + far_[index(parent)]);
    p_WB_.emplace_back(at - near_.back());
  }

  void join(int b, const std::string& name, AttachmentIndex near) {
    const int parent = parents_.back();
    if (parent < 0 && chance(0.5)) return;  // free in space
    const AttachmentIndex to = parent < 0
                                   ? builder_.attach_world("ground" + name, {})
                                   : ends_[index(parent)];
    const double k = log_uniform(1e2, 1e14);
    const double damping = chance(0.4) ? 0.0 : k * log_uniform(1e-9, 1e-1);
    joints::JointParameters parameters{
        .translational_stiffness = k,
        .rotational_stiffness = k * (chance(0.5) ? 1.0 : size_ * size_),
        .translational_damping = damping,
        .rotational_damping = damping * (chance(0.5) ? 1.0 : size_ * size_)};
    using joints::JointKind;
    const JointKind kind = static_cast<JointKind>(draw_int(0, 7));
    const Vector3 axis = draw_direction();
    const Vector3 second = axis.unitOrthogonal();
    std::vector<joints::JointElement> elements;
    const int coordinates =
        static_cast<int>(joints::find_coordinates(kind, axis, second).size());
    for (int i = 0; i < coordinates; ++i) {
      if (chance(0.5)) elements.push_back({i, draw_law()});
    }
    builder_.add_coupler(
        "joint" + std::to_string(b),
        joints::make_joint(kind, axis, second, parameters, elements), to, near);
  }

  joints::Signal draw_sine() {
    joints::SineSignal sine;
    sine.amplitude = uniform(0.0, 0.5);
    sine.frequency = log_uniform(0.01, 100.0);
    joints::Signal signal;
    signal.base = sine;
    return signal;
  }

  joints::ScalarLaw draw_law() {
    const double scale = mass_ * size_;
    switch (draw_int(0, 3)) {
      case 0:
        return joints::ScalarSpring(
            {.curve = joints::SpringCurve(
                 {.stiffness = log_uniform(1e-3, 1e6) * scale}),
             .damping = chance(0.5) ? 0.0 : log_uniform(1e-6, 1e3) * scale});
      case 1:
        return joints::Friction({.coulomb = log_uniform(1e-6, 1e1) * scale,
                                 .viscous = log_uniform(1e-6, 1e1) * scale,
                                 .speed = log_uniform(1e-4, 1e-1)});
      case 2: {
        const double gap = log_uniform(1e-3, 1.0);
        return joints::EndStop({.lower = -gap,
                                .upper = gap,
                                .stiffness = log_uniform(1e0, 1e9) * scale,
                                .damping = uniform(0.0, 1.0)});
      }
      default:
        return joints::Drive({.mode = joints::DriveMode::position,
                              .signal = draw_sine(),
                              .stiffness = log_uniform(1e0, 1e9) * scale,
                              .damping = log_uniform(1e-3, 1e3) * scale});
    }
  }

  void push(const std::string& name, AttachmentIndex where, double mass) {
    dynamics::Pulse pulse;
    pulse.shape = static_cast<dynamics::PulseShape>(draw_int(0, 2));
    pulse.start = chance(0.5) ? 0.0 : log_uniform(1e-6, 1.0);
    pulse.duration = log_uniform(1e-6, 1e2);
    const double force = mass * log_uniform(1e-3, 1e4);
    const auto frame =
        chance(0.5) ? dynamics::LoadFrame::body : dynamics::LoadFrame::world;
    builder_.add_load("push_" + name, where, force * draw_direction(),
                      Vector3::Zero(), frame, pulse);
  }

  // In line, all turning as one about the first one's centre.
  dynamics::SystemState make_start(const dynamics::SystemModel& model) {
    dynamics::SystemState state = dynamics::make_state(model);
    const Vector3 spin = spin_ * draw_direction();
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      dynamics::BodyState& body = state.bodies[b];
      body.p_WB = p_WB_[b];
      body.w_WB_B = spin;
      body.v_WB_W = spin.cross(p_WB_[b] - p_WB_[0]);
      if (!chance(0.1)) continue;
      const double extra = log_uniform(1e-3, 1e2);
      body.w_WB_B += extra * draw_direction();
    }
    return state;
  }

  dynamics::SimulationSettings draw_settings(int bodies) {
    dynamics::SimulationSettings settings;
    settings.integrator =
        chance(0.6)
            ? dynamics::IntegratorKind::generalized_alpha
            : static_cast<dynamics::IntegratorKind>(draw_int(
                  0,
                  static_cast<int>(dynamics::integrator_names().size()) - 1));
    settings.rho_inf = uniform(0.0, 1.0);
    settings.step = log_uniform(1e-6, 1e-1);
    // As many steps as 20 ms of work allow, about.
    const double steps = std::max(2.0, log_uniform(2.0, 4e3) / bodies);
    settings.end_time = steps * settings.step;
    settings.output_times = {0.0, 0.5 * settings.end_time, settings.end_time};
    if (settings.integrator == dynamics::IntegratorKind::generalized_alpha &&
        chance(0.05) && bodies <= 5) {
      settings.tolerance = size_ * log_uniform(1e-4, 1e-1);
      settings.end_time = log_uniform(1.0, 20.0) / frequency_;
      settings.step = settings.end_time;
      settings.output_times = {0.0, settings.end_time};
    }
    return settings;
  }

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  std::mt19937 random_;
  RandomSceneOptions options_;
  dynamics::SystemBuilder builder_;
  double size_ = 1.0;
  double mass_ = 1.0;
  double frequency_ = 1.0;
  double spin_ = 0.0;
  double push_fraction_ = 0.0;
  std::vector<Vector3> near_;
  std::vector<Vector3> far_;
  std::vector<Vector3> p_WB_;
  std::vector<int> parents_;
  std::vector<AttachmentIndex> ends_;
};

}  // namespace

RandomScene draw_scene(unsigned seed, const RandomSceneOptions& options) {
  return SceneDraw(seed, options).draw();
}

}  // namespace limber::testing
