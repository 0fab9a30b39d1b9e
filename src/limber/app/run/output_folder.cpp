// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/output_folder.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "limber/app/console/terminal.hpp"
#include "limber/app/console/text_file.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/files/scratch_folder.hpp"
#include "limber/common/files/unfinished_files.hpp"

namespace limber::app {
namespace {

namespace fs = std::filesystem;
// Files relative to their folder; folders end in "/".
using Names = std::set<std::string>;

constexpr const char* kList = ".limber-files";
constexpr const char* kStaging = ".limber-part-";
constexpr InputKind kListInput = {"list of files", std::uint64_t{1} << 26};

[[noreturn]] void refuse(const fs::path& folder, const std::string& why) {
  throw InputError(fmt::format(
      "results folder '{}' cannot be written ({}); choose another with --out",
      folder.string(), why));
}

fs::path make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse(folder, error.message());
  return folder;
}

/// A temporary folder beside the destination.
ScratchFolder make_staging(const fs::path& folder) {
  try {
    return ScratchFolder(folder / kStaging);
  } catch (const std::system_error& error) {
    refuse(folder, error.code().message());
  }
}

Names find_files(const fs::path& folder) {
  Names names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

bool is_folder(const std::string& name) { return name.ends_with('/'); }

// A name with a path elsewhere is not ours.
bool is_plain(const std::string& name) {
  const std::string bare =
      is_folder(name) ? name.substr(0, name.size() - 1) : name;
  return !bare.empty() && bare != "." && bare != ".." &&
         bare.find('/') == std::string::npos;
}

Names read_list(const fs::path& folder) {
  Names names;
  std::error_code error;
  if (!fs::is_regular_file(folder / kList, error)) return names;
  std::istringstream text(read_input(folder / kList, kListInput));
  for (std::string name; std::getline(text, name);) {
    if (is_plain(name)) names.insert(name);
  }
  return names;
}

void write_list(const fs::path& folder, const Names& names) {
  std::string text = "files of limber's, which its next command here replaces:";
  for (const std::string& name : names) text += "\n" + name;
  write_text(folder / kList, text);
}

void remove_stale_folders(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> stale;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    if (name.starts_with(kStaging) &&
        name.size() == std::string(kStaging).size() + 6 &&
        fs::symlink_status(entry->path(), ignored).type() ==
            fs::file_type::directory) {
      stale.push_back(entry->path());
    }
  }
  for (const fs::path& path : stale) fs::remove_all(path, error);
}

void replace_all(std::string& text, const std::string& old,
                 const std::string& by) {
  for (std::size_t at = text.find(old); at != std::string::npos;
       at = text.find(old, at + by.size())) {
    text.replace(at, old.size(), by);
  }
}

void replace_in_all(std::vector<std::string>& problems, const fs::path& made,
                    const fs::path& meant) {
  for (std::string& text : problems) {
    replace_all(text, made.string(), meant.string());
  }
}

std::optional<fs::path> make_rescue_folder() {
  constexpr const char* kPrefix = "limber-results-";
  const char* const requested = std::getenv("TMPDIR");
  const fs::path temporary = requested == nullptr ? "/tmp" : requested;
  for (const fs::path& prefix : {temporary / kPrefix, fs::path(kPrefix)}) {
    try {
      return make_private_folder(prefix);
    } catch (const std::system_error&) {  // NOLINT(bugprone-empty-catch)
      // The next one, if there is one.
    }
  }
  return std::nullopt;
}

// Where the files were written instead; nothing if nowhere.
std::optional<fs::path> rescue(const OutputFolder::Writer& writer) {
  std::optional<fs::path> folder = make_rescue_folder();
  if (!folder) return std::nullopt;
  try {
    writer(*folder);
    return folder;
  } catch (const InputError&) {
    std::error_code ignored;
    fs::remove_all(*folder, ignored);
    return std::nullopt;
  }
}

// Removes the commands' files in the folder, and the folder if it is then
// empty.
void remove_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::symlink_status(folder, error).type() != fs::file_type::directory) {
    return;
  }
  try {
    OutputFolder(folder).write([](const fs::path&) {});
    fs::remove(folder / kList, error);
  } catch (const InputError& problem) {
    print_warnings(
        {fmt::format("'{}' belongs to an earlier command and is kept: {}",
                     folder.string(), problem.what())});
    return;
  }
  fs::remove(folder, error);
}

void remove_owned(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  if (is_folder(name)) {
    remove_folder(folder / name.substr(0, name.size() - 1));
  } else {
    fs::remove(folder / name, ignored);
  }
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder)
    : path_(make_folder(folder)), lock_(path_) {
  if (!lock_.is_held()) {
    print_warnings({fmt::format(
        "the file system of results folder '{}' has no locks: let no other "
        "command write there at the same time",
        path_.string())});
  }
  remove_stale_parts(path_);
  remove_stale_folders(path_);
  const ScratchFolder probe = make_staging(path_);
  write_text(probe.path() / "probe", "x");
}

// The old files stay until the new ones are complete.
void OutputFolder::place(const fs::path& made, bool is_all) const {
  const Names before = read_list(path_);
  const Names files = find_files(made);
  Names now = files;
  now.insert(claimed_.begin(), claimed_.end());
  Names both = before;
  both.insert(now.begin(), now.end());
  write_list(path_, both);
  for (const std::string& name : files) {
    std::error_code error;
    fs::rename(made / name, path_ / name, error);
    if (error) refuse(path_, name + ": " + error.message());
  }
  if (!is_all) return;
  for (const std::string& name : before) {
    if (!now.contains(name)) remove_owned(path_, name);
  }
  write_list(path_, now);
}

void OutputFolder::claim(const std::set<std::string>& folders) {
  claimed_.clear();
  for (const std::string& name : folders) claimed_.insert(name + "/");
  Names both = read_list(path_);
  both.insert(claimed_.begin(), claimed_.end());
  write_list(path_, both);
}

void OutputFolder::write(const Writer& writer) const {
  write_all(writer, true);
}

void OutputFolder::add(const Writer& writer) const { write_all(writer, false); }

void OutputFolder::write_all(const Writer& writer, bool is_all) const {
  std::unique_ptr<const ScratchFolder> staging;
  std::vector<std::string> problems;
  try {
    staging.reset(new ScratchFolder(make_staging(path_)));
    writer(staging->path());
    place(staging->path(), is_all);
    return;
  } catch (const InputError& error) {
    problems = error.problems();
  }
  // Users know the destination, not the temporary folder.
  if (staging) replace_in_all(problems, staging->path(), path_);
  if (const std::optional<fs::path> elsewhere = rescue(writer)) {
    problems.push_back(
        fmt::format("the results are in '{}' instead", elsewhere->string()));
  } else if (staging) {
    place_if_possible(staging->path());  // the disk is not full
  }
  throw InputError(problems);
}

void OutputFolder::place_if_possible(const fs::path& made) const {
  try {
    place(made, false);
  } catch (const InputError&) {  // already reported
  }
}

}  // namespace limber::app
