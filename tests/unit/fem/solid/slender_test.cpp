// SPDX-License-Identifier: BSD-3-Clause
// Bars up to 1000 times as long as thick: their matrices, modes and solutions.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "limber/common/errors.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/conditioning.hpp"
#include "limber/fem/solid/eigenmodes.hpp"
#include "limber/fem/solid/stiffness_product.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::slender_test {
namespace {

using testing::BoxKind;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::write_file;

const ElasticMaterial kSteel{210e9, 0.3, 7850.0};

struct Bar {
  double length = 1.0;      ///< [m]
  double width = 1e-3;      ///< along y [m]
  double thickness = 1e-3;  ///< along z [m]
  int layers = 60;
  double unit = 1.0;  ///< of the mesh [m]
  int order = 2;
};

std::filesystem::path write_bar(const Bar& bar) {
  const double half = 0.5 * bar.width / bar.unit;
  const double top = 0.5 * bar.thickness / bar.unit;
  return write_file(
      fmt::format("bar{}_{}.geo", bar.order, bar.unit),
      fmt::format(
          "Point(1) = {{0, {}, {}}};\n"
          "l[] = Extrude {{0, {}, 0}} {{ Point{{1}}; Layers{{1}}; }};\n"
          "s[] = Extrude {{0, 0, {}}} {{ Line{{l[1]}}; Layers{{1}}; Recombine; "
          "}};\n"
          "b[] = Extrude {{{}, 0, 0}} {{ Surface{{s[1]}}; Layers{{{}}}; "
          "Recombine; }};\n"
          "Physical Surface(\"root\") = {{s[1]}};\n"
          "Physical Surface(\"tip\") = {{b[0]}};\n"
          "Physical Volume(\"body\") = {{b[1]}};\n",
          -half, -top, 2.0 * half, 2.0 * top, bar.length / bar.unit,
          bar.layers));
}

/// A bar, free or clamped at its root, and its solutions.
class Slender {
 public:
  Slender(const Bar& bar, bool is_clamped)
      : mesh_(
            read_mesh(write_bar(bar), {.order = bar.order, .unit = bar.unit})),
        matrices_(assemble(mesh_, {kSteel})),
        x_(mesh_.x),
        R_(make_rigid_modes(matrices_.M_s, x_)),
        tip_(mesh_.groups[find_group(mesh_, "tip")].nodes) {
    if (!is_clamped) return;
    const std::vector<int> free =
        find_free_nodes(mesh_, mesh_.groups[find_group(mesh_, "root")].nodes);
    for (int& node : tip_) {
      node = static_cast<int>(std::lower_bound(free.begin(), free.end(), node) -
                              free.begin());
    }
    matrices_ = restrict_to(matrices_, free);
    x_ = mesh_.x(Eigen::all, free);
    R_.resize(matrices_.dof_count(), 0);
  }

  [[nodiscard]] ElasticInverse inverse() const { return {matrices_, R_, x_}; }
  [[nodiscard]] const StructuralMatrices& matrices() const { return matrices_; }
  [[nodiscard]] const MatrixX& R() const { return R_; }

  /// Unit forces on the tip along x, y, z.
  [[nodiscard]] MatrixX tip_forces() const {
    MatrixX F = MatrixX::Zero(matrices_.dof_count(), 3);
    for (const int node : tip_)
      for (int c = 0; c < 3; ++c)
        F(3 * node + c, c) = 1.0 / static_cast<double>(tip_.size());
    return F;
  }

