// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/contact_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/restitution.hpp"

namespace limber::scene {
namespace {

constexpr const char* kDefault = "contact_default";

ContactOptions read_options(TomlTable& table) {
  ContactOptions options;
  options.friction = table.number("friction", kNonNegative);
  options.static_friction = table.number("static_friction", kNonNegative);
  options.stribeck_speed = table.number("stribeck_speed", kPositive);
  options.rolling_friction = table.number("rolling_friction", kNonNegative);
  options.restitution = table.number("restitution", {0.0, 1.0, false, false});
  options.damping = table.number("damping", kNonNegative);
  options.radius = table.number("radius", kPositive);
  options.stiffness = table.number("stiffness", kPositive);
  if (options.restitution && options.damping) {
    table.fail("has both 'restitution' and 'damping'; keep one");
  }
  return options;
}

/// `own` with what it leaves out from `otherwise`.
ContactOptions merge(const ContactOptions& own,
                     const ContactOptions& otherwise) {
  ContactOptions options = own;
  const auto fill = [](std::optional<double>& value,
                       const std::optional<double>& other) {
    if (!value) value = other;
  };
  fill(options.friction, otherwise.friction);
  fill(options.static_friction, otherwise.static_friction);
  fill(options.stribeck_speed, otherwise.stribeck_speed);
  fill(options.rolling_friction, otherwise.rolling_friction);
  fill(options.radius, otherwise.radius);
  fill(options.stiffness, otherwise.stiffness);
  // Both determine how much energy is lost.
  if (!own.damping) fill(options.restitution, otherwise.restitution);
  if (!own.restitution) fill(options.damping, otherwise.damping);
  return options;
}

void check_friction(const TomlTable& table, const ContactOptions& options) {
  const double sliding = options.friction.value_or(0.0);
  if (!options.static_friction || *options.static_friction >= sliding) return;
  table.fail(fmt::format(
      "static_friction is {}, less than friction, {}; expected at least that",
      *options.static_friction, sliding));
}

ContactSpec read_contact(TomlTable& table, const ContactOptions& otherwise) {
  ContactSpec contact;
  const auto names = table.texts("between");
  if (names && names->size() == 2) {
    contact.between = {(*names)[0], (*names)[1]};
  } else if (names || !table.has("between")) {
    table.fail("needs 'between', the names of two bodies");
  }
  contact.options = merge(read_options(table), otherwise);
  check_friction(table, contact.options);
  return contact;
}

/// The numbers of contacts that are so, of many the first.
template <typename Is>
std::vector<std::string> list_contacts(const std::vector<ContactSpec>& contacts,
                                       Is is_so) {
  constexpr std::size_t kMostListed = 10;
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (is_so(contacts[i].options)) numbers.push_back(fmt::format("{}", i + 1));
  }
  if (numbers.size() <= kMostListed) return numbers;
  numbers.resize(kMostListed);
  numbers.emplace_back("...");
  return numbers;
}

/// A notice of the contacts without a value, if there are any.
template <typename Leaves>
void report_default(const std::vector<ContactSpec>& contacts, Leaves leaves_out,
                    const char* key, const char* means,
                    std::vector<std::string>& notices) {
  const auto numbers = list_contacts(contacts, leaves_out);
  if (numbers.empty()) return;
  notices.push_back(
      fmt::format("no '{}' is given for [[contact]] {}: {}; give it there or "
                  "in [{}]",
                  key, fmt::join(numbers, ", "), means, kDefault));
}

/// A notice of restitutions that no damping gives.
void report_least_restitution(Scenario& scenario) {
  const auto numbers =
      list_contacts(scenario.contacts, [](const ContactOptions& o) {
        return o.restitution.value_or(1.0) < kLeastRestitution;
      });
  if (numbers.empty()) return;
  scenario.warnings.push_back(fmt::format(
      "'restitution' of [[contact]] {} is below {} and acts as that value: the "
      "bodies separate with {:.2g} % of their energy",
      fmt::join(numbers, ", "), kLeastRestitution,
      100.0 * kLeastRestitution * kLeastRestitution));
}

}  // namespace

void read_contacts(TomlTable& root, Scenario& scenario) {
  ContactOptions otherwise;
  if (const toml::table* table = root.table(kDefault)) {
    TomlTable section(*table, kDefault, root.problems());
    otherwise = read_options(section);
    section.finish();
  }
  for (const toml::table* table : root.tables("contact")) {
    TomlTable element(*table,
                      fmt::format("contact {}", scenario.contacts.size() + 1),
                      root.problems());
    scenario.contacts.push_back(read_contact(element, otherwise));
    element.finish();
  }
  report_default(
      scenario.contacts,
      [](const ContactOptions& o) { return !o.friction && !o.static_friction; },
      "friction", "it slides without friction (0)", scenario.warnings);
  report_default(
      scenario.contacts,
      [](const ContactOptions& o) { return !o.restitution && !o.damping; },
      "restitution", "it loses no energy (1)", scenario.warnings);
  report_least_restitution(scenario);
}

}  // namespace limber::scene
