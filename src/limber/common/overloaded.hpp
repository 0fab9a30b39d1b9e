// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber {

/// Several lambdas as one, for std::visit.
template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

}  // namespace limber
