// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/text/flat_deck.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/upper_case.hpp"
#include "limber/fem/text/deck_sets.hpp"

namespace limber::fem {
namespace {

/// A keyword with its data, of a part.
struct PartBlock {
  DeckPlace place;
  Keyword keyword;
  std::vector<std::pair<DeckPlace, std::string>> lines;
};

/// Where numbers and names are an instance's, or the assembly's.
struct Scope {
  std::string prefix;  ///< of names, as the file spells it
  long offset = 0;     ///< of numbers
  Pose pose;
};

enum class Numbers { none, nodes, elements };

constexpr std::array<std::string_view, 6> kRead = {
    "INCLUDE", "NODE", "ELEMENT", "NSET", "ELSET", "SURFACE"};

/// Parameters that name what parts have.
constexpr std::array<std::string_view, 8> kNames = {
    "ELSET",   "NSET",     "TIE NSET",    "PIN NSET",
    "SURFACE", "REF NODE", "ORIENTATION", "ROT NODE"};

template <typename List>
bool is_listed(const List& list, std::string_view name) {
  return std::ranges::find(list, name) != list.end();
}

class FlatDeckReader {
 public:
  FlatDeckReader(const std::filesystem::path& file, const FlatReading& reading)
      : file_(file), reading_(reading) {}

  std::vector<std::string> read() {
    read_keyword_deck(file_,
                      {[this](const TextScanner&, const Keyword& keyword) {
                         count_ += keyword.name == "INSTANCE" ? 1 : 0;
                         return keyword.name == "INCLUDE";
                       },
                       [](const TextScanner&, std::string_view) {}});
    read_keyword_deck(file_,
                      {[this](const TextScanner& at, const Keyword& keyword) {
                         return begin(keep(at), keyword);
                       },
                       [this](const TextScanner& at, std::string_view line) {
                         add_data(keep(at), line);
                       }});
    if (part_ || instance_)
      throw InputError(
          fmt::format("{}: the file ends within *{}. Expected *END "
                      "{} before.",
                      file_.string(), part_ ? "PART" : "INSTANCE",
                      part_ ? "PART" : "INSTANCE"));
    if (!own_nodes_.empty() || !own_elements_.empty())
      notices_.push_back(
          fmt::format("{}: {} is added to the numbers of nodes and elements of "
                      "the assembly",
                      file_.string(), assembly_.offset));
    return std::move(notices_);
  }

 private:
  /// With a path that stays.
  DeckPlace keep(const TextScanner& at) {
    return {*files_.insert(at.file()).first, at.number()};
  }

  bool begin(const DeckPlace& at, const Keyword& keyword) {
    goes_on_ = false;
    const std::string& name = keyword.name;
    if (name == "PART") {
      if (part_) at.fail("*PART within a *PART. Expected *END PART.");
      part_ = keyword.get("NAME");
      parts_[*part_].clear();
    } else if (name == "END PART") {
      if (!part_) at.fail("*END PART without *PART.");
      part_.reset();
    } else if (name == "INSTANCE") {
      begin_instance(at, keyword);
    } else if (name == "END INSTANCE") {
      if (!instance_) at.fail("*END INSTANCE without *INSTANCE.");
      end_instance(at);
    } else if (part_ || instance_) {
      std::vector<PartBlock>& blocks = part_ ? parts_[*part_] : blocks_;
      blocks.push_back({at, keyword, {}});
      is_moving_ = false;
      return is_listed(kRead, name);
    } else {
      keyword_ = keyword;
      const Keyword flat =
          scopes_.empty() ? keyword : translate(keyword, assembly_);
      return reading_.begin(at, flat, {});
    }
    return false;
  }

  void add_data(const DeckPlace& at, std::string_view line) {
    if (is_moving_) return add_move(at, line);
    if (!part_ && !instance_) {
      if (scopes_.empty()) return reading_.add_data(at, line);
      return reading_.add_data(at, translate(at, keyword_, line, assembly_));
    }
    std::vector<PartBlock>& blocks = part_ ? parts_[*part_] : blocks_;
    if (!blocks.empty()) blocks.back().lines.emplace_back(at, line);
  }

