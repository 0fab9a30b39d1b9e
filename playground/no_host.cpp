// SPDX-License-Identifier: BSD-3-Clause
// What a page has not: other programs, in place of
// src/limber/common/process/child_process.cpp, and an ELF file of its own.
#include <link.h>

#include "limber/common/errors.hpp"
#include "limber/common/process/child_process.hpp"

namespace limber {

ChildEnd run_child(const ChildTask& task) {
  throw InputError(task.program.string() + ": a page starts no programs");
}

}  // namespace limber

extern "C" int dl_iterate_phdr(int (*)(dl_phdr_info*, std::size_t, void*),
                               void*) {
  return 0;
}
