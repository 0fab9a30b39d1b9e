// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/nastran_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "limber/common/echo.hpp"
#include "limber/fem/nastran/bulk_card.hpp"
#include "limber/fem/nastran/card_effect.hpp"
#include "limber/fem/nastran/grid_table.hpp"

namespace limber::fem {
namespace {

struct PictureCard {
  std::string_view name;
  ModelElement::Shape shape;
  std::size_t first;  ///< field of the first corner
};

constexpr std::array<PictureCard, 18> kPictureCards = {{
    {"CBAR", ModelElement::Shape::line, 2},
    {"CBEAM", ModelElement::Shape::line, 2},
    {"CROD", ModelElement::Shape::line, 2},
    {"CTUBE", ModelElement::Shape::line, 2},
    {"CBEND", ModelElement::Shape::line, 2},
    {"CONROD", ModelElement::Shape::line, 1},
    {"PLOTEL", ModelElement::Shape::line, 1},
    {"CTRIA3", ModelElement::Shape::triangle, 2},
    {"CTRIAR", ModelElement::Shape::triangle, 2},
    {"CTRIA6", ModelElement::Shape::triangle, 2},
    {"CQUAD4", ModelElement::Shape::quad, 2},
    {"CQUADR", ModelElement::Shape::quad, 2},
    {"CQUAD8", ModelElement::Shape::quad, 2},
    {"CTETRA", ModelElement::Shape::tetra, 2},
    {"CPYRAM", ModelElement::Shape::pyramid, 2},
    {"CPENTA", ModelElement::Shape::wedge, 2},
    {"CHEXA", ModelElement::Shape::hexa, 2},
    {"CSHEAR", ModelElement::Shape::quad, 2},
}};

class PointReader {
 public:
  explicit PointReader(const std::filesystem::path& file)
      : deck_(read_deck(file, DeckUse::points)),
        problems_(deck_),
        grids_(problems_) {
    model_.file = file;
    model_.format = "Nastran bulk data";
  }

  ModelFile read() {
    CardReader reader(deck_, problems_);
    BulkCard card;
    while (reader.next(card)) add(card);
    std::vector<int> ids;
    for (const auto& [id, grid] : grids_.grids()) ids.push_back(id);
    std::sort(ids.begin(), ids.end());
    for (const int id : ids) {
      model_.tags.push_back(id);
      model_.x.push_back(grids_.find_position(grids_.grids().at(id)));
    }
    problems_.check();
    return std::move(model_);
  }

 private:
  void add(const BulkCard& card) {
    constexpr std::size_t kDisplacements = 5;  // CD
    if (card.name == "GRID" || card.name == "GRDSET") {
      const std::optional<int> system =
          card.integer(kDisplacements, 0, problems_);
      if (system && *system > 0)
        problems_.add(*card.line,
                      fmt::format("{} {} has displacements in coordinate "
                                  "system {} (CD). Expected the basic one, 0: "
                                  "blank CD fields before the matrices are "
                                  "written.",
                                  card.name, echo(card.field(0)), *system));
    }
    if (card.name == "GRID") {
      grids_.add_grid(card);
    } else if (card.name == "GRDSET") {
      grids_.add_default(card);
    } else if (is_coordinate_system(card.name)) {
      grids_.add_system(card);
    } else {
      add_element(card);
    }
  }

  void add_element(const BulkCard& card) {
    const auto* const found =
        std::find_if(kPictureCards.begin(), kPictureCards.end(),
                     [&](const auto& one) { return one.name == card.name; });
    if (found == kPictureCards.end()) return;
    ModelElement element{found->shape, {}};
    for (std::size_t i = 0; i < count_corners(found->shape); ++i)
      element.corners.push_back(
          card.integer(found->first + i, 0, problems_).value_or(0));
    model_.elements.push_back(std::move(element));
  }

  Deck deck_;
  DeckProblems problems_;
  GridTable grids_;
  ModelFile model_;
};

}  // namespace

ModelFile read_nastran_points(const std::filesystem::path& file) {
  return PointReader(file).read();
}

}  // namespace limber::fem
