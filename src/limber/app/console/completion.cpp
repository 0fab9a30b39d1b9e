// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/completion.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "limber/app/console/scene_words.hpp"
#include "limber/dynamics/integrators/integrator_kind.hpp"
#include "limber/dynamics/system/fidelity.hpp"

namespace limber::app {
namespace {

using Words = std::vector<std::string>;

/// Words for the values that --help calls by this name. @param scenario of the
/// command line; empty: none
Words list_values(const std::string& type, const std::string& scenario) {
  if (type == "KEY=VALUE" || type == "KEY") return list_keys(scenario);
  if (type == "PROBES") return list_probes(scenario);
  if (type == "INPUTS") return list_inputs(scenario);
  if (type == "LEVEL" || type == "LEVELS") return dynamics::fidelity_names();
  if (type == "INTEGRATOR") return dynamics::integrator_names();
  return {};
}

std::string take_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

bool is_option(const std::string& word) { return word.starts_with("-"); }

/// A shell may make three words of --name=value.
Words join_equals(const Words& words) {
  Words joined;
  for (const std::string& word : words) {
    if (word == "=" && &word != &words.back()) continue;
    joined.push_back(word == "=" ? "" : word);
  }
  return joined;
}

/// Position in a command line after some words.
struct Place {
  const CLI::App* command = nullptr;
  const CLI::Option* open = nullptr;  ///< whose value may come next
  int wanted = 0;                     ///< at most this many values

  void take(const std::string& word) {
    if (open != nullptr && wanted > 0 && !is_option(word)) {
      --wanted;
      return;
    }
    open = nullptr;
    if (is_option(word)) return take_option(word);
    const auto found = command->get_subcommands(
        [&](const CLI::App* sub) { return sub->get_name() == word; });
    if (!found.empty()) command = found.front();
  }

  void take_option(const std::string& word) {
    if (word.find('=') != std::string::npos) return;
    open = command->get_option_no_throw(word);
    if (open != nullptr) wanted = open->get_items_expected_max();
    if (wanted == 0) open = nullptr;
  }
};

/// `start` and the values that complete the rest of the word; after a comma the
/// next of a list.
std::vector<Candidate> list_values(const CLI::Option& option,
                                   const std::string& scenario,
                                   const std::string& start,
                                   const std::string& rest) {
  const std::size_t comma = rest.rfind(',');
  const std::string before =
      comma == std::string::npos ? "" : rest.substr(0, comma + 1);
  std::vector<Candidate> all;
  for (const std::string& value :
       list_values(option.get_type_name(), scenario)) {
    if ((before + value).starts_with(rest)) {
      all.push_back({start + before + value, ""});
    }
  }
  return all;
}

}  // namespace

std::vector<Candidate> list_options(const CLI::App& command,
                                    const std::string& start) {
  std::vector<Candidate> all;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->nonpositional() || option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) {
      const std::string word = "--" + name;
      if (!word.starts_with(start)) continue;
      all.push_back({word, take_line(option->get_description())});
    }
  }
  return all;
}

std::vector<Candidate> list_commands(const CLI::App& command,
                                     const std::string& start) {
  std::vector<Candidate> all;
  for (const CLI::App* one : command.get_subcommands(
           [](const CLI::App* sub) { return !sub->get_group().empty(); })) {
    if (!one->get_name().starts_with(start)) continue;
    all.push_back({one->get_name(), take_line(one->get_description())});
  }
  return all;
}

std::vector<Candidate> complete(const CLI::App& app, const Words& given) {
  const Words words = join_equals(given);
  Place place{&app};
  for (std::size_t i = 0; i + 1 < words.size(); ++i) place.take(words[i]);
  const std::string last = words.empty() ? "" : words.back();
  const auto named = std::find_if(
      words.begin(), words.end(),
      [](const std::string& word) { return word.ends_with(".toml"); });
  const std::string scenario = named == words.end() ? "" : *named;
  if (is_option(last)) {
    const std::size_t equals = last.find('=');
    if (equals == std::string::npos) return list_options(*place.command, last);
    const CLI::Option* option =
        place.command->get_option_no_throw(last.substr(0, equals));
    if (option == nullptr) return {};
    return list_values(*option, scenario, last.substr(0, equals + 1),
                       last.substr(equals + 1));
  }
  if (place.open != nullptr && place.wanted > 0) {
    return list_values(*place.open, scenario, "", last);
  }
  return list_commands(*place.command, last);
}

std::string to_lines(const std::vector<Candidate>& candidates) {
  std::string text;
  for (const Candidate& one : candidates) {
    text += one.word + "\t" + one.what + "\n";
  }
  return text;
}

}  // namespace limber::app
