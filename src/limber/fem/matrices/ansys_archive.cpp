// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/ansys_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <unordered_map>
#include <unordered_set>

#include "limber/common/echo.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {
namespace {

using AnsysShape = ModelElement::Shape;

enum class AnsysKind { unknown, line, shell, solid };

AnsysKind find_ansys_kind(long number) {
  switch (number) {
    case 4:
    case 8:
    case 16:
    case 44:
    case 180:
    case 188:
    case 189:
    case 288:
    case 289:
      return AnsysKind::line;
    case 63:
    case 93:
    case 181:
    case 281:
      return AnsysKind::shell;
    case 45:
    case 92:
    case 95:
    case 185:
    case 186:
    case 187:
    case 190:
    case 285:
      return AnsysKind::solid;
    default:
      return AnsysKind::unknown;
  }
}

class AnsysReader {
 public:
  explicit AnsysReader(const std::filesystem::path& file) : scanner_(file) {
    model_.file = file;
    model_.format = "Ansys archive";
  }

  ModelFile read() {
    while (scanner_.next_text()) {
      const std::string_view line = scanner_.line();
      if (begins_with_word(line, "NBLOCK")) {
        read_nodes();
      } else if (begins_with_word(line, "CMBLOCK")) {
        read_component();
      } else if (begins_with_word(line, "EBLOCK")) {
        read_elements();
      } else if (begins_with_word(line, "ET,")) {
        const std::vector<std::string_view> fields = split_commas(line);
        long id = 0;
        long number = 0;
        if (fields.size() > 2 && parse_whole(fields[1], id) &&
            parse_whole(fields[2], number))
          kinds_[id] = find_ansys_kind(number);
      }
    }
    if (model_.tags.empty()) scanner_.fail_at_end("a block of nodes (NBLOCK)");
    return std::move(model_);
  }

 private:
  FieldFormat next_format(std::string_view letters, std::string_view& rest) {
    if (!scanner_.next_text()) scanner_.fail_at_end("the block's format");
    rest = scanner_.line();
    const FieldFormat format = parse_format(rest, letters);
    if (format.count == 0)
      scanner_.fail(fmt::format(
          "'{}' is not a format. Expected one such as (3i9,6e21.13e3).",
          echo(rest)));
    return format;
  }

  static bool ends_block(std::string_view line) {
    return begins_with_word(line, "N,") || trim_blanks(line) == "-1";
  }

  void read_nodes() {
    std::string_view rest;
    const FieldFormat whole = next_format("I", rest);
    const FieldFormat real = parse_format(rest, "EDFG");
    if (real.count < 3)
      scanner_.fail(
          "no coordinates. Expected a format of three, such as 6e21.13e3.");
    for (;;) {
      if (!scanner_.next_text()) scanner_.fail_at_end("the end of NBLOCK (-1)");
      const std::string_view line = scanner_.line();
      if (ends_block(line)) return;
      long node = 0;
      if (!parse_whole(trim_blanks(line.substr(0, whole.width)), node) ||
          node < 1)
        scanner_.fail(
            fmt::format("'{}' is not a node. Expected an integer from 1.",
                        echo(line.substr(0, whole.width))));
      std::array<double, 6> values{};
      for (std::size_t i = 0; i < std::min<std::size_t>(6, real.count); ++i) {
        const std::size_t start = whole.count * whole.width + i * real.width;
        if (start >= line.size()) break;  // zeros at the end are left out
        const std::string_view text =
            trim_blanks(line.substr(start, real.width));
        if (!text.empty() && !parse_real(text, values[i]))
          scanner_.fail(
              fmt::format("'{}' is not a finite number. Expected a coordinate.",
                          echo(text)));
      }
      if (values[3] != 0.0 || values[4] != 0.0 || values[5] != 0.0)
        scanner_.fail(fmt::format(
            "node {} has rotated axes. Expected nodes in the global axes: "
            "NROTAT all back before the matrices are written.",
            node));
      if (!known_.insert(node).second)
        scanner_.fail(fmt::format(
            "node {} is given twice. Expected each node once.", node));
      model_.tags.push_back(node);
      model_.x.emplace_back(values[0], values[1], values[2]);
    }
  }

