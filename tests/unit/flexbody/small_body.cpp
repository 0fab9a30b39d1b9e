// SPDX-License-Identifier: BSD-3-Clause
#include "unit/flexbody/small_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <type_traits>
#include <utility>

namespace limber::flexbody::test {
namespace {

// Fills with numbers of all magnitudes.
class Numbers {
 public:
  explicit Numbers(unsigned seed) : random_(seed) {}

  double next() { return mantissa_(random_) * std::exp(exponent_(random_)); }
  MatrixX matrix(Eigen::Index rows, Eigen::Index columns) {
    MatrixX m(rows, columns);
    for (double& x : m.reshaped()) x = next();
    return m;
  }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> mantissa_{-1.0, 1.0};
  std::uniform_real_distribution<double> exponent_{-30.0, 30.0};
};

// Sizes and values as bytes, so that even -0 and 0 differ.
class Bytes {
 public:
  void add(const std::string& text) {
    add_integer(text.size());
    bytes_ += text;
  }
  template <typename Integer>
  void add_integer(Integer value) {
    add_raw(&value, sizeof(value));
  }
  void add(double value) { add_raw(&value, sizeof(value)); }
  void add(const MatrixX& values) {
    add_integer(values.rows());
    add_integer(values.cols());
    for (const double x : values.reshaped()) add(x);
  }
  void add(const std::vector<std::size_t>& values) {
    add_integer(values.size());
    for (const std::size_t v : values) add_integer(v);
  }
  [[nodiscard]] const std::string& get() const { return bytes_; }

 private:
  void add_raw(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  std::string bytes_;
};

class FieldList {
 public:
  template <typename Value>
  void add(const std::string& name, const Value& value) {
    Bytes bytes;
    if constexpr (std::is_integral_v<Value>) {
      bytes.add_integer(value);
    } else {
      bytes.add(value);
    }
    fields_.emplace_back(name, bytes.get());
  }
  void add(const std::string& name, const std::vector<Matrix3>& matrices) {
    add(name + " size", matrices.size());
    for (const Matrix3& m : matrices) add(name, MatrixX(m));
  }
  [[nodiscard]] auto get() const { return fields_; }

