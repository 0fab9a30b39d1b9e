// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/xdmf.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <fstream>

#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/files/whole_file.hpp"
#include "limber/dynamics/equations/node_motion.hpp"

namespace limber::results {
namespace {

using dynamics::SystemModel;
using dynamics::SystemState;

// All surfaces as one mesh: the bodies' rows concatenated.
struct Surface {
  std::vector<std::size_t> bodies;    // indices of those with a mesh
  std::vector<std::int64_t> corners;  // three a triangle
  std::size_t nodes = 0;
};

Surface gather_surface(const SystemModel& model) {
  Surface surface;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const auto& reduced = model.bodies[b].reduced;
    if (!reduced || reduced->triangles.empty()) continue;
    surface.bodies.push_back(b);
    for (const auto& triangle : reduced->triangles) {
      for (const std::size_t corner : triangle) {
        surface.corners.push_back(
            static_cast<std::int64_t>(surface.nodes + corner));
      }
    }
    surface.nodes += reduced->rows.tags.size();
  }
  return surface;
}

struct Fields {
  std::vector<double> points;        // 3 a node [m]
  std::vector<double> deformation;   // 1 a node [m]
  std::vector<double> displacement;  // 3 a node, from the start [m]
  std::vector<double> bending;       // 3 a node, R Phi eta [m]
};

void append(const MatrixX& nodes, std::vector<double>& values) {
  values.insert(values.end(), nodes.data(), nodes.data() + nodes.size());
}

/// @param start positions of each surface's nodes at the start
Fields move_surface(const SystemModel& model, const Surface& surface,
                    const SystemState& state,
                    const std::vector<MatrixX>& start) {
  Fields fields;
  for (std::size_t i = 0; i < surface.bodies.size(); ++i) {
    const std::size_t b = surface.bodies[i];
    const auto body = static_cast<dynamics::BodyIndex>(b);
    const Eigen::Index n = model.bodies[b].reduced->rows.x_B.cols();
    MatrixX nodes(3 * n, 1);
    calc_node_deformations(model, body, {&state, 1}, nodes);
    const VectorX sizes = nodes.reshaped(3, n).colwise().norm().transpose();
    fields.deformation.insert(fields.deformation.end(), sizes.begin(),
                              sizes.end());
    const Matrix3 R_WB = state.bodies[b].quat_WB.toRotationMatrix();
    append(R_WB * nodes.reshaped(3, n), fields.bending);
    calc_node_positions(model, body, {&state, 1}, nodes);
    append(nodes, fields.points);
    append(nodes - start[i], fields.displacement);
  }
  return fields;
}

std::vector<MatrixX> find_start(const SystemModel& model,
                                const Surface& surface,
                                const History& history) {
  std::vector<MatrixX> all;
  if (history.states.empty()) return all;
  for (const std::size_t b : surface.bodies) {
    MatrixX nodes(3 * model.bodies[b].reduced->rows.x_B.cols(), 1);
    calc_node_positions(model, static_cast<dynamics::BodyIndex>(b),
                        {history.states.data(), 1}, nodes);
    all.push_back(std::move(nodes));
  }
  return all;
}

// A file's name as XML text.
std::string escape(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c == '&') {
      text += "&amp;";
    } else if (c == '<') {
      text += "&lt;";
    } else if (c == '>') {
      text += "&gt;";
    } else {
      text += c;
    }
  }
  return text;
}

void write_item(std::ostream& out, const char* number, const std::string& shape,
                const std::string& place) {
  fmt::print(out,
             "<DataItem Dimensions=\"{}\" NumberType=\"{}\" "
             "Precision=\"8\" Format=\"HDF\">{}</DataItem>\n",
             shape, number, place);
}

std::string name_step(std::size_t i) { return fmt::format("steps/{:06}/", i); }

void write_motion(const std::filesystem::path& file, const SystemModel& model,
                  const Surface& surface, const History& history) {
  Hdf5File out = Hdf5File::create(file);
  out.write_array("triangles", surface.corners, {surface.corners.size() / 3, 3},
                  "1", "node indices");
  const std::vector<MatrixX> start = find_start(model, surface, history);
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    const Fields fields =
        move_surface(model, surface, history.states[i], start);
    out.write_array(name_step(i) + "points", fields.points, {surface.nodes, 3},
                    "m", "positions, world frame");
    out.write_array(name_step(i) + "deformation", fields.deformation,
                    {surface.nodes}, "m", "|Phi eta|");
    out.write_array(name_step(i) + "deformation_vector", fields.bending,
                    {surface.nodes, 3}, "m", "Phi eta, world frame");
    out.write_array(name_step(i) + "displacement", fields.displacement,
                    {surface.nodes, 3}, "m", "from the start, world frame");
  }
  out.close();
}

void write_step(std::ostream& out, const Surface& surface, double time,
                const std::string& data, const std::string& step) {
  const std::size_t triangles = surface.corners.size() / 3;
  fmt::print(out,
             "<Grid Name=\"bodies\" GridType=\"Uniform\">"
             "<Time Value=\"{:.17g}\"/>\n<Topology "
             "TopologyType=\"Triangle\" NumberOfElements=\"{}\">\n",
             time, triangles);
  write_item(out, "Int", fmt::format("{} 3", triangles), data + ":/triangles");
  out << "</Topology><Geometry GeometryType=\"XYZ\">\n";
  write_item(out, "Float", fmt::format("{} 3", surface.nodes),
             fmt::format("{}:/{}points", data, step));
  out << "</Geometry><Attribute Name=\"deformation\" "
         "AttributeType=\"Scalar\" Center=\"Node\">\n";
  write_item(out, "Float", fmt::format("{}", surface.nodes),
             fmt::format("{}:/{}deformation", data, step));
  out << "</Attribute>";
  for (const char* name : {"deformation_vector", "displacement"}) {
    fmt::print(out,
               "<Attribute Name=\"{}\" AttributeType=\"Vector\" "
               "Center=\"Node\">\n",
               name);
    write_item(out, "Float", fmt::format("{} 3", surface.nodes),
               fmt::format("{}:/{}{}", data, step, name));
    out << "</Attribute>";
  }
  out << "</Grid>\n";
}

void write_index(std::ostream& out, const Surface& surface,
                 const History& history, const std::string& data) {
  out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n"
         "<Grid Name=\"bodies\" GridType=\"Collection\" "
         "CollectionType=\"Temporal\">\n";
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    write_step(out, surface, history.times[i], data, name_step(i));
  }
  out << "</Grid></Domain></Xdmf>\n";
}

}  // namespace

void write_xdmf(const std::filesystem::path& file, const SystemModel& model,
                const History& history) {
  const Surface surface = gather_surface(model);
  if (surface.bodies.empty()) {
    throw InputError(fmt::format(
        "'{}': no body of this system has a mesh to show", file.string()));
  }
  std::filesystem::path data = file;
  data.replace_extension(".h5");
  write_whole(data, [&](const std::filesystem::path& part) {
    write_motion(part, model, surface, history);
  });
  write_whole(file, [&](const std::filesystem::path& part) {
    std::ofstream out(part);
    write_index(out, surface, history, escape(data.filename().string()));
    out.flush();
    if (out) return;
    throw InputError(fmt::format("'{}' cannot be written; is the disk full?",
                                 file.string()));
  });
}

}  // namespace limber::results
