// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <concepts>
#include <type_traits>

namespace limber {

/// Index into one kind of list, so that an index of another kind does not
/// compile in its place. It reads as an int; a number becomes an index only
/// where the code says so: `BodyIndex(0)`. By default -1, which no list has.
///
///     using BodyIndex = TypedIndex<struct BodyTag>;
template <typename Tag>
class TypedIndex {
 public:
  constexpr TypedIndex() = default;
  template <std::integral Number>
  constexpr explicit TypedIndex(Number value)
      : value_(static_cast<int>(value)) {}

  // NOLINTNEXTLINE(google-explicit-constructor): what reads it needs an int.
  constexpr operator int() const { return value_; }

  constexpr TypedIndex& operator++() {
    ++value_;
    return *this;
  }

 private:
  int value_ = -1;
};

/// Indices of different kinds are not comparable.
template <typename A, typename B>
requires(!std::is_same_v<A, B>) bool operator==(TypedIndex<A>,
                                                TypedIndex<B>) = delete;
template <typename A, typename B>
requires(!std::is_same_v<A, B>) std::strong_ordering operator<=>(
    TypedIndex<A>, TypedIndex<B>) = delete;

}  // namespace limber
