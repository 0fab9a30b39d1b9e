// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/event_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace limber::app {
namespace {

using dynamics::Event;

constexpr std::size_t kMostEventLines = 10;
constexpr std::size_t kMostMarks = 12;
/// Width of a mark's label, as a fraction of the picture's.
constexpr double kLabelWidth = 0.015;
/// Characters that fit along a mark.
constexpr std::size_t kMostLetters = 48;

/// Events of one kind.
struct Kind {
  std::string what;
  std::size_t count = 0;
  const Event* first = nullptr;
  const Event* last = nullptr;
};

std::vector<Kind> find_kinds(const std::vector<Event>& events) {
  std::vector<Kind> kinds;
  for (const Event& event : events) {
    auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) {
      return k.what == event.what;
    });
    if (kind == kinds.end()) {
      kind = kinds.insert(kinds.end(), {event.what, 0, &event, &event});
    }
    ++kind->count;
    kind->last = &event;
  }
  return kinds;
}

std::string place(const Event& event) {
  return fmt::format("{:.6g} s '{}'", event.time, event.source);
}

// Abbreviates text that no longer fits by dots.
void append(std::string& label, const std::string& more) {
  const std::string dots = ", ...";
  if (label.ends_with(dots)) return;
  const bool fits = label.size() + 2 + more.size() <= kMostLetters;
  label += fits ? ", " + more : dots;
}

}  // namespace

Json to_json(const std::vector<Event>& events) {
  Json json = Json::array();
  for (const Event& event : events) {
    json.push_back(Json{{"time", event.time},
                        {"source", event.source},
                        {"what", event.what},
                        {"rate", event.rate},
                        {"iterations", event.iterations}});
  }
  return json;
}

std::string to_text(const std::vector<Event>& events) {
  if (events.empty()) return "";
  std::string text = fmt::format("events  {}\n", events.size());
  if (events.size() <= kMostEventLines) {
    for (const Event& event : events) {
      text += fmt::format("  {} {}", place(event), event.what);
      if (event.rate != 0.0) text += fmt::format(", rate {:.4g}", event.rate);
      text += "\n";
    }
    return text;
  }
  for (const Kind& kind : find_kinds(events)) {
    text += fmt::format("  {} {}, first {}, last {}\n", kind.count, kind.what,
                        place(*kind.first), place(*kind.last));
  }
  return text;
}

std::vector<results::Mark> make_marks(const std::vector<Event>& events,
                                      double start, double end) {
  std::vector<results::Mark> marks;
  for (const Event& event : events) {
    if (event.time < start || event.time > end) continue;
    const std::string label = event.source + " " + event.what;
    if (!marks.empty() &&
        event.time - marks.back().time < kLabelWidth * (end - start)) {
      append(marks.back().label, label);
      continue;
    }
    marks.push_back({event.time, label});
  }
  if (marks.size() > kMostMarks) marks.clear();
  return marks;
}

}  // namespace limber::app
