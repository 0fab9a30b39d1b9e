// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "unit/fem/meshes.hpp"

/// Mass and stiffness of every element shape and order against known properties
/// of any elastic box: no figure here comes from this project.
namespace limber::fem::element_matrices_test {
namespace {

using testing::BoxKind;
using testing::kBoxCorner;
using testing::kBoxSize;

/// Sums of some thousand products in double precision.
constexpr double kRoundoff = 1e-12;
/// Allowed of the energies, which difference large nodal forces.
constexpr double kEnergy = 1e-10;

const ElasticMaterial kSteel{210e9, 0.3, 7850.0};
const double kVolume = kBoxSize.prod();

struct Case {
  std::string kind;
  int order = 1;
  bool serendipity = false;

  [[nodiscard]] bool is_skew() const { return kind == "skew"; }
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.kind << c.order; }

std::filesystem::path write_source(const std::string& kind) {
  using namespace testing;
  if (kind == "mixed") return write_file("linear.msh", mixed_msh(0.0));
  if (kind == "skew") return write_file("linear.msh", mixed_msh(0.05));
  if (kind == "pyramids") return write_file("linear.msh", pyramids_msh());
  const BoxKind box = kind == "tetrahedra"  ? BoxKind::tetrahedra
                      : kind == "hexahedra" ? BoxKind::hexahedra
                                            : BoxKind::prisms;
  return write_file("box.geo", box_geo(box));
}

class BoxOfElements : public ::testing::TestWithParam<Case> {
 protected:
  BoxOfElements()
      : mesh_(read_mesh(
            testing::convert(write_source(GetParam().kind), "box.msh",
                             {.order = GetParam().order,
                              .serendipity = GetParam().serendipity}))),
        matrices_(assemble(mesh_, {kSteel})) {}

  /// Elastic energy of a displacement field given at a point [J].
  template <typename Field>
  [[nodiscard]] double energy(const Field& field) const {
    MatrixX u(matrices_.dof_count(), 1);
    for (Eigen::Index n = 0; n < mesh_.x.cols(); ++n)
      u.block<3, 1>(3 * n, 0) = field(Vector3(mesh_.x.col(n)));
    return 0.5 * u.col(0).dot(multiply_stiffness(matrices_.K, u).col(0));
  }

  Mesh mesh_;
  StructuralMatrices matrices_;
};

TEST_P(BoxOfElements, HasTheShapesAndOrderAskedFor) {
  std::set<int> corners;
  for (const ElementBlock& block : mesh_.blocks) {
    EXPECT_EQ(block.element->order, GetParam().order);
    corners.insert(block.element->corner_count);
  }
  const std::string& kind = GetParam().kind;
  const std::set<int> expected = kind == "tetrahedra"  ? std::set{4}
                                 : kind == "hexahedra" ? std::set{8}
                                 : kind == "prisms"    ? std::set{6}
                                 : kind == "pyramids"  ? std::set{5}
                                                       : std::set{4, 5, 6, 8};
  EXPECT_EQ(corners, expected);
}

TEST_P(BoxOfElements, HasTheMassCentreAndInertiaOfABox) {
  const MassProperties body = calc_mass_properties(matrices_.M_s, mesh_.x);
  const double mass = kSteel.density * kVolume;
  EXPECT_NEAR(body.mass / mass, 1.0, kRoundoff);
  EXPECT_LT((body.center - kBoxCorner - 0.5 * kBoxSize).norm(), kRoundoff);
  const Matrix3 S0 =
      (mass / 12.0 * kBoxSize.array().square()).matrix().asDiagonal();
  EXPECT_LT((body.S0 - S0).norm() / S0.norm(), kRoundoff);
}

TEST_P(BoxOfElements, MassIsSymmetricAndPositiveDefinite) {
  const MatrixX M = matrices_.M_s;
  EXPECT_LT((M - M.transpose()).cwiseAbs().maxCoeff() / M.cwiseAbs().maxCoeff(),
            kRoundoff);
  EXPECT_TRUE(dense::find_cholesky(M));
}

TEST_P(BoxOfElements, RigidMotionsMeetNoForce) {
  const MatrixX R = make_rigid_modes(matrices_.M_s, mesh_.x);
  const MatrixX force = multiply_stiffness(matrices_.K, R);
  const double scale =
      matrices_.K.diagonal().maxCoeff() * R.cwiseAbs().maxCoeff();
  EXPECT_LT(force.cwiseAbs().maxCoeff() / scale, kRoundoff);
}

TEST_P(BoxOfElements, LinearFieldHasTheEnergyOfItsConstantStrain) {
  Matrix3 gradient;
  gradient << 1.0, 0.4, -0.3, 0.2, -0.7, 0.5, 0.1, -0.6, 0.9;
  const Matrix3 strain = 0.5 * (gradient + gradient.transpose());
  const double mu = kSteel.youngs_modulus / 2.0 / (1.0 + kSteel.poisson_ratio);
  const double lambda =
      2.0 * mu * kSteel.poisson_ratio / (1.0 - 2.0 * kSteel.poisson_ratio);
  const double expected =
      kVolume * (0.5 * lambda * strain.trace() * strain.trace() +
                 mu * strain.squaredNorm());
  const double found =
      energy([&](const Vector3& x) { return Vector3(gradient * x); });
  EXPECT_NEAR(found / expected, 1.0, kEnergy);
}

/// Saint-Venant's bending, curvature 1: stress E z along x and no other, so
/// the energy is E/2 int z^2 dV. Quadratic, so linear elements cannot have it.
TEST_P(BoxOfElements, PureBendingHasItsEnergyFromOrderTwoOn) {
  const double nu = kSteel.poisson_ratio;
  const Vector3 center = kBoxCorner + 0.5 * kBoxSize;
  const double found = energy([&](const Vector3& point) {
    const Vector3 d = point - center;
    const double x = d[0], y = d[1], z = d[2];
    return Vector3(x * z, -nu * y * z,
                   -0.5 * (x * x - nu * y * y + nu * z * z));
  });
  const double expected =
      0.5 * kSteel.youngs_modulus * kVolume * kBoxSize[2] * kBoxSize[2] / 12.0;
  if (GetParam().order == 1) {
    EXPECT_GT(found / expected, 1.01);
  } else if (GetParam().is_skew() && GetParam().serendipity) {
    // Without its inner nodes an element that is no affine image of its
    // reference holds a quadratic field only nearly.
    EXPECT_GT(found / expected, 1.0);
    EXPECT_LT(found / expected, 1.1);
  } else {
    EXPECT_NEAR(found / expected, 1.0, kEnergy);
  }
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const char* kind :
       {"tetrahedra", "hexahedra", "prisms", "pyramids", "mixed", "skew"}) {
    for (const int order : {1, 2, 3}) cases.push_back({kind, order});
    if (std::string(kind) != "tetrahedra") cases.push_back({kind, 2, true});
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Shapes, BoxOfElements,
                         ::testing::ValuesIn(all_cases()), [](const auto& p) {
                           return fmt::format(
                               "{}Order{}{}", p.param.kind, p.param.order,
                               p.param.serendipity ? "Serendipity" : "");
                         });

}  // namespace
}  // namespace limber::fem::element_matrices_test
