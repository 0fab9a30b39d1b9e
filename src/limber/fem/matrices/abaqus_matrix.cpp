// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/abaqus_matrix.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <unordered_map>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/upper_case.hpp"
#include "limber/fem/matrices/matrix_entries.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {
namespace {

constexpr long kMostAbaqusNode = 2'000'000'000;
constexpr long kMostAbaqusDof = 63;  // 30 is the last of Abaqus

RowLabel take_label(const TextScanner& scanner, std::string_view& rest) {
  const std::string_view node = take_word(rest);
  const std::string_view dof = take_word(rest);
  RowLabel label;
  long component = 0;
  if (!parse_whole(node, label.node) || label.node == 0 ||
      std::labs(label.node) > kMostAbaqusNode || !parse_whole(dof, component) ||
      component < 0 || component > kMostAbaqusDof) {
    scanner.fail(
        fmt::format("'{},{}' are not a node and a degree of freedom. Expected "
                    "node,dof, node,dof, value.",
                    echo(node), echo(dof)));
  }
  label.component = static_cast<int>(component);
  return label;
}

class SubstructureReader {
 public:
  explicit SubstructureReader(const std::filesystem::path& file)
      : scanner_(file) {}

  std::vector<SourceMatrix> read() {
    while (scanner_.next_text()) {
      const std::string_view line = trim_blanks(scanner_.line());
      if (line.starts_with("**")) {
        read_comment(line);
      } else if (line.starts_with('*')) {
        begin_keyword(line);
      } else if (part_ == Part::dofs) {
        add_dofs(line);
      } else if (part_ == Part::matrix) {
        add_values(line);
      } else {
        scanner_.fail(
            "data of no keyword. Expected *USER ELEMENT or *MATRIX before it.");
      }
    }
    finish_matrix();
    if (sources_.empty()) scanner_.fail_at_end("*MATRIX,TYPE=STIFFNESS");
    return std::move(sources_);
  }

 private:
  enum class Part { none, dofs, matrix, other };

  void read_comment(std::string_view line) {
    std::string_view rest = line.substr(2);
    if (contains_word(line, "ELEMENT NODES") ||
        contains_word(line, "SUBSTRUCTURE NODES")) {
      lists_nodes_ = true;
      nodes_.clear();
      return;
    }
    if (!lists_nodes_) return;
    for (std::string_view word; !(word = take_word(rest)).empty();) {
      long node = 0;
      if (!parse_whole(word, node) || node < 1 || node > kMostAbaqusNode) {
        lists_nodes_ = false;
        return;
      }
      nodes_.push_back(node);
    }
  }

  void begin_keyword(std::string_view line) {
    finish_matrix();
    lists_nodes_ = false;
    const std::string upper = to_upper(std::string(line));
    part_ = Part::other;
    if (upper.starts_with("*USER ELEMENT")) {
      part_ = Part::dofs;
      dofs_.clear();
      for (const std::string_view field : split_commas(upper)) {
        const std::size_t equals = field.find('=');
        if (field.starts_with("NODES") && equals != field.npos &&
            !parse_whole(trim_blanks(field.substr(equals + 1)), count_))
          scanner_.fail("*USER ELEMENT without a number. Expected NODES=.");
      }
    } else if (upper.starts_with("*MATRIX")) {
      const std::size_t type = upper.find("TYPE");
      const std::size_t equals =
          type == upper.npos ? upper.npos : upper.find('=', type);
      if (equals == upper.npos)
        scanner_.fail("*MATRIX without type. Expected TYPE=.");
      part_ = Part::matrix;
      name_ = trim_blanks(std::string_view(upper).substr(equals + 1));
      name_ = name_.substr(0, name_.find(','));
      row_ = column_ = 0;
      entries_ = {};
    }
  }

  /// Degrees of freedom of the first node; then, behind the place of the node
  /// from which on they change, others.
  void add_dofs(std::string_view line) {
    std::vector<int> dofs;
    long place = 1;
    bool is_first = dofs_.empty();
    for (std::string_view word; !(word = take_word(line)).empty();) {
      long value = 0;
      if (!parse_whole(word, value) || value < 1 || value > kMostAbaqusNode)
        scanner_.fail(fmt::format(
            "'{}' is not a degree of freedom. Expected those of the nodes.",
            echo(word)));
      if (!is_first) {
        place = value;
        is_first = true;
      } else if (value > kMostAbaqusDof) {
        scanner_.fail(fmt::format(
            "'{}' is not a degree of freedom. Expected 1 to 30.", echo(word)));
      } else {
        dofs.push_back(static_cast<int>(value));
      }
    }
    dofs_[place] = std::move(dofs);
  }

