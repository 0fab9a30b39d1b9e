// SPDX-License-Identifier: BSD-3-Clause
// Hits one end of a free steel beam for 10 ms and prints how that end moves.
#include <cstdio>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/reduction/reduce.hpp"

int main(int, char** argv) {
  using namespace limber;
  flexbody::Recipe recipe;
  recipe.mesh.file = argv[1];  // meshes/beam579.msh
  recipe.materials = {{"", {200e9, 0.0, 8000.0}}};
  recipe.interfaces = {{"tip", flexbody::GroupNodes{"tip"}}};
  const auto body = std::make_shared<flexbody::ReducedBody>(reduce(recipe));
  const Pose X_BT{Matrix3::Identity(), body->interfaces[0].p_B};
  dynamics::SystemBuilder scene;
  const auto beam =
      scene.add_flexible_body("beam", body, dynamics::Fidelity::coupled, {});
  const auto tip =
      scene.attach_interface("tip", beam, body->interfaces[0], X_BT);
  const dynamics::Pulse pulse{.duration = 0.01};
  scene.add_load("hit", tip, {1e4, 0, 0}, {0, 0, 0}, {}, pulse);
  const dynamics::SystemModel model = scene.build();
  dynamics::SystemState state = make_state(model);
  const dynamics::SimulationSettings settings{
      .end_time = 0.05, .step = 1e-4, .output_times = {0.01, 0.05}};
  simulate(model, state, settings, [&](auto& now, auto&) {
    const Vector3 p = find_frame_motion(model, now, tip).X_WF.p;
    std::printf("t = %.2f s  tip x = %.3e m\n", now.t, p.x());
  });
}
