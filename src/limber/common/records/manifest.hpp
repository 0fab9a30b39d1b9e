// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "limber/common/records/fields.hpp"
#include "limber/common/types.hpp"

namespace limber {

/// Text description of an object: a line for each value, its path and the value
/// separated by tabs. A list of more than a few numbers is stored as its size
/// and digest (XXH3).
///
///     describe(manifest, "settings", settings);
///
/// adds every field that fields_of() lists (common/records/fields.hpp),
/// recursively.
class Manifest {
 public:
  Manifest() = default;
  /// From a stored text().
  explicit Manifest(std::string text) : text_(std::move(text)) {}

  [[nodiscard]] const std::string& text() const { return text_; }

  void add(std::string_view name, std::string_view value);
  void add(std::string_view name, double value);
  /// @param shape how they are arranged, e.g. "3 x 4"; empty: a list
  void add(std::string_view name, const std::vector<double>& values,
           const std::string& shape = {});

  /// `work` adds its values below `place`; nothing is added if it adds none.
  template <typename Work>
  void within(std::string_view place, const Work& work) {
    const std::size_t before = path_.size();
    enter(place);
    work();
    path_.resize(before);
  }

 private:
  void enter(std::string_view place);

  std::string text_;
  std::string path_;  // each place followed by a tab
};

/// Differences between two manifests, one text each, in the order of `now`:
/// "coupler 'elbow', spring, stiffness: 10 -> 100 N/m".
[[nodiscard]] std::vector<std::string> find_differences(const Manifest& before,
                                                        const Manifest& now);

/// A class defined by its parameters().
template <typename T>
concept HasParameters = !HasFields<T> && requires(const T& thing) {
  thing.parameters();
};

template <typename T>
concept HasName = requires(const T& thing) {
  { thing.name } -> std::convertible_to<std::string>;
};

template <typename T>
std::string_view kind_of(const T& thing) {
  if constexpr (HasParameters<T>) {
    return kind_of(thing.parameters());
  } else {
    return names_of_fields<T>().kind;
  }
}

/// A number or an index.
template <typename T>
concept IsNumber = std::is_arithmetic_v<T> || requires(const T& value) {
  { value.operator int() } -> std::same_as<int>;
};

template <IsNumber T>
void describe(Manifest& out, std::string_view name, const T& value) {
  out.add(name, static_cast<double>(value));
}

/// An enumerator by its name if `to_string` has one.
template <typename T>
requires std::is_enum_v<T>
void describe(Manifest& out, std::string_view name, const T& value) {
  if constexpr (requires { to_string(value); }) {
    out.add(name, to_string(value));
  } else {
    out.add(name, static_cast<double>(value));
  }
}

inline void describe(Manifest& out, std::string_view name,
                     const std::string& text) {
  out.add(name, std::string_view(text));
}

template <typename Derived>
void describe(Manifest& out, std::string_view name,
              const Eigen::PlainObjectBase<Derived>& values) {
  const auto* data = values.derived().data();
  const std::string shape =
      std::to_string(values.rows()) + " x " + std::to_string(values.cols());
  out.add(name, std::vector<double>(data, data + values.size()),
          values.cols() == 1 ? "" : shape);
}

inline void describe(Manifest& out, std::string_view name,
                     const Quaternion& q) {
  describe(out, name, q.coeffs());
}

namespace detail {

template <std::size_t i, HasFields T>
void describe_field(Manifest& out, const T& thing) {
  constexpr const char* name = names_of_fields<T>().names[i];
  if constexpr (name != nullptr) {
    describe(out, name, std::get<i>(limber::tie_fields(thing)));
  }
}

template <HasFields T, std::size_t... i>
void describe_fields(Manifest& out, const T& thing, std::index_sequence<i...>) {
  (describe_field<i>(out, thing), ...);
}

}  // namespace detail

template <HasFields T>
void describe(Manifest& out, std::string_view name, const T& thing) {
  constexpr std::size_t count = names_of_fields<T>().names.size();
  out.within(name, [&] {
    detail::describe_fields(out, thing, std::make_index_sequence<count>());
  });
}

template <HasParameters T>
void describe(Manifest& out, std::string_view name, const T& thing) {
  describe(out, name, thing.parameters());
}

template <typename... Ts>
void describe(Manifest& out, std::string_view,
              const std::variant<Ts...>& choice) {
  std::visit([&](const auto& thing) { describe(out, kind_of(thing), thing); },
             choice);
}

template <typename T>
void describe(Manifest& out, std::string_view name,
              const std::optional<T>& value) {
  value ? describe(out, name, *value) : out.add(name, "none");
}

template <typename T>
void describe(Manifest& out, std::string_view name,
              const std::shared_ptr<T>& thing) {
  thing ? describe(out, name, *thing) : out.add(name, "none");
}

namespace detail {

/// Appends the entries of a number, or of a fixed-size matrix or array.
template <typename T>
void flatten(const T& value, std::vector<double>& numbers) {
  if constexpr (IsNumber<T> || std::is_enum_v<T>) {
    numbers.push_back(static_cast<double>(value));
  } else if constexpr (requires { value.derived(); }) {
    numbers.insert(numbers.end(), value.data(), value.data() + value.size());
  } else {
    for (const auto& part : value) flatten(part, numbers);
  }
}

template <typename T>
inline constexpr bool is_named_in_a_list = HasFields<T> || HasParameters<T>;
template <typename... Ts>
inline constexpr bool is_named_in_a_list<std::variant<Ts...>> = true;
template <>
inline constexpr bool is_named_in_a_list<std::string> = true;

}  // namespace detail

/// List entries are identified by kind and name, or numbered from 1.
template <typename T>
void describe(Manifest& out, std::string_view name,
              const std::vector<T>& things) {
  if constexpr (detail::is_named_in_a_list<T>) {
    for (std::size_t i = 0; i < things.size(); ++i) {
      const T& thing = things[i];
      std::string place = std::string(name) + ' ' + std::to_string(i + 1);
      if constexpr (HasFields<T>) {
        place = kind_of(thing);
        if constexpr (HasName<T>) {
          place += " '" + thing.name + "'";
        } else {
          place += ' ' + std::to_string(i + 1);
        }
      }
      if constexpr (requires { thing.valueless_by_exception(); }) {
        out.within(place, [&] { describe(out, "", thing); });
      } else {
        describe(out, place, thing);
      }
    }
  } else {
    std::vector<double> numbers;
    for (const T& thing : things) detail::flatten(thing, numbers);
    out.add(name, numbers);
  }
}

template <typename T, std::size_t n>
void describe(Manifest& out, std::string_view name,
              const std::array<T, n>& values) {
  describe(out, name, std::vector<T>(values.begin(), values.end()));
}

template <typename T>
void describe(Manifest& out, std::string_view name,
              const std::map<std::string, T>& things) {
  out.within(name, [&] {
    for (const auto& [key, thing] : things) describe(out, key, thing);
  });
}

}  // namespace limber
