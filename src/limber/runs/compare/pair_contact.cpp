// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/compare/pair_contact.hpp"

#include <algorithm>
#include <map>

namespace limber::runs {
namespace {

std::optional<double> find_relative(double value, double reference) {
  if (reference == 0.0) return std::nullopt;
  return value / reference - 1.0;
}

}  // namespace

std::vector<PairContact> sum_up(
    const std::vector<dynamics::ContactRecord>& records) {
  std::vector<PairContact> contacts;
  std::map<std::string, std::size_t> places;
  std::map<std::string, double> largest;  // impulse
  for (const dynamics::ContactRecord& record : records) {
    const auto [place, is_new] = places.emplace(record.pair, contacts.size());
    if (is_new) contacts.emplace_back().pair = record.pair;
    PairContact& contact = contacts[place->second];
    ++contact.impacts;
    contact.touches += record.touches;
    contact.impulse += record.impulse;
    contact.peak_force = std::max(contact.peak_force, record.peak_force);
    contact.duration += record.duration;
    if (is_new || record.impulse > largest[record.pair]) {
      largest[record.pair] = record.impulse;
      contact.restitution = record.restitution();
    }
  }
  return contacts;
}

ContactDifference find_difference(const PairContact& contact,
                                  const PairContact& reference) {
  ContactDifference difference;
  difference.impulse = find_relative(contact.impulse, reference.impulse);
  difference.peak_force =
      find_relative(contact.peak_force, reference.peak_force);
  difference.duration = find_relative(contact.duration, reference.duration);
  if (contact.restitution && reference.restitution) {
    difference.restitution = *contact.restitution - *reference.restitution;
  }
  return difference;
}

}  // namespace limber::runs
