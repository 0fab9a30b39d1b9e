// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/compare/contact_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/app/console/json.hpp"
#include "limber/app/reports/contact_report.hpp"

namespace limber::app {
namespace {

const runs::PairContact* find_pair(
    const std::vector<runs::PairContact>& contacts, const std::string& pair) {
  const auto found =
      std::find_if(contacts.begin(), contacts.end(),
                   [&](const runs::PairContact& c) { return c.pair == pair; });
  return found == contacts.end() ? nullptr : &*found;
}

Json to_json(const runs::ContactDifference& difference) {
  return Json{{"impulse", or_null(difference.impulse)},
              {"peak_force", or_null(difference.peak_force)},
              {"duration", or_null(difference.duration)},
              {"restitution", or_null(difference.restitution)}};
}

// "1693 (+0.3%)", without the fraction for the reference.
std::string to_cell(double value, const std::optional<double>& error) {
  const std::string text = fmt::format("{:.5g}", value);
  return error ? fmt::format("{} ({:+.1f}%)", text, 100.0 * *error) : text;
}

std::string to_cell(const std::optional<double>& restitution) {
  return restitution ? fmt::format("{:.4f}", *restitution) : "-";
}

std::string to_line(const std::string& run, std::size_t width,
                    const runs::PairContact* contact,
                    const runs::PairContact* reference) {
  if (contact == nullptr) {
    return fmt::format("{:<{}}  does not touch\n", run, width);
  }
  const runs::ContactDifference error =
      reference == nullptr ? runs::ContactDifference{}
                           : find_difference(*contact, *reference);
  return fmt::format("{:<{}}  {:>20}  {:>20}  {:>20}  {:>7}  {:>7}  {:>7}\n",
                     run, width, to_cell(contact->impulse, error.impulse),
                     to_cell(contact->peak_force, error.peak_force),
                     to_cell(contact->duration, error.duration),
                     to_cell(contact->restitution), contact->impacts,
                     contact->touches);
}

std::vector<std::string> list_pairs(const std::vector<NamedContacts>& runs,
                                    const NamedContacts& reference) {
  std::vector<std::string> pairs;
  const auto add = [&](const NamedContacts& run) {
    for (const runs::PairContact& contact : run.contacts) {
      if (std::find(pairs.begin(), pairs.end(), contact.pair) == pairs.end()) {
        pairs.push_back(contact.pair);
      }
    }
  };
  add(reference);
  for (const NamedContacts& run : runs) add(run);
  return pairs;
}

}  // namespace

Json to_json(const std::vector<runs::PairContact>& contacts,
             const std::vector<runs::PairContact>* reference) {
  Json list = Json::array();
  for (const runs::PairContact& contact : contacts) {
    Json item{{"between", split_pair(contact.pair)},
              {"impacts", contact.impacts},
              {"touches", contact.touches},
              {"impulse", contact.impulse},
              {"peak_force", contact.peak_force},
              {"duration", contact.duration},
              {"restitution", or_null(contact.restitution)}};
    if (reference != nullptr) {
      const runs::PairContact* same = find_pair(*reference, contact.pair);
      item["error"] = same == nullptr
                          ? Json(nullptr)
                          : to_json(find_difference(contact, *same));
    }
    list.push_back(item);
  }
  return list;
}

std::string to_text(const std::vector<NamedContacts>& runs,
                    const NamedContacts& reference) {
  std::size_t width = reference.run.size();
  for (const NamedContacts& run : runs) width = std::max(width, run.run.size());
  std::string text;
  for (const std::string& pair : list_pairs(runs, reference)) {
    width = std::max(width, pair.size());
    text += fmt::format("{:<{}}  {:>20}  {:>20}  {:>20}  {:>7}  {:>7}  {:>7}\n",
                        pair, width, "impulse [N s]", "peak [N]", "lasts [s]",
                        "e", "impacts", "touches");
    const runs::PairContact* truth = find_pair(reference.contacts, pair);
    for (const NamedContacts& run : runs) {
      text += to_line(run.run, width, find_pair(run.contacts, pair), truth);
    }
    text += to_line(reference.run, width, truth, nullptr);
  }
  return text;
}

}  // namespace limber::app
