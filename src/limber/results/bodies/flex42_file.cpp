// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "limber/common/errors.hpp"
#include "limber/results/bodies/body_coordinates.hpp"
#include "limber/results/bodies/body_files.hpp"

namespace limber::results {
namespace {

/// A list of entries, each with its indices, behind their number.
class EntryList {
 public:
  explicit EntryList(const char* title) : title_(title) {}

  template <typename... Index>
  void add(double value, Index... indices) {
    if (value == 0.0) return;
    ((text_ += fmt::format("{} ", indices)), ...);
    text_ += fmt::format(" {:.17g} ! indices, value\n", value);
    ++count_;
  }
  [[nodiscard]] std::string text() const {
    return fmt::format("******** {} ********\n{} ! number of elements\n{}",
                       title_, count_, text_);
  }

 private:
  const char* title_;
  std::string text_;
  std::size_t count_ = 0;
};

std::string list_shapes(const std::vector<BodyNode>& frames, Eigen::Index m) {
  EntryList translations("Analysis nodes: translation (PSI) [mode node axis]");
  EntryList rotations("Rotation (THETA) [mode node axis]");
  for (Eigen::Index k = 0; k < m; ++k)
    for (std::size_t i = 0; i < frames.size(); ++i)
      for (Eigen::Index c = 0; c < frames[i].rows.rows(); ++c)
        (c < 3 ? translations : rotations)
            .add(frames[i].rows(c, 6 + k), k, i, c % 3);
  return translations.text() + rotations.text();
}

std::string list_diagonal(const char* title, const VectorX& values) {
  EntryList list(title);
  for (Eigen::Index k = 0; k < values.size(); ++k) list.add(values[k], k, k);
  return list.text();
}

std::string list_integrals(const flexbody::InertiaShapeIntegrals& integrals,
                           std::size_t m) {
  EntryList L("L, 3 x 3 x Nf [i j mode]");
  EntryList N("N, 3 x 3 x Nf x Nf [i j mode mode]");
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < m; ++k) {
        L.add(integrals.S1[k](i, j), i, j, k);
        for (std::size_t l = 0; l < m; ++l)
          N.add(integrals.S2[k * m + l](i, j), i, j, k, l);
      }
  return L.text() + N.text();
}

std::vector<BodyNode> list_interfaces(const flexbody::ReducedBody& body) {
  std::vector<BodyNode> nodes = list_nodes(body);
  std::erase_if(nodes, [](const BodyNode& n) { return n.interface.empty(); });
  return nodes;
}

}  // namespace

std::string make_flex42_file(const flexbody::ReducedBody& body, double ratio) {
  require_free(body);
  if (!body.inertia_record.gap.empty())
    throw InputError(fmt::format(
        "body '{}' has no integrals of second order, which 42 reads: {}",
        body.name, body.inertia_record.gap));
  const Eigen::Index m = body.lambda.size();
  std::string text = fmt::format(
      "<<<<<<<< 42: flexible body, by Limber >>>>>>>>\n{} ! description\n{} ! "
      "number of flex modes\n******** Initial modal states x, u ********\n",
      body.name, m);
  for (Eigen::Index k = 0; k < m; ++k)
    text += fmt::format("0.0 0.0 ! mode {}, x, u\n", k);
  text += EntryList("Joints: translation (PSI) [mode joint axis]").text();
  text += EntryList("Joints: rotation (THETA) [mode joint axis]").text();
  text += list_shapes(list_interfaces(body), m);
  text += list_diagonal("Mass matrix [row column]", VectorX::Ones(m));
  text += list_diagonal("Stiffness matrix [row column]", body.lambda);
  text += list_diagonal("Damping matrix [row column]",
                        2.0 * ratio * body.lambda.cwiseMax(0.0).cwiseSqrt());
  for (const char* title :
       {"Linear momentum, Pf, 3 x Nf", "Angular momentum, Hf, 3 x Nf"}) {
    text += fmt::format("******** {} ********\n", title);
    // Mean axes at the centre of mass.
    for (Eigen::Index k = 0; k < m; ++k)
      text += fmt::format("0.0 0.0 0.0 ! mode {}\n", k);
  }
  text += list_integrals(body.integrals, static_cast<std::size_t>(m));
  return text;
}

std::string make_nodes42_file(const flexbody::ReducedBody& body) {
  std::string text = "Nodes:\n";
  std::size_t i = 0;
  for (const BodyNode& node : list_interfaces(body)) {
    const Vector3 x = node.x_B + body.p_MoBcm_M;
    text += fmt::format(
        "- Node:\n    Index: {}\n    Comment: {}\n    Location: [{:.17g}, "
        "{:.17g}, {:.17g}]\n",
        i++, node.interface, x[0], x[1], x[2]);
  }
  return text;
}

}  // namespace limber::results
