// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/flat_file.hpp"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <string_view>

#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/files/whole_file.hpp"

namespace limber {
namespace {

constexpr InputKind kFlatFile = {"flat file", std::uint64_t{1} << 31};
constexpr std::string_view kFlatMagic = "LIMBFLAT";

void append(std::string& out, std::uint64_t number) {
  char bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  out.append(bytes, sizeof number);
}

class FlatReader {
 public:
  FlatReader(const std::filesystem::path& file, std::size_t start)
      : file_(file), bytes_(read_input(file, kFlatFile)), at_(start) {
    if (start > bytes_.size()) fail("is truncated");
  }

  [[nodiscard]] bool is_at_end() const { return at_ == bytes_.size(); }
  std::string take(std::uint64_t size) {
    if (size > bytes_.size() - at_) fail("is truncated");
    std::string part = bytes_.substr(at_, static_cast<std::size_t>(size));
    at_ += part.size();
    return part;
  }
  std::uint64_t take_number() {
    std::uint64_t number = 0;
    std::memcpy(&number, take(sizeof number).data(), sizeof number);
    return number;
  }
  [[nodiscard]] std::string front() const { return bytes_.substr(0, at_); }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("'{}' {}", file_.string(), what));
  }

 private:
  std::filesystem::path file_;
  std::string bytes_;
  std::size_t at_;
};

FlatDataset take_dataset(FlatReader& reader) {
  FlatDataset set;
  set.unit = reader.take(reader.take_number());
  const std::uint64_t kind = reader.take_number();
  if (kind > static_cast<std::uint64_t>(FlatKind::singles)) {
    reader.fail(fmt::format("has a dataset of unknown kind {}", kind));
  }
  set.kind = static_cast<FlatKind>(kind);
  set.rows = reader.take_number();
  set.columns = reader.take_number();
  const std::uint64_t most = kFlatFile.most_bytes / size_of(set.kind);
  if (set.rows > most || (set.rows > 0 && set.columns > most / set.rows)) {
    reader.fail("has a dataset that is longer than the file");
  }
  set.bytes = reader.take(set.rows * set.columns * size_of(set.kind));
  return set;
}

}  // namespace

std::uint64_t size_of(FlatKind kind) {
  switch (kind) {
    case FlatKind::text:
      return 1;
    case FlatKind::singles:
      return 4;
    default:
      return 8;
  }
}

void write_flat(const std::filesystem::path& file, const FlatFile& content) {
  std::string out = content.user_block;
  out += kFlatMagic;
  for (const auto& [name, set] : content.datasets) {
    append(out, name.size());
    out += name;
    append(out, set.unit.size());
    out += set.unit;
    append(out, static_cast<std::uint64_t>(set.kind));
    append(out, set.rows);
    append(out, set.columns);
    out += set.bytes;
  }
  write_whole(file, out);
}

FlatFile read_flat(const std::filesystem::path& file, std::size_t user_block) {
  FlatReader reader(file, user_block);
  FlatFile content{reader.front(), {}};
  if (reader.take(kFlatMagic.size()) != kFlatMagic) {
    reader.fail("is not a flat file");
  }
  while (!reader.is_at_end()) {
    const std::string name = reader.take(reader.take_number());
    content.datasets[name] = take_dataset(reader);
  }
  return content;
}

bool is_flat(const std::filesystem::path& file, std::size_t user_block) {
  std::ifstream in(file, std::ios::binary);
  std::string magic(kFlatMagic.size(), '\0');
  in.seekg(static_cast<std::streamoff>(user_block));
  in.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  return in && magic == kFlatMagic;
}

}  // namespace limber
