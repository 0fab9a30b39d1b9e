// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/gltf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/escape_texts.hpp"
#include "limber/common/files/whole_file.hpp"
#include "limber/results/offset.hpp"
#include "limber/results/solids.hpp"
#include "limber/version.hpp"
#include "limber/view/home.hpp"

namespace limber::view {
namespace {

using nlohmann::json;

// Of the specification's enumerations.
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kVertices = 34962;
constexpr int kIndices = 34963;

constexpr std::array<std::array<double, 3>, 8> kColours = {
    {{0.08, 0.19, 0.39},
     {0.89, 0.27, 0.03},
     {0.10, 0.36, 0.08},
     {0.43, 0.20, 0.36},
     {0.18, 0.48, 0.45},
     {0.84, 0.58, 0.07},
     {0.76, 0.10, 0.10},
     {0.33, 0.18, 0.11}}};

using Singles = Eigen::MatrixXf;  // a column an element

class GltfWriter {
 public:
  GltfWriter(const Recording& recording, double magnification)
      : recording_(recording),
        magnification_(magnification),
        home_(find_home(recording)),
        times_(find_times(recording.times)) {
    // What its rounding leaves out, the bodies' own translations hold.
    home_.path = home_.path.cast<float>().cast<double>().eval();
    surfaces_.resize(recording.surfaces.size());
  }

  std::string write() {
    const double root2 = std::numbers::sqrt2 / 2.0;
    root_["asset"] = {{"version", "2.0"},
                      {"generator", std::string("Limber ") + LIMBER_VERSION}};
    root_["scene"] = 0;
    root_["scenes"] = {{{"nodes", {0}}}};
    // From z up to y up.
    root_["nodes"] = {{{"name", recording_.name},
                       {"rotation", {-root2, 0.0, 0.0, root2}},
                       {"extras", {{"start", recording_.times[0]}}}}};
    root_["animations"] = {{{"name", "motion"},
                            {"channels", json::array()},
                            {"samplers", json::array()}}};
    if (times_.size() > 1) {
      const Eigen::Map<const Singles> row(times_.data(), 1, std::ssize(times_));
      input_ = add_floats(row, "SCALAR", 0, true);
    }
    add_home();
    for (std::size_t b = 0; b < recording_.bodies.size(); ++b) add_body(b);
    add_fixed();
    if (root_["animations"][0]["channels"].empty()) root_.erase("animations");
    return join();
  }

 private:
  /// From the first; each later than the one before it.
  /// @throws InputError if they are too close together for single precision.
  static std::vector<float> find_times(const VectorX& times) {
    constexpr double kVisible = 1e-6;  // of the duration
    const VectorX since = times.array() - times[0];
    std::vector<float> singles;
    for (Eigen::Index i = 0; i < since.size(); ++i) {
      auto t = static_cast<float>(since[i]);
      if (i > 0) {
        t = std::max(t, std::nextafter(singles.back(),
                                       std::numeric_limits<float>::max()));
      }
      if (i > 0 && !(std::abs(t - since[i]) <= kVisible * since.tail<1>()[0])) {
        throw InputError(fmt::format(
            "output {} is at {:.9g} s: too many outputs lie closer together "
            "than single precision, in which glTF stores times; run the "
            "scenario with a larger output_interval",
            i + 1, times[i]));
      }
      singles.push_back(t);
    }
    return singles;
  }

  /// Nodes that hold what positions are relative to, where they do.
  void add_home() {
    if (!home_.offset.isZero(0.0)) {
      fixed_ = bodies_ = add_node(
          {{"name", "offset"}, {"translation", to_json(home_.offset)}}, fixed_);
    }
    if (!home_.travels) return;
    bodies_ = add_node({{"name", "common motion"},
                        {"translation", to_json(home_.path.row(0))}},
                       fixed_);
    add_translation(bodies_, home_.path);
  }

