// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/manual.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "limber/app/console/help_text.hpp"
#include "limber/app/console/text_file.hpp"
#include "limber/version.hpp"

namespace limber::app {
namespace {

/// Text as such for man(7): no commands at the start of a line, hyphens that
/// can be copied.
std::string escape(const std::string& text) {
  std::string escaped;
  bool is_start = true;
  for (const char c : text) {
    if (is_start && (c == '.' || c == '\'')) escaped += "\\&";
    is_start = c == '\n';
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string bold(const std::string& text) {
  return "\\fB" + escape(text) + "\\fR";
}
std::string italic(const std::string& text) {
  return "\\fI" + escape(text) + "\\fR";
}

/// "limber run", and "limber-run" of its page.
std::string name_of(const CLI::App& app, char between) {
  const CLI::App* parent = app.get_parent();
  if (parent == nullptr) return app.get_name();
  return name_of(*parent, between) + between + app.get_name();
}

std::vector<const CLI::App*> find_commands(const CLI::App& app) {
  return app.get_subcommands(
      [](const CLI::App* sub) { return !sub->get_group().empty(); });
}

std::vector<const CLI::Option*> find_options(const CLI::App& app,
                                             bool is_positional) {
  return app.get_options([&](const CLI::Option* option) {
    return option->nonpositional() != is_positional &&
           !option->get_group().empty();
  });
}

std::string describe(const CLI::Option& option, const std::string& name) {
  std::string text = ".TP\n" + bold(name);
  if (option.nonpositional() && option.get_items_expected_max() > 0) {
    text += " " + italic(option.get_type_name());
  }
  text += "\n" + escape(option.get_description());
  if (option.get_required()) text += " (required)";
  return text + "\n";
}

std::string describe_synopsis(const CLI::App& app) {
  std::string text = ".SH SYNOPSIS\n" + bold(name_of(app, ' '));
  text += " [" + italic("OPTIONS") + "]";
  for (const CLI::Option* option : find_options(app, true)) {
    const std::string name = italic(option->get_name(true));
    text += option->get_required() ? " " + name : " [" + name + "]";
  }
  if (!find_commands(app).empty()) text += " " + italic("COMMAND");
  return text + "\n";
}

std::string describe_commands(const CLI::App& app) {
  std::string text;
  for (const CLI::App* one : find_commands(app)) {
    text += ".TP\n" + bold(name_of(*one, '-')) + "(1)\n" +
            escape(one->get_description()) + "\n";
  }
  return text.empty() ? "" : ".SH COMMANDS\n" + text;
}

/// "-h, --help"
std::string list_names(const CLI::Option& option, bool is_positional) {
  std::string names = option.get_name(is_positional, true);
  for (std::size_t at = names.find(','); at != std::string::npos;
       at = names.find(',', at + 2)) {
    names.insert(at + 1, " ");
  }
  return names;
}

std::string describe_options(const CLI::App& app, bool is_positional) {
  std::string text;
  for (const CLI::Option* option : find_options(app, is_positional)) {
    text += describe(*option, list_names(*option, is_positional));
  }
  if (text.empty()) return "";
  return std::string(".SH ") + (is_positional ? "ARGUMENTS" : "OPTIONS") +
         "\n" + text;
}

std::string describe_parent(const CLI::App& app) {
  if (app.get_parent() != nullptr) {
    return ".SH SEE ALSO\n" + bold(name_of(*app.get_parent(), '-')) + "(1)\n";
  }
  return ".SH ENVIRONMENT AND EXIT STATUS\n.nf\n" +
         escape(describe_surroundings()) + ".fi\n";
}

void write_all(const CLI::App& app, const std::filesystem::path& folder) {
  write_text(folder / (name_of(app, '-') + ".1"), to_manual(app));
  for (const CLI::App* one : find_commands(app)) write_all(*one, folder);
}

}  // namespace

std::string to_manual(const CLI::App& app) {
  std::string title = name_of(app, '-');
  std::string text = fmt::format(".SH NAME\n{} \\- {}\n", escape(title),
                                 escape(app.get_description()));
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return char(std::toupper(c)); });
  return fmt::format(".TH \"{}\" 1 \"\" \"Limber {}\" \"Limber Manual\"\n",
                     title, LIMBER_VERSION) +
         text + describe_synopsis(app) + describe_commands(app) +
         describe_options(app, true) + describe_options(app, false) +
         describe_parent(app);
}

void write_manuals(const CLI::App& app, const std::filesystem::path& folder) {
  write_all(app, folder);
}

}  // namespace limber::app
