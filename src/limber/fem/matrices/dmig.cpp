// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/dmig.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/upper_case.hpp"
#include "limber/fem/matrices/matrix_entries.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {
namespace {

/// A line's data fields; absent ones are blank.
struct DmigLine {
  std::string_view head;
  bool is_large = false;
  std::array<std::string_view, 8> fields;

  [[nodiscard]] std::size_t count() const { return is_large ? 4 : 8; }
};

DmigLine split_dmig_line(std::string_view text) {
  constexpr std::size_t kHead = 8;
  DmigLine line;
  const std::size_t comma = text.find(',');
  line.head = trim_blanks(text.substr(0, std::min(comma, kHead)));
  line.is_large = line.head.find('*') != std::string_view::npos;
  if (comma != std::string_view::npos) {
    const std::vector<std::string_view> parts = split_commas(text);
    for (std::size_t i = 0; i < line.count() && i + 1 < parts.size(); ++i)
      line.fields[i] = parts[i + 1];
    return line;
  }
  const std::size_t width = line.is_large ? 16 : 8;
  for (std::size_t i = 0; i < line.count(); ++i) {
    const std::size_t start = kHead + i * width;
    if (start >= text.size()) break;
    line.fields[i] = trim_blanks(text.substr(start, width));
  }
  return line;
}

class DmigMatrix {
 public:
  long form = 0;
  std::size_t line = 0;  // of its header
  MatrixEntries entries;

  /// Row of a point, a new one if it has none.
  int find_row(const RowLabel& label) {
    // Components are below 8.
    const auto [found, is_new] = places_.try_emplace(
        label.node * 8 + label.component, static_cast<int>(labels_.size()));
    if (is_new) {
      labels_.push_back(label);
      is_row_.push_back(false);
      column_lines_.push_back(0);
    }
    return found->second;
  }
  void mark_row(int row) { is_row_[index(row)] = true; }
  void mark_column(int row, std::size_t at) { column_lines_[index(row)] = at; }

  SourceMatrix finish(const std::string& name,
                      const std::filesystem::path& file) && {
    SourceMatrix source;
    source.matrix.file = file.string();
    source.format = "DMIG";
    source.name = name;
    source.role = guess_role(name);
    source.labels = std::move(labels_);
    if (source.role == MatrixRole::other) return source;
    if (form == 2 || form == 9) check_square(name, source);
    std::move(entries).make_symmetric(source.labels.size(), source);
    return source;
  }

 private:
  /// Of a rectangular form, columns are points that are rows, too.
  void check_square(const std::string& name, const SourceMatrix& source) {
    for (std::size_t i = 0; i < is_row_.size(); ++i) {
      if (is_row_[i]) continue;
      throw InputError(fmt::format(
          "{}:{}: column {} of {} (form {}, rectangular) is not a row. "
          "Expected a square matrix, whose columns are its rows: form 1 or 6.",
          source.matrix.file, column_lines_[i], name_row(source.labels[i]),
          name, form));
    }
  }

  std::unordered_map<long, int> places_;
  std::vector<RowLabel> labels_;
  std::vector<bool> is_row_;
  std::vector<std::size_t> column_lines_;
};

class DmigReader {
 public:
  explicit DmigReader(const std::filesystem::path& file) : scanner_(file) {}

  std::vector<SourceMatrix> read() {
    while (scanner_.next_text()) add(without_comment());
    std::vector<SourceMatrix> sources;
    for (auto& [name, matrix] : matrices_) {
      if (matrix.entries.empty())
        throw InputError(
            fmt::format("{}:{}: {} has no columns. Expected DMIG "
                        "cards with its entries.",
                        scanner_.file().string(), matrix.line, name));
      sources.push_back(std::move(matrix).finish(name, scanner_.file()));
    }
    return sources;
  }

 private:
  enum class Place { outside, head, column };

  std::string_view without_comment() {
    std::string_view line = scanner_.line();
    line = line.substr(0, line.find('$'));
    if (line.find('\t') == std::string_view::npos) return line;
    expanded_.clear();
    for (const char c : line) {
      if (c == '\t') {
        expanded_.append(8 - expanded_.size() % 8, ' ');
      } else {
        expanded_ += c;
      }
    }
    return expanded_;
  }

