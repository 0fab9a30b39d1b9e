// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_residual.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/fem/mesh/node_weights.hpp"
#include "unit/reduction/bar.hpp"

/// The flexibility that a basis leaves out, against the rod's closed form and
/// the sum over all other modes.
namespace limber::flexbody::contact_residual_test {
namespace {

using testing::Bar;
using testing::make_recipe;

constexpr double kPi = std::numbers::pi;

/// A load on a whole group along x.
ContactPatch press(const fem::Mesh& mesh, const std::string& group) {
  const fem::WeightedNodes on =
      fem::weigh_group(mesh, mesh.groups[fem::find_group(mesh, group)]);
  return {Vector3::UnitX(), 0.0, on.nodes, on.weights};
}

/// Axial fields of the free nodes, one a column.
template <typename Field>
MatrixX make_axial(const MeshedBody& body, int count, const Field& field) {
  const std::vector<int>& nodes = body.support.free_nodes;
  MatrixX fields = MatrixX::Zero(3 * std::ssize(nodes), count);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (int n = 0; n < count; ++n)
      fields(3 * static_cast<Eigen::Index>(i), n) =
          field(n + 1, body.mesh.x(0, nodes[i]));
  }
  return fields;
}

struct Rod {
  explicit Rod(bool is_clamped)
      : bar{.size = {1.0, 0.01, 0.01},
            .cells = 40,
            .material = {210e9, 0.0, 7850.0},
            .is_clamped = is_clamped} {}
  Bar bar;
  MeshedBody body{make_recipe(bar), {}};
  double flexibility = 1.0 / (210e9 * 1e-4);  ///< L / (E A) [m/N]
};

/// Static answer of a free rod L / (3 E A), of a mode 2 L / (n^2 pi^2 E A).
TEST(ContactResidual, OfAFreeRodIsTheSumOverTheLeftOutModes) {
  const Rod rod(false);
  const auto cosine = [](int n, double x) { return std::cos(n * kPi * x); };
  double expected = 1.0 / 3.0;
  for (int m = 0; m <= 5; ++m) {
    if (m > 0) expected -= 2.0 / (kPi * kPi * m * m);
    const ReducedBasis basis = make_reduced_basis(
        make_axial(rod.body, m, cosine), rod.body.support, 1e-8);
    ASSERT_EQ(basis.lambda.size(), m);
    const double R = calc_residual_flexibility(
        rod.body, basis, {press(rod.body.mesh, "tip")})[0];
    EXPECT_NEAR(R / (rod.flexibility * expected), 1.0, 1e-3) << m;
  }
}

/// L / (E A) and 8 L / ((2 n - 1)^2 pi^2 E A).
TEST(ContactResidual, OfAClampedRodIsTheSumOverTheLeftOutModes) {
  const Rod rod(true);
  const auto sine = [](int n, double x) {
    return std::sin((n - 0.5) * kPi * x);
  };
  double expected = 1.0;
  for (int m = 0; m <= 5; ++m) {
    if (m > 0) expected -= 8.0 / std::pow((2 * m - 1) * kPi, 2.0);
    const ReducedBasis basis = make_reduced_basis(make_axial(rod.body, m, sine),
                                                  rod.body.support, 1e-8);
    const double R = calc_residual_flexibility(
        rod.body, basis, {press(rod.body.mesh, "tip")})[0];
    EXPECT_NEAR(R / (rod.flexibility * expected), 1.0, 1e-3) << m;
  }
}

/// A short bar with all its modes, by dense matrices.
struct DenseBar {
  explicit DenseBar(bool is_clamped)
      : body{make_recipe({.size = {0.3, 0.1, 0.05},
                          .cells = 2,
                          .material = {200e9, 0.3, 8000.0},
                          .is_clamped = is_clamped}),
             {}},
        pairs(dense::find_eigenpairs(
            testing::dense_stiffness(body),
            testing::kron(body.support.matrices.M_s, Matrix3::Identity()))),
        rigid(is_clamped ? 0 : 6) {}

  /// The elastic modes [begin, begin + count).
  [[nodiscard]] ReducedBasis make_basis(Eigen::Index count) const {
    return {pairs.values.segment(rigid, count),
            pairs.vectors.middleCols(rigid, count)};
  }
  [[nodiscard]] Eigen::Index elastic() const {
    return pairs.values.size() - rigid;
  }
  /// On single nodes of the surface, in several directions.
  [[nodiscard]] std::vector<ContactPatch> make_patches() const {
    std::vector<ContactPatch> patches;
    const std::vector<int>& nodes = body.mesh.boundary_nodes;
    for (std::size_t i = 0; i + 2 < nodes.size(); i += 5) {
      const double angle = static_cast<double>(i);
      patches.push_back(
          {Vector3(std::cos(angle), std::sin(angle), 0.5).normalized(),
           0.0,
           {nodes[i], nodes[i + 1], nodes[i + 2]},
           Vector3(0.2, 0.5, 0.3)});
    }
    return patches;
  }
  /// phi_k . f of a patch, over all modes.
  [[nodiscard]] VectorX find_shares(const ContactPatch& patch) const {
    MatrixX f = MatrixX::Zero(3 * body.mesh.x.cols(), 1);
    for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
      f.middleRows<3>(3 * patch.nodes[i]) +=
          patch.weights[static_cast<Eigen::Index>(i)] * patch.normal;
    }
    return pairs.vectors.transpose() * take_rows(f, body.support.free_nodes);
  }
  /// sum (phi_k . f)^2 / lambda_k over the modes that a basis leaves out.
  [[nodiscard]] double sum_left_out(const ContactPatch& patch,
                                    Eigen::Index count) const {
    const Eigen::Index left = elastic() - count;
    return find_shares(patch)
        .tail(left)
        .cwiseAbs2()
        .cwiseQuotient(pairs.values.tail(left))
        .sum();
  }

