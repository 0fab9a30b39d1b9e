// SPDX-License-Identifier: BSD-3-Clause
#include "support/meshed_bodies.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/reduction/reduce.hpp"

namespace limber::testing {
namespace {

// tests/data/random_bodies; each 1 m long.
constexpr std::array kShapes = {"bar", "arc", "block"};

fem::TracedMesh read_shape(const std::string& name) {
  return fem::read_traced_mesh(std::string(LIMBER_SOURCE_DIR) +
                                   "/tests/data/random_bodies/" + name + ".geo",
                               {.order = 2});
}

flexbody::Recipe make_recipe(const flexbody::Material& material, int modes) {
  flexbody::Recipe recipe;
  recipe.name = "body";
  recipe.materials = {{"", material}};
  for (const char* name : {"near", "far"}) {
    recipe.interfaces.push_back(
        {name, flexbody::GroupNodes{name}, flexbody::Weighting::uniform});
  }
  recipe.basis.eigenmodes = modes;
  recipe.manifold = true;
  return recipe;
}

flexbody::ReducedBody reduce_shape(const fem::TracedMesh& mesh, int modes) {
  return flexbody::reduce(make_recipe({1.0, 0.3, 1.0}, modes),
                          std::make_shared<const fem::TracedMesh>(mesh));
}

// By how much a body is longer, heavier and faster than another of its shape.
struct Similarity {
  double length = 1.0;
  double mass = 1.0;
  double frequency = 1.0;
};

void scale(flexbody::InterfaceTable& table, const Similarity& by) {
  const double mode = 1.0 / std::sqrt(by.mass);
  table.p_B *= by.length;
  table.Phi_B *= mode;
  table.Psi_B *= mode / by.length;
  table.Phi2_B /= by.mass * by.length;
  table.Psi2_B /= by.mass * by.length * by.length;
  Vector6 unit;
  unit << Vector3::Ones(), Vector3::Constant(1.0 / by.length);
  table.flexibility = unit.asDiagonal() * table.flexibility *
                      unit.asDiagonal() /
                      (by.mass * by.frequency * by.frequency);
}

flexbody::ReducedBody scale(flexbody::ReducedBody body, const Similarity& by) {
  const double root_mass = std::sqrt(by.mass);
  body.mass *= by.mass;
  body.p_MoBcm_M *= by.length;
  body.size *= by.length;
  body.integrals.S0 *= by.mass * by.length * by.length;
  for (Matrix3& S1 : body.integrals.S1) S1 *= root_mass * by.length;
  body.levers.lumped *= by.mass * by.length;
  body.levers.consistent *= by.mass * by.length;
  body.levers.displacement *= by.length / (by.frequency * by.frequency);
  body.lambda *= by.frequency * by.frequency;
  body.rows.x_B *= by.length;
  body.rows.Phi_B /= root_mass;
  for (flexbody::InterfaceTable& table : body.interfaces) scale(table, by);
  body.manifold->Q *= by.frequency / (root_mass * by.length);
  body.manifold->Theta_B /= by.mass * by.length;
  return body;
}

// Its bodies with 1 to 8 eigenmodes, 1 m long.
std::vector<flexbody::ReducedBody> reduce_shapes(const char* name) {
  constexpr int kMostModes = 8;
  const fem::TracedMesh mesh = read_shape(name);
  std::vector<flexbody::ReducedBody> bodies;
  for (int modes = 1; modes <= kMostModes; ++modes) {
    bodies.push_back(reduce_shape(mesh, modes));
  }
  return bodies;
}

}  // namespace

BodyMaker make_meshed_bodies() {
  std::vector<std::vector<flexbody::ReducedBody>> shapes;
  for (const char* name : kShapes) shapes.push_back(reduce_shapes(name));
  return [shapes = std::move(shapes)](const BodyDraw& draw) {
    const flexbody::ReducedBody& body =
        shapes[draw.variant % shapes.size()]
              [static_cast<std::size_t>(draw.modes) - 1];
    return std::make_shared<const flexbody::ReducedBody>(
        scale(body, {draw.length, draw.mass / body.mass,
                     draw.lowest / std::sqrt(body.lambda.minCoeff())}));
  };
}

}  // namespace limber::testing
