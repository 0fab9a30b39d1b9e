// SPDX-License-Identifier: BSD-3-Clause
#include "limber/mesher/sandbox.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "limber/common/process/landlock.hpp"
#include "limber/mesher/seccomp.hpp"

namespace limber::mesher {
namespace {

// Commands of Gmsh 4 that run programs or write files, with any arguments.
constexpr std::array kDangerous = {"SystemCall", "NonBlockingSystemCall",
                                   "System",     "UnixCmd",
                                   "OnelabRun",  "OnelabAction",
                                   "Save",       "Print",
                                   "CreateFile", "Plugin",
                                   "Parse",      "ParseString",
                                   "WriteFile",  "Background"};

constexpr std::array kFleeting = {"Cpu",   "CpuTime",     "Memory",
                                  "Today", "TotalMemory", "GetEnv",
                                  "Rand",  "TIME",        "Time"};

bool is_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// The text without comments; strings become "".
std::string strip(std::string_view text) {
  std::string bare;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    std::size_t end = 0;
    if (rest.starts_with("//")) {
      end = rest.find('\n');
    } else if (rest.starts_with("/*")) {
      end = rest.find("*/", 2);
      if (end != std::string_view::npos) end += 2;
    } else if (rest[0] == '"' || rest[0] == '\'') {
      end = rest.find(rest[0], 1);
      if (end != std::string_view::npos) ++end;
      bare += "\"\"";
    } else {
      bare += rest[0];
      end = 1;
    }
    if (end == std::string_view::npos) break;
    i += end;
  }
  return bare;
}

/// Calls `use` with each name and the text after it, until it returns true.
template <typename Use>
bool find_name(std::string_view text, const Use& use) {
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && is_name(text[end])) ++end;
    if (end > i && use(text.substr(i, end - i), text.substr(end))) return true;
    i = std::max(end, i + 1);
  }
  return false;
}

template <typename List>
bool is_in(const List& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

/// Printf("...") > "file"
bool prints_to_file(std::string_view name, std::string_view rest) {
  if (name != "Printf" && name != "Error" && name != "Warning") return false;
  return rest.substr(0, rest.find(';')).find('>') != std::string_view::npos;
}

}  // namespace

Sandbox enter_sandbox() {
  if (apply_seccomp(Refusing::quietly)) return Sandbox::kernel;
  // Landlock, if available, denied writing before this program began.
  const int rule = make_landlock(LandlockRule::no_execution);
  const bool holds = apply_landlock(rule);
  if (rule >= 0) close(rule);
  return holds ? Sandbox::kernel : Sandbox::text_search;
}

void report_violations() { apply_seccomp(Refusing::with_message); }

std::optional<std::string> find_dangerous_command(std::string_view text) {
  std::optional<std::string> found;
  find_name(strip(text), [&](std::string_view name, std::string_view rest) {
    if (is_in(kDangerous, name) || prints_to_file(name, rest)) {
      found = std::string(name);
    }
    return found.has_value();
  });
  return found;
}

bool has_unrepeatable_command(std::string_view text) {
  return find_name(text, [](std::string_view name, std::string_view) {
    return is_in(kFleeting, name);
  });
}

}  // namespace limber::mesher
