// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/build_id.hpp"

#include <elf.h>
#include <link.h>

#include <cstddef>
#include <cstring>
#include <string_view>

#include "limber/common/files/own_file.hpp"

namespace limber {
namespace {

constexpr std::string_view kOwner("GNU\0", 4);

// Parts of a note are aligned to four bytes.
std::size_t pad(std::size_t size) { return (size + 3) / 4 * 4; }

std::string to_hexadecimal(std::string_view bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += kDigits[byte / 16];
    text += kDigits[byte % 16];
  }
  return text;
}

std::string read_notes(std::string_view notes) {
  ElfW(Nhdr) head;
  while (notes.size() >= sizeof(head)) {
    std::memcpy(&head, notes.data(), sizeof(head));
    const std::size_t content = sizeof(head) + pad(head.n_namesz);
    const std::size_t end = content + pad(head.n_descsz);
    if (end > notes.size()) break;
    if (head.n_type == NT_GNU_BUILD_ID &&
        notes.substr(sizeof(head), head.n_namesz) == kOwner) {
      return to_hexadecimal(notes.substr(content, head.n_descsz));
    }
    notes.remove_prefix(end);
  }
  return {};
}

bool has_code(const dl_phdr_info& info, const void* code) {
  const auto address = reinterpret_cast<ElfW(Addr)>(code);
  for (int i = 0; i < info.dlpi_phnum; ++i) {
    const auto& part = info.dlpi_phdr[i];
    const ElfW(Addr) begin = info.dlpi_addr + part.p_vaddr;
    if (part.p_type == PT_LOAD && address >= begin &&
        address - begin < part.p_memsz) {
      return true;
    }
  }
  return false;
}

// The program itself comes first. All but Limber's own file is skipped.
int read_own(dl_phdr_info* info, std::size_t /*size*/, void* result) {
  const void* const code = find_own_code();
  if (code != nullptr && !has_code(*info, code)) return 0;
  auto& id = *static_cast<std::string*>(result);
  for (int i = 0; i < info->dlpi_phnum && id.empty(); ++i) {
    const auto& part = info->dlpi_phdr[i];
    if (part.p_type != PT_NOTE) continue;
    id = read_notes(
        {reinterpret_cast<const char*>(info->dlpi_addr + part.p_vaddr),
         part.p_memsz});
  }
  return 1;
}

}  // namespace

std::string find_build_id() {
  std::string id;
  dl_iterate_phdr(&read_own, &id);
  return id;
}

}  // namespace limber
