// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/node_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "limber/common/echo.hpp"
#include "limber/common/upper_case.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {
namespace {

constexpr long kMostNodeNumber = 2'000'000'000;

/// Fields of a table's line: between semicolons, or commas, or tabs, or blanks.
std::vector<std::string> split_table_line(std::string_view line) {
  std::string text(line);
  const auto has = [&](char c) { return text.find(c) != std::string::npos; };
  const bool by_tabs = has('\t') && !has(';');
  if (by_tabs || has(';'))
    std::replace(text.begin(), text.end(), ',', '.');  // decimal commas
  std::replace(text.begin(), text.end(), ';', ' ');
  std::vector<std::string> fields;
  std::string_view rest = text;
  for (std::string_view word; !(word = take_word(rest)).empty();)
    fields.emplace_back(word);
  return fields;
}

bool is_table_comment(std::string_view line) {
  const std::string_view text = trim_blanks(line);
  return text.empty() || text[0] == '#' || text[0] == '%' || text[0] == '!' ||
         text[0] == '$' || text.starts_with("**");
}

bool is_number(const std::string& text) {
  double value = 0.0;
  return parse_real(text, value);
}

/// A point alone is written so by Workbench: "0," for 0.
double read_coordinate(const TextScanner& scanner, const std::string& text) {
  double value = 0.0;
  if (!parse_real(text, value))
    scanner.fail(fmt::format(
        "'{}' is not a finite number. Expected a coordinate.", echo(text)));
  return value;
}

long read_node(const TextScanner& scanner, const std::string& text) {
  long node = 0;
  if (!parse_whole(text, node) || node < 1 || node > kMostNodeNumber)
    scanner.fail(fmt::format("'{}' is not a node. Expected an integer from 1.",
                             echo(text)));
  return node;
}

/// 123 or 123456 and the like: digits 1 to 6, ascending.
long read_components(const TextScanner& scanner, const std::string& text) {
  long value = 0;
  const bool is_right =
      parse_whole(text, value) && value > 0 &&
      std::adjacent_find(text.begin(), text.end(), std::greater_equal<>()) ==
          text.end() &&
      text.find_first_not_of("123456") == std::string::npos;
  if (!is_right)
    scanner.fail(
        fmt::format("'{}' are not components. Expected ascending digits 1 to "
                    "6, such as 123 or 123456.",
                    echo(text)));
  return value;
}

/// 1 to 6, 0, or a name; -1 if it is none of them.
int find_component(std::string_view word) {
  const std::string upper = to_upper(std::string(word));
  constexpr std::array<std::array<std::string_view, 3>, 6> kNames = {
      {{"UX", "X", "TX"},
       {"UY", "Y", "TY"},
       {"UZ", "Z", "TZ"},
       {"ROTX", "RX", "THXY"},
       {"ROTY", "RY", "THYZ"},
       {"ROTZ", "RZ", "THZX"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i)
    for (const std::string_view name : kNames[i])
      if (upper == name) return static_cast<int>(i) + 1;
  long value = -1;
  if (parse_whole(word, value) && value >= 0 && value <= 6)
    return static_cast<int>(value);
  constexpr int kUnknown = 7;  // TEMP, WARP and others: a row of its node
  const bool is_name = std::all_of(upper.begin(), upper.end(),
                                   [](char c) { return c >= 'A' && c <= 'Z'; });
  return is_name && upper.size() >= 2 ? kUnknown : -1;
}

class NodeTableReader {
 public:
  explicit NodeTableReader(const std::filesystem::path& file) : scanner_(file) {
    model_.file = file;
    model_.format = "table of nodes";
  }

  ModelFile read() {
    while (scanner_.next_text()) {
      if (is_table_comment(scanner_.line())) continue;
      const std::vector<std::string> fields = split_table_line(scanner_.line());
      if (fields.empty() || !is_number(fields[0])) {
        take_head();
      } else {
        add_node(fields);
      }
    }
    if (model_.tags.empty()) scanner_.fail_at_end("lines node, x, y, z");
    return std::move(model_);
  }

 private:
  /// Which column is what. Text that names no columns is passed over.
  void take_head() {
    const std::string upper = to_upper(std::string(scanner_.line()));
    std::vector<std::string> names = split_table_line(upper);
    const auto find = [&](std::initializer_list<std::string_view> known) {
      for (std::size_t i = 0; i < names.size(); ++i)
        if (std::find(known.begin(), known.end(), names[i]) != known.end())
          return static_cast<int>(i);
      return -1;
    };
    const std::array<int, 4> columns = {find({"NODE", "ID", "TAG"}),
                                        find({"X"}), find({"Y"}), find({"Z"})};
    if (*std::min_element(columns.begin(), columns.end()) < 0) {
      if (!model_.tags.empty() && upper.find("NODE") == std::string::npos)
        scanner_.fail(fmt::format("'{}' is not a node. Expected node, x, y, z.",
                                  echo(scanner_.line())));
      return;
    }
    columns_ = columns;
    components_ = find({"COMPONENTS", "DOFS"});
    angles_ = find({"THXY", "ROTX"});
    width_ = names.size();
    has_head_ = true;
  }

  void add_node(const std::vector<std::string>& fields) {
    const std::size_t least = static_cast<std::size_t>(*std::max_element(
                                  columns_.begin(), columns_.end())) +
                              1;
    if (fields.size() < least || fields.size() > std::max(width_, least) ||
        (components_ >= 0 && fields.size() < width_)) {
      scanner_.fail(
          fmt::format("{} columns. Expected {}.", fields.size(),
                      has_head_ ? "those of the head line" : "node, x, y, z"));
    }
    const auto at = [&](int i) -> const std::string& {
      return fields[static_cast<std::size_t>(i)];
    };
    const long node = read_node(scanner_, at(columns_[0]));
    const auto [found, is_new] = lines_.try_emplace(node, scanner_.number());
    if (!is_new)
      scanner_.fail(fmt::format(
          "node {} is given twice, first on line {}. Expected each node once.",
          node, found->second));
    Vector3 x;
    for (int i = 0; i < 3; ++i)
      x[i] = read_coordinate(scanner_,
                             at(columns_[static_cast<std::size_t>(i) + 1]));
    if (angles_ >= 0)
      for (std::size_t i = static_cast<std::size_t>(angles_); i < fields.size();
           ++i)
        if (read_coordinate(scanner_, fields[i]) != 0.0)
          scanner_.fail(fmt::format(
              "node {} has rotated axes ({}). Expected nodes in the global "
              "axes: NROTAT all back before the matrices are written.",
              node, echo(fields[i])));
    model_.tags.push_back(node);
    model_.x.push_back(x);
    model_.components.push_back(
        components_ < 0 ? 0 : read_components(scanner_, at(components_)));
  }

  TextScanner scanner_;
  ModelFile model_;
  std::array<int, 4> columns_ = {0, 1, 2, 3};
  int components_ = -1;
  int angles_ = -1;
  std::size_t width_ = 4;
  bool has_head_ = false;
  std::unordered_map<long, std::size_t> lines_;
};

/// Puts rows that came in any order in their places.
class RowTableMaker {
 public:
  void add(const TextScanner& scanner, long row, const RowLabel& label) {
    // Rows beyond the number of lines are found missing at the end.
    const long most = static_cast<long>(kMostRows);
    if (row < 1 || row > most)
      scanner.fail(fmt::format("row {}. Expected 1 to {}.", row, most));
    const auto at = static_cast<std::size_t>(row) - 1;
    if (at >= labels_.size()) {
      labels_.resize(at + 1);
      lines_.resize(at + 1, 0);
    }
    if (lines_[at] != 0)
      scanner.fail(fmt::format(
          "row {} is given twice, first on line {}. Expected each row once.",
          row, lines_[at]));
    labels_[at] = label;
    lines_[at] = scanner.number();
  }
  [[nodiscard]] bool empty() const { return labels_.empty(); }
  std::vector<RowLabel> finish(const TextScanner& scanner) && {
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (lines_[i] == 0)
        scanner.fail_at_end(fmt::format("row {}, which is missing among {}",
                                        i + 1, lines_.size()));
    return std::move(labels_);
  }

 private:
  static constexpr std::size_t kMostRows = 10'000'000;
  std::vector<RowLabel> labels_;
  std::vector<std::size_t> lines_;
};

}  // namespace

ModelFile read_node_table(const std::filesystem::path& file) {
  return NodeTableReader(file).read();
}

RowTable read_row_table(const std::filesystem::path& file) {
  TextScanner scanner(file);
  RowTableMaker rows;
  while (scanner.next_text()) {
    if (is_table_comment(scanner.line())) continue;
    const std::vector<std::string> fields = split_table_line(scanner.line());
    if (rows.empty() && !is_number(fields[0])) continue;  // the head line
    long row = 0;
    RowLabel label;
    if (fields.size() != 3 || !parse_whole(fields[0], row) ||
        !parse_whole(fields[1], label.node) || label.node < 0 ||
        label.node > kMostNodeNumber ||
        (label.component = find_component(fields[2])) < 0) {
      scanner.fail(
          fmt::format("'{}'. Expected row, node and component: 1 to 6, "
                      "UX to ROTZ, or 0 of a scalar row.",
                      echo(scanner.line())));
    }
    // Scalar rows without a number are not the same row.
    if (label == RowLabel{}) label.node = -row;
    rows.add(scanner, row, label);
  }
  if (rows.empty()) scanner.fail_at_end("lines row, node, component");
  return {file, "table of rows", std::move(rows).finish(scanner)};
}

RowTable read_dof_lines(const std::filesystem::path& file) {
  TextScanner scanner(file);
  RowTable table{file, "CalculiX's rows (.dof)", {}};
  while (scanner.next_text()) {
    const std::string_view text = trim_blanks(scanner.line());
    const std::size_t dot = text.find('.');
    RowLabel label;
    long component = 0;
    if (dot == std::string_view::npos ||
        !parse_whole(text.substr(0, dot), label.node) || label.node < 1 ||
        !parse_whole(text.substr(dot + 1), component) || component < 0 ||
        component > 6 || label.node > kMostNodeNumber) {
      scanner.fail(fmt::format("'{}'. Expected node.component, such as 12.3.",
                               echo(text)));
    }
    label.component = static_cast<int>(component);
    table.labels.push_back(label);
  }
  if (table.labels.empty()) scanner.fail_at_end("lines node.component");
  return table;
}

std::vector<RowTable> read_set_print(const std::filesystem::path& file) {
  TextScanner scanner(file);
  std::vector<RowTable> tables;
  RowTableMaker rows;
  std::string set;
  const auto finish = [&] {
    if (!rows.empty())
      tables.push_back(
          {file, "Nastran's set " + set, std::move(rows).finish(scanner)});
    rows = {};
  };
  bool is_inside = false;
  while (scanner.next_text()) {
    std::string_view rest = scanner.line();
    if (contains_word(rest, "DISPLACEMENT SET")) {
      const std::string name(take_word(rest));
      if (!is_inside || name != set) finish();
      set = name;
      is_inside = true;
      continue;
    }
    // "  11=   4-1   4-2   4-3": rows from 11 on
    const std::size_t equals = rest.find('=');
    long row = 0;
    if (!is_inside || equals == std::string_view::npos ||
        !parse_whole(trim_blanks(rest.substr(0, equals)), row))
      continue;
    rest.remove_prefix(equals + 1);
    for (std::string_view word; !(word = take_word(rest)).empty(); ++row) {
      if (word.starts_with('=')) break;
      const std::size_t dash = word.find('-');
      RowLabel label;
      long component = 0;
      if (dash == std::string_view::npos ||
          !parse_whole(word.substr(0, dash), label.node) || label.node < 1 ||
          label.node > kMostNodeNumber ||
          !parse_whole(word.substr(dash + 1), component) || component < 0 ||
          component > 6)
        scanner.fail(fmt::format("'{}' is not a row. Expected grid-component.",
                                 echo(word)));
      label.component = static_cast<int>(component);
      rows.add(scanner, row, label);
    }
  }
  finish();
  if (tables.empty()) scanner.fail_at_end("a table of a displacement set");
  return tables;
}

}  // namespace limber::fem
