// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/sealed_file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/files/whole_file.hpp"
#include "limber/common/records/digest.hpp"

namespace limber {
namespace {

std::string make_head(const Seal& seal, std::string_view content) {
  Digest digest;
  digest.add_bytes(content.data(), content.size());
  return fmt::format("{}\nlayout {}\nxxh128 {}\n", seal.kind, seal.layout,
                     digest.text());
}

constexpr InputKind kSealed = {"sealed file", std::uint64_t{1} << 38};

}  // namespace

void write_sealed(const std::filesystem::path& file, const Seal& seal,
                  std::string_view content) {
  const std::string head = make_head(seal, content);
  write_whole(file, [&](const std::filesystem::path& part) {
    std::ofstream out(part, std::ios::binary);
    out << head << content;
    out.close();
    if (!out) {
      throw InputError(fmt::format("'{}' cannot be written; is the disk full?",
                                   file.string()));
    }
  });
}

bool has_seal(const std::filesystem::path& file, std::string_view kind) {
  try {
    std::string start(kind.size() + 1, '\0');
    start.resize(InputFile(file, kSealed).read(start.data(), start.size()));
    return start == std::string(kind) + '\n';
  } catch (const InputError&) {
    return false;
  }
}

std::string read_sealed(const std::filesystem::path& file, const Seal& seal) {
  const auto refuse = [&](const char* what) {
    throw InputError(
        fmt::format("'{}' {} '{}'", file.string(), what, seal.kind));
  };
  // Checked first, before gigabytes of another kind are read.
  if (!has_seal(file, seal.kind)) {
    check_input(file, kSealed);
    refuse("is no");
  }
  std::string content = read_input(file, kSealed);
  const std::size_t head_size = make_head(seal, {}).size();
  const std::string head = content.substr(0, head_size);
  content.erase(0, head_size);
  if (head == make_head(seal, content)) return content;
  const std::string layout =
      fmt::format("{}\nlayout {}\n", seal.kind, seal.layout);
  if (!head.starts_with(layout)) refuse("has another layout than this");
  refuse("is a damaged");
  return {};
}

}  // namespace limber
