// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <system_error>

namespace limber {

InputError::InputError(const std::string& problem)
    : std::runtime_error(problem), problems_{problem} {}

InputError::InputError(std::vector<std::string> problems)
    : std::runtime_error(fmt::format("{}", fmt::join(problems, "\n"))),
      problems_(std::move(problems)) {}

std::string describe_errno() { return std::generic_category().message(errno); }

namespace detail {
void fail_contract(const char* expression, const char* file, int line) {
  throw ContractError(
      fmt::format("{}:{}: expected {}", file, line, expression));
}
}  // namespace detail

}  // namespace limber
