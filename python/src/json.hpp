// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bindings.hpp"
#include "limber/app/console/json.hpp"

namespace limber::python {

/// Dictionaries, lists, texts and numbers; numbers that are not finite are
/// None, as in the files.
[[nodiscard]] py::object to_python(const app::Json& json);

}  // namespace limber::python