 private:
  Mesh mesh_;
  StructuralMatrices matrices_;
  Matrix3X x_;
  MatrixX R_;
  std::vector<int> tip_;
};

/// Roots of the frequency equation of Euler and Bernoulli's beam.
using Roots = std::array<double, 5>;
constexpr Roots kClamped{1.87510407, 4.69409113, 7.85475744, 10.99554073,
                         14.13716839};
constexpr Roots kFree{4.73004074, 7.85320462, 10.99560784, 14.13716549,
                      17.27875966};

double bending_eigenvalue(const Bar& bar, double root, double depth) {
  return kSteel.youngs_modulus * depth * depth / (12.0 * kSteel.density) *
         std::pow(root / bar.length, 4);
}

void expect_bending_modes(const Bar& bar, bool is_clamped, double tolerance) {
  SCOPED_TRACE(fmt::format("order {}, unit {} m, {}", bar.order, bar.unit,
                           is_clamped ? "clamped" : "free"));
  constexpr int kCount = 24;
  const Slender body(bar, is_clamped);
  const Eigenmodes modes = find_eigenmodes(body.inverse(), kCount);
  for (const double depth : {bar.width, bar.thickness})
    for (const double root : is_clamped ? kClamped : kFree) {
      const double expected = bending_eigenvalue(bar, root, depth);
      const double off =
          (modes.lambda.array() / expected - 1.0).abs().minCoeff();
      EXPECT_LT(off, tolerance) << "root " << root << ", depth " << depth;
    }
  const MatrixX M_Phi = multiply_mass(body.matrices().M_s, modes.Phi);
  EXPECT_LT((modes.Phi.transpose() * M_Phi - MatrixX::Identity(kCount, kCount))
                .cwiseAbs()
                .maxCoeff(),
            1e-11);
  EXPECT_LT((body.R().transpose() * M_Phi).norm(), 1e-11);
}

/// 1:1000. Shear and rotary inertia take 1e-4 of the fifth mode, Poisson's
/// ratio at the clamp as little. The rest is the mesh's: elements 17 times as
/// long as thick, and a clamp whose strain reaches over one of them.
TEST(SlenderBar, HasTheBendingModesOfABeam) {
  for (const bool is_clamped : {false, true}) {
    for (const double unit : {1.0, 1e-3})
      expect_bending_modes({.unit = unit}, is_clamped, 1e-2);
    expect_bending_modes({.layers = 40, .order = 3}, is_clamped,
                         is_clamped ? 3e-3 : 1e-4);
  }
}

/// A blade of steel, 1 m x 20 mm x 4 mm. Shear and rotary inertia take 4 % of
/// the eigenvalue of the fifth mode across its width.
TEST(SlenderBar, ABladeHasTheBendingModesOfABeam) {
  for (const bool is_clamped : {false, true})
    expect_bending_modes({.width = 0.02, .thickness = 0.004, .layers = 60},
                         is_clamped, 0.04);
}

/// Elements of first order lock: stiffer than a beam, but solvable.
TEST(SlenderBar, OfFirstOrderIsStifferThanABeam) {
  const Bar bar{.layers = 200, .order = 1};
  const Slender body(bar, true);
  const double first = find_eigenmodes(body.inverse(), 2).lambda[0];
  EXPECT_GT(first, bending_eigenvalue(bar, kClamped[0], bar.thickness));
  const MatrixX X = body.inverse().solve(body.tip_forces());
  EXPECT_GT(X.norm(), 0.0);
}

/// F L^3 / (3 E I), F L / (E A).
TEST(SlenderBar, BendsUnderATipForceAsABeam) {
  for (const double unit : {1.0, 1e-3}) {
    const Bar bar{.unit = unit};
    const Slender body(bar, true);
    const MatrixX F = body.tip_forces();
    const MatrixX compliance = F.transpose() * body.inverse().solve(F);
    const double area = bar.width * bar.thickness;
    const double inertia = bar.width * std::pow(bar.thickness, 3) / 12.0;
    const double bending =
        std::pow(bar.length, 3) / (3.0 * kSteel.youngs_modulus * inertia);
    const double stretching = bar.length / (kSteel.youngs_modulus * area);
    // The mesh's error: a quarter of it on 250 layers instead of 60.
    EXPECT_NEAR(compliance(0, 0) / stretching, 1.0, 1e-3);
    EXPECT_NEAR(compliance(1, 1) / bending, 1.0, 3e-3);
    EXPECT_NEAR(compliance(2, 2) / bending, 1.0, 3e-3);
    // By symmetry the solutions are uncoupled.
    EXPECT_LT(std::abs(compliance(1, 2)), 1e-9 * bending);
    EXPECT_LT(std::abs(compliance(0, 2)), 1e-9 * bending);
    EXPECT_LT(std::abs(compliance(2, 0)), 1e-9 * bending);
  }
}

/// Other units round differently: the difference of the solutions is their
/// roundoff. Eigenvalues go with 1/L^2, compliance with 1/L.
TEST(SlenderBar, AnswersAreTheSameInAnyUnit) {
  for (const bool is_clamped : {false, true}) {
    const auto solve = [&](double scale) {
      const Slender body({.length = scale,
                          .width = 1e-3 * scale,
                          .thickness = 1e-3 * scale,
                          .unit = 1e-3},
                         is_clamped);
      const MatrixX F = body.tip_forces();
      const MatrixX compliance = F.transpose() * body.inverse().solve(F);
      VectorX found(15);
      found << find_eigenmodes(body.inverse(), 12).lambda * scale * scale,
          compliance.diagonal() * scale;
      return found;
    };
    const VectorX expected = solve(1.0);
    for (const double scale : {1.0 / 3.0, 70.0}) {
      const VectorX found = solve(scale);
      EXPECT_LT(
          ((found - expected).array() / expected.array()).abs().maxCoeff(),
          5e-9);  // twice what refinement may leave, and some
    }
  }
}

TEST(SlenderBar, ElasticInverseAnswersFreeLoadsWithoutRigidMotion) {
  const Slender body({}, false);
  const MatrixX F = body.tip_forces();
  const MatrixX X = body.inverse().solve(F);
  const MatrixX MR = multiply_mass(body.matrices().M_s, body.R());
  EXPECT_LE((MR.transpose() * X).norm(), 1e-12 * MR.norm() * X.norm());
  const MatrixX work = F.transpose() * X;
  EXPECT_LT((work - work.transpose()).norm() / work.norm(), 1e-11);
}

class OfEveryKind : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Order, OfEveryKind, ::testing::Values(1, 2, 3));

