// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/text/deck_place.hpp"

#include <fmt/format.h>

#include "limber/common/errors.hpp"

namespace limber::fem {

std::string DeckPlace::text() const {
  return fmt::format("{}:{}", file_->string(), number_);
}

void DeckPlace::fail(const std::string& what) const {
  throw InputError(fmt::format("{}: {}", text(), what));
}

}  // namespace limber::fem
