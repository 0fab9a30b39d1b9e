// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/json.hpp"

#include "limber/common/escape_texts.hpp"

namespace limber::app {
namespace {

std::string to_line(const Json& json) { return escape_texts(json).dump(); }

void add_outline(const Json& json, int depth, std::string& out) {
  const std::string margin(static_cast<std::size_t>(2 * depth), ' ');
  if (json.is_array()) {
    for (const Json& item : json) out += margin + to_line(item) + "\n";
    return;
  }
  for (const auto& [key, value] : json.items()) {
    const bool is_table =
        value.is_array() && !value.empty() && value.front().is_object();
    if (is_table || value.is_object()) {
      out += margin + key + ":\n";
      add_outline(value, depth + 1, out);
    } else {
      out += margin + key + ": " + to_line(value) + "\n";
    }
  }
}

}  // namespace

Json to_json(const MatrixX& values) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    if (values.cols() == 1) {
      rows.push_back(values(i, 0));
      continue;
    }
    Json row = Json::array();
    for (const double value : values.row(i)) row.push_back(value);
    rows.push_back(std::move(row));
  }
  return rows;
}

Json or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::string to_text(const Json& json) { return escape_texts(json).dump(2); }

std::string outline(const Json& object) {
  std::string out;
  add_outline(object, 0, out);
  if (!out.empty() && out.back() == '\n') out.pop_back();
  return out;
}

}  // namespace limber::app