std::vector<std::filesystem::path> write_boxes(int order) {
  std::vector<std::filesystem::path> files;
  for (const BoxKind kind :
       {BoxKind::tetrahedra, BoxKind::hexahedra, BoxKind::prisms})
    files.push_back(testing::convert(
        write_file("box.geo", testing::box_geo(kind)),
        fmt::format("box{}.msh", static_cast<int>(kind)), {.order = order}));
  files.push_back(
      testing::convert(write_file("mixed.msh", testing::mixed_msh(0.1)),
                       "mixed_order.msh", {.order = order}));
  return files;
}

/// Parallel-sided and warped elements of each shape.
TEST_P(OfEveryKind, StiffnessProductIsThatOfTheMatrix) {
  for (const auto& file : write_boxes(GetParam())) {
    const Mesh mesh = read_mesh(file, {});
    const StructuralMatrices matrices = assemble(mesh, {kSteel});
    std::mt19937_64 random{3};
    std::normal_distribution<double> normal;
    MatrixX X(matrices.dof_count(), 3);
    for (double& value : X.reshaped()) value = normal(random);
    const MatrixX by_matrix = multiply_stiffness(matrices.K, X);
    const MatrixX by_product = multiply_stiffness(matrices, X);
    EXPECT_LT((by_product - by_matrix).norm(), 1e-13 * by_matrix.norm())
        << file;
  }
}

/// A translation has no force at all, a turn that of roundoff in its strain.
TEST_P(OfEveryKind, StiffnessProductHasNoForceOnRigidMotion) {
  for (const auto& file : write_boxes(GetParam())) {
    const Mesh mesh = read_mesh(file, {});
    const StructuralMatrices matrices = assemble(mesh, {kSteel});
    MatrixX motion(matrices.dof_count(), 6);
    for (Eigen::Index n = 0; n < mesh.x.cols(); ++n)
      for (int c = 0; c < 3; ++c) {
        const Vector3 axis = Vector3::Unit(c);
        motion.block<3, 1>(3 * n, c) = 0.7 * axis;
        motion.block<3, 1>(3 * n, 3 + c) = axis.cross(Vector3(mesh.x.col(n)));
      }
    const MatrixX force = multiply_stiffness(matrices, motion);
    EXPECT_EQ(force.leftCols(3).cwiseAbs().maxCoeff(), 0.0) << file;
    const double stiffness = matrices.K.diagonal().maxCoeff();
    EXPECT_LT(force.rightCols(3).cwiseAbs().maxCoeff(),
              1e-15 * stiffness * mesh.size().maxCoeff())
        << file;
  }
}

std::string causes_of(const Mesh& mesh,
                      const std::vector<ElasticMaterial>& materials) {
  return describe_conditioning(assemble(mesh, materials), mesh.x);
}

TEST(Conditioning, NamesFlatElementsOnlyIfThereAreSuch) {
  Mesh mesh = read_mesh(write_bar({.length = 0.03, .layers = 3}), {.order = 1});
  EXPECT_THAT(causes_of(mesh, {kSteel}), Not(HasSubstr("flat")));
  EXPECT_THAT(causes_of(mesh, {kSteel}),
              HasSubstr("times as long as thick and its elements are sound"));
  // The second section is moved nearly onto the first.
  for (Eigen::Index n = 0; n < mesh.x.cols(); ++n)
    if (std::abs(mesh.x(0, n) - 0.01) < 1e-6) mesh.x(0, n) = 1e-7;
  const std::string flat = causes_of(mesh, {kSteel});
  EXPECT_THAT(flat, HasSubstr("(Hexahedron 8) is nearly flat"));
  EXPECT_THAT(flat, Not(HasSubstr("sound")));
}

TEST(Conditioning, NamesContrastOfMaterials) {
  Mesh mesh = read_mesh(write_bar({.length = 0.03, .layers = 3}), {});
  mesh.volume_groups.push_back(mesh.volume_groups[0]);
  mesh.blocks[0].regions.back() = 1;
  const std::string text = causes_of(mesh, {kSteel, {1e3, 0.3, 1000.0}});
  EXPECT_THAT(text, HasSubstr("Young's moduli from 1e+03 to 2.1e+11 Pa"));
  EXPECT_THAT(text, Not(HasSubstr("flat")));
}

/// Past what double precision can factor: the error says what makes it so.
TEST(Conditioning, ErrorOfABodyThatIsTooSlenderBlamesNoElement) {
  try {
    const Slender body({.width = 1e-5, .thickness = 1e-5, .layers = 400}, true);
    static_cast<void>(body.inverse().solve(body.tip_forces()));
    ADD_FAILURE() << "solved";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("times as long as thick and its elements are sound"));
    EXPECT_THAT(error.what(), Not(HasSubstr("flat")));
  }
}

}  // namespace
}  // namespace limber::fem::slender_test
