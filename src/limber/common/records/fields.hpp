// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "limber/common/evaluation_time.hpp"
#include "limber/common/pose.hpp"

namespace limber {

/// Name of an aggregate and of all its fields, in order, with units in
/// brackets. Checkpoints and manifests are written from these lists only. A
/// list of the wrong length does not compile, so a new field cannot be
/// forgotten. Declared in the namespace of its type:
///
///     constexpr auto fields_of(const Spring*) {
///       return list_fields("spring", "stiffness [N/m]", "rest [m]");
///     }
///
/// A field without a name (nullptr) is in checkpoints, but not in manifests.
/// Source     structured bindings, whose count the compiler checks
template <std::size_t n>
struct FieldList {
  std::string_view kind;
  std::array<const char*, n> names;
};

template <typename... Names>
constexpr FieldList<sizeof...(Names)> list_fields(const char* kind,
                                                  Names... names) {
  return {kind, {names...}};
}

template <typename T>
concept HasFields = std::is_aggregate_v<T> && requires(const T* thing) {
  fields_of(thing);
};

template <HasFields T>
constexpr auto names_of_fields() {
  return fields_of(static_cast<const T*>(nullptr));
}

namespace detail {

template <std::size_t n, typename T>
constexpr auto tie_fields(T& t) {
  static_assert(n >= 1 && n <= 24, "add a case");
  if constexpr (n == 1) {
    auto& [a] = t;
    return std::tie(a);
  } else if constexpr (n == 2) {
    auto& [a, b] = t;
    return std::tie(a, b);
  } else if constexpr (n == 3) {
    auto& [a, b, c] = t;
    return std::tie(a, b, c);
  } else if constexpr (n == 4) {
    auto& [a, b, c, d] = t;
    return std::tie(a, b, c, d);
  } else if constexpr (n == 5) {
    auto& [a, b, c, d, e] = t;
    return std::tie(a, b, c, d, e);
  } else if constexpr (n == 6) {
    auto& [a, b, c, d, e, f] = t;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (n == 7) {
    auto& [a, b, c, d, e, f, g] = t;
    return std::tie(a, b, c, d, e, f, g);
  } else if constexpr (n == 8) {
    auto& [a, b, c, d, e, f, g, h] = t;
    return std::tie(a, b, c, d, e, f, g, h);
  } else if constexpr (n == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = t;
    return std::tie(a, b, c, d, e, f, g, h, i);
  } else if constexpr (n == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (n == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (n == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (n == 13) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m);
  } else if constexpr (n == 14) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, o);
  } else if constexpr (n == 15) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p);
  } else if constexpr (n == 16) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q);
  } else if constexpr (n == 17) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r);
  } else if constexpr (n == 18) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s);
  } else if constexpr (n == 19) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, u] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, u);
  } else if constexpr (n == 20) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, u, v] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, u, v);
  } else if constexpr (n == 21) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, u, v, w] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, u, v,
                    w);
  } else if constexpr (n == 22) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, u, v, w, x] =
        t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, u, v,
                    w, x);
  } else if constexpr (n == 23) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, u, v, w, x,
           y] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, u, v,
                    w, x, y);
  } else {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, u, v, w, x, y,
           z] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, u, v,
                    w, x, y, z);
  }
}

}  // namespace detail

/// References to all fields.
template <typename T>
requires HasFields<std::remove_const_t<T>>
constexpr auto tie_fields(T& thing) {
  constexpr auto list = names_of_fields<std::remove_const_t<T>>();
  return detail::tie_fields<list.names.size()>(thing);
}

/// Calls `visit(name, field)` for each field in order; the name may be nullptr.
template <typename T, typename Visit>
requires HasFields<std::remove_const_t<T>>
constexpr void for_each_field(T& thing, const Visit& visit) {
  constexpr auto list = names_of_fields<std::remove_const_t<T>>();
  std::apply(
      [&](auto&... fields) {
        std::size_t i = 0;
        (visit(list.names[i++], fields), ...);
      },
      tie_fields(thing));
}

constexpr auto fields_of(const InputState*) {
  return list_fields("input", "since [s]", "value", "rate [1/s]",
                     "value before", "rate before [1/s]");
}

constexpr auto fields_of(const Pose*) {
  return list_fields("pose", "R", "p [m]");
}

}  // namespace limber