 private:
  std::vector<std::pair<std::string, std::string>> fields_;
};

void add_lists(const ReducedBody& body, FieldList& fields) {
  fields.add("triangles size", body.triangles.size());
  for (const auto& t : body.triangles) {
    fields.add("triangle", std::vector<std::size_t>(t.begin(), t.end()));
  }
  fields.add("groups size", body.groups.size());
  for (const NodeGroup& group : body.groups) {
    fields.add("group name", group.name);
    fields.add("group dimension", group.dimension);
    fields.add("group tags", group.tags);
    fields.add("group weights", MatrixX(group.weights));
  }
  fields.add("interfaces size", body.interfaces.size());
  for (const InterfaceTable& table : body.interfaces) {
    fields.add("interface name", table.name);
    fields.add("interface p_B", MatrixX(table.p_B));
    fields.add("interface Phi_B", MatrixX(table.Phi_B));
    fields.add("interface Psi_B", MatrixX(table.Psi_B));
    fields.add("interface rotation_axes", MatrixX(table.rotation_axes));
    fields.add("interface node_count", table.node_count);
    fields.add("interface flexibility", MatrixX(table.flexibility));
  }
}

std::vector<std::size_t> to_sizes(const std::vector<int>& values) {
  return {values.begin(), values.end()};
}

void add_selection(const ReducedBody& body, FieldList& fields) {
  fields.add("selection", body.selection.has_value());
  if (!body.selection) return;
  fields.add("selection measure",
             std::string(to_string(body.selection->measure)));
  fields.add("selection threshold", body.selection->threshold);
  fields.add("selection candidates", body.selection->candidates);
  fields.add("selection modes", to_sizes(body.selection->modes));
  fields.add("selection cases", body.selection->cases.size());
  for (const SelectedCase& item : body.selection->cases) {
    fields.add("case name", item.name);
    fields.add("case modes", to_sizes(item.modes));
    fields.add("case reached", item.reached);
    fields.add("case eigenmode_error", item.eigenmode_error);
    fields.add("case basis_error", item.basis_error);
  }
}

void add_load_modes(const ReducedBody& body, FieldList& fields) {
  fields.add("load modes", body.load_modes.size());
  for (const LoadModesRecord& record : body.load_modes) {
    fields.add("forces name", record.name);
    fields.add("forces counts", to_sizes({record.directions, record.taken}));
    fields.add("forces is_whole", record.is_whole);
    fields.add("forces left_out", record.left_out);
  }
}

void add_field(const std::optional<ProjectedField>& field,
               const std::string& name, FieldList& fields) {
  fields.add(name, field.has_value());
  if (!field) return;
  fields.add(name + " eta", MatrixX(field->eta));
  fields.add(name + " rigid_share", field->rigid_fraction);
  fields.add(name + " missed_share", field->missed_fraction);
  fields.add(name + " key", field->key);
}

void add_contact_surfaces(const ReducedBody& body, FieldList& fields) {
  fields.add("contact surfaces", body.contact_surfaces.size());
  for (const ContactSurface& surface : body.contact_surfaces) {
    fields.add("contact name", surface.name);
    fields.add("contact tags", surface.tags);
    fields.add("contact x_B", MatrixX(surface.x_B));
    fields.add("contact Phi_B", surface.Phi_B);
    fields.add("contact residual", MatrixX(surface.residual));
    fields.add("contact patch_radius", MatrixX(surface.patch_radius));
    fields.add("contact faces", surface.faces.size());
    for (const auto& face : surface.faces) {
      fields.add("contact face", to_sizes({face.begin(), face.end()}));
    }
    for (const ContactSlice& slice : surface.slices) {
      fields.add("slice normals_B", MatrixX(slice.normals_B));
      fields.add("slice heights", MatrixX(slice.heights));
      fields.add("slice centre_B", MatrixX(slice.centre_B));
      fields.add("slice motion_B", slice.motion_B);
      fields.add("slice flexibility_B", MatrixX(slice.flexibility_B));
      fields.add("slice own_B", MatrixX(slice.own_B));
    }
    fields.add("contact youngs_modulus", surface.youngs_modulus);
    fields.add("contact poisson_ratio", surface.poisson_ratio);
  }
}

ContactSurface make_surface(const std::string& name, Eigen::Index nodes,
                            std::vector<std::array<int, 6>> faces,
                            Numbers& numbers) {
  ContactSurface surface;
  surface.name = name;
  surface.tags.assign(static_cast<std::size_t>(nodes), 13);
  surface.x_B = numbers.matrix(3, nodes);
  surface.Phi_B = numbers.matrix(3 * nodes, 2);
  surface.residual = numbers.matrix(nodes, 1);
  surface.patch_radius = numbers.matrix(nodes, 1);
  surface.faces = std::move(faces);
  surface.youngs_modulus = numbers.next();
  surface.poisson_ratio = numbers.next();
  return surface;
}

}  // namespace

ReducedBody make_small_body(unsigned seed) {
  Numbers numbers(seed);
  constexpr Eigen::Index m = 2;
  constexpr Eigen::Index n = 3;
  ReducedBody body;
  body.name = fmt::format("small body {}", seed);
  body.content_key = fmt::format("key {}", seed);
  body.clamped = seed % 2 == 1;
  body.mass = numbers.next();
  body.p_MoBcm_M = numbers.matrix(3, 1);
  body.size = numbers.matrix(3, 1);
  body.mesh_nodes = 1001 + seed;
  if (seed % 2 == 1) body.locking = MeshLocking{18.4 + seed, 12.3};
  body.mesh_elements = 1002 + seed;
  body.mesh_boundary_nodes = 1003 + seed;
  body.lambda = numbers.matrix(m, 1);
  body.integrals.S0 = numbers.matrix(3, 3);
  for (int k = 0; k < m; ++k) {
    body.integrals.S1.emplace_back(numbers.matrix(3, 3));
  }
  for (int kl = 0; kl < m * m; ++kl) {
    body.integrals.S2.emplace_back(numbers.matrix(3, 3));
  }
  body.integrals.P = numbers.matrix(3, m);
  body.levers = {numbers.next(), numbers.next(), numbers.next()};
  body.rows.tags = {7, 5, 11};
  body.rows.x_B = numbers.matrix(3, n);
  body.rows.Phi_B = numbers.matrix(3 * n, m);
  body.triangles = {{0, 1, 2}, {2, 1, 0}};
  body.groups.push_back({"root", 2, {7, 5}, numbers.matrix(2, 1)});
  body.groups.push_back({"tip", 0, {11}, numbers.matrix(1, 1)});
  InterfaceTable table;
  table.name = "flange";
  table.p_B = numbers.matrix(3, 1);
  table.Phi_B = numbers.matrix(3, m);
  table.Psi_B = numbers.matrix(3, m);
  table.rotation_axes = numbers.matrix(3, 2);
  table.node_count = 17;
  table.flexibility = numbers.matrix(6, 6);
  body.interfaces.push_back(table);
  body.selection = SelectionRecord{
      ModeMeasure::mass,
      numbers.next(),
      60,
      {0, 3, 9},
      {{"tip, force (1, 0, 0) N", {0, 9}, numbers.next(), numbers.next(), 0.5},
       {"nothing", {}, 1.0, 0.0, 0.0},
       {"file.txt from 0.1 s", {3}, 0.25, 0.125, numbers.next()}}};
  body.load_modes = {{"forces.txt", 30, true, 12, numbers.next()},
                     {"other.txt", 90, false, 3, 0.25}};
  body.initial.displacement =
      ProjectedField{numbers.matrix(m, 1), 0.25, numbers.next(), "a key"};
  if (seed % 2 == 0) {
    body.initial.velocity = body.initial.displacement;
    body.contact_surfaces = {
        make_surface("skin", 6, {{{0, 1, 2, 3, 4, 5}, {2, 1, 0, 4, 3, 5}}},
                     numbers),
        make_surface("tip", 3, {{{0, 1, 2, -1, -1, -1}}}, numbers)};
    body.contact_surfaces[1].slices = {{.normals_B = numbers.matrix(3, 2),
                                        .heights = numbers.matrix(2, 1),
                                        .centre_B = numbers.matrix(3, 1),
                                        .motion_B = numbers.matrix(6, m),
                                        .flexibility_B = numbers.matrix(3, 3),
                                        .own_B = numbers.matrix(3, 3)}};
  }
  return body;
}

std::vector<std::pair<std::string, std::string>> list_fields(
    const ReducedBody& body) {
  FieldList fields;
  fields.add("name", body.name);
  fields.add("clamped", body.clamped);
  fields.add("mass", body.mass);
  fields.add("p_MoBcm_M", MatrixX(body.p_MoBcm_M));
  fields.add("size", MatrixX(body.size));
  fields.add("S0", MatrixX(body.integrals.S0));
  fields.add("S1", body.integrals.S1);
  fields.add("S2", body.integrals.S2);
  fields.add("P", MatrixX(body.integrals.P));
  fields.add("levers",
             MatrixX(Vector3(body.levers.lumped, body.levers.consistent,
                             body.levers.displacement)));
  fields.add("lambda", MatrixX(body.lambda));
  fields.add("row tags", body.rows.tags);
  fields.add("x_B", MatrixX(body.rows.x_B));
  fields.add("Phi_B", MatrixX(body.rows.Phi_B));
  fields.add("mesh_nodes", body.mesh_nodes);
  fields.add("locking", body.locking.has_value());
  if (body.locking) {
    fields.add("locking frequency", body.locking->frequency);
    fields.add("locking refined", body.locking->refined_frequency);
  }
  fields.add("mesh_elements", body.mesh_elements);
  fields.add("mesh_boundary_nodes", body.mesh_boundary_nodes);
  fields.add("content_key", body.content_key);
  add_lists(body, fields);
  add_selection(body, fields);
  add_load_modes(body, fields);
  add_field(body.initial.displacement, "initial displacement", fields);
  add_field(body.initial.velocity, "initial velocity", fields);
  add_contact_surfaces(body, fields);
  return fields.get();
}

std::string find_difference(const ReducedBody& a, const ReducedBody& b) {
  const auto in_a = list_fields(a);
  const auto in_b = list_fields(b);
  const auto [at_a, at_b] =
      std::mismatch(in_a.begin(), in_a.end(), in_b.begin(), in_b.end());
  if (at_a != in_a.end()) return at_a->first;
  return at_b != in_b.end() ? at_b->first : "";
}

}  // namespace limber::flexbody::test
