// SPDX-License-Identifier: BSD-3-Clause
#include "page.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber::bench {
namespace {

// Lines of at most 80 columns; words are never cut.
std::string wrap(const std::string& paragraph) {
  std::istringstream words(paragraph);
  std::string text;
  std::size_t column = 0;
  for (std::string word; words >> word;) {
    if (column > 0 && column + 1 + word.size() > 80) {
      text += '\n';
      column = 0;
    } else if (column > 0) {
      text += ' ';
      ++column;
    }
    text += word;
    column += word.size();
  }
  return text;
}

std::string join_row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

}  // namespace

Page::Page(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code trouble;
  std::filesystem::create_directories(folder_ / "data", trouble);
  if (trouble) {
    throw InputError(fmt::format("'{}' cannot be made: {}", folder_.string(),
                                 trouble.message()));
  }
}

void Page::heading(const std::string& text) { body_ += "## " + text + "\n\n"; }

void Page::text(const std::string& paragraph) {
  body_ += wrap(paragraph) + "\n\n";
}

void Page::table(const std::vector<std::string>& header,
                 const std::vector<std::vector<std::string>>& rows) {
  body_ += join_row(header);
  body_ += "|---|";
  for (std::size_t i = 1; i < header.size(); ++i) body_ += "---:|";
  body_ += '\n';
  for (const auto& row : rows) body_ += join_row(row);
  body_ += '\n';
}

void Page::figure(const Plot& plot, const std::string& name,
                  const std::string& caption) {
  write_csv(plot, folder_ / "data" / (name + ".csv"));
  picture(draw(plot, folder_ / (name + ".png")), name, caption);
}

void Page::picture(const std::string& trouble, const std::string& name,
                   const std::string& caption) {
  if (!trouble.empty()) trouble_ = trouble;
  body_ += fmt::format("![{0}]({1}.png)\n\n*{0}*\n\n", caption, name);
}

void Page::check(bool holds, const std::string& claim) {
  ++checks_;
  if (!holds) ++failures_;
  text(fmt::format("- **{}** {}", holds ? "Holds:" : "DOES NOT HOLD:", claim));
}

void Page::write() const {
  const std::filesystem::path file = folder_ / "README.md";
  std::ofstream out(file);
  out << body_;
  out.flush();
  if (!out) {
    throw InputError(fmt::format("'{}' cannot be written", file.string()));
  }
}

}  // namespace limber::bench
