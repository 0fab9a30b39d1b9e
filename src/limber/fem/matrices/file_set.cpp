// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/file_set.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/fem/matrices/abaqus_matrix.hpp"
#include "limber/fem/matrices/ansys_archive.hpp"
#include "limber/fem/matrices/coordinate_text.hpp"
#include "limber/fem/matrices/dmig.hpp"
#include "limber/fem/matrices/file_kind.hpp"
#include "limber/fem/matrices/harwell_boeing.hpp"
#include "limber/fem/matrices/matrix_market.hpp"
#include "limber/fem/matrices/nastran_points.hpp"
#include "limber/fem/matrices/node_table.hpp"
#include "limber/fem/matrices/op4.hpp"

namespace limber::fem {
namespace {

using Path = std::filesystem::path;

/// Rows of a table whose nodes have components.
Eigen::Index count_components(const ModelFile& model) {
  Eigen::Index count = 0;
  for (const long digits : model.components)
    if (digits > 0) count += std::ssize(std::to_string(digits));
  return count;
}

class FileSetReader {
 public:
  FileSet read(const std::vector<Path>& paths,
               const std::vector<Path>& recovery) {
    std::vector<std::string> names;
    for (const Path& path : paths) {
      names.push_back(path.string());
      std::error_code error;
      if (std::filesystem::is_directory(path, error)) {
        add_folder(path);
      } else {
        add_file(path);
      }
    }
    set_.source = fmt::format("{}", fmt::join(names, ", "));
    for (const Path& file : recovery) add_recovery_file(file);
    read_matrix_files();
    set_.is_calculix = files_.contains(ModelFileKind::dof_lines);
    read_row_files();
    take_recovery_rows();
    take_points();
    read_node_files();
    if (!passed_over_.empty())
      set_.found.push_back(fmt::format("not recognised, not used: {}",
                                       fmt::join(passed_over_, ", ")));
    return std::move(set_);
  }

 private:
  void add_folder(const Path& folder) {
    std::vector<Path> entries;
    std::error_code error;
    for (std::filesystem::directory_iterator it(folder, error), end;
         !error && it != end; it.increment(error))
      if (it->is_regular_file(error)) entries.push_back(it->path());
    if (error)
      throw InputError(fmt::format("{}: cannot read this folder: {}",
                                   folder.string(), error.message()));
    std::sort(entries.begin(), entries.end());
    for (const Path& entry : entries) {
      const ModelFileKind kind = recognise_file(entry);
      if (kind == ModelFileKind::unknown || kind == ModelFileKind::binary) {
        passed_over_.push_back(entry.filename().string());
      } else {
        files_[kind].push_back(entry);
      }
    }
  }

  void add_file(const Path& file) {
    const ModelFileKind kind = recognise_file(file);
    if (kind == ModelFileKind::unknown || kind == ModelFileKind::binary)
      throw InputError(fmt::format(
          "{}:1: {}. Expected a matrix (Matrix Market, DMIG, OP4 in ASCII, "
          "Harwell-Boeing, coordinates, Abaqus matrix input or substructure), "
          "a table of rows or nodes, or a model (Nastran, Abaqus, CalculiX, "
          "Ansys).",
          file.string(), name_of(kind)));
    files_[kind].push_back(file);
  }

  void add_recovery_file(const Path& file) {
    const ModelFileKind kind = recognise_file(file);
    switch (kind) {
      case ModelFileKind::matrix_market:
        set_.matrices.push_back(read_matrix_market(file, true));
        return;
      case ModelFileKind::op4:
        for (SourceMatrix& source : read_op4(file, true))
          set_.matrices.push_back(std::move(source));
        return;
      case ModelFileKind::node_table:
        set_points(file);
        return;
      case ModelFileKind::row_table:
        set_recovery_rows(read_row_table(file));
        return;
      default:
        throw InputError(fmt::format(
            "{}:1: {}. Expected recovery rows: a matrix (Matrix Market, OP4 in "
            "ASCII), a table of their points or of their rows.",
            file.string(), name_of(kind)));
    }
  }

  void set_points(const Path& file) {
    if (set_.points)
      throw InputError(
          fmt::format("{}: the points of the recovery rows are also in {}. "
                      "Expected one table.",
                      file.string(), set_.points->file.string()));
    set_.points = read_node_table(file);
    note(file, fmt::format("points of the recovery rows, {} points",
                           set_.points->tags.size()));
  }

  void set_recovery_rows(RowTable table) {
    if (set_.recovery_rows)
      throw InputError(
          fmt::format("{}: the rows of the recovery matrix are also in {}. "
                      "Expected one table.",
                      table.file.string(), set_.recovery_rows->file.string()));
    note(table.file, fmt::format("what the recovery rows are, {} rows",
                                 table.labels.size()));
    set_.recovery_rows = std::move(table);
  }

