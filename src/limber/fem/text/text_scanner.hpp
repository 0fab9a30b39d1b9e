// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "limber/common/files/input_file.hpp"

namespace limber::fem {

inline constexpr InputKind kMatrixInput = {"file of a finite-element model",
                                           std::uint64_t{1} << 36};

/// Lines of a text file one after the other, read in blocks.
class TextScanner {
 public:
  /// @throws InputError if it cannot be read
  explicit TextScanner(std::filesystem::path file);

  /// Goes to the next line. @returns false at the end of the file
  /// @throws InputError for bytes that are no text
  bool next();
  /// Goes to the next line that is not blank.
  bool next_text();
  /// Makes the next call of `next` stay on this line.
  void stay() { stays_ = true; }

  /// This line without its end and trailing blanks, valid until `next`.
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] std::size_t number() const { return number_; }  ///< from 1
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  /// @throws InputError "file:line: what"
  [[noreturn]] void fail(const std::string& what) const;
  /// The same for the end of the file. @param what was expected there
  [[noreturn]] void fail_at_end(const std::string& what) const;

 private:
  bool fill();

  std::filesystem::path file_;
  InputFile input_;
  std::string buffer_;
  std::size_t block_ = 4096;  // to read next; larger ones in large files
  std::size_t start_ = 0;     // of what is not yet read, in the buffer
  bool ended_ = false;
  bool stays_ = false;
  std::string_view line_;
  std::size_t number_ = 0;
};

/// Takes the next word off the front of `rest`: words are separated by blanks,
/// tabs and commas. @returns empty if there is none
[[nodiscard]] std::string_view take_word(std::string_view& rest);

/// Without leading and trailing blanks and tabs.
[[nodiscard]] std::string_view trim_blanks(std::string_view text);

/// Fields between commas, trimmed; empty ones too.
[[nodiscard]] std::vector<std::string_view> split_commas(std::string_view line);

/// Whether `text` contains `word`, whatever the case of its letters.
/// @param upper_word in upper case
[[nodiscard]] bool contains_word(std::string_view text,
                                 std::string_view upper_word);
/// Whether `text` begins with `word`, whatever the case of its letters.
[[nodiscard]] bool begins_with_word(std::string_view text,
                                    std::string_view upper_word);

/// Reads an integer; false unless the whole text is one.
[[nodiscard]] bool parse_whole(std::string_view text, long& value);

/// Reads a finite real number with an exponent of any Fortran or Nastran form:
/// 1.5e3, 1.5D3, 1.5+3; false unless the whole text is one. Below the range of
/// a double is zero.
[[nodiscard]] bool parse_real(std::string_view text, double& value);

/// Significant decimal digits in which a number is written, without leading
/// zeros: 5 of "-0.012300e5". 0 for integers, which are exact, and zero.
[[nodiscard]] int count_digits(std::string_view number);

/// A Fortran format of equal fields, such as (1P,3E23.16) and (13I6).
struct FieldFormat {
  std::size_t count = 0;  ///< fields a line
  std::size_t width = 0;  ///< columns a field
};

/// The first repeated field of a format; count 0 if there is none.
/// @param letters that may denote the field, in upper case
[[nodiscard]] FieldFormat parse_format(std::string_view text,
                                       std::string_view letters);

/// Values in fields of equal width over as many lines as they take.
class FieldReader {
 public:
  FieldReader(TextScanner& scanner, FieldFormat format)
      : scanner_(&scanner), format_(format), next_(format.count) {}
  /// The next field, trimmed. @throws InputError at the end of the file
  std::string_view take();
  /// The rest of the line is blank. @throws InputError otherwise
  void end() const;

 private:
  TextScanner* scanner_;
  FieldFormat format_;
  std::size_t next_;
};

}  // namespace limber::fem
