// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "interruption.hpp"
#include "limber/runs/library_lock.hpp"

namespace limber::python {

/// Work without the GIL, one at a time, that signals end.
/// @param work given the watch that it has to call
template <typename Work>
auto run_alone(const Work& work) {
  clear_cause();
  const Progress watch = make_watch(py::none());
  const py::gil_scoped_release release;
  const auto lock = runs::lock_libraries();
  return work(watch);
}

}  // namespace limber::python
