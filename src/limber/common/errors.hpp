// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

/// The three kinds of error. Messages name the problem with its value and unit,
/// the reason, and what would fix it.
namespace limber {

/// Wrong input: a file, a key, a parameter value. Exit status 2.
class InputError : public std::runtime_error {
 public:
  /// @param problem what is wrong, where, what was expected.
  explicit InputError(const std::string& problem);
  /// All problems of one file at once; the message has a line for each.
  explicit InputError(std::vector<std::string> problems);

  [[nodiscard]] const std::vector<std::string>& problems() const {
    return problems_;
  }

 private:
  std::vector<std::string> problems_;
};

/// The C library's errno as text.
[[nodiscard]] std::string describe_errno();

/// A computation that cannot continue: no convergence, a singular matrix, a
/// value that is not finite. Exit status 3; results so far are kept.
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A programming error of the caller: wrong size, index of another model. Exit
/// status 70.
class ContractError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

namespace detail {
[[noreturn]] void fail_contract(const char* expression, const char* file,
                                int line);
}  // namespace detail

}  // namespace limber

/// Checks a precondition in every build. @throws limber::ContractError.
#define LIMBER_EXPECT(expression)                                       \
  do {                                                                  \
    if (!(expression)) {                                                \
      ::limber::detail::fail_contract(#expression, __FILE__, __LINE__); \
    }                                                                   \
  } while (false)
