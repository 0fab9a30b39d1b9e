// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/json.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/parse_number.hpp"
#include "limber/flexbody/file/cache.hpp"
#include "limber/flexbody/file/cache_contents.hpp"

namespace limber::app {
namespace {

namespace fs = std::filesystem;
using flexbody::CacheContents;
using flexbody::CacheItem;
using Units = std::vector<std::pair<std::string, double>>;

struct CacheOptions {
  std::string cache;
  std::string older_than;
  std::string keep;
  bool all = false;
  bool dry_run = false;
  bool json = false;
};

const Units kTimes = {
    {"s", 1.0}, {"min", 60.0}, {"h", 3600.0}, {"d", 86400.0}, {"w", 604800.0}};
const Units kSizes = {{"B", 1.0}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}};

fs::path find_cache_folder(const CacheOptions& options) {
  return options.cache.empty() ? flexbody::default_cache_folder()
                               : fs::path(options.cache);
}

/// "30d", "2.5GB".
double parse_with_unit(const std::string& option, const std::string& text,
                       const Units& units) {
  const std::size_t end = text.find_first_not_of("0123456789.");
  const std::string unit = end == std::string::npos ? "" : text.substr(end);
  const std::optional<double> number = parse_number(text.substr(0, end));
  std::string known;
  for (const auto& [name, factor] : units) {
    if (number && unit == name) return *number * factor;
    known += (known.empty() ? "" : ", ") + name;
  }
  throw InputError(
      fmt::format("{} '{}': expected a number and one of the units {}", option,
                  text, known));
}

/// In the largest unit of which it has one.
std::string with_unit(double value, const Units& units) {
  auto unit = units.begin();
  while (std::next(unit) != units.end() && value >= std::next(unit)->second) {
    ++unit;
  }
  return fmt::format("{:.3g} {}", value / unit->second, unit->first);
}

const char* to_string(CacheItem::Kind kind) {
  switch (kind) {
    case CacheItem::Kind::mesh:
      return "mesh";
    case CacheItem::Kind::damaged:
      return "damaged";
    case CacheItem::Kind::unfinished:
      return "unfinished";
    default:
      return "body";
  }
}

Json describe_item(const CacheItem& item) {
  Json json{{"kind", to_string(item.kind)},
            {"file", item.files.front().string()},
            {"bytes", item.bytes},
            {"age", item.age}};
  if (!item.mesh.empty()) json["mesh"] = item.mesh.string();
  if (item.kind != CacheItem::Kind::body) return json;
  json["body"] = item.name;
  json["modes"] = item.modes;
  json["nodes"] = item.nodes;
  return json;
}

Json list_items(const std::vector<CacheItem>& items) {
  Json json = Json::array();
  for (const CacheItem& item : items) json.push_back(describe_item(item));
  return json;
}

std::uintmax_t add_sizes(const std::vector<CacheItem>& items) {
  std::uintmax_t bytes = 0;
  for (const CacheItem& item : items) bytes += item.bytes;
  return bytes;
}

std::string format_item(const CacheItem& item) {
  const bool is_body = item.kind == CacheItem::Kind::body;
  return fmt::format(
      "{:<20} {:>6} {:>8} {:>10} {:>10}  {}\n",
      is_body ? item.name : fmt::format("({})", to_string(item.kind)),
      is_body ? fmt::format("{}", item.modes) : "",
      is_body ? fmt::format("{}", item.nodes) : "",
      with_unit(static_cast<double>(item.bytes), kSizes),
      with_unit(std::max(item.age, 0.0), kTimes), item.mesh.string());
}

std::string count(const std::vector<CacheItem>& items) {
  return fmt::format("{} {}, {}", items.size(),
                     items.size() == 1 ? "entry" : "entries",
                     with_unit(static_cast<double>(add_sizes(items)), kSizes));
}

std::string describe_others(std::size_t others) {
  if (others == 0) return "";
  return fmt::format("; {} that {} not of a cache {} left alone",
                     others == 1 ? "1 file" : fmt::format("{} files", others),
                     others == 1 ? "is" : "are", others == 1 ? "is" : "are");
}

void list(const CacheOptions& options) {
  const fs::path folder = find_cache_folder(options);
  const CacheContents contents = flexbody::read_cache(folder);
  if (options.json) {
    const Json json{{"folder", folder.string()},
                    {"bytes", add_sizes(contents.items)},
                    {"items", list_items(contents.items)},
                    {"others", contents.others}};
    fmt::print("{}\n", to_text(json));
    return;
  }
  if (!contents.items.empty()) {
    fmt::print("{:<20} {:>6} {:>8} {:>10} {:>10}  {}\n", "body", "modes",
               "nodes", "size", "unused for", "mesh");
  }
  for (const CacheItem& item : contents.items)
    fmt::print("{}", format_item(item));
  fmt::print("{} in {}{}\n", count(contents.items), folder.string(),
             describe_others(contents.others));
}

/// Those that the options choose; `items` begins with the longest unused.
std::vector<CacheItem> choose(const CacheOptions& options,
                              const std::vector<CacheItem>& items) {
  if (options.all) return items;
  std::vector<CacheItem> chosen;
  if (!options.older_than.empty()) {
    const double least =
        parse_with_unit("--older-than", options.older_than, kTimes);
    std::copy_if(items.begin(), items.end(), std::back_inserter(chosen),
                 [&](const CacheItem& item) { return item.age > least; });
    return chosen;
  }
  const double most = parse_with_unit("--keep", options.keep, kSizes);
  std::uintmax_t left = add_sizes(items);
  for (const CacheItem& item : items) {
    if (static_cast<double>(left) <= most) break;
    left -= item.bytes;
    chosen.push_back(item);
  }
  return chosen;
}

void clean(const CacheOptions& options) {
  const int given = int{options.all} + int{!options.older_than.empty()} +
                    int{!options.keep.empty()};
  if (given != 1) {
    throw InputError(
        "limber cache clean needs one of --all, --older-than TIME and --keep "
        "SIZE");
  }
  const fs::path folder = find_cache_folder(options);
  const CacheContents contents = flexbody::read_cache(folder);
  const std::vector<CacheItem> chosen = choose(options, contents.items);
  if (!options.dry_run) flexbody::remove_from_cache(folder, chosen);
  if (options.json) {
    const Json json{{"folder", folder.string()},
                    {"removed", list_items(chosen)},
                    {"bytes", add_sizes(chosen)},
                    {"dry_run", options.dry_run},
                    {"others", contents.others}};
    fmt::print("{}\n", to_text(json));
    return;
  }
  fmt::print("{} {} from {}{}\n", count(chosen),
             options.dry_run ? "would be removed" : "removed", folder.string(),
             describe_others(contents.others));
}

using Command = void (*)(const CacheOptions&);

CLI::App* add_command(CLI::App& cache, const char* name, const char* what,
                      Command run, Action& action,
                      const std::shared_ptr<CacheOptions>& options) {
  CLI::App* command = cache.add_subcommand(name, what);
  add_cache_option(*command, options->cache);
  add_json(*command, options->json);
  command->callback(
      [&action, run, options] { action = [run, options] { run(*options); }; });
  return command;
}

}  // namespace

void add_cache(CLI::App& app, Action& action) {
  const auto options = std::make_shared<CacheOptions>();
  CLI::App* cache =
      app.add_subcommand("cache", "List or clean the folder of reduced bodies");
  cache->require_subcommand(1);
  (void)add_command(
      *cache, "list",
      "Bodies and meshes, with their size and the time since their last use",
      list, action, options);
  CLI::App* cleaning =
      add_command(*cache, "clean", "Remove bodies and meshes; other files stay",
                  clean, action, options);
  cleaning->add_flag("--all", options->all, "All of them");
  cleaning
      ->add_option("--older-than", options->older_than,
                   "Those unused for longer, for example 30d or 12h")
      ->type_name("TIME");
  cleaning
      ->add_option("--keep", options->keep,
                   "The longest unused, until the rest take at most this size, "
                   "for example 2GB or 500MB")
      ->type_name("SIZE");
  cleaning->add_flag("--dry-run", options->dry_run,
                     "Only list what would be removed");
}

}  // namespace limber::app
