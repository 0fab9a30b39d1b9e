// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/file_kind.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "limber/common/upper_case.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {
namespace {

constexpr std::size_t kPeekBytes = std::size_t{1} << 16;
constexpr std::size_t kPeekLines = 400;

std::string peek(const std::filesystem::path& file) {
  InputFile input(file, kMatrixInput);
  std::string text(kPeekBytes, '\0');
  text.resize(input.read(text.data(), text.size()));
  return text;
}

/// Lines that are not blank, upper case; the last may be cut.
std::vector<std::string> list_lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t start = 0;
       start < text.size() && lines.size() < kPeekLines;) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    std::string_view line = std::string_view(text).substr(start, end - start);
    if (start == 0 && line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    line = line.substr(0, line.find_last_not_of(" \t\r\f\v") + 1);
    if (!line.empty()) lines.push_back(to_upper(std::string(line)));
    start = end + 1;
  }
  return lines;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::string_view word; !(word = take_word(line)).empty();)
    words.push_back(word);
  return words;
}

bool is_whole(std::string_view word) {
  long value = 0;
  return parse_whole(word, value);
}

bool is_real(std::string_view word) {
  double value = 0.0;
  return parse_real(word, value);
}

ModelFileKind find_market_kind(const std::vector<std::string>& lines) {
  const std::vector<std::string_view> head = words_of(lines[0]);
  if (head.size() < 4 || head[2] != "ARRAY" || head[3] != "INTEGER")
    return ModelFileKind::matrix_market;
  for (const std::string& line : lines) {
    if (line.starts_with('%')) continue;
    const std::vector<std::string_view> sizes = words_of(line);
    return sizes.size() == 2 && sizes[1] == "1" ? ModelFileKind::node_map
                                                : ModelFileKind::matrix_market;
  }
  return ModelFileKind::matrix_market;
}

bool is_op4_head(const std::string& line) {
  constexpr std::size_t kColumns = 8;
  if (line.size() <= 5 * kColumns) return false;
  for (std::size_t i = 0; i < 4; ++i)
    if (!is_whole(
            trim_blanks(std::string_view(line).substr(i * kColumns, kColumns))))
      return false;
  return parse_format(std::string_view(line).substr(5 * kColumns), "EDFG")
             .count > 0;
}

bool is_boeing_head(const std::vector<std::string>& lines) {
  // The title may be blank.
  for (std::size_t i = 1; i <= 2 && i + 1 < lines.size(); ++i) {
    const std::vector<std::string_view> words = words_of(lines[i]);
    if (words.size() >= 4 && words[0].size() == 3 &&
        std::string_view("RCP").find(words[0][0]) != std::string_view::npos &&
        std::string_view("AE").find(words[0][2]) != std::string_view::npos &&
        is_whole(words[1]) && is_whole(words[2]) &&
        lines[i + 1].find('(') != std::string::npos)
      return true;
  }
  return false;
}

bool is_nastran_line(const std::string& line) {
  constexpr std::array<std::string_view, 6> kNames = {
      "DMIG", "GRID", "GRDSET", "SPOINT", "CORD2", "CORD1"};
  if (line.starts_with("BEGIN BULK") || line.starts_with("BEGIN SUPER") ||
      line.starts_with("INCLUDE '") || line.starts_with("INCLUDE \""))
    return true;
  return std::any_of(kNames.begin(), kNames.end(), [&](std::string_view name) {
    if (!line.starts_with(name)) return false;
    const std::string_view rest = std::string_view(line).substr(name.size());
    const bool is_system = name.starts_with("CORD");
    return is_system || rest.empty() ||
           std::string_view(" *,\t").find(rest[0]) != std::string_view::npos;
  });
}

