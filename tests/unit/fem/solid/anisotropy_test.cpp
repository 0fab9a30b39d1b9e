// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/material/anisotropy.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/cauchy_stress.hpp"
#include "limber/fem/solid/element_matrices.hpp"
#include "limber/fem/solid/nonlinear_solid.hpp"
#include "limber/fem/solid/second_order.hpp"
#include "limber/fem/solid/stiffness_product.hpp"
#include "limber/fem/solid/stress_recovery.hpp"
#include "places.hpp"
#include "unit/fem/meshes.hpp"

/// Solids of anisotropic materials against closed forms and CalculiX.
namespace limber::fem::solid_anisotropy_test {
namespace {

using testing::BoxKind;
using testing::kBoxSize;

constexpr Elasticity kLaw = Elasticity::st_venant_kirchhoff;
const Matrix6 kLaminate = make_orthotropic(
    {{140e9, 10e9, 12e9}, {0.3, 0.25, 0.4}, {5e9, 4e9, 3.4e9}});
const ElasticMaterial kTurned = make_material(
    kLaminate, make_axes({1.0, 0.5, 0.2}, {-0.3, 1.0, 0.4}), 1600.0);
const ElasticMaterial kAround = make_material(
    kLaminate, make_cylindrical_axes({0.1, 0.2, 1.0}, {0.2, -1.0, 0.0}),
    1600.0);
const ElasticMaterial kSteel{210e9, 0.3, 7850.0};
const ElasticMaterial kSteelBy21 =
    make_material(make_isotropic(210e9, 0.3),
                  make_axes({1.0, 0.5, 0.2}, {-0.3, 1.0, 0.4}), 7850.0);

Mesh make_box(BoxKind kind = BoxKind::hexahedra, int order = 2) {
  return read_mesh(
      testing::convert(testing::write_file("box.geo", testing::box_geo(kind)),
                       "box.msh", {.order = order}));
}

Mesh read_data(const std::string& name, const MeshOptions& options = {}) {
  return read_mesh(std::filesystem::path(LIMBER_SOURCE_DIR) / "tests/data" /
                       "anisotropic" / name,
                   options);
}

VectorX sample(const Mesh& mesh, const std::function<Vector3(Vector3)>& field) {
  VectorX u(3 * mesh.x.cols());
  for (Eigen::Index n = 0; n < mesh.x.cols(); ++n)
    u.segment<3>(3 * n) = field(mesh.x.col(n));
  return u;
}

/// Elastic energy by the matrix, and by its product without one.
std::pair<double, double> find_energies(const StructuralMatrices& matrices,
                                        const VectorX& u) {
  const StructuralMatrices by_entries{matrices.M_s, matrices.K};
  return {0.5 * u.dot(multiply_stiffness(by_entries, u).col(0)),
          0.5 * u.dot(multiply_stiffness(matrices, u).col(0))};
}

/// Of the lowest elastic modes of a free body.
VectorX find_eigenvalues(const Mesh& mesh,
                         const std::vector<ElasticMaterial>& materials,
                         int count = 6) {
  const StructuralMatrices matrices = assemble(mesh, materials);
  const MatrixX lower = matrices.K;
  const MatrixX K = lower.selfadjointView<Eigen::Lower>();
  const MatrixX M =
      multiply_mass(matrices.M_s, MatrixX::Identity(K.rows(), K.cols()));
  return dense::find_eigenpairs(K, M).values.segment(6, count);
}

Vector6 to_engineering(const Matrix3& H) {
  Vector6 gamma = to_components(0.5 * (H + H.transpose()));
  gamma.tail<3>() *= 2.0;
  return gamma;
}

const Matrix3 kGradient{{1e-3, 0.4e-3, -0.3e-3},
                        {0.2e-3, -0.7e-3, 0.5e-3},
                        {0.1e-3, -0.6e-3, 0.9e-3}};

TEST(AnisotropicSolid, LinearFieldHasTheEnergyAndStressOfItsStrain) {
  for (const BoxKind kind :
       {BoxKind::tetrahedra, BoxKind::hexahedra, BoxKind::prisms}) {
    const Mesh mesh = make_box(kind);
    const VectorX u =
        sample(mesh, [](const Vector3& x) -> Vector3 { return kGradient * x; });
    const Vector6 gamma = to_engineering(kGradient);
    const Vector6 stress = find_stiffness(kTurned, Vector3::Zero()) * gamma;
    const double expected = 0.5 * gamma.dot(stress) * kBoxSize.prod();
    const auto [by_entries, by_product] =
        find_energies(assemble(mesh, {kTurned}), u);
    EXPECT_NEAR(by_entries / expected, 1.0, 1e-10);
    EXPECT_NEAR(by_product / expected, 1.0, 1e-10);
    const NodalStress nodal = recover_stress(mesh, {kTurned}, u);
    EXPECT_LT((nodal.stress.colwise() - stress).cwiseAbs().maxCoeff(),
              1e-9 * stress.norm());
    EXPECT_LT(nodal.averaging(0, 0), 1e-15 * expected);
  }
}

TEST(AnisotropicSolid, BarBendsWithTheModulusAlongIt) {
  // Axis 1 along the bar, x; pure bending about z is a field of second degree.
  const ElasticMaterial bar = make_material(kLaminate, {}, 1600.0);
  const Mesh mesh = make_box();
  const Vector3 center = testing::kBoxCorner + 0.5 * kBoxSize;
  constexpr double kCurvature = 1e-3;
  const VectorX u = sample(mesh, [&](const Vector3& x) -> Vector3 {
    const Vector3 d = x - center;
    return kCurvature * Vector3(d[0] * d[1],
                                -0.5 * (d[0] * d[0] + 0.3 * d[1] * d[1] -
                                        0.25 * d[2] * d[2]),
                                -0.25 * d[1] * d[2]);
  });
  const double second_moment = kBoxSize[2] * std::pow(kBoxSize[1], 3) / 12.0;
  const double expected =
      0.5 * 140e9 * second_moment * kCurvature * kCurvature * kBoxSize[0];
  const auto [by_entries, by_product] = find_energies(assemble(mesh, {bar}), u);
  EXPECT_NEAR(by_entries / expected, 1.0, 1e-9);
  EXPECT_NEAR(by_product / expected, 1.0, 1e-9);
}

TEST(AnisotropicSolid, TurnedWithItsAxesHasTheSameFrequencies) {
  Mesh mesh = read_data("anisotropic.inp");
  const Matrix3 Q =
      Eigen::AngleAxisd(0.9, Vector3(0.3, -0.5, 0.8).normalized()).matrix();
  for (ElasticMaterial material : {kTurned, kAround}) {
    const VectorX before = find_eigenvalues(mesh, {material});
    Mesh turned = mesh;
    turned.x = Q * mesh.x;
    MaterialAxes& axes = material.anisotropy->axes;
    axes.directions = Q * axes.directions;
    axes.point = Q * axes.point;
    const VectorX after = find_eigenvalues(turned, {material});
    EXPECT_LT((after - before).cwiseQuotient(before).cwiseAbs().maxCoeff(),
              1e-10);
  }
}

TEST(AnisotropicSolid, OfAnIsotropicMaterialIsThatMaterial) {
  const Mesh mesh = make_box(BoxKind::tetrahedra);
  const StructuralMatrices by_two = assemble(mesh, {kSteel});
  const StructuralMatrices by_21 = assemble(mesh, {kSteelBy21});
  EXPECT_LT((MatrixX(by_two.K) - MatrixX(by_21.K)).norm(),
            1e-13 * by_two.K.norm());
  const VectorX u = sample(mesh, [](const Vector3& x) -> Vector3 {
    return 0.1 * Vector3(x[0] * x[1], -x[2], x[1] * x[1] - x[0]);
  });
  const MatrixX F = MatrixX::Zero(u.size(), 1);
  const MatrixX force = by_two.product->subtract_from(F, u);
  EXPECT_LT((by_21.product->subtract_from(F, u) - force).norm(),
            1e-12 * force.norm());

  MatrixX Phi(u.size(), 2);
  Phi << u, sample(mesh, [](const Vector3& x) -> Vector3 {
    return 0.1 * Vector3(x[0] * x[1] * x[2], x[2] * x[2], x[0] * x[2]);
  });
  const SecondOrderTerms two = calc_second_order(mesh, {kSteel}, kLaw, Phi);
  const SecondOrderTerms many =
      calc_second_order(mesh, {kSteelBy21}, kLaw, Phi);
  EXPECT_LT((two.loads - many.loads).norm(), 1e-12 * two.loads.norm());
  EXPECT_LT((two.strain - many.strain).norm(), 1e-12 * two.strain.norm());
  const MatrixX Theta = MatrixX::Random(u.size(), 3);
  const MatrixX W = calc_pair_energy(mesh, {kSteel}, Phi, Theta, {0, 1, 2});
  EXPECT_LT(
      (calc_pair_energy(mesh, {kSteelBy21}, Phi, Theta, {0, 1, 2}) - W).norm(),
      1e-12 * W.norm());
  const NodalStress stress = recover_stress(mesh, {kSteel}, Phi);
  const NodalStress same = recover_stress(mesh, {kSteelBy21}, Phi);
  EXPECT_LT((stress.stress - same.stress).norm(), 1e-12 * stress.stress.norm());
  EXPECT_LT((stress.averaging - same.averaging).norm(),
            1e-11 * stress.averaging.norm());
}

TEST(AnisotropicSolid, LargeDeformationHasAPotentialAndItsTangent) {
  for (const ElasticMaterial& material : {kTurned, kAround}) {
    const Mesh mesh = read_data("anisotropic.inp");
    const std::vector<ElasticMaterial> materials{material};
    const NonlinearSolid solid(mesh, materials, kLaw);
    NonlinearSolid::Workspace workspace = solid.make_workspace();
    const Eigen::Index count = mesh.x.cols();
    const VectorX u = sample(mesh, [](const Vector3& x) -> Vector3 {
      return 2.0 * Vector3(x[2] * x[2], x[0] * x[2], -x[2] * x[0]);
    });
    const VectorX step = sample(mesh, [](const Vector3& x) -> Vector3 {
      return Vector3(x[1], x[2] * x[2], -x[0] * x[1]);
    });
    const auto find = [&](const VectorX& at) {
      Matrix3X force(3, count);
      const double energy =
          solid.calc_force(at.reshaped(3, count), force, workspace);
      return std::pair<double, VectorX>(energy, force.reshaped());
    };
    constexpr double kStep = 1e-4;
    const auto plus = find(u + kStep * step);
    const auto minus = find(u - kStep * step);
    const auto here = find(u);
    EXPECT_NEAR(
        (plus.first - minus.first) / (2.0 * kStep) / here.second.dot(step), 1.0,
        1e-6);
    const VectorX difference = (plus.second - minus.second) / (2.0 * kStep);
    VectorX tangent = VectorX::Zero(u.size());
    for (const ElementBlock& block : mesh.blocks) {
      for (std::size_t e = 0; e < block.size(); ++e) {
        const int* first = block.element_nodes(e);
        const std::vector<int> own(first, first + block.element->node_count);
        const Matrix3X u_e = u.reshaped(3, count)(Eigen::all, own);
        const Matrix3X step_e = step.reshaped(3, count)(Eigen::all, own);
        const VectorX force =
            calc_element_tangent(*block.element, mesh.x(Eigen::all, own), u_e,
                                 material, kLaw) *
            step_e.reshaped();
        for (std::size_t a = 0; a < own.size(); ++a)
          tangent.segment<3>(3 * Eigen::Index{own[a]}) +=
              force.segment<3>(3 * static_cast<Eigen::Index>(a));
      }
    }
    EXPECT_LT((tangent - difference).norm(), 1e-6 * difference.norm());
    // Small displacements have the forces of the linear solid.
    const VectorX linear =
        multiply_stiffness(assemble(mesh, materials), 1e-7 * u);
    EXPECT_LT((find(1e-7 * u).second - linear).norm(), 1e-6 * linear.norm());
  }
}

TEST(AnisotropicSolid, CauchyStressOfATurnedBodyIsTheTurnedStress) {
  const Mesh mesh = make_box();
  const std::vector<int> nodes{0, 5};
  const CauchyStress stress(mesh, {kTurned}, kLaw, nodes);
  const Matrix3 H = 0.1 * Matrix3::Identity();
  const Matrix3 R =
      Eigen::AngleAxisd(0.8, Vector3(0.3, 0.5, -0.2).normalized()).matrix();
  const auto find = [&](const Matrix3& F) {
    const Matrix3X u = (F - Matrix3::Identity()) * mesh.x;
    Matrix6X at(6, std::ssize(stress.nodes()));
    stress.evaluate(u, at);
    const Vector6 s = at.col(0);
    Matrix3 sigma;
    sigma << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    return sigma;
  };
  const Matrix3 F = Matrix3::Identity() + H;
  const Matrix3 sigma = find(F);
  EXPECT_LT((find(R * F) - R * sigma * R.transpose()).norm(),
            1e-10 * sigma.norm());
  // F = 1.1 I: E = 0.105 I, and sigma = F S F' / det F = S / 1.1.
  const Vector6 gamma{{0.105, 0.105, 0.105, 0.0, 0.0, 0.0}};
  const Vector6 S = find_stiffness(kTurned, Vector3::Zero()) * gamma;
  EXPECT_LT((to_components(sigma) - S / 1.1).norm(), 1e-10 * S.norm());
}

TEST(AnisotropicSolid, NeoHookeanLawRefusesIt) {
  const Mesh mesh = make_box();
  EXPECT_THROW(NonlinearSolid(mesh, {kTurned}, Elasticity::neo_hookean),
               InputError);
}

/// Eigenvalues that CalculiX prints for a deck, of C3D10 those by SciPy:
/// tests/data/anisotropic.
struct Reference {
  std::string deck;
  Vector6 eigenvalues;
  double tolerance;
};
class AgainstCalculix : public ::testing::TestWithParam<Reference> {};

TEST_P(AgainstCalculix, EigenvaluesAreThoseOfTheDeckItself) {
  const Mesh mesh =
      read_data(GetParam().deck,
                {.unit = GetParam().deck.ends_with(".bdf") ? 1e-3 : 0.0});
  const VectorX found = find_eigenvalues(mesh, assign_materials(mesh, {}));
  for (Eigen::Index k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k] / GetParam().eigenvalues[k], 1.0, GetParam().tolerance)
        << k;
}

const Vector6 kBlock{
    {3.214572e8, 4.276792e8, 5.043727e8, 1.620335e9, 1.750959e9, 2.147099e9}};
INSTANTIATE_TEST_SUITE_P(
    Decks, AgainstCalculix,
    ::testing::Values(
        Reference{"block.inp", kBlock, 5e-7},
        Reference{"block.bdf", kBlock, 5e-7},
        Reference{"turned.inp",
                  Vector6{{3.017236e8, 3.970678e8, 5.559564e8, 1.568286e9,
                           1.596271e9, 2.124486e9}},
                  5e-7},
        Reference{"orthotropic.inp",
                  Vector6{{3.280455423e8, 4.232311533e8, 6.970930467e8,
                           1.604456248e9, 1.919316565e9, 2.618897262e9}},
                  1e-9},
        Reference{"anisotropic.inp",
                  Vector6{{2.977993237e8, 3.983724959e8, 7.086667321e8,
                           1.470833164e9, 1.776249341e9, 2.633507499e9}},
                  1e-9}),
    [](const auto& tested) {
      std::string name = tested.param.deck;
      std::replace(name.begin(), name.end(), '.', '_');
      return name;
    });

}  // namespace
}  // namespace limber::fem::solid_anisotropy_test