  /// Nodes, where -5 after 2 means 2 to 5.
  void read_component() {
    const std::vector<std::string_view> fields = split_commas(scanner_.line());
    long count = 0;
    if (fields.size() < 4 || !begins_with_word(fields[2], "NODE")) return;
    // A comment may follow: 12 ! users node component definition
    const std::string_view number =
        trim_blanks(fields[3].substr(0, fields[3].find('!')));
    if (!parse_whole(number, count) || count < 1)
      scanner_.fail(
          "CMBLOCK without its number of items. Expected it in the 4th field.");
    NamedNodes set{std::string(fields[1]), {}};
    std::string_view rest;
    FieldReader items(scanner_, next_format("I", rest));
    for (long i = 0; i < count; ++i) {
      const std::string_view text = items.take();
      long item = 0;
      if (!parse_whole(text, item) || item == 0 ||
          (item < 0 && set.nodes.empty()) || std::labs(item) > 2'000'000'000)
        scanner_.fail(
            fmt::format("'{}' is not an item. Expected a node.", echo(text)));
      if (item > 0) {
        set.nodes.push_back(item);
        continue;
      }
      for (long node = set.nodes.back() + 1; node <= -item; ++node)
        if (known_.contains(node)) set.nodes.push_back(node);
    }
    model_.sets.push_back(std::move(set));
  }

  /// For pictures: what cannot be drawn is passed over.
  void read_elements() {
    if (!contains_word(scanner_.line(), "SOLID")) return;
    std::string_view rest;
    const FieldFormat format = next_format("I", rest);
    constexpr std::size_t kHead = 11;
    while (scanner_.next_text()) {
      std::vector<long> fields;
      const auto add_line = [&] {
        const std::string_view line = scanner_.line();
        for (std::size_t i = 0; i * format.width < line.size(); ++i) {
          long value = 0;
          if (!parse_whole(
                  trim_blanks(line.substr(i * format.width, format.width)),
                  value))
            return false;
          fields.push_back(value);
        }
        return true;
      };
      if (!add_line()) {
        scanner_.stay();
        return;
      }
      if (fields.size() < kHead) return;  // the block's end, -1
      const auto count = static_cast<std::size_t>(std::max(0L, fields[8]));
      while (fields.size() < kHead + count) {
        if (!scanner_.next_text() || !add_line()) return;
      }
      add_element(fields[1], {fields.begin() + kHead,
                              fields.begin() +
                                  static_cast<std::ptrdiff_t>(kHead + count)});
    }
  }

  void add_element(long type, std::vector<long> nodes) {
    const auto found = kinds_.find(type);
    if (found == kinds_.end()) return;
    std::size_t corners = 2;
    if (found->second == AnsysKind::shell) corners = 4;
    if (found->second == AnsysKind::solid)
      corners = nodes.size() == 10 || nodes.size() == 4 ? 4 : 8;
    if (nodes.size() < corners && !(corners == 4 && nodes.size() == 3)) return;
    nodes.resize(std::min(corners, nodes.size()));
    // Collapsed elements repeat a corner.
    std::vector<long> unique;
    for (const long node : nodes)
      if (std::find(unique.begin(), unique.end(), node) == unique.end())
        unique.push_back(node);
    ModelElement element;
    element.corners = std::move(unique);
    const std::size_t size = element.corners.size();
    switch (found->second) {
      case AnsysKind::line:
        element.shape = AnsysShape::line;
        break;
      case AnsysKind::shell:
        element.shape = size == 3 ? AnsysShape::triangle : AnsysShape::quad;
        break;
      case AnsysKind::solid:
        element.shape = size == 4   ? AnsysShape::tetra
                        : size == 5 ? AnsysShape::pyramid
                        : size == 6 ? AnsysShape::wedge
                                    : AnsysShape::hexa;
        break;
      case AnsysKind::unknown:
        return;
    }
    if (size == count_corners(element.shape))
      model_.elements.push_back(std::move(element));
  }

  TextScanner scanner_;
  ModelFile model_;
  std::unordered_set<long> known_;
  std::unordered_map<long, AnsysKind> kinds_;
};

}  // namespace

ModelFile read_ansys_archive(const std::filesystem::path& file) {
  return AnsysReader(file).read();
}

}  // namespace limber::fem
