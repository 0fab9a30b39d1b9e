// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/records/manifest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <utility>

#include "limber/common/records/digest.hpp"

namespace limber {
namespace {

// Longest list that is written out.
constexpr std::size_t kFew = 9;

// So that tabs and line breaks are only separators.
std::string escape(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\') {
      safe += "\\\\";
    } else if (c == '\t') {
      safe += "\\t";
    } else if (c == '\n') {
      safe += "\\n";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string describe_shape(const std::vector<double>& values,
                           const std::string& shape) {
  if (!shape.empty()) return shape + " numbers";
  return fmt::format("{} numbers from {} to {}", values.size(), values.front(),
                     values.back());
}

using Values = std::map<std::string, std::string, std::less<>>;

// The values by path; several in a row where names are shared.
struct Lines {
  Values values;
  std::vector<std::string> paths;  // in order
};

Lines read_lines(const std::string& text) {
  Lines lines;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const std::size_t tab = line.rfind('\t');
    const std::string path = line.substr(0, tab);
    const std::string value =
        tab == std::string::npos ? "" : line.substr(tab + 1);
    const auto [found, is_new] = lines.values.emplace(path, value);
    if (is_new) {
      lines.paths.push_back(path);
    } else {
      found->second += "; " + value;
    }
    begin = end + 1;
  }
  return lines;
}

// Whether any path equals this place or lies within it.
bool has_place(const Values& values, const std::string& place) {
  if (values.contains(place)) return true;
  const auto next = values.lower_bound(place + '\t');
  return next != values.end() && next->first.starts_with(place + '\t');
}

// The outermost missing place of a path.
std::string find_missing(const Values& values, const std::string& path) {
  std::size_t end = path.find('\t');
  while (end != std::string::npos && has_place(values, path.substr(0, end))) {
    end = path.find('\t', end + 1);
  }
  return path.substr(0, end);
}

// A path in readable form, and the unit in brackets at its end, if any.
std::pair<std::string, std::string> split_unit(const std::string& path) {
  std::string text;
  for (const char c : path) {
    c == '\t' ? text += ", " : text += c;
  }
  const std::size_t open = text.rfind(" [");
  if (open == std::string::npos || text.back() != ']') return {text, ""};
  const std::string unit = text.substr(open + 2, text.size() - open - 3);
  return {text.substr(0, open), unit.empty() ? "" : " " + unit};
}

std::string without_digest(const std::string& value) {
  return value.substr(0, value.find(" #"));
}

std::string describe_change(const std::string& path, const std::string& before,
                            const std::string& now) {
  const auto [name, unit] = split_unit(path);
  const std::string from = without_digest(before);
  const std::string to = without_digest(now);
  if (from == to) return fmt::format("{}: other values ({})", name, to);
  return fmt::format("{}: {} -> {}{}", name, from, to, unit);
}

}  // namespace

void Manifest::enter(std::string_view place) {
  if (!place.empty()) path_ += escape(place) + '\t';
}

void Manifest::add(std::string_view name, std::string_view value) {
  text_ += path_;
  text_ += escape(name);
  text_ += '\t';
  text_ += escape(value);
  text_ += '\n';
}

void Manifest::add(std::string_view name, double value) {
  add(name, std::string_view(fmt::format("{}", value)));
}

void Manifest::add(std::string_view name, const std::vector<double>& values,
                   const std::string& shape) {
  if (values.size() <= kFew) {
    add(name, std::string_view(fmt::format("({})", fmt::join(values, ", "))));
    return;
  }
  Digest digest;
  digest.add(shape);
  digest.add_bytes(values.data(), sizeof(double) * values.size());
  add(name, std::string_view(fmt::format(
                "{} #{}", describe_shape(values, shape), digest.text())));
}

std::vector<std::string> find_differences(const Manifest& before,
                                          const Manifest& now) {
  if (before.text() == now.text()) return {};
  const Lines old_lines = read_lines(before.text());
  const Lines new_lines = read_lines(now.text());
  std::vector<std::string> texts;
  std::set<std::string> reported;
  const auto report_missing = [&](const Values& values, const std::string& path,
                                  const char* what) {
    const std::string place = find_missing(values, path);
    if (!reported.insert(place).second) return;
    texts.push_back(split_unit(place).first + what);
  };
  for (const std::string& path : new_lines.paths) {
    const auto old = old_lines.values.find(path);
    const std::string& value = new_lines.values.at(path);
    if (old == old_lines.values.end()) {
      report_missing(old_lines.values, path, " is new");
    } else if (old->second != value) {
      texts.push_back(describe_change(path, old->second, value));
    }
  }
  for (const std::string& path : old_lines.paths) {
    if (!new_lines.values.contains(path)) {
      report_missing(new_lines.values, path, " is gone");
    }
  }
  if (texts.empty()) texts.emplace_back("the same entries in another order");
  return texts;
}

}  // namespace limber
