// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/path_step.hpp"

#include <string_view>

namespace limber::results {
namespace {

std::string replace_all(std::string text, std::string_view old,
                        std::string_view fresh) {
  for (std::size_t at = text.find(old); at != std::string::npos;
       at = text.find(old, at + fresh.size())) {
    text.replace(at, old.size(), fresh);
  }
  return text;
}

}  // namespace

std::string to_path_step(const std::string& name) {
  if (name == ".") return "%2E";
  return replace_all(replace_all(name, "%", "%25"), "/", "%2F");
}

std::string from_path_step(const std::string& step) {
  if (step == "%2E") return ".";
  return replace_all(replace_all(step, "%2F", "/"), "%25", "%");
}

}  // namespace limber::results