  void add(std::string_view text) {
    if (trim_blanks(text).empty()) return;
    const bool continues =
        text[0] == ' ' || text[0] == '+' || text[0] == '*' || text[0] == ',';
    if (continues) {
      if (place_ != Place::outside) add_continuation(split_dmig_line(text));
      return;
    }
    place_ = Place::outside;
    if (!begins_with_word(text, "DMIG")) return;
    const DmigLine line = split_dmig_line(text);
    const std::string head = to_upper(std::string(line.head));
    if (head != "DMIG" && head != "DMIG*") return;  // DMIGAX and others
    const std::string name = to_upper(std::string(line.fields[0]));
    if (name.empty()) scanner_.fail("DMIG without a name. Expected one.");
    if (line.fields[1] == "0") {
      begin_matrix(line, name);
    } else {
      begin_column(line, name);
    }
  }

  void begin_matrix(const DmigLine& line, const std::string& name) {
    const auto [found, is_new] = matrices_.try_emplace(name);
    if (!is_new)
      scanner_.fail(fmt::format(
          "{} is given twice, first on line {}. Expected each matrix once.",
          echo(name), found->second.line));
    DmigMatrix& matrix = found->second;
    matrix.line = scanner_.number();
    long type = 0;
    if (!parse_whole(line.fields[2], matrix.form) ||
        (matrix.form != 1 && matrix.form != 2 && matrix.form != 6 &&
         matrix.form != 9))
      scanner_.fail(fmt::format("form (IFO) '{}' of {}. Expected 1, 2, 6 or 9.",
                                echo(line.fields[2]), echo(name)));
    if (!parse_whole(line.fields[3], type) || (type != 1 && type != 2))
      scanner_.fail(
          fmt::format("type (TIN) '{}' of {}. Expected 1 or 2: real, "
                      "in single or double precision.",
                      echo(line.fields[3]), echo(name)));
    place_ = Place::head;
  }

  void begin_column(const DmigLine& line, const std::string& name) {
    const auto found = matrices_.find(name);
    if (found == matrices_.end())
      scanner_.fail(
          fmt::format("a column of {} before its head. Expected "
                      "'DMIG, {}, 0, form, type' first.",
                      echo(name), echo(name)));
    matrix_ = &found->second;
    place_ = Place::column;
    column_ = matrix_->find_row(read_label(line.fields[1], line.fields[2]));
    matrix_->mark_column(column_, scanner_.number());
    if (!line.is_large) add_entry(line, 4);
  }

  void add_continuation(const DmigLine& line) {
    if (place_ == Place::head) return;
    for (std::size_t i = 0; i < line.count(); i += 4) add_entry(line, i);
  }

  void add_entry(const DmigLine& line, std::size_t first) {
    const std::string_view node = line.fields[first];
    const std::string_view component = line.fields[first + 1];
    const std::string_view value = line.fields[first + 2];
    const std::string_view imaginary = line.fields[first + 3];
    if (node.empty() && component.empty() && value.empty()) return;
    const int row = matrix_->find_row(read_label(node, component));
    matrix_->mark_row(row);
    double second = 0.0;
    if (!imaginary.empty() && (!parse_real(imaginary, second) || second != 0.0))
      scanner_.fail(
          fmt::format("'{}' as imaginary part. Expected a real "
                      "matrix, with blank fields there.",
                      echo(imaginary)));
    matrix_->entries.add(row, column_, matrix_->entries.read(scanner_, value),
                         scanner_.number());
  }

  RowLabel read_label(std::string_view node, std::string_view component) {
    RowLabel label;
    long number = 0;
    constexpr long kMostNode = 2'000'000'000;
    if (!parse_whole(node, label.node) || label.node < 1 ||
        label.node > kMostNode)
      scanner_.fail(fmt::format(
          "'{}' is not a point. Expected a grid or scalar point, from 1.",
          echo(node)));
    if (!component.empty() &&
        (!parse_whole(component, number) || number < 0 || number > 6))
      scanner_.fail(fmt::format(
          "'{}' is not a component. Expected 1 to 6, or 0 of a scalar point.",
          echo(component)));
    label.component = static_cast<int>(number);
    return label;
  }

  TextScanner scanner_;
  std::string expanded_;
  std::map<std::string, DmigMatrix> matrices_;
  Place place_ = Place::outside;
  DmigMatrix* matrix_ = nullptr;
  int column_ = 0;
};

}  // namespace

std::vector<SourceMatrix> read_dmig(const std::filesystem::path& file) {
  return DmigReader(file).read();
}

}  // namespace limber::fem
