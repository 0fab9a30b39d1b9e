// SPDX-License-Identifier: BSD-3-Clause
#include "app/json.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/errors.hpp"

namespace limber::app {
namespace {

std::string quote(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string number(double value) {
  // JSON has no word for what is not finite.
  if (!std::isfinite(value)) return "null";
  if (value == std::floor(value) && std::abs(value) < 1e15) {
    return fmt::format("{:.0f}", value);
  }
  return fmt::format("{}", value);
}

void new_line(std::string& out, int indent, int depth) {
  if (indent < 0) return;
  out += '\n';
  out.append(static_cast<std::size_t>(indent * depth), ' ');
}

}  // namespace

Json::Json(const VectorX& values) : value_(Array{}) {
  for (const double value : values) push(value);
}

Json::Json(const std::vector<double>& values) : value_(Array{}) {
  for (const double value : values) push(value);
}

Json::Json(const std::vector<std::string>& values) : value_(Array{}) {
  for (const std::string& value : values) push(value);
}

Json Json::array() {
  Json json;
  json.value_ = Array{};
  return json;
}

Json Json::object() {
  Json json;
  json.value_ = Object{};
  return json;
}

Json Json::matrix(const MatrixX& values) {
  Json rows = array();
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    rows.push(Json(VectorX(values.row(i))));
  }
  return rows;
}

Json& Json::add(const std::string& key, Json value) {
  LIMBER_EXPECT(std::holds_alternative<Object>(value_));
  std::get<Object>(value_).emplace_back(key, std::move(value));
  return *this;
}

Json& Json::push(Json value) {
  LIMBER_EXPECT(std::holds_alternative<Array>(value_));
  std::get<Array>(value_).push_back(std::move(value));
  return *this;
}

std::string Json::text(int indent) const {
  std::string out;
  write(out, indent, 0);
  return out;
}

std::string Json::outline() const {
  std::string out;
  write_outline(out, 0);
  if (!out.empty() && out.back() == '\n') out.pop_back();
  return out;
}

void Json::write_outline(std::string& out, int depth) const {
  const std::string margin(static_cast<std::size_t>(2 * depth), ' ');
  const auto is_object = [](const Json& json) {
    return std::holds_alternative<Object>(json.value_);
  };
  if (const Array* items = std::get_if<Array>(&value_)) {
    for (const Json& item : *items) out += margin + item.text(-1) + "\n";
    return;
  }
  for (const auto& [key, value] : std::get<Object>(value_)) {
    const Array* items = std::get_if<Array>(&value.value_);
    const bool nested =
        items != nullptr && !items->empty() && is_object(items->front());
    if (nested || is_object(value)) {
      out += margin + key + ":\n";
      value.write_outline(out, depth + 1);
    } else {
      out += margin + key + ": " + value.text(-1) + "\n";
    }
  }
}

void Json::write(std::string& out, int indent, int depth) const {
  if (std::holds_alternative<std::nullptr_t>(value_)) out += "null";
  if (const bool* b = std::get_if<bool>(&value_)) out += *b ? "true" : "false";
  if (const double* d = std::get_if<double>(&value_)) out += number(*d);
  if (const auto* s = std::get_if<std::string>(&value_)) out += quote(*s);
  if (const Array* items = std::get_if<Array>(&value_)) {
    out += '[';
    for (std::size_t i = 0; i < items->size(); ++i) {
      if (i > 0) out += indent < 0 ? "," : ", ";
      (*items)[i].write(out, indent, depth + 1);
    }
    out += ']';
  }
  const Object* members = std::get_if<Object>(&value_);
  if (members == nullptr) return;
  out += '{';
  for (std::size_t i = 0; i < members->size(); ++i) {
    if (i > 0) out += ',';
    new_line(out, indent, depth + 1);
    out += quote((*members)[i].first) + (indent < 0 ? ":" : ": ");
    (*members)[i].second.write(out, indent, depth + 1);
  }
  if (!members->empty()) new_line(out, indent, depth);
  out += '}';
}

}  // namespace limber::app
