// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/joints/joint_kind.hpp"

/// What Newton's matrix costs where many couplers hold one body: each another
/// body to it, or all the same.
namespace limber {
namespace {

using dynamics::NewtonMatrix;

joints::Joint make_hinge() {
  return joints::make_joint(joints::JointKind::revolute, Vector3::UnitX(),
                            Vector3::UnitY(),
                            {.translational_stiffness = 1e8,
                             .rotational_stiffness = 1e6,
                             .translational_damping = 1e3,
                             .rotational_damping = 1e1,
                             .free_damping = 0.1},
                            {});
}

/// A rigid panel with `count` flaps on hinges along its edge.
dynamics::SystemModel make_panel(int count) {
  dynamics::SystemBuilder builder;
  const Matrix3 inertia = Vector3(1.0, 2.0, 2.5).asDiagonal();
  const auto panel = builder.add_rigid_body("panel", {10.0, inertia});
  for (int i = 0; i < count; ++i) {
    const auto flap = builder.add_rigid_body(fmt::format("flap {}", i),
                                             {1.0, 0.01 * inertia});
    const Pose edge{Matrix3::Identity(), Vector3(0.1 * i, 0.5, 0.0)};
    const Pose end{Matrix3::Identity(), Vector3(0.0, -0.1, 0.0)};
    builder.add_coupler(fmt::format("hinge {}", i), make_hinge(),
                        builder.attach_frame("edge", panel, edge),
                        builder.attach_frame("end", flap, end));
  }
  return builder.build();
}

/// A rigid panel on `count` hinges along the edge of another.
dynamics::SystemModel make_pair(int count) {
  dynamics::SystemBuilder builder;
  const Matrix3 inertia = Vector3(1.0, 2.0, 2.5).asDiagonal();
  const auto base = builder.add_rigid_body("base", {10.0, inertia});
  const auto panel = builder.add_rigid_body("panel", {5.0, inertia});
  for (int i = 0; i < count; ++i) {
    const Pose edge{Matrix3::Identity(), Vector3(0.1 * i, 0.5, 0.0)};
    const Pose end{Matrix3::Identity(), Vector3(0.1 * i, -0.5, 0.0)};
    builder.add_coupler(fmt::format("hinge {}", i), make_hinge(),
                        builder.attach_frame("edge", base, edge),
                        builder.attach_frame("end", panel, end));
  }
  return builder.build();
}

void factor_and_solve(benchmark::State& state,
                      dynamics::SystemModel (*make)(int count)) {
  const dynamics::SystemModel model = make(static_cast<int>(state.range(0)));
  const dynamics::SystemState at = dynamics::make_state(model);
  dynamics::SystemTerms terms = dynamics::make_terms(model);
  calc_terms(model, at, Side::right, terms);
  const std::vector<Vector3> turns(model.bodies.size(), Vector3::Zero());
  const VectorX residual = VectorX::Ones(count_unknowns(model));
  VectorX x;
  NewtonMatrix matrix(model);
  for (auto _ : state) {
    matrix.factor(model, at, terms, turns, {4e6, 2e3});
    matrix.solve(model, terms, residual, x);
    benchmark::DoNotOptimize(x.data());
  }
  state.SetComplexityN(state.range(0));
}

void set_counts(benchmark::internal::Benchmark* of) {
  for (const int count : {6, 12, 25, 50, 100, 200, 400}) of->Arg(count);
  of->Complexity()->Unit(benchmark::kMicrosecond);
}
BENCHMARK_CAPTURE(factor_and_solve, flaps, make_panel)->Apply(set_counts);
BENCHMARK_CAPTURE(factor_and_solve, hinges, make_pair)->Apply(set_counts);

}  // namespace
}  // namespace limber
