// SPDX-License-Identifier: BSD-3-Clause
// A page starts no programs; in place of
// src/limber/common/process/child_process.cpp.
#include "limber/common/errors.hpp"
#include "limber/common/process/child_process.hpp"

namespace limber {

ChildEnd run_child(const ChildTask& task) {
  throw InputError(task.program.string() + ": a page starts no programs");
}

}  // namespace limber