  // ---- instances
  void begin_instance(const DeckPlace& at, const Keyword& keyword) {
    if (part_ || instance_)
      at.fail("*INSTANCE within another or a *PART. Expected its end before.");
    const std::string part = keyword.get("PART");
    if (!parts_.contains(part))
      at.fail(
          fmt::format("*INSTANCE has the part {}, which is missing. "
                      "Expected its *PART before.",
                      echo(part)));
    instance_ = keyword.get("NAME");
    if (instance_->empty() || instance_->find('.') != std::string::npos ||
        scopes_.contains(*instance_))
      at.fail("*INSTANCE has no name of its own. Expected one without a dot.");
    if (scopes_.empty()) find_step();
    constexpr long kMost = 1'000'000'000;
    if (count_ * step_ > kMost)
      at.fail(fmt::format(
          "{} instances with numbers up to {} have no numbers of their own. "
          "Expected fewer of them, or smaller ones.",
          count_, step_));
    const auto number = static_cast<long>(scopes_.size());
    scopes_[*instance_] = {
        count_ > 1 ? keyword.spelled.at("NAME") + "." : std::string(),
        number * step_, Pose()};
    if (number > 0)
      notices_.push_back(fmt::format(
          "{}: {} is added to the numbers of nodes and elements of instance {}",
          file_.string(), number * step_, keyword.spelled.at("NAME")));
    assembly_ = {{}, count_ * step_, {}};
    blocks_ = parts_[part];
    moves_.clear();
    is_moving_ = true;
  }

  /// A power of ten above all numbers of parts.
  void find_step() {
    for (const auto& [name, blocks] : parts_)
      for (const PartBlock& block : blocks)
        if (block.keyword.name == "NODE" || block.keyword.name == "ELEMENT")
          for (const auto& [at, line] : block.lines) {
            long number = 0;
            if (parse_whole(split_commas(line)[0], number))
              while (step_ <= number) step_ *= 10;
          }
  }

  void end_instance(const DeckPlace& at) {
    Scope& scope = scopes_[*instance_];
    scope.pose = find_pose(at);
    is_moving_ = false;
    for (const PartBlock& block : blocks_) {
      goes_on_ = false;
      reading_.begin(block.place, translate(block.keyword, scope), scope.pose);
      for (const auto& [place, line] : block.lines)
        reading_.add_data(place, translate(place, block.keyword, line, scope));
    }
    blocks_.clear();
    instance_.reset();
  }

  void add_move(const DeckPlace& at, std::string_view line) {
    constexpr std::array<std::size_t, 2> kCounts = {3, 7};
    const std::vector<std::string_view> fields = split_commas(line);
    std::vector<double>& move = moves_.emplace_back(7, 0.0);
    if (moves_.size() > kCounts.size() ||
        fields.size() > kCounts[moves_.size() - 1])
      at.fail(
          "*INSTANCE has a line too many or too long. Expected a translation "
          "of three numbers, and two points and an angle.");
    for (std::size_t i = 0; i < fields.size(); ++i)
      move[i] = read_deck_real(at, fields[i]);
  }

  /// A line of translation, and one of two points and an angle [degrees] about
  /// the axis through them, in that order.
  [[nodiscard]] Pose find_pose(const DeckPlace& at) const {
    Pose pose;
    if (!moves_.empty()) pose.p = {moves_[0][0], moves_[0][1], moves_[0][2]};
    if (moves_.size() < 2) return pose;
    const std::vector<double>& turn = moves_[1];
    const Vector3 a(turn[0], turn[1], turn[2]);
    const Vector3 b(turn[3], turn[4], turn[5]);
    if (!((b - a).norm() > 0.0))
      at.fail("*INSTANCE turns about an axis without length.");
    Pose turned;
    turned.R = Eigen::AngleAxisd(turn[6] * std::numbers::pi / 180.0,
                                 (b - a).normalized())
                   .matrix();
    turned.p = a - turned.R * a;
    return turned * pose;
  }

  // ---- numbers and names in a scope
  [[nodiscard]] std::string resolve(const std::string& text, Numbers numbers,
                                    const Scope& scope) const {
    long number = 0;
    if (parse_whole(text, number)) {
      if (numbers == Numbers::none) return text;
      const bool is_assembly = &scope == &assembly_;
      const std::set<long>& own =
          numbers == Numbers::nodes ? own_nodes_ : own_elements_;
      if (is_assembly && count_ == 1 && !own.contains(number)) return text;
      return std::to_string(number + scope.offset);
    }
    const std::size_t dot = text.find('.');
    const auto instance = scopes_.find(to_upper(text.substr(0, dot)));
    if (dot != std::string::npos && instance != scopes_.end())
      return resolve(text.substr(dot + 1), numbers, instance->second);
    return text.empty() ? text : scope.prefix + text;
  }

  /// The scope of INSTANCE=, or the one around it.
  [[nodiscard]] const Scope& find_scope(const Keyword& keyword,
                                        const Scope& around) const {
    const auto found = scopes_.find(keyword.get("INSTANCE"));
    return found == scopes_.end() ? around : found->second;
  }

