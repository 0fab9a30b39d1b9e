// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <type_traits>

namespace limber::errors_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(InputError, KeepsEveryProblem) {
  const InputError error(std::vector<std::string>{"first", "second"});
  EXPECT_THAT(error.problems(), ElementsAre("first", "second"));
  EXPECT_THAT(error.what(), HasSubstr("first\n"));
  EXPECT_THAT(error.what(), HasSubstr("second"));
}

TEST(InputError, OneProblemIsItsText) {
  const InputError error("density is -1 kg/m^3");
  EXPECT_THAT(error.problems(), ElementsAre("density is -1 kg/m^3"));
  EXPECT_STREQ(error.what(), "density is -1 kg/m^3");
}

TEST(ContractError, NamesTheExpressionAndThePlace) {
  const int size = 3;
  try {
    LIMBER_EXPECT(size == 4);
    FAIL() << "no throw";
  } catch (const ContractError& error) {
    EXPECT_THAT(error.what(), HasSubstr("size == 4"));
    EXPECT_THAT(error.what(), HasSubstr("errors_test.cpp"));
  }
}

TEST(ContractError, IsNotThrownWhenTheContractHolds) {
  int evaluations = 0;
  EXPECT_NO_THROW(LIMBER_EXPECT(++evaluations == 1));
  EXPECT_EQ(evaluations, 1);
}

TEST(Errors, ClassesStayApart) {
  // The exit status depends on it.
  EXPECT_THROW(throw NumericalError("no convergence"), std::runtime_error);
  EXPECT_FALSE((std::is_base_of_v<InputError, NumericalError>));
  EXPECT_FALSE((std::is_base_of_v<std::runtime_error, ContractError>));
}

}  // namespace
}  // namespace limber::errors_test
