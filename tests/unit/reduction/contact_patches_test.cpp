// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_patches.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <vector>

#include "limber/fem/mesh/mesh_reader.hpp"
#include "support/temporary_folder.hpp"

/// Patches on a plate of 8 x 6 x 2 cm in cells of 1 x 1 x 1 cm.
namespace limber::flexbody::contact_patches_test {
namespace {

constexpr double kCell = 0.01;  // m
const Vector3 kSize{0.08, 0.06, 0.02};

std::filesystem::path write_plate(int order) {
  std::filesystem::path file =
      limber::test::own_folder() / ("plate" + std::to_string(order) + ".geo");
  std::ofstream(file)
      << "Point(1) = {0, 0, 0};\n"
         "l[] = Extrude {0, 0.06, 0} { Point{1}; Layers{6}; };\n"
         "s[] = Extrude {0.08, 0, 0} { Line{l[1]}; Layers{8}; Recombine; };\n"
         "v[] = Extrude {0, 0, 0.02} { Surface{s[1]}; Layers{2}; Recombine; "
         "};\n"
         "Physical Surface(\"top\") = {v[0]};\n"
         "Physical Volume(\"plate\") = {v[1]};\n";
  return file;
}

struct Plate {
  explicit Plate(int order)
      : mesh(fem::read_mesh(write_plate(order), {0.0, order, 1.0})) {}

  [[nodiscard]] std::size_t find_point(const Vector3& x) const {
    std::size_t best = 0;
    for (std::size_t p = 0; p < mesh_surface.points.size(); ++p) {
      if ((mesh_surface.points[p].x - x).norm() <
          (mesh_surface.points[best].x - x).norm())
        best = p;
    }
    return best;
  }
  [[nodiscard]] ContactPatch make_patch(const Vector3& x, double b) const {
    const std::size_t p = find_point(x);
    fem::Surface centre = mesh_surface;
    centre.points = {mesh_surface.points[p]};
    return find_patches(mesh, centre, normals.col(static_cast<Eigen::Index>(p)),
                        VectorX::Constant(1, b))[0];
  }

  fem::Mesh mesh;
  fem::Surface mesh_surface = fem::make_surface(mesh, mesh.boundary_faces);
  Matrix3X normals = find_normals(mesh, mesh_surface);
};

const Plate& plate() {
  static const Plate made(2);
  return made;
}

/// w^T g of a scalar field.
template <typename Field>
double average(const ContactPatch& patch, const Field& field) {
  double sum = 0.0;
  for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
    sum += patch.weights[static_cast<Eigen::Index>(i)] *
           field(Vector3(plate().mesh.x.col(patch.nodes[i])));
  }
  return sum;
}

/// Second-order functions are exact for fields of second degree, whose means
/// under Hertz's pressure are known: x at the centre, r^2 = 2/5 b^2.
TEST(ContactPatches, HaveTheMomentsOfHertzsPressure) {
  for (const Vector3& x :
       {Vector3(0.04, 0.03, 0.02), Vector3(0.04, 0.025, 0.02),
        Vector3(0.045, 0.025, 0.02)}) {
    for (const double b : {0.5 * kCell, kCell, 2.3 * kCell}) {
      const ContactPatch patch = plate().make_patch(x, b);
      EXPECT_NEAR(patch.weights.sum(), 1.0, 1e-12);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(average(patch, [&](const Vector3& p) { return p[c]; }),
                    x[c], 2e-3 * b);
      }
      EXPECT_NEAR(
          average(patch,
                  [&](const Vector3& p) { return (p - x).squaredNorm(); }),
          0.4 * b * b, 0.01 * b * b);
    }
  }
}