  /// Of tables of rows beside the model's that of the recovery matrix.
  void take_recovery_rows() {
    const SourceMatrix* const recovery = find_recovery(set_);
    if (recovery == nullptr || set_.recovery_rows) return;
    const auto size = [](const RowTable& t) {
      return static_cast<Eigen::Index>(t.labels.size());
    };
    const auto& entries = recovery->matrix.entries;
    if (entries.rows() == entries.cols()) return;
    const auto fits = [&](const RowTable& t) {
      return size(t) == entries.rows();
    };
    const auto found =
        std::find_if(set_.row_tables.begin(), set_.row_tables.end(), fits);
    if (found == set_.row_tables.end()) return;
    set_recovery_rows(std::move(*found));
    set_.row_tables.erase(found);
  }

  /// Of two tables of nodes that which fits the recovery matrix.
  void take_points() {
    const SourceMatrix* const recovery = find_recovery(set_);
    std::vector<Path>& tables = files_[ModelFileKind::node_table];
    if (recovery == nullptr || set_.points || tables.size() < 2) return;
    const Eigen::Index rows = recovery->matrix.entries.rows();
    const auto fits = [&](const Path& file) {
      const ModelFile points = read_node_table(file);
      const auto count = static_cast<Eigen::Index>(points.tags.size());
      return 3 * count == rows || 6 * count == rows ||
             count_components(points) == rows;
    };
    std::vector<Path> fitting;
    std::copy_if(tables.begin(), tables.end(), std::back_inserter(fitting),
                 fits);
    if (fitting.size() != 1) return;
    std::erase(tables, fitting.front());
    set_points(fitting.front());
  }

  void add(SourceMatrix source, const Path& file) {
    if (source.role == MatrixRole::unknown)
      source.role = guess_role(file.filename().string());
    set_.matrices.push_back(std::move(source));
  }

  void read_matrix_files() {
    using One = SourceMatrix (*)(const Path&);
    using Many = std::vector<SourceMatrix> (*)(const Path&);
    constexpr std::array<std::pair<ModelFileKind, One>, 4> kOne = {{
        {ModelFileKind::matrix_market,
         [](const Path& file) {
           const bool is_moment = find_second_moment(file) >= 0;
           SourceMatrix source = read_matrix_market(file, is_moment);
           if (is_moment) {
             source.role = MatrixRole::moment;
             source.name = file.stem().string();
           }
           return source;
         }},
        {ModelFileKind::coordinates, read_coordinate_text},
        {ModelFileKind::matrix_input, read_matrix_input},
        {ModelFileKind::harwell_boeing, read_harwell_boeing},
    }};
    constexpr std::array<std::pair<ModelFileKind, Many>, 3> kMany = {{
        {ModelFileKind::substructure, read_substructure},
        {ModelFileKind::op4, [](const Path& file) { return read_op4(file); }},
        {ModelFileKind::nastran, read_dmig},
    }};
    for (const auto& [kind, read_one] : kOne)
      for (const Path& file : files_[kind]) add(read_one(file), file);
    for (const auto& [kind, read_many] : kMany)
      for (const Path& file : files_[kind])
        for (SourceMatrix& source : read_many(file))
          add(std::move(source), file);
  }

  void read_row_files() {
    for (const Path& file : files_[ModelFileKind::dof_lines])
      set_.row_tables.push_back(read_dof_lines(file));
    for (const Path& file : files_[ModelFileKind::row_table])
      set_.row_tables.push_back(read_row_table(file));
    for (const Path& file : files_[ModelFileKind::set_print])
      for (RowTable& table : read_set_print(file))
        set_.row_tables.push_back(std::move(table));
    if (const Path* const file = find_single(ModelFileKind::node_map)) {
      set_.node_map = read_node_map(*file);
      note(*file, fmt::format("node of each block of rows, {} blocks",
                              set_.node_map.size()));
    }
    for (const RowTable& table : set_.row_tables)
      note(table.file,
           fmt::format("{}, {} rows", table.format, table.labels.size()));
  }

  /// The file of a kind, null if there is none. Of several that beside the
  /// matrices, whose name has the same beginning.
  const Path* find_single(ModelFileKind kind) {
    const std::vector<Path>& all = files_[kind];
    if (all.empty()) return nullptr;
    if (all.size() == 1) return all.data();
    std::set<std::string> stems;
    for (const SourceMatrix& source : set_.matrices)
      stems.insert(Path(source.matrix.file).stem().string());
    std::vector<const Path*> beside;
    for (const Path& file : all)
      if (stems.contains(file.stem().string())) beside.push_back(&file);
    if (beside.size() == 1) return beside[0];
    std::vector<std::string> names;
    for (const Path& file : all) names.push_back(file.string());
    throw InputError(fmt::format(
        "{}: {} files of one kind ({}). Expected one: "
        "{}.",
        set_.source, all.size(), name_of(kind), fmt::join(names, ", ")));
  }

