// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/cache_contents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <system_error>
#include <tuple>

#include "limber/common/errors.hpp"
#include "limber/common/files/folder_lock.hpp"
#include "limber/common/files/sealed_file.hpp"
#include "limber/common/files/unfinished_files.hpp"
#include "limber/common/records/wire.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/flexbody/file/cache_file.hpp"
#include "limber/flexbody/file/mesh_index.hpp"

namespace limber::flexbody {
namespace {

namespace fs = std::filesystem;
using Kind = CacheItem::Kind;

constexpr Seal kOrigin = {"limber body origin", 1};
constexpr std::size_t kKeyLetters = 32;

fs::path origin_of(fs::path body) { return body.replace_extension(".origin"); }

bool is_key(const std::string& text) {
  return text.size() == kKeyLetters &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

fs::path read_origin(const fs::path& body) {
  const fs::path file = origin_of(body);
  if (!is_own_file(file)) return {};
  try {
    Wire wire(read_sealed(file, kOrigin));
    std::string mesh;
    wire(mesh);
    wire.finish();
    return mesh;
  } catch (const std::exception&) {
    return {};
  }
}

/// One file of the folder: an item, a part of one, or a file of others.
std::optional<CacheItem> read_item(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::string key = name.substr(0, name.find('.'));
  const std::string rest = name.substr(key.size());
  if (!is_key(key) || !is_own_file(file)) return std::nullopt;
  CacheItem item;
  item.files = {file};
  if (is_stale_part(file)) {
    item.kind = Kind::unfinished;
    return item;
  }
  if (rest == ".mesh" && has_seal(file, kMeshRecord)) {
    item.kind = Kind::mesh;
    item.mesh = read_mesh_file(file);
    return item;
  }
  if (rest != ".h5" || !has_seal(file, kReducedBodyFormat)) {
    return std::nullopt;
  }
  if (fs::exists(origin_of(file))) item.files.push_back(origin_of(file));
  item.mesh = read_origin(file);
  try {
    const ReducedBody body = read_body(file);
    item.name = body.name;
    item.nodes = body.mesh_nodes;
    item.modes = static_cast<std::size_t>(body.lambda.size());
  } catch (const std::exception&) {
    item.kind = Kind::damaged;
  }
  return item;
}

void measure(CacheItem& item) {
  std::error_code gone;
  const auto used = fs::last_write_time(item.files.front(), gone);
  const auto now = fs::file_time_type::clock::now();
  item.age = std::chrono::duration<double>(now - used).count();
  for (const fs::path& file : item.files) {
    const std::uintmax_t bytes = fs::file_size(file, gone);
    if (!gone) item.bytes += bytes;
  }
}

std::unique_ptr<FolderLock> lock_folder(const fs::path& folder) {
  try {
    return std::make_unique<FolderLock>(folder);
  } catch (const InputError&) {
    throw InputError(
        fmt::format("cache '{}' is in use by another process, or cannot be "
                    "written; wait for its end",
                    folder.string()));
  }
}

bool is_part_of_item(const fs::path& file) {
  const std::string key = file.stem().string();
  return file.extension() == ".origin" && is_key(key) &&
         fs::exists(fs::path(file).replace_extension(".h5"));
}

}  // namespace

CacheContents read_cache(const fs::path& folder) {
  CacheContents contents;
  std::error_code error;
  if (!fs::exists(folder, error)) return contents;
  for (fs::directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    std::optional<CacheItem> item = read_item(at->path());
    if (item) {
      measure(*item);
      contents.items.push_back(std::move(*item));
    } else if (!is_part_of_item(at->path())) {
      ++contents.others;
    }
  }
  if (error) {
    throw InputError(fmt::format("cache '{}' cannot be read: {}",
                                 folder.string(), error.message()));
  }
  std::sort(contents.items.begin(), contents.items.end(),
            [](const CacheItem& a, const CacheItem& b) {
              return std::tie(b.age, a.files) < std::tie(a.age, b.files);
            });
  return contents;
}

void write_origin(const fs::path& body, const fs::path& mesh) {
  std::string text = fs::absolute(mesh).lexically_normal().string();
  Wire wire;
  wire(text);
  write_own_file(origin_of(body), [&](const fs::path& place) {
    write_sealed(place, kOrigin, wire.bytes());
  });
}

void remove_from_cache(const fs::path& folder,
                       const std::vector<CacheItem>& items) {
  if (items.empty()) return;
  const auto lock = lock_folder(folder);
  for (const CacheItem& item : items) {
    for (const fs::path& file : item.files) {
      std::error_code error;
      fs::remove(file, error);
      if (!error) continue;
      throw InputError(fmt::format("'{}' cannot be removed: {}", file.string(),
                                   error.message()));
    }
  }
}

}  // namespace limber::flexbody
