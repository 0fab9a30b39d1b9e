// SPDX-License-Identifier: BSD-3-Clause
// One beam in every format (tests/data/matrices/README.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "unit/fem/matrices/sample_files.hpp"

namespace limber::fem::samples_test {
namespace {

using test::compare_entries;
using test::list_entries;
using test::read_sample;
using test::rigid_motions;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

struct Sample {
  const char* folder;
  int digits;
  const char* triangles;
};

class EveryFormat : public ::testing::TestWithParam<Sample> {};

TEST_P(EveryFormat, GivesTheSameModelToItsDigits) {
  static const MatrixModel reference = read_sample("matrix_market");
  const MatrixModel model = read_sample(GetParam().folder);
  EXPECT_THAT(model.tags, ElementsAre(7, 10, 20));
  EXPECT_LT((model.x - reference.x).norm(), 1e-12);
  EXPECT_THAT(model.rows, SizeIs(18));
  EXPECT_EQ(model.stiffness.digits, GetParam().digits);
  // Half a unit of the last digit, of numbers up to the largest.
  const double rounding = 0.51 * std::pow(10.0, 1 - GetParam().digits);
  for (const auto part : {&MatrixModel::stiffness, &MatrixModel::mass})
    EXPECT_LT(compare_entries(list_entries(model, model.*part),
                              list_entries(reference, reference.*part)),
              rounding);
  EXPECT_THAT(model.found, Contains(AllOf(HasSubstr("stiffness"),
                                          HasSubstr(GetParam().triangles))));
  EXPECT_THAT(model.found, Not(Contains(HasSubstr("not recognised"))));
}

INSTANTIATE_TEST_SUITE_P(
    Formats, EveryFormat,
    ::testing::Values(
        Sample{"matrix_market", 17, "lower triangle, mirrored"},
        Sample{"matrix_market_general", 17, "both triangles"},
        Sample{"matrix_market_array", 17, "lower triangle, mirrored"},
        Sample{"matrix_market_array_general", 17, "both triangles"},
        Sample{"dmig_large", 10, "triangle, mirrored"},
        Sample{"dmig_square", 10, "both triangles"},
        Sample{"dmig_small", 4, "triangle, mirrored"},
        Sample{"dmig_free", 16, "both triangles"},
        Sample{"op4_dense", 17, "both triangles"},
        Sample{"op4_numbers", 17, "both triangles"},
        Sample{"op4_sparse", 17, "both triangles"},
        Sample{"op4_bigmat", 17, "both triangles"},
        Sample{"abaqus_coordinate", 16, "both triangles"},
        Sample{"abaqus_matrix_input", 16, "triangle, mirrored"},
        Sample{"abaqus_substructure", 14, "lower triangle, mirrored"},
        Sample{"ansys_harwell_boeing", 16, "lower triangle, mirrored"},
        Sample{"ansys_mmf", 16, "lower triangle, mirrored"}),
    [](const auto& one) { return one.param.folder; });

TEST(MatrixSamples, HaveTheBeamsMassAndNoStiffnessAgainstRigidMotions) {
  const MatrixModel model = read_sample("matrix_market");
  const MatrixX X = rigid_motions(model);
  const double length = std::sqrt(0.25 + 0.01) + std::sqrt(0.25 + 0.01 + 0.04);
  const MatrixX J = X.transpose() * (model.mass.entries * X);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(J(i, i), 2700.0 * 6e-4 * length, 1e-13);
  EXPECT_LT((model.stiffness.entries * X).cwiseAbs().maxCoeff(),
            1e-14 * model.stiffness.entries.coeffs().cwiseAbs().maxCoeff());
}

TEST(MatrixSamples, ElementsOfModelFilesAreDrawn) {
  for (const char* folder : {"dmig_large", "op4_dense", "abaqus_coordinate",
                             "ansys_harwell_boeing"}) {
    const MatrixModel model = read_sample(folder);
    // Tags 7, 10, 20: the beams 10-20 and 20-7.
    EXPECT_THAT(model.edges, ElementsAre(ElementsAre(1, 2), ElementsAre(2, 0)))
        << folder;
  }
  const MatrixModel model = read_sample("ansys_harwell_boeing");
  ASSERT_THAT(model.sets, SizeIs(1));
  EXPECT_EQ(model.sets[0].name, "ENDS");
  EXPECT_THAT(model.sets[0].nodes, ElementsAre(0, 1));
  EXPECT_THAT(read_sample("abaqus_coordinate").sets, SizeIs(2));
}

}  // namespace
}  // namespace limber::fem::samples_test
