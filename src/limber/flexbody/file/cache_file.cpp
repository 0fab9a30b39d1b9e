// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/cache_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <system_error>

namespace limber::flexbody {

bool is_own_file(const std::filesystem::path& file) {
  struct stat info {};
  if (lstat(file.c_str(), &info) != 0) return false;
  const bool is_others = info.st_uid != geteuid() && info.st_uid != 0;
  return S_ISREG(info.st_mode) && !is_others &&
         (info.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

void note_use(const std::filesystem::path& file) {
  std::error_code ignored;
  std::filesystem::last_write_time(
      file, std::filesystem::file_time_type::clock::now(), ignored);
}

void write_own_file(
    const std::filesystem::path& file,
    const std::function<void(const std::filesystem::path&)>& write) {
  const std::filesystem::path folder = file.parent_path();
  if (std::filesystem::create_directories(folder)) {
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
  }
  write(file);
  constexpr auto kOthers = std::filesystem::perms::group_write |
                           std::filesystem::perms::others_write;
  std::filesystem::permissions(file, kOthers,
                               std::filesystem::perm_options::remove);
}

}  // namespace limber::flexbody
