// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/points_reader.hpp"

namespace limber::scene {
namespace {

std::vector<double> required_numbers(TomlTable& table, const std::string& key) {
  if (!table.has(key)) table.fail("needs '" + key + "', an array of numbers");
  return table.numbers(key).value_or(std::vector<double>{});
}

}  // namespace

Series read_points(TomlTable& table, const std::filesystem::path& folder) {
  const auto file = table.text("file");
  if (!file) {
    return {required_numbers(table, "times"),
            required_numbers(table, "values")};
  }
  if (table.has("times") || table.has("values")) {
    table.fail("has both 'file' and 'times' or 'values'; keep one");
  }
  (void)table.numbers("times");
  (void)table.numbers("values");
  try {
    return read_series((folder / *file).lexically_normal());
  } catch (const InputError& error) {
    table.fail("file", error.problems().front());
  }
  return {};
}

}  // namespace limber::scene
