// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/process/landlock.hpp"

#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace limber {
namespace {

// Newer than the headers of Debian 12.
constexpr std::uint64_t kTruncate = 1ULL << 14;  // version 3
constexpr std::uint64_t kConnect = 3;            // bind and connect, version 4
struct Attributes {
  std::uint64_t files = 0;
  std::uint64_t network = 0;
};

std::uint64_t changes_of(long version) {
  std::uint64_t rights =
      LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
      LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
      LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
      LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
      LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
  if (version >= 3) rights |= kTruncate;
  return rights;
}

}  // namespace

int make_landlock(LandlockRule rule) {
  const long version = syscall(SYS_landlock_create_ruleset, nullptr, 0,
                               LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return -1;
  Attributes attributes;
  std::size_t size = sizeof(attributes.files);
  if (rule == LandlockRule::no_execution) {
    attributes.files = LANDLOCK_ACCESS_FS_EXECUTE;
  } else {
    attributes.files = changes_of(version);
    if (version >= 4) {
      attributes.network = kConnect;
      size = sizeof(attributes);
    }
  }
  return static_cast<int>(
      syscall(SYS_landlock_create_ruleset, &attributes, size, 0));
}

bool apply_landlock(int descriptor) {
  if (descriptor < 0) return false;
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  return syscall(SYS_landlock_restrict_self, descriptor, 0) == 0;
}

}  // namespace limber
