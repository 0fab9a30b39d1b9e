// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "limber/common/errors.hpp"
#include "limber/common/stack_array.hpp"
#include "limber/contact/narrow_phase/meeting.hpp"

namespace limber::contact {

/// The meetings of a pair of shapes, stored on the stack.
class Meetings {
 public:
  /// The largest number for any two shapes.
  static constexpr std::size_t kMost = 64;

  explicit Meetings(std::size_t count) {
    LIMBER_EXPECT(count > 0);
    for (std::size_t i = 0; i < count; ++i) all_.add();
  }

  [[nodiscard]] std::span<Meeting> all() { return all_.all(); }
  [[nodiscard]] std::span<const Meeting> all() const { return all_.all(); }
  [[nodiscard]] const Meeting& operator[](std::size_t i) const {
    return all_.all()[i];
  }
  [[nodiscard]] std::size_t find_deepest() const {
    const auto all = all_.all();
    const auto deepest = std::max_element(
        all.begin(), all.end(),
        [](const Meeting& a, const Meeting& b) { return a.depth < b.depth; });
    return static_cast<std::size_t>(deepest - all.begin());
  }

 private:
  StackArray<Meeting, kMost> all_;
};

}  // namespace limber::contact
