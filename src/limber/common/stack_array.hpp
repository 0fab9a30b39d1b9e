// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

#include "limber/common/errors.hpp"

namespace limber {

/// Up to kMost values on the stack, of which only those added are written.
template <typename Value, std::size_t kMost>
class StackArray {
 public:
  StackArray() = default;
  /// Of those added.
  StackArray(const StackArray& other) {
    for (const Value& value : other.all()) {
      std::construct_at(begin() + count_++, value);
    }
  }
  StackArray& operator=(const StackArray&) = delete;

  /// @throws ContractError beyond kMost.
  Value& add() {
    LIMBER_EXPECT(count_ < kMost);
    return *std::construct_at(begin() + count_++);
  }
  [[nodiscard]] std::span<Value> all() { return {begin(), count_}; }
  [[nodiscard]] std::span<const Value> all() const {
    return {reinterpret_cast<const Value*>(place_), count_};
  }

 private:
  static_assert(std::is_trivially_destructible_v<Value>);
  [[nodiscard]] Value* begin() { return reinterpret_cast<Value*>(place_); }

  alignas(Value) std::byte place_[kMost * sizeof(Value)];
  std::size_t count_ = 0;
};

}  // namespace limber
