// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/source_matrix.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <string_view>

#include "limber/common/upper_case.hpp"

namespace limber::fem {
namespace {

/// A word of its own: no letter before or after it.
bool has_role_word(const std::string& name, std::string_view word) {
  for (std::size_t at = name.find(word); at != std::string::npos;
       at = name.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || std::isalpha(name[at - 1] & 0xff) == 0) &&
        (end == name.size() || std::isalpha(name[end] & 0xff) == 0))
      return true;
  }
  return false;
}

constexpr std::array<std::string_view, 6> kMoments = {"S_XX", "S_YY", "S_ZZ",
                                                      "S_XY", "S_XZ", "S_YZ"};

}  // namespace

std::string name_row(const RowLabel& label) {
  return fmt::format("{}.{}", label.node, label.component);
}

MatrixRole guess_role(const std::string& name) {
  const std::string upper = to_upper(name);
  const bool is_stiffness =
      upper.find("STIF") != std::string::npos || upper.ends_with(".STI");
  const bool is_mass =
      upper.find("MASS") != std::string::npos || upper.ends_with(".MAS");
  if (is_stiffness != is_mass)
    return is_stiffness ? MatrixRole::stiffness : MatrixRole::mass;
  if (upper.starts_with("K4")) return MatrixRole::other;  // structural damping
  // Nastran's names, and what people call their own files.
  constexpr std::array<std::string_view, 18> kEndings = {
      "",   "AA",  "AAX", "GG",  "GGX", "HH",  "LL",  "TT", "NN",
      "FF", "MAT", "XX",  "JJX", "JJ",  "2GG", "MTX", "OO", "SS"};
  for (const std::string_view ending : kEndings) {
    const bool k = has_role_word(upper, "K" + std::string(ending));
    const bool m = has_role_word(upper, "M" + std::string(ending));
    if (k != m) return k ? MatrixRole::stiffness : MatrixRole::mass;
  }
  return MatrixRole::unknown;
}

std::string describe_matrix(const SourceMatrix& source) {
  return fmt::format(
      "{}{}{} ({}, {} rows)",
      std::filesystem::path(source.matrix.file).filename().string(),
      source.name.empty() ? "" : " ", source.name, source.format,
      source.matrix.entries.rows());
}

int find_second_moment(const std::filesystem::path& file) {
  const std::string name = to_upper(file.stem().string());
  for (std::size_t i = 0; i < kMoments.size(); ++i)
    if (name == kMoments[i]) return static_cast<int>(i);
  return -1;
}

}  // namespace limber::fem
