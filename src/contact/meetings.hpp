// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "limber/contact/shapes/meeting.hpp"

namespace limber::contact {

/// The meetings of a pair of shapes, on the stack where they are few.
class Meetings {
 public:
  explicit Meetings(std::size_t count) : many_(count > kFew ? count : 0) {
    all_ = many_.empty() ? std::span(few_).first(count) : std::span(many_);
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
  static constexpr std::size_t kFew = 25;  // of any two convex shapes
  std::array<Meeting, kFew> few_;
  std::vector<Meeting> many_;
  std::span<Meeting> all_;
};

}  // namespace limber::contact
