// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/records/fields.hpp"
#include "limber/common/records/whole_number.hpp"
#include "limber/common/types.hpp"

namespace limber {

/// Serialises values as a sequence of numbers, bit for bit; the same list of
/// values writes and reads. Used for checkpoints. An aggregate is serialised by
/// all fields that fields_of() lists (common/records/fields.hpp), other types
/// by their own `exchange`:
///
///     void exchange(Archive& archive, Thing& thing) {
///       archive(thing.size, thing.names);
///     }
///
/// Limits     integers up to 2^53
class Archive {
 public:
  /// For writing.
  Archive() = default;
  /// For writing, into the memory of `spare`, whose numbers are lost.
  [[nodiscard]] static Archive write_into(std::vector<double> spare) {
    Archive archive;
    archive.numbers_ = std::move(spare);
    archive.numbers_.clear();
    return archive;
  }
  /// For reading `numbers` that an archive has written.
  explicit Archive(std::vector<double> numbers)
      : numbers_(std::move(numbers)), reads_(true) {}

  [[nodiscard]] bool reads() const { return reads_; }
  /// When reading: whether unread numbers remain.
  [[nodiscard]] bool has_more() const { return next_ < numbers_.size(); }
  [[nodiscard]] const std::vector<double>& numbers() const { return numbers_; }
  /// What was written; ends the archive.
  [[nodiscard]] std::vector<double> take_numbers() {
    return std::move(numbers_);
  }
  /// Writes the values, or reads them.
  /// @throws InputError when reading past the end.
  template <typename... Values>
  void operator()(Values&... values) {
    (exchange(*this, values), ...);
  }

  void pass(double& value) {
    if (!reads_) {
      numbers_.push_back(value);
      return;
    }
    if (next_ == numbers_.size()) fail();
    value = numbers_[next_++];
  }

  /// `count` numbers in a row.
  void pass(double* values, std::size_t count) {
    if (!reads_) {
      numbers_.insert(numbers_.end(), values, values + count);
      return;
    }
    if (count > numbers_.size() - next_) fail();
    std::copy_n(numbers_.data() + next_, count, values);
    next_ += count;
  }

  /// The length of a list that follows.
  void pass_size(std::size_t& size) {
    auto number = static_cast<double>(size);
    pass(number);
    const auto left = static_cast<double>(numbers_.size() - next_);
    if (reads_ && !(number >= 0.0 && number <= left)) fail();
    size = static_cast<std::size_t>(number);
  }

  /// An integer; reading checks that `Number` can hold it.
  template <typename Number>
  void pass_whole(Number& value) {
    auto number = static_cast<double>(value);
    pass(number);
    if (!fits<Number>(number)) fail();
    value = static_cast<Number>(number);
  }

 private:
  [[noreturn]] static void fail() {
    throw InputError("the record is truncated or corrupt");
  }

  std::vector<double> numbers_;
  std::size_t next_ = 0;
  bool reads_ = false;
};

inline void exchange(Archive& archive, double& value) { archive.pass(value); }

template <std::integral Number>
void exchange(Archive& archive, Number& value) {
  archive.pass_whole(value);
}

template <typename Enum>
requires std::is_enum_v<Enum>
void exchange(Archive& archive, Enum& value) {
  auto number = static_cast<std::underlying_type_t<Enum>>(value);
  archive.pass_whole(number);
  value = static_cast<Enum>(number);
}

inline void exchange(Archive& archive, std::string& text) {
  std::size_t size = text.size();
  archive.pass_size(size);
  text.resize(size);
  for (char& c : text) exchange(archive, c);
}

template <typename Value>
void exchange(Archive& archive, std::vector<Value>& values) {
  std::size_t size = values.size();
  archive.pass_size(size);
  values.resize(size);
  if constexpr (std::same_as<Value, double>) {
    archive.pass(values.data(), size);
  } else {
    for (Value& value : values) exchange(archive, value);
  }
}

template <typename Value, std::size_t n>
void exchange(Archive& archive, std::array<Value, n>& values) {
  for (Value& value : values) exchange(archive, value);
}

/// Vectors and matrices; those of fixed size without their dimensions.
template <typename Derived>
void exchange(Archive& archive, Eigen::PlainObjectBase<Derived>& values) {
  if constexpr (Derived::SizeAtCompileTime == Eigen::Dynamic) {
    auto rows = static_cast<std::size_t>(values.rows());
    auto columns = static_cast<std::size_t>(values.cols());
    archive.pass_size(rows);
    archive.pass_size(columns);
    values.resize(static_cast<Eigen::Index>(rows),
                  static_cast<Eigen::Index>(columns));
  }
  archive.pass(values.data(), static_cast<std::size_t>(values.size()));
}

inline void exchange(Archive& archive, Quaternion& q) {
  exchange(archive, q.coeffs());
}

/// All its fields, in order.
template <HasFields T>
void exchange(Archive& archive, T& thing) {
  std::apply([&](auto&... fields) { archive(fields...); }, tie_fields(thing));
}

}  // namespace limber
