// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "common/errors.hpp"
#include "common/fields.hpp"
#include "common/types.hpp"
#include "common/whole_number.hpp"

namespace limber {

/// Values in a row as numbers, to the bit: written, and read again by the same
/// list of them. What a checkpoint is made of. An aggregate goes in by all
/// fields that fields_of() lists (common/fields.hpp), other things by an
/// `exchange` of their own:
///
///     void exchange(Archive& archive, Thing& thing) {
///       archive(thing.size, thing.names);
///     }
///
/// Limits     whole numbers up to 2^53
class Archive {
 public:
  /// To write.
  Archive() = default;
  /// To read `numbers`, as an archive wrote them.
  explicit Archive(std::vector<double> numbers)
      : numbers_(std::move(numbers)), reads_(true) {}

  [[nodiscard]] bool reads() const { return reads_; }
  /// When reading: whether there are numbers that were not read yet.
  [[nodiscard]] bool has_more() const { return next_ < numbers_.size(); }
  [[nodiscard]] const std::vector<double>& numbers() const { return numbers_; }

  /// Writes the values, or reads them.
  /// @throws InputError when reading what is not there.
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

  /// The length of a list that follows.
  void pass_size(std::size_t& size) {
    auto number = static_cast<double>(size);
    pass(number);
    const auto left = static_cast<double>(numbers_.size() - next_);
    if (reads_ && !(number >= 0.0 && number <= left)) fail();
    size = static_cast<std::size_t>(number);
  }

  /// A whole number; read, one that `Number` can hold.
  template <typename Number>
  void pass_whole(Number& value) {
    auto number = static_cast<double>(value);
    pass(number);
    if (!fits<Number>(number)) fail();
    value = static_cast<Number>(number);
  }

 private:
  [[noreturn]] static void fail() {
    throw InputError(
        "the record is damaged: it is not what it says that it holds");
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
  for (Value& value : values) exchange(archive, value);
}

template <typename Value, std::size_t n>
void exchange(Archive& archive, std::array<Value, n>& values) {
  for (Value& value : values) exchange(archive, value);
}

/// Vectors and matrices; of those of fixed size the entries alone.
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
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    archive.pass(values.data()[i]);
  }
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
