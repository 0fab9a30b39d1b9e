// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plot.hpp"

namespace limber::bench {

/// A page written section by section: README.md, its pictures beside it, and
/// their data as CSV in data/.
class Page {
 public:
  /// Makes the folder. @throws InputError if it cannot be made.
  explicit Page(std::filesystem::path folder);

  void heading(const std::string& text);
  /// A paragraph of Markdown.
  void text(const std::string& paragraph);
  /// The first column is aligned left, the others right.
  void table(const std::vector<std::string>& header,
             const std::vector<std::vector<std::string>>& rows);
  /// Draws `plot` as name.png and writes data/name.csv.
  void figure(const Plot& plot, const std::string& name,
              const std::string& caption);
  /// A picture name.png that was drawn already.
  /// @param trouble why it was not, if so
  void picture(const std::string& trouble, const std::string& name,
               const std::string& caption);
  /// Reports whether a claim holds in this run; counts failures.
  void check(bool holds, const std::string& claim);

  [[nodiscard]] int checks() const { return checks_; }
  [[nodiscard]] int failures() const { return failures_; }
  /// Why there were no pictures; empty if there were.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

  /// @throws InputError if it cannot be written.
  void write() const;

 private:
  std::filesystem::path folder_;
  std::string body_;
  std::string trouble_;
  int checks_ = 0;
  int failures_ = 0;
};

}  // namespace limber::bench