/// A line of names: "NODE,X,Y,Z" or "ROW,NODE,COMPONENT".
ModelFileKind find_head_kind(const std::string& line) {
  std::string text = line;
  std::replace(text.begin(), text.end(), ';', ' ');
  const std::vector<std::string_view> words = words_of(text);
  const auto has = [&](std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  constexpr std::size_t kMostNames = 8;  // more words are a sentence
  if (words.size() > kMostNames) return ModelFileKind::unknown;
  if ((has("ROW") || has("EQN")) && has("NODE"))
    return ModelFileKind::row_table;
  if (has("X") && has("Y") && has("Z")) return ModelFileKind::node_table;
  return ModelFileKind::unknown;
}

/// By the first line of numbers.
ModelFileKind find_number_kind(const std::string& line, bool has_head) {
  std::string text = line;
  const bool by_tabs = text.find('\t') != std::string::npos;
  const bool by_semicolons = text.find(';') != std::string::npos;
  if (by_tabs || by_semicolons)
    std::replace(text.begin(), text.end(), ',', '.');
  std::replace(text.begin(), text.end(), ';', ' ');
  const bool is_separated =
      by_semicolons || line.find(',') != std::string::npos;
  const std::vector<std::string_view> words = words_of(text);
  if (words.empty() || !std::all_of(words.begin(), words.end(), is_real))
    return ModelFileKind::unknown;
  const auto wholes = static_cast<std::size_t>(
      std::find_if_not(words.begin(), words.end(), is_whole) - words.begin());
  switch (words.size()) {
    case 1:
      return wholes == 0 && words[0].find_first_not_of("0123456789.") ==
                                std::string_view::npos
                 ? ModelFileKind::dof_lines
                 : ModelFileKind::unknown;
    case 3:
      if (wholes == 3 && is_separated) return ModelFileKind::row_table;
      return wholes >= 2 && !is_separated ? ModelFileKind::coordinates
                                          : ModelFileKind::unknown;
    case 4:
      return wholes >= 1 && (is_separated || (by_tabs && has_head))
                 ? ModelFileKind::node_table
                 : ModelFileKind::unknown;
    case 5:
      return wholes >= 4 ? ModelFileKind::matrix_input : ModelFileKind::unknown;
    default:
      return ModelFileKind::unknown;
  }
}

bool has_set_print(const std::filesystem::path& file) {
  TextScanner scanner(file);
  while (scanner.next())
    if (contains_word(scanner.line(), "DISPLACEMENT SET")) return true;
  return false;
}

bool is_keyword(const std::string& line) {
  constexpr std::array<std::string_view, 17> kNames = {
      "*HEADING",  "*NODE",        "*ELEMENT",  "*INCLUDE",   "*PART",
      "*PREPRINT", "*MATERIAL",    "*NSET",     "*ELSET",     "*SYSTEM",
      "*RESTART",  "*AMPLITUDE",   "*ASSEMBLY", "*PARAMETER", "*SURFACE",
      "*MATRIX",   "*USER ELEMENT"};
  return std::any_of(kNames.begin(), kNames.end(), [&](std::string_view name) {
    return line.starts_with(name);
  });
}

bool is_ansys_command(const std::string& line) {
  constexpr std::array<std::string_view, 6> kNames = {
      "/COM", "/PREP7", "/BATCH", "/TITLE", "/NOPR", "NBLOCK,"};
  return std::any_of(kNames.begin(), kNames.end(), [&](std::string_view name) {
    return line.starts_with(name);
  });
}

ModelFileKind find_keyword_kind(const std::vector<std::string>& lines) {
  for (const std::string& line : lines)
    if (line.starts_with("*USER ELEMENT") || line.starts_with("*MATRIX,TYPE") ||
        line.starts_with("*MATRIX, TYPE"))
      return ModelFileKind::substructure;
  return ModelFileKind::input_deck;
}

}  // namespace

std::string_view name_of(ModelFileKind kind) {
  switch (kind) {
    case ModelFileKind::unknown:
      return "not recognised";
    case ModelFileKind::binary:
      return "not text";
    case ModelFileKind::matrix_market:
      return "Matrix Market";
    case ModelFileKind::node_map:
      return "map of nodes";
    case ModelFileKind::coordinates:
      return "coordinates of entries";
    case ModelFileKind::matrix_input:
      return "Abaqus matrix input";
    case ModelFileKind::substructure:
      return "Abaqus substructure";
    case ModelFileKind::harwell_boeing:
      return "Harwell-Boeing";
    case ModelFileKind::op4:
      return "Nastran OP4";
    case ModelFileKind::nastran:
      return "Nastran cards";
    case ModelFileKind::input_deck:
      return "input file of Abaqus or CalculiX";
    case ModelFileKind::dof_lines:
      return "CalculiX's rows";
    case ModelFileKind::row_table:
      return "table of rows";
    case ModelFileKind::node_table:
      return "table of nodes";
    case ModelFileKind::ansys_archive:
      return "Ansys archive";
    case ModelFileKind::frd:
      return "CalculiX results";
    case ModelFileKind::expansion:
      return "CalculiX's expanded elements";
    case ModelFileKind::set_print:
      return "Nastran's print of sets";
  }
  return "";
}

ModelFileKind recognise_file(const std::filesystem::path& file) {
  const std::string text = peek(file);
  if (text.find('\0') != std::string::npos) return ModelFileKind::binary;
  const std::vector<std::string> lines = list_lines(text);
  if (lines.empty()) return ModelFileKind::unknown;
  const std::string& first = lines[0];
  if (first.starts_with("%%MATRIXMARKET")) return find_market_kind(lines);
  if (is_op4_head(first)) return ModelFileKind::op4;
  if (is_boeing_head(lines)) return ModelFileKind::harwell_boeing;
  if (trim_blanks(first) == "1C" || trim_blanks(first).starts_with("1C "))
    return ModelFileKind::frd;
  if (first.find("WITH LABEL") != std::string::npos ||
      first.find("A KNOT WAS GENERATED") != std::string::npos)
    return ModelFileKind::expansion;
  if (to_upper(file.extension().string()) == ".F06")
    return has_set_print(file) ? ModelFileKind::set_print
                               : ModelFileKind::unknown;
  for (const std::string& line : lines)
    if (line.find("U S E T   D E F I N I T I O N") != std::string::npos)
      return ModelFileKind::set_print;
  if (std::any_of(lines.begin(), lines.end(), is_nastran_line))
    return ModelFileKind::nastran;
  bool has_head = false;  // text before the first number
  for (const std::string& line : lines) {
    if (words_of(line).empty()) continue;
    if (line.starts_with("**")) {
      if (line.find("SUBSTRUCTURE") != std::string::npos ||
          line.find("ELEMENT NODES") != std::string::npos)
        return find_keyword_kind(lines);
      continue;
    }
    if (is_keyword(line)) return find_keyword_kind(lines);
    if (is_ansys_command(line)) return ModelFileKind::ansys_archive;
    if (line[0] == '#' || line[0] == '%' || line[0] == '!' || line[0] == '$')
      continue;
    const ModelFileKind by_head = find_head_kind(line);
    if (by_head != ModelFileKind::unknown) return by_head;
    if (is_real(words_of(line).front()))
      return find_number_kind(line, has_head);
    has_head = true;
  }
  return ModelFileKind::unknown;
}

}  // namespace limber::fem
