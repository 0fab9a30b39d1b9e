// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"

namespace limber {
namespace {

// A file may have thousands of names, and as many unknown ones.
constexpr std::size_t kMostCompared = 1000;
constexpr std::size_t kMostListed = 30;

std::string list_names(const std::vector<std::string>& names) {
  if (names.empty()) return "none";
  const auto listed =
      static_cast<std::ptrdiff_t>(std::min(names.size(), kMostListed));
  const std::string more =
      names.size() > kMostListed
          ? fmt::format(" and {} more", names.size() - kMostListed)
          : "";
  std::vector<std::string> shown;
  std::transform(names.begin(), names.begin() + listed,
                 std::back_inserter(shown), echo);
  return fmt::format("{}{}", fmt::join(shown, ", "), more);
}

/// Whether it is `name` without what comes before a dot, as a link's own name
/// is of `robot.link`.
bool is_end_of(std::string_view end, std::string_view name) {
  return !end.empty() && name.size() > end.size() + 1 && name.ends_with(end) &&
         name[name.size() - end.size() - 1] == '.';
}

}  // namespace

std::size_t find_edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
    }
  }
  return row.back();
}

std::string nearest_name(std::string_view unknown,
                         const std::vector<std::string>& known) {
  if (known.size() > kMostCompared) return "";
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, unknown.size() / 2);
  for (const std::string& name : known) {
    const std::size_t distance = find_edit_distance(unknown, name);
    if (distance <= best_distance &&
        (best.empty() || distance < best_distance)) {
      best = name;
      best_distance = distance;
    }
  }
  if (best == unknown) return best;
  const auto qualified = std::find_if(
      known.begin(), known.end(),
      [&](const std::string& name) { return is_end_of(unknown, name); });
  return qualified == known.end() ? best : *qualified;
}

std::string describe_unknown(std::string_view kind, std::string_view name,
                             const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  const std::string hint =
      nearest.empty() ? "" : fmt::format("; did you mean '{}'?", echo(nearest));
  return fmt::format("unknown {} '{}'{} (known: {})", kind, echo(name), hint,
                     list_names(known));
}

std::size_t find_name(std::string_view kind, std::string_view name,
                      const std::vector<std::string>& known) {
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) {
    throw InputError(describe_unknown(kind, name, known));
  }
  return static_cast<std::size_t>(found - known.begin());
}

}  // namespace limber
