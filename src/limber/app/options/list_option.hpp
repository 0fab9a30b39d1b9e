// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace limber::app {

/// The values of an option that are separated by commas.
/// @param given one text each time that the option was given
/// @throws CLI::ValidationError if one is empty, as in "a," and "a,,b", which
/// CLI11's own splitting ignores
[[nodiscard]] std::vector<std::string> split_list(
    const std::string& option, const std::vector<std::string>& given);

/// Adds an option with values separated by commas.
/// @param values must live until the command line is parsed
/// @param check of each value
template <typename T>
CLI::Option* add_list(CLI::App& command, const std::string& option,
                      std::vector<T>& values, const std::string& description,
                      const CLI::Validator& check = {}) {
  const auto read = [option, &values,
                     check](const std::vector<std::string>& given) {
    values.clear();
    for (std::string& text : split_list(option, given)) {
      const std::string why = check(text);
      if (!why.empty()) throw CLI::ValidationError(option, why);
      T value{};
      if (!CLI::detail::lexical_cast(text, value)) {
        throw CLI::ConversionError(text, option);
      }
      values.push_back(value);
    }
  };
  return command
      .add_option_function<std::vector<std::string>>(option, read, description)
      ->type_name(CLI::detail::type_name<T>());
}

}  // namespace limber::app