  static json to_json(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

  int add_view(const void* data, std::size_t bytes, int target) {
    json view = {
        {"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes}};
    if (target != 0) view["target"] = target;
    bytes_.append(static_cast<const char*>(data), bytes);
    return append("bufferViews", std::move(view));
  }

  int append(const char* list, json value) {
    root_[list].push_back(std::move(value));
    return static_cast<int>(root_[list].size()) - 1;
  }

  /// @param has_bounds as positions and times need them
  int add_floats(const Singles& columns, const char* type, int target,
                 bool has_bounds) {
    if (!columns.allFinite()) {
      throw InputError(
          "a value exceeds single precision (3.4e38), in which glTF stores it; "
          "take a smaller --magnification");
    }
    const auto count = static_cast<std::size_t>(columns.size());
    json accessor = {
        {"bufferView", add_view(columns.data(), 4 * count, target)},
        {"componentType", kFloat},
        {"count", columns.cols()},
        {"type", type}};
    if (has_bounds) {
      for (Eigen::Index c = 0; c < columns.rows(); ++c) {
        accessor["min"].push_back(columns.row(c).minCoeff());
        accessor["max"].push_back(columns.row(c).maxCoeff());
      }
    }
    return append("accessors", std::move(accessor));
  }

  int add_indices(const std::vector<std::uint32_t>& corners) {
    return append(
        "accessors",
        {{"bufferView", add_view(corners.data(), 4 * corners.size(), kIndices)},
         {"componentType", kUnsignedInt},
         {"count", corners.size()},
         {"type", "SCALAR"}});
  }

  int add_material(std::size_t b) {
    const auto& [r, g, blue] = kColours[b % kColours.size()];
    return append("materials", {{"pbrMetallicRoughness",
                                 {{"baseColorFactor", {r, g, blue, 1.0}},
                                  {"metallicFactor", 0.0},
                                  {"roughnessFactor", 0.7}}},
                                {"doubleSided", true}});
  }

  /// Geometry of a surface, shared by the bodies that have it.
  const json& get_surface(std::size_t s) {
    json& primitive = surfaces_[s];
    if (!primitive.is_null()) return primitive;
    const Surface& surface = recording_.surfaces[s];
    primitive["attributes"]["POSITION"] =
        add_floats(surface.x_B.cast<float>(), "VEC3", kVertices, true);
    primitive["indices"] =
        add_indices({surface.corners.begin(), surface.corners.end()});
    for (Eigen::Index k = 0; k < surface.Phi_B.cols(); ++k) {
      const Singles shape =
          surface.Phi_B.col(k).reshaped(3, surface.x_B.cols()).cast<float>();
      primitive["targets"].push_back(
          {{"POSITION", add_floats(shape, "VEC3", kVertices, true)}});
    }
    return primitive;
  }

  json make_primitive(const results::Solid& solid) {
    return {{"attributes",
             {{"POSITION",
               add_floats(solid.x.cast<float>(), "VEC3", kVertices, true)}}},
            {"indices", add_indices(solid.corners)}};
  }

  static results::Solid make_shape(const Shape& shape) {
    return results::place_solid(results::make_solid(shape.form, 1.0),
                                shape.X_BS);
  }

  json make_primitives(std::size_t b) {
    const Body& body = recording_.bodies[b];
    json primitives = json::array();
    if (body.surface >= 0) {
      primitives.push_back(get_surface(std::size_t(body.surface)));
    }
    for (const Shape& shape : recording_.shapes) {
      if (shape.body != static_cast<int>(b)) continue;
      primitives.push_back(make_primitive(make_shape(shape)));
    }
    if (primitives.empty()) {
      primitives.push_back(
          make_primitive(results::make_ellipsoid(body.mass, body.inertia)));
    }
    const int material = add_material(b);
    for (json& primitive : primitives) primitive["material"] = material;
    return primitives;
  }

  void add_channel(int node, const char* path, const Singles& values,
                   const char* type) {
    json& animation = root_["animations"][0];
    const int output = add_floats(values, type, 0, false);
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()},
         {"target", {{"node", node}, {"path", path}}}});
    animation["samplers"].push_back(
        {{"input", input_}, {"interpolation", "LINEAR"}, {"output", output}});
  }

  void add_body(std::size_t b) {
    const Body& body = recording_.bodies[b];
    const MatrixX eta = magnification_ * body.eta;
    const MatrixX q = find_rotations(body);
    json mesh = {{"name", body.name}, {"primitives", make_primitives(b)}};
    const bool has_modes = eta.cols() > 0;
    const auto [parent, p] = place_body(body);
    json node = {{"name", body.name},
                 {"translation", to_json(p.row(0))},
                 {"rotation", {q(0, 0), q(0, 1), q(0, 2), q(0, 3)}}};
    if (has_modes) {
      for (Eigen::Index k = 0; k < eta.cols(); ++k) {
        mesh["weights"].push_back(eta(0, k));
      }
    }
    node["mesh"] = append("meshes", std::move(mesh));
    const int index = add_node(std::move(node), parent);
    if (times_.size() < 2) return;
    add_translation(index, p);
    add_channel(index, "rotation", q.transpose().cast<float>(), "VEC4");
    if (!has_modes) return;
    // All weights of an output, one after the other.
    const Singles weights = eta.transpose().cast<float>();
    add_channel(index, "weights", weights.reshaped(1, weights.size()),
                "SCALAR");
  }

