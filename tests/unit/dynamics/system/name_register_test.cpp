// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/name_register.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "limber/common/errors.hpp"

namespace limber::dynamics::name_register_test {
namespace {

using ::testing::HasSubstr;

std::string find_problem(const std::string& name) {
  try {
    return NameRegister().check("body", name);
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(NameRegister, RefusesNamesThatFormatsOfResultsCannotHold) {
  EXPECT_EQ(find_problem("Tr\xc3\xa4ger"), "body 'Tr\xc3\xa4ger'");
  EXPECT_THAT(find_problem("b\xff"),
              HasSubstr("'b\\xff' of a body is not UTF-8"));
  EXPECT_THAT(find_problem("a\nb"), HasSubstr("control character"));
  EXPECT_THAT(find_problem(std::string(201, 'n')), HasSubstr("200 bytes"));
}

}  // namespace
}  // namespace limber::dynamics::name_register_test
