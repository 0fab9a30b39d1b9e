// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/own_file.hpp"

#include <dlfcn.h>

#include <atomic>

namespace limber {
namespace {

std::atomic<const void*> own_code = nullptr;

}  // namespace

void set_own_code(const void* code) { own_code = code; }

const void* find_own_code() { return own_code; }

std::filesystem::path find_own_file() {
  std::error_code unknown;
  const void* code = own_code;
  if (code == nullptr) {
    return std::filesystem::read_symlink("/proc/self/exe", unknown);
  }
  Dl_info found = {};
  if (dladdr(code, &found) == 0) return {};
  return std::filesystem::absolute(found.dli_fname, unknown);
}

}  // namespace limber
