// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/types.hpp"

namespace limber {

/// Serialises values as bytes between processes of one machine; the same list
/// of values writes and reads.
///
///     void exchange(Wire& wire, Thing& thing) { wire(thing.size, thing.names);
///     }
///
/// Input may be hostile: reads are bounds-checked, and memory use is a small
/// multiple of the bytes received.
class Wire {
 public:
  /// For writing.
  Wire() = default;
  /// For reading `bytes` that a wire has written.
  explicit Wire(std::string bytes) : bytes_(std::move(bytes)), reads_(true) {}

  [[nodiscard]] bool reads() const { return reads_; }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

  /// Writes the values, or reads them.
  /// @throws InputError when reading past the end.
  template <typename... Values>
  void operator()(Values&... values) {
    (exchange(*this, values), ...);
  }

  void pass(void* data, std::size_t size) {
    if (!reads_) {
      bytes_.append(static_cast<const char*>(data), size);
      return;
    }
    if (size > left()) fail();
    if (size > 0) std::memcpy(data, bytes_.data() + next_, size);
    next_ += size;
  }

  /// The length of a list that follows, each entry of at least `least` bytes.
  void pass_size(std::size_t& size, std::size_t least) {
    auto count = static_cast<std::uint64_t>(size);
    pass(&count, sizeof(count));
    if (reads_ && count > left() / least) fail();
    size = static_cast<std::size_t>(count);
  }

  /// @throws InputError if unread bytes remain.
  void finish() const {
    if (reads_ && left() > 0) fail();
  }

 private:
  [[nodiscard]] std::size_t left() const { return bytes_.size() - next_; }
  [[noreturn]] static void fail() {
    throw InputError("the message is damaged: its lengths are inconsistent");
  }

  std::string bytes_;
  std::size_t next_ = 0;
  bool reads_ = false;
};

template <typename Number>
std::enable_if_t<std::is_arithmetic_v<Number>> exchange(Wire& wire,
                                                        Number& value) {
  if constexpr (std::is_same_v<Number, bool>) {
    auto byte = static_cast<unsigned char>(value ? 1 : 0);
    wire.pass(&byte, 1);
    value = byte != 0;
  } else {
    wire.pass(&value, sizeof(value));
  }
}

inline void exchange(Wire& wire, std::string& text) {
  std::size_t size = text.size();
  wire.pass_size(size, 1);
  text.resize(size);
  wire.pass(text.data(), size);
}

template <typename Value>
void exchange(Wire& wire, std::vector<Value>& values) {
  constexpr bool kIsPlain =
      std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>;
  std::size_t size = values.size();
  // An entry that is not a number begins with its own length.
  wire.pass_size(size, kIsPlain ? sizeof(Value) : sizeof(std::uint64_t));
  values.resize(size);
  if constexpr (kIsPlain) {
    wire.pass(values.data(), size * sizeof(Value));
  } else {
    for (Value& value : values) exchange(wire, value);
  }
}

/// Vectors and matrices of doubles, of any size.
template <typename Derived>
void exchange(Wire& wire, Eigen::PlainObjectBase<Derived>& values) {
  auto rows = static_cast<std::size_t>(values.rows());
  auto columns = static_cast<std::size_t>(values.cols());
  wire.pass_size(rows, 1);
  wire.pass_size(columns, rows > 0 ? rows * sizeof(double) : 1);
  const auto fits = [](std::size_t count, Eigen::Index fixed) {
    return fixed == Eigen::Dynamic || count == static_cast<std::size_t>(fixed);
  };
  if (!fits(rows, Derived::RowsAtCompileTime) ||
      !fits(columns, Derived::ColsAtCompileTime)) {
    throw InputError("the message is damaged: a matrix has another shape");
  }
  values.resize(static_cast<Eigen::Index>(rows),
                static_cast<Eigen::Index>(columns));
  wire.pass(values.data(), rows * columns * sizeof(double));
}

}  // namespace limber
