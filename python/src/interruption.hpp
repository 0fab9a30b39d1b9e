// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bindings.hpp"
#include "limber/common/progress.hpp"

namespace limber::python {

/// What Python code raised in the current thread's run, to be the cause of the
/// error that ends it. With the GIL held.
void clear_cause();
void set_cause(const py::error_already_set& error);
/// @returns the exception, or None
[[nodiscard]] py::object take_cause();

/// Ends work between two steps when a signal's handler raises, as that of
/// Ctrl-C does in Python's main thread, or `callback(what, fraction)` does:
/// throws dynamics::Interrupted, and sets the cause. It is called without the
/// GIL.
/// @param callback may be None
[[nodiscard]] Progress make_watch(const py::object& callback);

/// Whether the handler of a signal raised; asks every few milliseconds. Without
/// the GIL, in the thread that it began in.
class SignalWatch {
 public:
  [[nodiscard]] bool operator()();

 private:
  double requested_ = 0.0;  // time of a steady clock [s]
};

}  // namespace limber::python
