// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/force_file.hpp"

#include <gmock/gmock.h>

#include "unit/scene/temporary_file.hpp"

namespace limber::scene::force_file_test {
namespace {

using test::input_error;
using test::TemporaryFile;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string error_of(const std::string& text) {
  const TemporaryFile file("force.txt", text);
  return input_error([&] { (void)read_force_file(file.path()); });
}

TEST(ForceFile, IsARowOfTimesAndARowADegreeOfFreedom) {
  const TemporaryFile file("force.txt", "0 0.01 0.5\n1 2 3\n-4 5e1 6\n\n");
  const ForceFile forces = read_force_file(file.path());
  EXPECT_THAT(forces.times, ElementsAre(0.0, 0.01, 0.5));
  const MatrixX expected{{1.0, 2.0, 3.0}, {-4.0, 50.0, 6.0}};
  EXPECT_EQ(forces.forces, expected);
}

TEST(ForceFile, LeavesOutTimesAtWhichNothingChanges) {
  const TemporaryFile file("force.txt", "0 1 2 3\n5 5 7 7\n6 6 6 6\n");
  const ForceFile forces = read_force_file(file.path());
  EXPECT_THAT(forces.times, ElementsAre(0.0, 2.0));
  const MatrixX expected{{5.0, 7.0}, {6.0, 6.0}};
  EXPECT_EQ(forces.forces, expected);
}

TEST(ForceFile, RefusesWhatIsNotOneForceATime) {
  EXPECT_THAT(error_of("0 1\n1 2\n1 2 3\n"),
              AllOf(HasSubstr("force.txt:3"), HasSubstr("3 forces for 2")));
}

TEST(ForceFile, RefusesTimesThatDoNotIncrease) {
  EXPECT_THAT(error_of("0 2 2\n1 2 3\n"),
              AllOf(HasSubstr("force.txt:1"), HasSubstr("must increase")));
}

TEST(ForceFile, RefusesWhatIsNoFiniteNumber) {
  EXPECT_THAT(error_of("0 1\n1 nan\n"), HasSubstr("force.txt:2"));
  EXPECT_THAT(error_of("0 inf\n1 2\n"), HasSubstr("force.txt:1"));
  EXPECT_THAT(error_of("0 1\n1 x\n"), HasSubstr("'x' is not a number"));
}

TEST(ForceFile, RefusesAZeroByteInPlaceOfPassingOverWhatFollows) {
  EXPECT_THAT(error_of(std::string("0 1\n1 2\0003\n", 9)),
              AllOf(HasSubstr("force.txt:2"), HasSubstr("a byte 0")));
}

TEST(ForceFile, RefusesAnEmptyOrMissingFile) {
  EXPECT_THAT(error_of(""), HasSubstr("no times"));
  EXPECT_THAT(input_error([] { (void)read_force_file("gone.txt"); }),
              HasSubstr("gone.txt"));
}

TEST(NodalField, IsOneValueARow) {
  const TemporaryFile file("field.txt", "1\n\n-2.5\n3e-3\n");
  EXPECT_EQ(read_nodal_field(file.path()), Vector3(1.0, -2.5, 3e-3));
}

TEST(NodalField, RefusesAnythingElseWithItsLine) {
  const auto field_error = [](const std::string& text) {
    const TemporaryFile file("field.txt", text);
    return input_error([&] { (void)read_nodal_field(file.path()); });
  };
  EXPECT_THAT(field_error("1\n2 3\n"),
              AllOf(HasSubstr("field.txt:2"), HasSubstr("2 values")));
  EXPECT_THAT(field_error("1\ninf\n"), HasSubstr("field.txt:2"));
  EXPECT_THAT(field_error("\n"), HasSubstr("no values"));
  EXPECT_THAT(input_error([] { (void)read_nodal_field("gone.txt"); }),
              HasSubstr("cannot read this nodal field"));
}

}  // namespace
}  // namespace limber::scene::force_file_test
