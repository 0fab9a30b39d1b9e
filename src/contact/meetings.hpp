// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

#include "limber/common/errors.hpp"
#include "limber/contact/narrow_phase/meeting.hpp"

namespace limber::contact {

/// The meetings of a pair of shapes, stored on the stack.
class Meetings {
 public:
  /// The largest number for any two shapes.
  static constexpr std::size_t kMost = 64;

  explicit Meetings(std::size_t count)
      : all_(reinterpret_cast<Meeting*>(place_), count) {
    LIMBER_EXPECT(count > 0 && count <= kMost);
    std::uninitialized_default_construct(all_.begin(), all_.end());
  }
  Meetings(const Meetings&) = delete;  // `all_` points into it
  Meetings& operator=(const Meetings&) = delete;

  [[nodiscard]] std::span<Meeting> all() { return all_; }
  [[nodiscard]] const Meeting& operator[](std::size_t i) const {
    return all_[i];
  }
  [[nodiscard]] std::size_t find_deepest() const {
    const auto deepest = std::max_element(
        all_.begin(), all_.end(),
        [](const Meeting& a, const Meeting& b) { return a.depth < b.depth; });
    return static_cast<std::size_t>(deepest - all_.begin());
  }

 private:
  static_assert(std::is_trivially_destructible_v<Meeting>);
  alignas(Meeting) std::byte place_[kMost * sizeof(Meeting)];
  std::span<Meeting> all_;
};

}  // namespace limber::contact