  [[nodiscard]] Keyword translate(Keyword keyword, const Scope& around) const {
    const auto rename = [&](std::string_view key, const Scope& scope) {
      const auto spelled = keyword.spelled.find(std::string(key));
      if (spelled == keyword.spelled.end()) return;
      const bool is_node = key.ends_with("NODE");
      spelled->second = resolve(
          spelled->second, is_node ? Numbers::nodes : Numbers::none, scope);
      keyword.parameters[std::string(key)] = to_upper(spelled->second);
    };
    // A set of the assembly has a name of its own, whatever it holds.
    for (const std::string_view key : kNames)
      rename(key, keyword.name == "NSET" && key == "ELSET"
                      ? find_scope(keyword, around)
                      : around);
    if (keyword.name == "SURFACE" || keyword.name == "ORIENTATION")
      rename("NAME", around);
    return keyword;
  }

  [[nodiscard]] std::string translate(const DeckPlace& at,
                                      const Keyword& keyword,
                                      std::string_view line,
                                      const Scope& around) {
    const std::string& name = keyword.name;
    const Scope& scope = find_scope(keyword, around);
    std::vector<std::string> fields;
    for (const std::string_view field : split_commas(line))
      fields.emplace_back(field);
    const auto resolve_from = [&](std::size_t first, std::size_t last,
                                  Numbers numbers) {
      for (std::size_t i = first; i < std::min(last, fields.size()); ++i)
        fields[i] = resolve(fields[i], numbers, scope);
    };
    constexpr std::size_t kAll = 1000;
    if (name == "NODE") {
      move_node(at, scope, fields);
    } else if (name == "ELEMENT") {
      if (!goes_on_) {
        note_own(fields[0], around, own_elements_);
        resolve_from(0, 1, Numbers::elements);
      }
      resolve_from(goes_on_ ? 0 : 1, kAll, Numbers::nodes);
      goes_on_ = line.ends_with(',');
    } else if (name == "NSET" || name == "ELSET") {
      resolve_from(0, keyword.has("GENERATE") ? 2 : kAll,
                   name == "NSET" ? Numbers::nodes : Numbers::elements);
    } else if (name == "SURFACE") {
      resolve_from(
          0, 1,
          keyword.get("TYPE") == "NODE" ? Numbers::nodes : Numbers::elements);
    } else if (name == "BOUNDARY") {
      resolve_from(0, 1, Numbers::nodes);
    } else if (name == "MPC") {
      resolve_from(1, kAll, Numbers::nodes);
    } else if (name == "SHELL SECTION" && keyword.has("COMPOSITE") &&
               fields.size() > 3) {
      double angle = 0.0;
      if (!parse_real(fields[3], angle))
        fields[3] = resolve(fields[3], Numbers::none, scope);
    } else {
      return std::string(line);
    }
    return fmt::format("{}", fmt::join(fields, ","));
  }

  void note_own(const std::string& field, const Scope& scope,
                std::set<long>& own) const {
    long number = 0;
    if (&scope == &assembly_ && parse_whole(field, number)) own.insert(number);
  }

  void move_node(const DeckPlace& at, const Scope& scope,
                 std::vector<std::string>& fields) {
    note_own(fields[0], scope, own_nodes_);
    fields[0] = resolve(fields[0], Numbers::nodes, scope);
    const bool is_moved =
        !scope.pose.R.isIdentity(0.0) || !scope.pose.p.isZero(0.0);
    if (!is_moved) return;
    fields.resize(4);
    Vector3 x;
    for (Eigen::Index i = 0; i < 3; ++i)
      x[i] = read_deck_real(at, fields[static_cast<std::size_t>(i) + 1]);
    x = scope.pose * x;
    for (Eigen::Index i = 0; i < 3; ++i)
      fields[static_cast<std::size_t>(i) + 1] = fmt::format("{}", x[i]);
  }

  std::filesystem::path file_;
  const FlatReading& reading_;
  std::vector<std::string> notices_;
  std::set<std::filesystem::path> files_;
  long count_ = 0;  // of instances in all
  long step_ = 10;
  std::map<std::string, std::vector<PartBlock>> parts_;
  std::map<std::string, Scope> scopes_;  // of instances
  Scope assembly_;
  std::set<long> own_nodes_;  // of the assembly
  std::set<long> own_elements_;
  std::optional<std::string> part_;      // open
  std::optional<std::string> instance_;  // open
  std::vector<PartBlock> blocks_;        // of the open instance
  std::vector<std::vector<double>> moves_;
  bool is_moving_ = false;  // whether lines are of *INSTANCE
  bool goes_on_ = false;    // whether an element does
  Keyword keyword_;         // last one outside of parts and instances
};

}  // namespace

std::vector<std::string> read_flat_deck(const std::filesystem::path& file,
                                        const FlatReading& reading) {
  return FlatDeckReader(file, reading).read();
}

}  // namespace limber::fem