  void add_translation(int node, const MatrixX& p) {
    if (times_.size() < 2 || find_motion(p) == 0.0) return;
    add_channel(node, "translation", p.transpose().cast<float>(), "VEC3");
  }

  struct Placed {
    int parent;
    MatrixX p;  // T x 3, relative to it [m]
  };

  /// A body that single precision would move by more than a millionth of its
  /// own motion gets a parent that holds those places to single precision, and
  /// what they lack itself.
  Placed place_body(const Body& body) {
    constexpr double kVisible = 1e-6;
    const MatrixX p =
        (body.p_WB.rowwise() - home_.offset.transpose()) - home_.path;
    const MatrixX coarse = p.cast<float>().cast<double>();
    const MatrixX fine = p - coarse;
    const double motion = std::min(
        find_motion(p), results::estimate_radius(body.mass, body.inertia));
    const bool is_right = fine.cwiseAbs().maxCoeff() <= kVisible * motion;
    if (is_right || motion == 0.0) return {bodies_, p};
    const int parent = add_node({{"name", body.name + " (coarse)"},
                                 {"translation", to_json(coarse.row(0))}},
                                bodies_);
    add_translation(parent, coarse);
    return {parent, fine};
  }

  /// Largest distance from the start [m].
  static double find_motion(const MatrixX& p) {
    return (p.rowwise() - p.row(0)).rowwise().norm().maxCoeff();
  }

  /// x y z w, each in the hemisphere of the one before it.
  static MatrixX find_rotations(const Body& body) {
    MatrixX q(body.quat_WB.rows(), 4);
    for (Eigen::Index i = 0; i < q.rows(); ++i) {
      const Eigen::RowVector4d wxyz = body.quat_WB.row(i).normalized();
      q.row(i) << wxyz[1], wxyz[2], wxyz[3], wxyz[0];
      if (i > 0 && q.row(i).dot(q.row(i - 1)) < 0.0) q.row(i) *= -1.0;
    }
    return q;
  }

  int add_node(json node, int parent) {
    const int index = append("nodes", std::move(node));
    root_["nodes"][std::size_t(parent)]["children"].push_back(index);
    return index;
  }

  void add_fixed() {
    for (const Shape& shape : recording_.shapes) {
      if (shape.body >= 0) continue;
      // About its own place, which the node holds.
      json primitive =
          make_primitive(make_shape({shape.name,
                                     shape.body,
                                     shape.form,
                                     {shape.X_BS.R, Vector3::Zero()}}));
      primitive["material"] = add_material(kColours.size() - 1);
      json primitives = json::array();
      primitives.push_back(std::move(primitive));
      const int mesh =
          append("meshes", {{"name", shape.name}, {"primitives", primitives}});
      add_node({{"name", shape.name},
                {"mesh", mesh},
                {"translation", to_json(shape.X_BS.p - home_.offset)}},
               fixed_);
    }
  }

  static void add_word(std::string& bytes, std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    std::array<char, 4> raw{};
    std::memcpy(raw.data(), &word, 4);
    bytes.append(raw.data(), 4);
  }

  static void add_chunk(std::string& bytes, std::uint32_t type,
                        std::string content, char padding) {
    content.resize((content.size() + 3) / 4 * 4, padding);
    add_word(bytes, content.size());
    add_word(bytes, type);
    bytes += content;
  }

  std::string join() {
    root_["buffers"] = {{{"byteLength", (bytes_.size() + 3) / 4 * 4}}};
    // Sizes have 32 bits; the other half is more than enough for the text.
    constexpr std::size_t kMostBytes = std::size_t{1} << 31;
    if (bytes_.size() >= kMostBytes) {
      throw InputError(
          fmt::format("the scene has {:.3g} GiB of values; a .glb file has at "
                      "most 2: run the scenario with fewer outputs",
                      double(bytes_.size()) / double(1 << 30)));
    }
    std::string chunks;
    add_chunk(chunks, 0x4E4F534A, escape_texts(root_).dump(), ' ');
    add_chunk(chunks, 0x004E4942, bytes_, '\0');
    std::string file = "glTF";
    add_word(file, 2);
    add_word(file, 12 + chunks.size());
    return file + chunks;
  }

  const Recording& recording_;
  double magnification_;
  results::Home home_;
  std::vector<float> times_;
  int fixed_ = 0;   // node of what does not move
  int bodies_ = 0;  // node of all bodies
  std::vector<json> surfaces_;
  json root_;
  std::string bytes_;
  int input_ = -1;
};

}  // namespace

void write_gltf(const std::filesystem::path& file, const Recording& recording,
                double magnification) {
  write_whole(file, GltfWriter(recording, magnification).write());
}

}  // namespace limber::view
