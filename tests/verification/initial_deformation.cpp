// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "verification/beam_scene.hpp"
#include "verification/shear_load.hpp"

/// Bodies that start deformed and moving.
namespace limber::initial_deformation {
namespace {

using flexbody::ReducedBody;
using test::beam;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Of products of M-norms with sums of a thousand terms.
constexpr double kRoundoff = 1e-11;

std::vector<int> moving_nodes(bool is_clamped) {
  if (is_clamped) return test::free_nodes(beam());
  std::vector<int> nodes(beam().node_count());
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = static_cast<int>(i);
  return nodes;
}

/// The lowest mode shapes on the nodes that move, 3n x count.
MatrixX mode_shapes(int count, bool is_clamped) {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh", is_clamped);
  recipe.basis.eigenmodes = count;
  recipe.rows = flexbody::parse_rows({"all"});
  const ReducedBody body = flexbody::reduce(recipe);
  const std::vector<int> nodes = moving_nodes(is_clamped);
  MatrixX Phi(3 * static_cast<Eigen::Index>(nodes.size()), count);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    Phi.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        body.rows.Phi_B.middleRows<3>(3 * nodes[i]);
  return Phi;
}

/// The beam with six modes and an initial velocity.
ReducedBody reduce_with(const VectorX& velocity, bool is_clamped,
                        const std::string& rows = "interfaces") {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh", is_clamped);
  recipe.basis.eigenmodes = 6;
  recipe.initial_velocity = {"velocity.txt", velocity};
  recipe.rows = flexbody::parse_rows({rows});
  return flexbody::reduce(recipe);
}

TEST(InitialDeformation, OfAModeShapeIsThatMode) {
  for (const bool is_clamped : {false, true}) {
    const MatrixX Phi = mode_shapes(6, is_clamped);
    for (const Eigen::Index k : {0, 5}) {
      const auto field =
          *reduce_with(0.02 * Phi.col(k), is_clamped).initial.velocity;
      EXPECT_NEAR((field.eta - 0.02 * VectorX::Unit(6, k)).norm(), 0.0,
                  kRoundoff);
      EXPECT_NEAR(field.missed_fraction, 0.0, 1e-7);  // root of roundoff
      EXPECT_NEAR(field.rigid_fraction, 0.0, kRoundoff);
    }
  }
}

// 0.6 and 0.8 of two M-orthonormal shapes, one of them not in the basis.
TEST(InitialDeformation, TellsWhatTheBasisMisses) {
  const MatrixX Phi = mode_shapes(9, false);
  const auto field =
      *reduce_with(0.6 * Phi.col(0) + 0.8 * Phi.col(8), false).initial.velocity;
  EXPECT_NEAR(field.missed_fraction, 0.8, 1e-9);
  EXPECT_NEAR(field.eta[0], 0.6, 1e-9);
  EXPECT_THAT(describe_losses(field, "initial velocity"),
              ElementsAre(HasSubstr("80 % of the initial velocity")));
}

TEST(InitialDeformation, LeavesRigidMotionToTheBodyFrame) {
  const Vector3 v(1.0, -2.0, 0.5);
  const Vector3 w(0.3, 0.1, -0.7);
  VectorX field(3 * static_cast<Eigen::Index>(beam().node_count()));
  for (Eigen::Index n = 0; n < beam().x.cols(); ++n)
    field.segment<3>(3 * n) = v + w.cross(Vector3(beam().x.col(n)));
  const auto rigid = *reduce_with(field, false).initial.velocity;
  // Of the field's norm, sqrt(40000 kg) times metres a second.
  EXPECT_NEAR(rigid.eta.norm(), 0.0, 1e-12 * 200.0 * 10.0);
  EXPECT_NEAR(rigid.rigid_fraction, 1.0, kRoundoff);
  EXPECT_EQ(rigid.missed_fraction, 0.0);
  EXPECT_THAT(describe_losses(rigid, "initial velocity"),
              ElementsAre(HasSubstr("100 % of the initial velocity")));
  // Half of it in norm beside as much of a mode: 1 / sqrt(2).
  const MatrixX Phi = mode_shapes(1, false);
  const double size = 200.0 * v.norm();
  const VectorX translation = v.replicate(beam().node_count(), 1);
  const auto mixed =
      *reduce_with(translation + size * Phi.col(0), false).initial.velocity;
  EXPECT_NEAR(mixed.rigid_fraction, std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(mixed.eta[0] / size, 1.0, 1e-9);
}

// A clamped body has no rigid motion: all of a uniform field is deformation.
TEST(InitialDeformation, OfAClampedBodyHasNoRigidShare) {
  const VectorX field = VectorX::Ones(
      3 * static_cast<Eigen::Index>(test::free_nodes(beam()).size()));
  const auto found = *reduce_with(field, true).initial.velocity;
  EXPECT_EQ(found.rigid_fraction, 0.0);
  EXPECT_GT(found.missed_fraction, 0.1);
  EXPECT_GT(found.eta.norm(), 100.0);
}

TEST(InitialDeformation, DoesNotDependOnTheRowsThatAreKept) {
  VectorX field(3 * static_cast<Eigen::Index>(beam().node_count()));
  for (Eigen::Index i = 0; i < field.size(); ++i)
    field[i] = std::sin(static_cast<double>(i));
  const auto all = *reduce_with(field, false, "all").initial.velocity;
  for (const char* rows : {"boundary", "tip", "interfaces"}) {
    const auto few = *reduce_with(field, false, rows).initial.velocity;
    EXPECT_EQ(all.eta, few.eta) << rows;
    EXPECT_EQ(all.missed_fraction, few.missed_fraction) << rows;
  }
}

/// The scene with files for the start of its link.
scene::Scene deformed_scene(const test::SceneBench& bench, bool is_clamped,
                            const VectorX& u, const VectorX& v) {
  scene::Scene scene = test::beam_scene(is_clamped);
  scene.scenario.fidelity = dynamics::Fidelity::uncoupled;
  scene::LinkStart& start = scene.scenario.link_starts["beam"];
  start.displacement = bench.write("u.txt", u);
  if (v.size() > 0) start.velocity = bench.write("v.txt", v);
  return scene;
}

// eta_k = c cos(omega_k t). Fourth-order Runge-Kutta: a phase error of
// (omega h)^5 / 120 a step.
TEST(InitialDeformation, SwingsFreelyAsACosine) {
  constexpr double c = 1e-3;
  for (const bool is_clamped : {false, true}) {
    const test::SceneBench bench;
    const VectorX shape = mode_shapes(6, is_clamped).col(2);
    const scene::BuiltScene built =
        bench.build(deformed_scene(bench, is_clamped, c * shape, {}));
    EXPECT_THAT(built.warnings, IsEmpty());
    dynamics::SystemState state = built.initial;
    dynamics::simulate(built.model, state, built.settings, {});
    const double omega = std::sqrt(built.model.bodies[0].reduced->lambda[2]);
    const double steps = built.settings.end_time / built.settings.step;
    const double error =
        steps * std::pow(omega * built.settings.step, 5) / 120.0;
    ASSERT_GT(omega * built.settings.end_time, 6.0);  // about a period
    EXPECT_NEAR(state.eta[2] / c, std::cos(omega * built.settings.end_time),
                2.0 * error + 1e-10);
    EXPECT_NEAR(state.etadot[2] / (c * omega),
                -std::sin(omega * built.settings.end_time),
                2.0 * error + 1e-10);
  }
}

// u^T K u / 2 and v^T M v / 2 by the finite elements themselves.
TEST(InitialDeformation, StartsWithItsElasticAndKineticEnergy) {
  const test::SceneBench bench;
  const MatrixX Phi = mode_shapes(6, false);
  VectorX a(6), b(6);
  a << 1, -2, 3, 0.5, 0.1, -1;
  b << -200, 100, 0, 50, 30, 400;
  const VectorX u = Phi * a;
  const VectorX v = Phi * b;
  const scene::BuiltScene built =
      bench.build(deformed_scene(bench, false, u, v));
  const auto energy = dynamics::calc_energy(built.model, built.initial);
  const fem::StructuralMatrices matrices = fem::assemble(
      beam(), fem::assign_materials(beam(), {{"", {200e9, 0.0, 8000.0}}}));
  const double elastic =
      0.5 * u.dot(VectorX(fem::multiply_stiffness(matrices.K, u)));
  const double kinetic =
      0.5 * v.dot(VectorX(fem::multiply_mass(matrices.M_s, v)));
  EXPECT_NEAR(energy.elastic / elastic, 1.0, 1e-9);
  EXPECT_NEAR(energy.kinetic_modal / kinetic, 1.0, 1e-9);
  EXPECT_EQ(energy.kinetic_rigid, 0.0);
}

TEST(InitialDeformation, ByModesPadsWithZeros) {
  const test::SceneBench bench;
  scene::Scene scene = test::beam_scene();
  scene.scenario.link_starts["beam"] = {{1.0, 2.0}, {0.0, 0.0, 3.0}, {}, {}};
  const auto state = bench.build(scene).initial;
  EXPECT_THAT(state.eta, ElementsAre(1.0, 2.0, 0.0, 0.0, 0.0, 0.0));
  EXPECT_THAT(state.etadot, ElementsAre(0.0, 0.0, 3.0, 0.0, 0.0, 0.0));
}

std::string error_of(const test::SceneBench& bench, const scene::Scene& scene) {
  try {
    static_cast<void>(bench.build(scene));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(InitialDeformation, ByMoreModesThanThereAreIsRefused) {
  const test::SceneBench bench;
  scene::Scene scene = test::beam_scene();
  scene.scenario.link_starts["beam"].eta.assign(7, 1.0);
  EXPECT_THAT(error_of(bench, scene),
              HasSubstr("[initial.links.beam]: 7 modal coordinates; the body "
                        "has 6 modes"));
}

TEST(InitialDeformation, OfARigidLinkIsAWarning) {
  const test::SceneBench bench;
  scene::Scene scene = test::beam_scene();
  scene.scenario.fidelity = dynamics::Fidelity::rigid;
  scene.scenario.link_starts["beam"].eta = {1.0};
  EXPECT_THAT(bench.build(scene).warnings,
              ElementsAre(HasSubstr("link 'beam' is rigid in this run")));
}

TEST(InitialDeformation, BeyondTheBasisIsAWarningOfTheScene) {
  const test::SceneBench bench;
  const MatrixX Phi = mode_shapes(9, false);
  const auto built = bench.build(deformed_scene(bench, false, Phi.col(8), {}));
  EXPECT_THAT(built.warnings,
              ElementsAre(HasSubstr("link 'beam': 100 % of the initial "
                                    "displacement")));
}

TEST(InitialDeformation, OfAnotherMeshOrNotFiniteIsRefused) {
  const test::SceneBench bench;
  scene::Scene scene = test::beam_scene(true);
  scene.scenario.link_starts["beam"].displacement =
      bench.write("u.txt", VectorX::Ones(7));
  EXPECT_THAT(error_of(bench, scene),
              HasSubstr("u.txt: 7 rows; expected 1626"));
  scene.scenario.link_starts["beam"].displacement =
      bench.write("u.txt", VectorX::Constant(1626, std::nan("")));
  EXPECT_THAT(error_of(bench, scene), HasSubstr("u.txt:1: value 1: 'nan'"));
}

/// A scene whose link is a saved reduced body with few rows.
scene::Scene saved_scene(const test::SceneBench& bench,
                         const ReducedBody& body) {
  flexbody::write_body(body, bench.path() / "body.h5");
  scene::Scene scene = test::beam_scene();
  scene::FlexibleLink& link = *scene.robot.links[0].flexible;
  link.mesh.file.clear();
  link.reduced_file = bench.path() / "body.h5";
  return scene;
}

TEST(InitialDeformation, OfASavedBodyMustBeProjectedBeforeItsRowsAreDropped) {
  const test::SceneBench bench;
  const VectorX field = mode_shapes(6, false).col(1);
  const ReducedBody body = reduce_with(field, false);
  scene::Scene scene = saved_scene(bench, body);
  scene::LinkStart& start = scene.scenario.link_starts["beam"];
  start.velocity = bench.write("velocity.txt", field);
  EXPECT_EQ(bench.build(scene).initial.etadot, body.initial.velocity->eta);
  start.displacement = start.velocity;
  EXPECT_THAT(error_of(bench, scene),
              AllOf(HasSubstr("holds no initial displacement"),
                    HasSubstr("limber reduce --initial-displacement")));
  start.displacement.clear();
  start.velocity = bench.write("velocity.txt", 2.0 * field);
  EXPECT_THAT(error_of(bench, scene),
              HasSubstr("was made with another initial velocity"));
}

}  // namespace
}  // namespace limber::initial_deformation