TEST(ContactPatches, AtTheRimOfASurfaceAreHalfADisc) {
  const auto& mesh = plate().mesh;
  const fem::Surface top = fem::make_surface(
      mesh,
      fem::find_group_faces(mesh, mesh.groups[fem::find_group(mesh, "top")]));
  const auto n = static_cast<Eigen::Index>(top.points.size());
  const Vector3 x(0.0, 0.03, 0.02);
  const auto patches = find_patches(mesh, top, find_normals(mesh, top),
                                    VectorX::Constant(n, kCell));
  for (std::size_t p = 0; p < top.points.size(); ++p) {
    if ((top.points[p].x - x).norm() > 1e-9) continue;
    EXPECT_NEAR(patches[p].normal[2], 1.0, 1e-12);
    // Centroid of half a ball, since the pressure is a ball's height.
    EXPECT_NEAR(average(patches[p], [](const Vector3& q) { return q[0]; }),
                3.0 / 8.0 * kCell, 5e-3 * kCell);
    EXPECT_NEAR(average(patches[p], [](const Vector3& q) { return q[1]; }),
                x[1], 5e-3 * kCell);
  }
}

TEST(ContactPatches, DoNotReachThroughThePlateNorAroundItsEdge) {
  const double b = 1.5 * kSize[2];  // to the other side and beyond
  const ContactPatch patch = plate().make_patch({0.02, 0.03, 0.02}, b);
  EXPECT_GT(patch.nodes.size(), 50U);
  for (const int node : patch.nodes) {
    EXPECT_NEAR(plate().mesh.x(2, node), kSize[2], 1e-12);
  }
}

TEST(ContactPatches, OnAnEdgeOfTheBodyHaveTheMeanNormalAndBothFaces) {
  const ContactPatch patch = plate().make_patch({0.0, 0.03, 0.02}, kCell);
  const Vector3 mean = Vector3(-1.0, 0.0, 1.0).normalized();
  EXPECT_LT((patch.normal - mean).norm(), 1e-12);
  EXPECT_NEAR(average(patch, [](const Vector3& p) { return p[0]; }),
              kSize[2] - average(patch, [](const Vector3& p) { return p[2]; }),
              1e-3 * kCell);
  EXPECT_GT(average(patch, [](const Vector3& p) { return p[0]; }), 0.1 * kCell);
}

TEST(ContactRadii, AreTheEdgesUnlessTheBodyIsThinner) {
  const auto& [mesh, mesh_surface, normals] = plate();
  const VectorX radii = find_patch_radii(mesh, mesh_surface, normals);
  EXPECT_NEAR(radii.minCoeff(), kCell, 1e-9);
  EXPECT_NEAR(radii.maxCoeff(), kCell, 1e-9);
  fem::Mesh thin = mesh;
  const double thickness = 0.3 * kCell;
  thin.x.row(2) *= thickness / kSize[2];
  const fem::Surface thin_surface =
      fem::make_surface(thin, thin.boundary_faces);
  const VectorX thin_radii =
      find_patch_radii(thin, thin_surface, find_normals(thin, thin_surface));
  const auto p =
      static_cast<Eigen::Index>(plate().find_point({0.04, 0.03, kSize[2]}));
  EXPECT_NEAR(thin_radii[p], kMostOfThickness * thickness, 1e-9);
}

/// A field of any kind is constant, linear or quadratic within a patch of the
/// finest size, and a smaller patch is a point.
TEST(ContactPatches, OfVanishingSizeAreTheirNode) {
  const Vector3 x(0.04, 0.03, 0.02);
  const ContactPatch patch = plate().make_patch(x, 0.05 * kCell);
  const auto field = [](const Vector3& p) { return std::sin(100.0 * p[0]); };
  EXPECT_NEAR(average(patch, field), field(x), 2e-3);
}

TEST(ContactPatches, OfLinearElementsReproduceLinearFields) {
  const Plate linear(1);
  const ContactPatch patch = linear.make_patch({0.04, 0.03, 0.02}, 1.3 * kCell);
  Vector3 mean = Vector3::Zero();
  for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
    mean += patch.weights[static_cast<Eigen::Index>(i)] *
            linear.mesh.x.col(patch.nodes[i]);
  }
  EXPECT_LT((mean - Vector3(0.04, 0.03, 0.02)).norm(), 2e-3 * kCell);
}

}  // namespace
}  // namespace limber::flexbody::contact_patches_test
