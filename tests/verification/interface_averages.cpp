// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/system/nodal_frame.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/reduction/full_body_maker.hpp"
#include "limber/reduction/modal/interfaces.hpp"
#include "limber/reduction/reduce.hpp"
#include "places.hpp"
#include "verification/body_reference.hpp"

/// The motion of an interface against the rigid motion that its nodes make.
namespace limber::interface_averages {
namespace {

using flexbody::Interface;
using flexbody::NodeSelection;

constexpr double kRoundoff = 1e-13;

const Vector3 kShift(0.3, -0.2, 0.7);  // [m]
const Vector3 kTurn(0.4, -0.9, 0.25);  // [rad]

/// The lower link of the arm: a tube along x with a bore of 16 mm through
/// each lug, about y, the first at the origin.
const std::filesystem::path kLink =
    LIMBER_SOURCE_DIR "/meshes/capture_lower_link.geo";
constexpr double kPin = 0.008;  // radius [m]

struct Case {
  std::string name;
  NodeSelection nodes;
  int rank;
  Vector3 line;  ///< about which no rotation is defined; zero at rank 3
};

void expect_rigid_motion(const fem::Mesh& mesh, const Case& test) {
  SCOPED_TRACE(test.name);
  flexbody::Recipe recipe;
  recipe.interfaces = {{"seat", test.nodes}};
  const Interface seat = flexbody::find_interfaces(mesh, recipe).front();
  ASSERT_EQ(seat.motion.rotation_rank(), test.rank);
  MatrixX field(3, mesh.x.cols());
  for (Eigen::Index n = 0; n < field.cols(); ++n) {
    field.col(n) = kShift + kTurn.cross(Vector3(mesh.x.col(n)));
  }
  const Vector6 motion = seat.motion.apply(field.reshaped());
  const Vector3 p = seat.motion.mean_point();
  const double size = kShift.norm() + kTurn.norm() * mesh.size().norm();
  EXPECT_LT((motion.head<3>() - kShift - kTurn.cross(p)).norm(),
            kRoundoff * size);
  // Rounding of positions over the lever that measures the turn.
  const double lever = (mesh.x(Eigen::all, seat.selection.nodes).colwise() - p)
                           .colwise()
                           .norm()
                           .maxCoeff();
  const Vector3 defined = kTurn - kTurn.dot(test.line) * test.line;
  EXPECT_LT((motion.tail<3>() - defined).norm(), kRoundoff * size / lever);
}

TEST(InterfaceAverage, OfPlanesAndCylindersIsTheRigidMotionOfTheirNodes) {
  const fem::Mesh link = fem::read_mesh(kLink);
  const Vector3 y = Vector3::UnitY();
  expect_rigid_motion(link, {"bore", flexbody::make_cylinder(-y, y, kPin, 0.0),
                             3, Vector3::Zero()});
  expect_rigid_motion(
      link, {"side of the tube", flexbody::make_plane({0, 0.025, 0}, y, 0.0), 3,
             Vector3::Zero()});
}

TEST(InterfaceAverage, OfALineIsTheRigidMotionButItsTurnAboutTheLine) {
  const fem::Mesh beam = fem::read_mesh(test::beam_file("beam579_v41.msh"));
  const Vector3 z = Vector3::UnitZ();
  expect_rigid_motion(beam, {"tip", flexbody::make_plane({0, 0, 5}, z, 0.0), 3,
                             Vector3::Zero()});
  expect_rigid_motion(
      beam,
      {"edge", flexbody::make_cylinder({1, 1, 0}, {1, 1, 5}, 0.01, 0.0), 2, z});
  // The plane touches the beam along one edge alone.
  expect_rigid_motion(
      beam, {"edge by a plane", flexbody::make_plane({1, 1, 0}, {1, 1, 0}, 0.0),
             2, z});
}

/// Edges are straight, so the middles of a bore's edges lie inside its radius:
/// why the cylinder is filled.
TEST(InterfaceSelection, CylinderOfAPinIsTheGroupOfItsBore) {
  const fem::Mesh link = fem::read_mesh(kLink);
  flexbody::Recipe recipe;
  const Vector3 y = Vector3::UnitY();
  recipe.interfaces = {{"group", flexbody::GroupNodes{"root"}},
                       {"cylinder", flexbody::make_cylinder(-y, y, kPin, 0.0)}};
  const auto found = flexbody::find_interfaces(link, recipe);
  EXPECT_GT(found[0].selection.nodes.size(), 30U);
  EXPECT_EQ(found[0].selection.nodes, found[1].selection.nodes);
  EXPECT_LT((found[0].selection.weights - found[1].selection.weights).norm(),
            1e-12);
}

TEST(InterfaceSelection, PlaneOfATipHasTheTableOfItsGroup) {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
  recipe.basis.eigenmodes = 6;
  recipe.interfaces = {
      {"group", flexbody::GroupNodes{"tip"}},
      {"plane", flexbody::make_plane({0, 0, 5}, {0, 0, 1}, 0.0)}};
  const auto body = flexbody::reduce(recipe);
  const auto& group = body.interfaces.at(0);
  const auto& plane = body.interfaces.at(1);
  EXPECT_LT((group.p_B - plane.p_B).norm(), 1e-12);
  EXPECT_LT((group.Phi_B - plane.Phi_B).norm(), 1e-12 * group.Phi_B.norm());
  EXPECT_LT((group.Psi_B - plane.Psi_B).norm(), 1e-12 * group.Psi_B.norm());
}

/// At level full a turn of any size.
TEST(InterfaceAverage, OfAPlaneFollowsAFiniteRotationAtLevelFull) {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
  recipe.interfaces = {
      {"tip", flexbody::make_plane({0, 0, 5}, {0, 0, 1}, 0.0)}};
  const auto body = flexbody::make_full_body(recipe, {});
  const dynamics::NodalFrame frame = dynamics::make_nodal_frame(
      *body, find_node_set(*body, "tip"), Vector3(0, 0, 2.5));
  for (const double angle : {1e-3, 1.0, 0.9 * std::numbers::pi}) {
    const Matrix3 R = exp_rotation(angle * kTurn.normalized());
    const Matrix3X u = ((R * body->x_B).colwise() + kShift) - body->x_B;
    const Matrix3X udot = Matrix3X::Zero(3, u.cols());
    dynamics::NodalFrameMotion motion;
    calc_nodal_frame(frame, dynamics::ConstNodes(u.data(), 3, u.cols()),
                     dynamics::ConstNodes(udot.data(), 3, u.cols()), motion);
    EXPECT_LT((motion.R_HB - R).norm(), 1e-13);
    EXPECT_LT((motion.p_H - R * Vector3(0, 0, 2.5) - kShift).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace limber::interface_averages
