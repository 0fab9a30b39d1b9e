// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/system_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"

namespace limber::dynamics {
namespace {

template <typename Thing>
std::vector<std::string> names_of(const std::vector<Thing>& things) {
  std::vector<std::string> names;
  for (const Thing& thing : things) names.push_back(thing.name);
  return names;
}

}  // namespace

BodyIndex SystemModel::find_body(std::string_view name) const {
  return BodyIndex(find_name("body", name, names_of(bodies)));
}

AttachmentIndex SystemModel::find_attachment(std::string_view name) const {
  const std::vector<std::string> names = names_of(attachments);
  const AttachmentIndex found(find_name("attachment", name, names));
  const auto count = std::count(names.begin(), names.end(), name);
  if (count == 1) return found;
  throw InputError(fmt::format(
      "{} attachments are called '{}'; keep the index that adding it returns",
      count, echo(std::string(name))));
}

CouplerIndex SystemModel::find_coupler(std::string_view name) const {
  return CouplerIndex(find_name("coupler", name, names_of(couplers)));
}

TransmissionIndex SystemModel::find_transmission(std::string_view name) const {
  return TransmissionIndex(
      find_name("transmission", name, names_of(transmissions)));
}

LoadIndex SystemModel::find_load(std::string_view name) const {
  return LoadIndex(find_name("load", name, names_of(loads)));
}

bool has_ideal_joints(const SystemModel& model) {
  return std::ranges::any_of(model.couplers, [](const Coupler& coupler) {
    return joints::is_ideal(coupler.law);
  });
}

}  // namespace limber::dynamics
