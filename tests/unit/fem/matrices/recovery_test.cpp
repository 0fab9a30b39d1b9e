// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "unit/fem/matrices/sample_files.hpp"

/// Recovery rows and second moments of a model's mass, from files.
namespace limber::fem::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

using Path = std::filesystem::path;

MatrixModel read_with(const Path& folder) {
  return read_matrices(
      {{folder},
       {folder / "recovery/otm.mtx", folder / "recovery/points.csv"}});
}

std::string find_error(const MatrixFiles& files) {
  try {
    static_cast<void>(read_matrices(files));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_recovered(const MatrixModel& model) {
  EXPECT_EQ(model.rows.size(), 20U);
  EXPECT_EQ(model.tags.size(), 50U);  // 2 of the boundary, 48 points
  EXPECT_EQ(model.condensed.size(), 144U);
  EXPECT_TRUE(model.has_recovery);
  EXPECT_THAT(model.found, Contains(HasSubstr("otm.mtx: recovery")));
  // A translation of the boundary moves every point by as much.
  VectorX x = VectorX::Zero(20);
  x[1] = x[7] = 1.0;
  const VectorX u = model.equations * x;
  for (Eigen::Index i = 0; i < u.size(); ++i)
    EXPECT_NEAR(u[i], i % 3 == 1 ? 1.0 : 0.0, 1e-9);
}

TEST(Recovery, IsReadFromFilesOfItsOwn) {
  expect_recovered(read_with(sample_folder("superelement")));
}

TEST(Recovery, IsFoundBesideTheMatricesByItsShape) {
  const Path folder = copy_sample("superelement");
  for (const char* name : {"otm.mtx", "points.csv"})
    replace_text(folder / name,
                 read_text(sample_folder("superelement") / "recovery" / name));
  expect_recovered(read_matrices({{folder}}));
}

TEST(Recovery, OfOtherColumnsThanTheStiffnessHasRowsIsRefused) {
  const Path folder = copy_sample("superelement");
  replace_text(folder / "otm.mtx",
               "%%MatrixMarket matrix array real general\n3 2\n1\n0\n0\n0\n1\n"
               "0\n");
  EXPECT_THAT(find_error({{folder}}),
              HasSubstr("3 x 2 entries. Expected 20 columns"));
}

TEST(Recovery, WithoutItsPointsIsRefused) {
  const Path folder = sample_folder("superelement");
  EXPECT_THAT(find_error({{folder}, {folder / "recovery/otm.mtx"}}),
              HasSubstr("it has 144 rows, and the meaning of only 0 is known"));
  EXPECT_THAT(find_error({{folder}, {folder / "recovery/points.csv"}}),
              HasSubstr("no matrix of recovery rows"));
  EXPECT_THAT(find_error({{folder}, {folder / "rows.csv", folder / "K.mtx"}}),
              HasSubstr("'symmetric', 20 rows and 20 columns"));
}

TEST(Recovery, OfARowOfTheModelMustBeThatRow) {
  const Path folder = sample_folder("superelement");
  const Path own = copy_sample("superelement");
  const std::string matrix =
      "%%MatrixMarket matrix coordinate real general\n1 20 1\n";
  replace_text(own / "p.csv", "node,x,y,z,components\n2,1,1,0,1\n");
  replace_text(own / "r.mtx", matrix + "1 7 1.0\n");
  const std::vector<Path> recovery = {own / "p.csv", own / "r.mtx"};
  EXPECT_EQ(find_error({{folder}, recovery}), "");
  replace_text(own / "r.mtx", matrix + "1 8 1.0\n");
  EXPECT_THAT(find_error({{folder}, recovery}),
              HasSubstr("row 1 recovers 2.1, which is row 7 of the matrices"));
  replace_text(own / "p.csv", "node,x,y,z,components\n2,5,1,0,1\n");
  EXPECT_THAT(find_error({{folder}, recovery}),
              HasSubstr("point 2 is not at the position of node 2"));
}

TEST(SecondMoments, MustBeSixAndSumToTheMass) {
  const Path folder = copy_sample("superelement");
  const auto write = [&](const char* name, const std::string& entries) {
    replace_text(
        folder / name,
        "%%MatrixMarket matrix coordinate real general\n20 20 1\n" + entries);
  };
  write("S_xx.mtx", "1 1 1.0\n");
  EXPECT_THAT(find_error({{folder}}), HasSubstr("1 of six second moments"));
  for (const char* name :
       {"S_yy.mtx", "S_zz.mtx", "S_xy.mtx", "S_xz.mtx", "S_yz.mtx"})
    write(name, "1 1 1.0\n");
  EXPECT_THAT(find_error({{folder}}),
              HasSubstr("S_xx + S_yy + S_zz differs from the mass matrix"));
}

}  // namespace
}  // namespace limber::fem::test
