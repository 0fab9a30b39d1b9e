// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/gmsh/unv_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/parse_number.hpp"

namespace limber::fem {
namespace {

/// Descriptors of elements that Gmsh reads: beams, shells and solids.
constexpr std::array kKnownElements = {
    11, 21, 22, 23,  24,  31,  32,  41,  42,  44,  45,  51,  52, 54,
    55, 61, 62, 64,  65,  71,  72,  74,  75,  81,  82,  84,  85, 91,
    92, 94, 95, 101, 102, 104, 105, 111, 112, 113, 115, 116, 118};
constexpr std::array kBeams = {11, 21, 22, 23, 24, 31, 32};

template <typename List>
bool is_one_of(const List& list, int value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// The numbers of a line, with exponents by D or E.
std::vector<double> read_numbers(std::string_view line) {
  std::vector<double> numbers;
  for (const std::string_view word : split_words(line)) {
    std::string text(word);
    std::replace(text.begin(), text.end(), 'D', 'e');
    const std::optional<double> number = parse_number(text);
    if (!number) break;
    numbers.push_back(*number);
  }
  return numbers;
}

class UnvChecker {
 public:
  explicit UnvChecker(const std::filesystem::path& file)
      : name_(file.string()), text_(read_input(file, kMeshInput)) {
    for (std::size_t start = 0; start < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', start), text_.size());
      lines_.push_back(std::string_view(text_).substr(start, end - start));
      start = end + 1;
    }
  }

  UnvContent check() {
    for (line_ = 0; line_ < lines_.size(); ++line_)
      if (is_mark(lines_[line_])) check_dataset();
    for (const auto& [system, line] : used_systems_)
      if (own_systems_.contains(system))
        fail(line, fmt::format("the node is in coordinate system {}, which is "
                               "not read. Expected nodes in the global "
                               "Cartesian system",
                               system));
    return std::move(content_);
  }

 private:
  static bool is_mark(std::string_view line) {
    const auto words = split_words(line);
    return words.size() == 1 && words[0] == "-1";
  }

  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}.", name_, line + 1, what));
  }

  /// From the mark that begins a dataset to the one that ends it.
  void check_dataset() {
    const std::size_t begin = line_++;
    std::size_t end = line_;
    while (end < lines_.size() && !is_mark(lines_[end])) ++end;
    if (end >= lines_.size())
      fail(begin,
           "the dataset that begins here does not end, so the file is "
           "truncated. Expected a line -1");
    const auto numbers = read_numbers(lines_[line_]);
    const int dataset = numbers.empty() ? 0 : static_cast<int>(numbers[0]);
    ++line_;
    if (dataset == 2411) check_nodes(end);
    if (dataset == 2412) check_elements(end);
    if (dataset == 2420) read_systems(end);
    if (dataset == 164) read_unit(end);
    constexpr std::array kOld = {15, 71, 780, 781};
    if (is_one_of(kOld, dataset))
      fail(line_ - 1, fmt::format("dataset {} is not read. Expected nodes in "
                                  "dataset 2411 and elements in 2412",
                                  dataset));
    line_ = end;
  }

  /// The integers of a record. @throws InputError if there are too few
  std::vector<int> read_record(std::size_t least) {
    const std::vector<double> numbers = read_numbers(lines_[line_]);
    if (numbers.size() < least)
      fail(line_,
           fmt::format("a record of {} numbers was expected, with blanks "
                       "between them",
                       least));
    return {numbers.begin(), numbers.end()};
  }

  void check_nodes(std::size_t end) {
    constexpr std::size_t kSystem = 1;
    for (; line_ + 1 < end; line_ += 2) {
      used_systems_.emplace(read_record(4)[kSystem], line_);
      if (read_numbers(lines_[line_ + 1]).size() != 3)
        fail(line_ + 1, "three coordinates were expected");
      ++content_.nodes;
    }
    if (line_ < end) fail(line_, "the node has no coordinates");
  }

  void check_elements(std::size_t end) {
    constexpr std::size_t kDescriptor = 1;
    constexpr std::size_t kNodeCount = 5;
    while (line_ < end) {
      const std::size_t first = line_;
      const std::vector<int> record = read_record(6);
      const int descriptor = record[kDescriptor];
      if (!is_one_of(kKnownElements, descriptor))
        fail(first,
             fmt::format("element {} of type {} is not a solid and would be "
                         "lost. Expected solids, and shells and beams on their "
                         "surface",
                         record[0], descriptor));
      line_ += is_one_of(kBeams, descriptor) ? 2 : 1;
      int missing = record[kNodeCount];
      for (; missing > 0 && line_ < end; ++line_)
        missing -= static_cast<int>(split_words(lines_[line_]).size());
      if (missing != 0)
        fail(first, fmt::format("element {} does not have the {} nodes that "
                                "its record announces",
                                record[0], record[kNodeCount]));
      ++content_.elements;
    }
  }

  /// Keeps those that differ from the global Cartesian one.
  void read_systems(std::size_t end) {
    constexpr std::size_t kHead = 2;   // the part's number and name
    constexpr std::size_t kLines = 6;  // of a system
    for (line_ += kHead; line_ + kLines <= end; line_ += kLines) {
      const std::vector<int> record = read_record(2);
      bool is_global = record[1] == 0;
      for (std::size_t row = 0; row < 4; ++row) {
        const std::vector<double> x = read_numbers(lines_[line_ + 2 + row]);
        for (std::size_t i = 0; i < 3; ++i)
          is_global &= x.size() == 3 && x[i] == (i == row ? 1.0 : 0.0);
      }
      if (!is_global) own_systems_.insert(record[0]);
    }
  }

  /// The second record begins with the file's units per metre.
  void read_unit(std::size_t end) {
    if (line_ + 1 >= end) return;
    const std::vector<double> factors = read_numbers(lines_[line_ + 1]);
    if (factors.empty() || !(factors[0] > 0.0)) return;
    content_.unit = 1.0 / factors[0];
  }

  std::string name_;
  std::string text_;
  std::vector<std::string_view> lines_;
  std::size_t line_ = 0;
  UnvContent content_;
  std::map<int, std::size_t> used_systems_;  // and the first line of use
  std::set<int> own_systems_;
};

}  // namespace

UnvContent check_unv(const std::filesystem::path& file) {
  return UnvChecker(file).check();
}

}  // namespace limber::fem
