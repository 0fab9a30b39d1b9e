// SPDX-License-Identifier: BSD-3-Clause
#include "json.hpp"

#include <cmath>

namespace limber::python {

py::object to_python(const app::Json& json) {
  if (json.is_null()) return py::none();
  if (json.is_boolean()) return py::bool_(json.get<bool>());
  if (json.is_number_integer()) return py::int_(json.get<long long>());
  if (json.is_number()) {
    const auto value = json.get<double>();
    if (!std::isfinite(value)) return py::none();
    return py::float_(value);
  }
  if (json.is_string()) {
    // Bytes that are no UTF-8, as of file names, are replaced.
    const auto& text = json.get_ref<const std::string&>();
    return py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
        text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
  }
  if (json.is_array()) {
    py::list list;
    for (const app::Json& one : json) list.append(to_python(one));
    return list;
  }
  py::dict dict;
  for (const auto& [key, value] : json.items()) {
    dict[py::str(key)] = to_python(value);
  }
  return dict;
}

}  // namespace limber::python