  /// (s / (lambda - s))^2 of the first mode left out: what one solution with
  /// the shifted factor errs by.
  [[nodiscard]] double find_shift_error(Eigen::Index count) const {
    const double s = body.inverse.shift();
    return std::pow(s / (pairs.values[rigid + count] - s), 2.0);
  }

  MeshedBody body;
  dense::Eigenpairs pairs;
  Eigen::Index rigid;
};

class ContactResidualOfModes : public ::testing::TestWithParam<bool> {
 protected:
  static const DenseBar& bar() {
    static const DenseBar free(false);
    static const DenseBar clamped(true);
    return GetParam() ? clamped : free;
  }
};
INSTANTIATE_TEST_SUITE_P(Support, ContactResidualOfModes, ::testing::Bool(),
                         [](const auto& p) {
                           return p.param ? "Clamped" : "Free";
                         });

TEST_P(ContactResidualOfModes, IsTheSumOverAllModesThatAreLeftOut) {
  const std::vector<ContactPatch> patches = bar().make_patches();
  ASSERT_GT(patches.size(), 5U);
  for (const Eigen::Index m : {0, 1, 4, 20}) {
    const VectorX R =
        calc_residual_flexibility(bar().body, bar().make_basis(m), patches);
    for (std::size_t p = 0; p < patches.size(); ++p) {
      const double expected = bar().sum_left_out(patches[p], m);
      if (expected == 0.0) {  // on the clamp
        EXPECT_EQ(R[static_cast<Eigen::Index>(p)], 0.0);
        continue;
      }
      EXPECT_NEAR(R[static_cast<Eigen::Index>(p)] / expected, 1.0,
                  std::max(1e-9, bar().find_shift_error(m)))
          << m;
    }
  }
}

TEST_P(ContactResidualOfModes, ShrinksWithEachModeAndVanishesWithAll) {
  const std::vector<ContactPatch> patches = bar().make_patches();
  const auto calc = [&](Eigen::Index m) {
    return calc_residual_flexibility(bar().body, bar().make_basis(m), patches);
  };
  const VectorX all = calc(0);
  VectorX before = all;
  for (const Eigen::Index m :
       {Eigen::Index{2}, Eigen::Index{5}, Eigen::Index{15}, Eigen::Index{40},
        bar().elastic() / 2}) {
    const VectorX R = calc(m);
    EXPECT_TRUE((R.array() >= 0.0).all());
    EXPECT_TRUE((R.array() <= before.array() * (1.0 + 1e-12)).all());
    before = R;
  }
  EXPECT_LT(calc(bar().elastic()).cwiseAbs().maxCoeff(),
            1e-12 * all.maxCoeff());
}

/// Static modes are not eigenvectors; one of the load itself answers it all.
TEST_P(ContactResidualOfModes, VanishesIfTheBasisHasTheStaticAnswer) {
  const std::vector<ContactPatch> patches = {bar().make_patches()[3],
                                             bar().make_patches()[5]};
  const VectorX f_in_modes = bar().find_shares(patches[0]);
  const Eigen::Index elastic = bar().elastic();
  const MatrixX answer =
      bar().pairs.vectors.rightCols(elastic) *
      f_in_modes.tail(elastic).cwiseQuotient(bar().pairs.values.tail(elastic));
  const ReducedBasis basis =
      make_reduced_basis(answer, bar().body.support, 1e-8);
  const VectorX R = calc_residual_flexibility(bar().body, basis, patches);
  const double whole = bar().sum_left_out(patches[0], 0);
  EXPECT_LT(std::abs(R[0]), 1e-12 * whole);
  // Of another load it takes what that load's work on the answer is.
  const double work =
      f_in_modes.tail(elastic)
          .cwiseProduct(bar().find_shares(patches[1]).tail(elastic))
          .cwiseQuotient(bar().pairs.values.tail(elastic))
          .sum();
  EXPECT_NEAR(R[1] / (bar().sum_left_out(patches[1], 0) - work * work / whole),
              1.0, 2e-4);
}

/// Mean of u = pi p0 (2 b^2 - r^2) / (4 E' b), weighted by the pressure, by
/// quadrature [@johnson1985, sec. 3.4].
TEST(HertzShare, IsTheMeanDisplacementUnderTheOwnPressure) {
  const fem::ElasticMaterial steel{210e9, 0.3, 7850.0};
  const double b = 3e-3;
  const double stiffness = 210e9 / (1.0 - 0.3 * 0.3);
  const double p0 = 3.0 / (2.0 * kPi * b * b);  // of 1 N
  constexpr int kSteps = 20000;
  double work = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double r = (i + 0.5) * b / kSteps;
    const double p = p0 * std::sqrt(1.0 - r * r / (b * b));
    const double u = kPi * p0 * (2.0 * b * b - r * r) / (4.0 * stiffness * b);
    work += p * u * 2.0 * kPi * r * b / kSteps;
  }
  EXPECT_NEAR(calc_hertz_fraction(steel, b) / work, 1.0, 1e-6);
}

}  // namespace
}  // namespace limber::flexbody::contact_residual_test