  void read_node_files() {
    std::vector<ModelFile> models;
    if (const Path* const file = find_single(ModelFileKind::node_table))
      models.push_back(read_node_table(*file));
    if (const Path* const file = find_single(ModelFileKind::ansys_archive))
      models.push_back(read_ansys_archive(*file));
    if (const Path* const file = find_single(ModelFileKind::input_deck)) {
      set_.deck = read_input_deck(*file);
      expand();
      models.push_back(set_.deck->model);
    }
    std::optional<ModelFile> nastran = read_nastran_files();
    if (nastran) models.push_back(std::move(*nastran));
    std::erase_if(models, [](const ModelFile& m) { return m.tags.empty(); });
    if (models.size() > 1) {
      std::vector<std::string> names;
      for (const ModelFile& model : models)
        names.push_back(
            fmt::format("{} ({})", model.file.string(), model.format));
      throw InputError(
          fmt::format("{}: nodes are in {} files. Expected one: "
                      "{}.",
                      set_.source, models.size(), fmt::join(names, ", ")));
    }
    if (models.empty()) return;
    set_.nodes = std::move(models[0]);
    note(set_.nodes->file,
         fmt::format("nodes, {}, {} nodes", set_.nodes->format,
                     set_.nodes->tags.size()));
  }

  /// Points may be spread over files, if they agree.
  std::optional<ModelFile> read_nastran_files() {
    std::optional<ModelFile> all;
    std::unordered_map<long, Vector3> known;
    for (const Path& file : files_[ModelFileKind::nastran]) {
      ModelFile model = read_nastran_points(file);
      if (model.tags.empty()) continue;
      if (!all) {
        for (std::size_t i = 0; i < model.tags.size(); ++i)
          known[model.tags[i]] = model.x[i];
        all = std::move(model);
        continue;
      }
      for (std::size_t i = 0; i < model.tags.size(); ++i) {
        const auto [place, is_new] =
            known.try_emplace(model.tags[i], model.x[i]);
        if (is_new) {
          all->tags.push_back(model.tags[i]);
          all->x.push_back(model.x[i]);
        } else if (place->second != model.x[i]) {
          throw InputError(
              fmt::format("{}: GRID {} has another position than in {}. "
                          "Expected one position.",
                          file.string(), model.tags[i], all->file.string()));
        }
      }
      all->elements.insert(all->elements.end(), model.elements.begin(),
                           model.elements.end());
    }
    return all;
  }

  /// Shells and beams that CalculiX expanded.
  void expand() {
    if (!set_.is_calculix || set_.row_tables.size() != 1) return;
    std::vector<RowLabel>& rows = set_.row_tables[0].labels;
    const Path* const topology = find_single(ModelFileKind::expansion);
    set_.is_expanded = topology != nullptr;
    if (set_.is_expanded) {
      const std::vector<ExpandedElement> elements = read_expansion(*topology);
      const ModelFile solid = read_solid_nodes();
      expand_nodes(elements, solid, *set_.deck, rows);
      note(*topology, fmt::format("{} shells or beams, expanded to solids",
                                  elements.size()));
    }
    name_rotations(*set_.deck, rows);
  }

  ModelFile read_solid_nodes() {
    std::vector<ModelFile> all;
    for (const Path& file : files_[ModelFileKind::frd]) {
      ModelFile model = read_frd(file);
      if (!model.tags.empty()) all.push_back(std::move(model));
    }
    if (all.size() != 1)
      throw InputError(fmt::format(
          "{}: {} result files (.frd) have nodes. Expected one, of a run of "
          "this model with *NODE FILE, OUTPUT=3D, for the solids that shells "
          "and beams were expanded to: a run that stores matrices writes none.",
          set_.source, all.size()));
    note(all[0].file, fmt::format("positions of expanded nodes, {} nodes",
                                  all[0].tags.size()));
    return std::move(all[0]);
  }

  void note(const Path& file, const std::string& what) {
    set_.found.push_back(fmt::format("{}: {}", file.filename().string(), what));
  }

  FileSet set_;
  std::map<ModelFileKind, std::vector<Path>> files_;
  std::vector<std::string> passed_over_;
};

}  // namespace

SourceMatrix* find_recovery(FileSet& set) {
  return find_role(set, MatrixRole::recovery, "recovery");
}

SourceMatrix* find_role(FileSet& set, MatrixRole role, const char* name) {
  SourceMatrix* found = nullptr;
  for (SourceMatrix& source : set.matrices) {
    if (source.role != role) continue;
    if (found != nullptr)
      throw InputError(fmt::format(
          "{}: two {} matrices: {} and {}. Expected "
          "one; give the files to be read.",
          set.source, name, describe_matrix(*found), describe_matrix(source)));
    found = &source;
  }
  return found;
}

FileSet read_file_set(const std::vector<std::filesystem::path>& paths,
                      const std::vector<std::filesystem::path>& recovery) {
  return FileSetReader().read(paths, recovery);
}

}  // namespace limber::fem
