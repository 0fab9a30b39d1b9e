// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/matrix_part.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/fem/matrices/read_matrices.hpp"
#include "places.hpp"

/// What is wrong with matrices is one error that names the node.
namespace limber::flexbody::matrix_part_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Matrix = Eigen::SparseMatrix<double>;

constexpr double kMass = 7.4186889;

/// tests/data/matrices/arch: 13 nodes, 78 rows, lumped masses.
fem::MatrixModel arch() {
  return fem::read_matrices({{LIMBER_SOURCE_DIR "/tests/data/matrices/arch"}});
}

std::string check(const fem::MatrixModel& model, double mass = kMass,
                  double unit = 1.0) {
  try {
    const auto part = make_matrix_part(model, mass, unit);
    return part->system.notices.empty() ? "accepted"
                                        : part->system.notices.front();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1U);
    return error.what();
  }
}

int row(int node, int component) { return 6 * (node - 1) + component; }

TEST(MatrixPart, OfASoundModelHasNothingToReport) {
  EXPECT_EQ(check(arch()), "accepted");
}

TEST(MatrixPart, WithASpringToGroundNamesItsNode) {
  fem::MatrixModel model = arch();
  const int at = row(5, 2);
  model.stiffness.entries.coeffRef(at, at) *= 1.0 + 1e-4;
  EXPECT_THAT(check(model), AllOf(HasSubstr("of the whole body has"),
                                  HasSubstr("held at node"), HasSubstr(" 5")));
}

TEST(MatrixPart, WithAWeakSpringToGroundIsProjected) {
  fem::MatrixModel model = arch();
  const double K = 1e-4 * 4e7;
  model.stiffness.entries.coeffRef(row(5, 2), row(5, 2)) += 1e-3 * K;
  EXPECT_THAT(check(model), HasSubstr("it is projected out"));
}

TEST(MatrixPart, WithCoordinatesInAnotherUnitNamesTheRotation) {
  fem::MatrixModel model = arch();
  model.x *= 1000.0;
  EXPECT_THAT(check(model), HasSubstr("rotation about"));
}

TEST(MatrixPart, WithNodesInAnotherOrderNamesThem) {
  fem::MatrixModel model = arch();
  model.x.col(3).swap(model.x.col(7));
  EXPECT_THAT(check(model),
              AllOf(HasSubstr("rotation about"), HasSubstr("held at nodes")));
}

TEST(MatrixPart, WithAnotherMassThanStatedSuggestsTheUnit) {
  EXPECT_THAT(check(arch(), 2.0 * kMass), HasSubstr("are stated"));
  EXPECT_THAT(check(arch(), 1000.0 * kMass),
              HasSubstr("if lengths were in mm"));
  EXPECT_THAT(check(arch(), -1.0), HasSubstr("expected that of the whole"));
}

TEST(MatrixPart, OfOneTriangleIsRefused) {
  fem::MatrixModel model = arch();
  const Matrix K = model.stiffness.entries.triangularView<Eigen::Lower>();
  model.stiffness.entries = K;
  EXPECT_THAT(check(model), HasSubstr("in one triangle"));
}

TEST(MatrixPart, ThatIsNotSymmetricNamesTheRows) {
  fem::MatrixModel model = arch();
  model.stiffness.entries.coeffRef(row(4, 1), row(5, 1)) *= 1.1;
  EXPECT_THAT(check(model),
              AllOf(HasSubstr("not symmetric"), HasSubstr("node 4, y"),
                    HasSubstr("node 5, y")));
}

TEST(MatrixPart, WithOffDiagonalsDoubledSaysSo) {
  fem::MatrixModel model = arch();
  const VectorX diagonal = model.stiffness.entries.diagonal();
  model.stiffness.entries *= 2.0;
  for (int i = 0; i < diagonal.size(); ++i)
    model.stiffness.entries.coeffRef(i, i) = diagonal[i];
  EXPECT_THAT(check(model), HasSubstr("doubled"));
}

TEST(MatrixPart, WithANegativeMassNamesItsNode) {
  fem::MatrixModel model = arch();
  model.mass.entries.coeffRef(row(6, 4), row(6, 4)) = -1e-3;
  EXPECT_THAT(check(model), AllOf(HasSubstr("the mass of node 6, rotation "
                                            "about y is -0.001")));
}

TEST(MatrixPart, WithAnEntryThatIsNotFiniteNamesIt) {
  fem::MatrixModel model = arch();
  model.stiffness.entries.coeffRef(row(2, 0), row(2, 0)) = NAN;
  EXPECT_THAT(check(model), HasSubstr("node 2, x"));
}

TEST(MatrixPart, WithAMechanismNamesWhatMoves) {
  fem::MatrixModel model = arch();
  // The last node on its own.
  for (int c = 0; c < 6; ++c)
    for (int j = 0; j < 78; ++j) {
      if (model.stiffness.entries.coeff(row(13, c), j) == 0.0) continue;
      model.stiffness.entries.coeffRef(row(13, c), j) = 0.0;
      model.stiffness.entries.coeffRef(j, row(13, c)) = 0.0;
    }
  EXPECT_NE(check(model), "accepted");
}

TEST(MatrixPart, LeavesRowsOutThatHaveNothing) {
  fem::MatrixModel model = arch();
  const auto n = model.rows.size();
  Matrix K(78 + 6, 78 + 6);
  Matrix M = K;
  for (auto [from, to] : {std::pair{&model.stiffness.entries, &K},
                          std::pair{&model.mass.entries, &M}}) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < 78; ++j)
      for (Matrix::InnerIterator it(*from, j); it; ++it)
        entries.emplace_back(it.row(), j, it.value());
    to->setFromTriplets(entries.begin(), entries.end());
    *from = *to;
  }
  model.x.conservativeResize(3, 14);
  model.x.col(13) = Vector3(0.1, 0.2, 0.3);
  model.tags.push_back(77);
  for (int c = 0; c < 6; ++c) model.rows.push_back({13, c});
  ASSERT_EQ(model.rows.size(), n + 6);
  EXPECT_THAT(check(model),
              AllOf(HasSubstr("6 of 84 rows have neither stiffness nor mass"),
                    HasSubstr("node 77, x")));
}

TEST(MatrixPart, WithHugeDiagonalsIsClampedThere) {
  fem::MatrixModel model = arch();
  for (int c = 0; c < 6; ++c)
    model.stiffness.entries.coeffRef(row(1, c), row(1, c)) = 1e36;
  EXPECT_THAT(check(model),
              AllOf(HasSubstr("6 of 78 rows"), HasSubstr("are clamped"),
                    HasSubstr("node 1, x")));
}

TEST(MatrixPart, OfFewDigitsStatesTheirError) {
  fem::MatrixModel model = arch();
  model.stiffness.digits = 5;
  for (int j = 0; j < 78; ++j)
    for (Matrix::InnerIterator it(model.stiffness.entries, j); it; ++it)
      if (it.value() != 0.0) {
        const double scale =
            std::pow(10.0, 4 - std::floor(std::log10(std::abs(it.value()))));
        it.valueRef() = std::round(it.value() * scale) / scale;
      }
  EXPECT_NE(check(model), "accepted");
}

TEST(MatrixPart, ThatDoesNotFitItsRowsIsRefused) {
  fem::MatrixModel model = arch();
  model.rows.pop_back();
  try {
    static_cast<void>(make_matrix_part(model, kMass, 1.0));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("expected 77 x 77"));
  }
}

}  // namespace
}  // namespace limber::flexbody::matrix_part_test
