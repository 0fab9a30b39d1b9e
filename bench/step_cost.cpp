// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>

#include "dynamics/generalized_alpha.hpp"
#include "dynamics/runge_kutta.hpp"
#include "dynamics/system_builder.hpp"
#include "flexbody/reduce.hpp"
#include "joints/joint_kind.hpp"

/// What a step costs online: against the mesh, against the number of bodies.
namespace limber {
namespace {

using Body = std::shared_ptr<const flexbody::ReducedBody>;

constexpr double kStep = 1e-4;  // [s]

/// The report's beam, ten modes: four eigenmodes and its root's six
/// static-deformation modes.
Body reduce_beam(const std::string& mesh) {
  static std::map<std::string, Body> known;
  Body& body = known[mesh];
  if (body) return body;
  flexbody::Recipe recipe;
  recipe.name = "beam";
  recipe.mesh.file =
      std::string(LIMBER_SOURCE_DIR) + "/tests/data/beam/" + mesh;
  recipe.materials = {{"", {200e9, 0.0, 8000.0}}};
  recipe.interfaces = {{"root", flexbody::GroupNodes{"root"},
                        flexbody::Weighting::uniform, true},
                       {"tip", flexbody::GroupNodes{"tip"},
                        flexbody::Weighting::uniform, false}};
  recipe.basis.eigenmodes = 4;
  body = std::make_shared<const flexbody::ReducedBody>(reduce(recipe));
  return body;
}

struct Scene {
  dynamics::SystemModel model;
  dynamics::SystemState state;
};

/// Beams end to end on hinges with stiff bushings, spinning about the long
/// axis and swung at one end, so that every term of the equations is at work.
Scene make_chain(const Body& body, int count) {
  constexpr double kStiffness = 1e12;  // [N/m], [N m/rad]
  constexpr double kSwing = 1e5;       // [N]
  const flexbody::InterfaceTable& root = body->interfaces[0];
  const flexbody::InterfaceTable& tip = body->interfaces[1];
  const joints::Bushing hinge =
      joints::make_joint_bushing(joints::JointKind::revolute, Vector3::UnitX(),
                                 {.translational_stiffness = kStiffness,
                                  .rotational_stiffness = kStiffness,
                                  .translational_damping = 1e-5 * kStiffness,
                                  .rotational_damping = 1e-5 * kStiffness});
  dynamics::SystemBuilder builder;
  int last_tip = -1;
  for (int i = 0; i < count; ++i) {
    const int b = builder.add_flexible_body(
        "beam" + std::to_string(i), body, dynamics::Fidelity::coupled,
        {.rayleigh_stiffness = 1e-6, .ratios = {}});
    const int at_root = builder.attach_interface(
        "root" + std::to_string(i), b, root, {Matrix3::Identity(), root.p_B});
    if (i > 0) {
      builder.add_coupler("hinge" + std::to_string(i), hinge, last_tip,
                          at_root);
    } else {
      builder.add_load("swing", at_root, kSwing * Vector3::UnitY(),
                       Vector3::Zero(), dynamics::LoadFrame::world,
                       dynamics::Sinusoid{20.0});
    }
    last_tip = builder.attach_interface("tip" + std::to_string(i), b, tip,
                                        {Matrix3::Identity(), tip.p_B});
  }
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  for (int i = 0; i < count; ++i) {
    auto& b = scene.state.bodies[static_cast<std::size_t>(i)];
    b.p_WB = i * (tip.p_B - root.p_B);
    b.w_WB_B = Vector3(0.0, 0.0, 1.0);
  }
  return scene;
}

/// Steps without end; reports microseconds a body a step.
template <typename Integrator>
void time_steps(benchmark::State& state, Scene scene, Integrator& integrator,
                double step) {
  long iterations = 0;
  for (auto _ : state) {
    iterations +=
        integrator.step(scene.state, step, scene.state.t + step).iterations;
  }
  const auto bodies = static_cast<double>(scene.model.bodies.size());
  state.counters["newton"] = benchmark::Counter(
      static_cast<double>(iterations), benchmark::Counter::kAvgIterations);
  state.counters["s_per_body_step"] =
      benchmark::Counter(bodies, benchmark::Counter::kIsIterationInvariantRate |
                                     benchmark::Counter::kInvert);
}

void time_generalized_alpha(benchmark::State& state, const Body& body,
                            int count) {
  Scene scene = make_chain(body, count);
  dynamics::GeneralizedAlpha integrator(scene.model, {});
  integrator.start(scene.state, kStep);
  time_steps(state, scene, integrator, kStep);
}

void mesh_579_nodes(benchmark::State& state) {
  time_generalized_alpha(state, reduce_beam("beam579_v41.msh"), 1);
}
void mesh_29764_nodes(benchmark::State& state) {
  time_generalized_alpha(state, reduce_beam("beam30k_v41.msh"), 1);
}
void chain(benchmark::State& state) {
  time_generalized_alpha(state, reduce_beam("beam579_v41.msh"),
                         static_cast<int>(state.range(0)));
}
/// For comparison: four evaluations of the right-hand side, no Newton.
void explicit_beam(benchmark::State& state) {
  Scene scene = make_chain(reduce_beam("beam579_v41.msh"), 1);
  dynamics::RungeKutta4 integrator(scene.model);
  time_steps(state, scene, integrator, 1e-6);
}

BENCHMARK(mesh_579_nodes);
BENCHMARK(mesh_29764_nodes);
BENCHMARK(chain)->Arg(3)->Arg(10)->Arg(30)->Arg(100)->Arg(300);
BENCHMARK(explicit_beam);

}  // namespace
}  // namespace limber