  void add_values(std::string_view line) {
    for (std::string_view word; !(word = take_word(line)).empty();) {
      if (row_ >= kMostMatrixRows)
        scanner_.fail("too many rows. Expected at most 10 million.");
      const double value = entries_.read(scanner_, word);
      if (value != 0.0) entries_.add(row_, column_, value, scanner_.number());
      if (++column_ > row_) {
        ++row_;
        column_ = 0;
      }
    }
  }

  std::vector<RowLabel> make_labels(std::size_t rows) {
    if (nodes_.empty() || count_ != static_cast<long>(nodes_.size()) ||
        dofs_.empty() || dofs_.begin()->first != 1) {
      scanner_.fail(fmt::format(
          "{} nodes are listed and NODES={}. Expected '** ELEMENT NODES', "
          "comments with as many nodes, and *USER ELEMENT with their degrees "
          "of freedom before the matrices.",
          nodes_.size(), count_));
    }
    std::vector<RowLabel> labels;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const auto next = dofs_.upper_bound(static_cast<long>(i) + 1);
      for (const int dof : std::prev(next)->second)
        labels.push_back({nodes_[i], dof});
    }
    if (labels.size() > rows)
      scanner_.fail(
          fmt::format("{} rows of {}, and {} degrees of freedom. "
                      "Expected as many rows, or more.",
                      rows, echo(name_), labels.size()));
    for (long k = 1; labels.size() < rows; ++k) labels.push_back({-k, 0});
    return labels;
  }

  void finish_matrix() {
    if (part_ != Part::matrix) return;
    part_ = Part::none;
    if (column_ != 0 || row_ == 0) {
      scanner_.fail(
          fmt::format("row {} of {} has {} values. Expected the lower "
                      "triangle: {} of them.",
                      row_ + 1, echo(name_), column_, row_ + 1));
    }
    SourceMatrix source;
    source.matrix.file = scanner_.file().string();
    source.format = "Abaqus substructure";
    source.name = name_;
    source.role = guess_role(name_);
    source.labels = make_labels(static_cast<std::size_t>(row_));
    std::move(entries_).make_symmetric(static_cast<std::size_t>(row_), source);
    sources_.push_back(std::move(source));
  }

  TextScanner scanner_;
  Part part_ = Part::none;
  bool lists_nodes_ = false;
  std::vector<long> nodes_;
  long count_ = 0;
  std::map<long, std::vector<int>> dofs_;  // from a place on
  std::string name_;
  long row_ = 0;
  long column_ = 0;
  MatrixEntries entries_;
  std::vector<SourceMatrix> sources_;
};

}  // namespace

SourceMatrix read_matrix_input(const std::filesystem::path& file) {
  TextScanner scanner(file);
  MatrixEntries entries;
  SourceMatrix source;
  std::unordered_map<long, int> places;
  const auto find_row = [&](const RowLabel& label) {
    const auto [found, is_new] =
        places.try_emplace(label.node * 64 + label.component,
                           static_cast<int>(source.labels.size()));
    if (is_new) source.labels.push_back(label);
    return found->second;
  };
  while (scanner.next_text()) {
    std::string_view rest = scanner.line();
    if (rest.starts_with('*')) continue;
    const int row = find_row(take_label(scanner, rest));
    const int column = find_row(take_label(scanner, rest));
    const double value = entries.read(scanner, take_word(rest));
    if (!trim_blanks(rest).empty())
      scanner.fail(
          "more than one entry on this line. Expected node,dof, node,dof, "
          "value.");
    entries.add(row, column, value, scanner.number());
  }
  if (entries.empty()) scanner.fail_at_end("lines node,dof, node,dof, value");
  source.matrix.file = file.string();
  source.format = "Abaqus matrix input";
  std::move(entries).make_symmetric(source.labels.size(), source);
  return source;
}

std::vector<SourceMatrix> read_substructure(const std::filesystem::path& file) {
  return SubstructureReader(file).read();
}

}  // namespace limber::fem
