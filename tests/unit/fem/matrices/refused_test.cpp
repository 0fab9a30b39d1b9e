// SPDX-License-Identifier: BSD-3-Clause
// Relatives of the samples, and what is refused, with its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "limber/common/errors.hpp"
#include "support/temporary_folder.hpp"
#include "unit/fem/matrices/sample_files.hpp"

namespace limber::fem::refused_test {
namespace {

using test::compare_entries;
using test::copy_sample;
using test::find_read_error;
using test::list_entries;
using test::read_sample;
using test::read_text;
using test::replace_text;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::SizeIs;
namespace fs = std::filesystem;

const std::vector<std::string>& all_samples() {
  static const std::vector<std::string> names = {
      "matrix_market",       "matrix_market_general",
      "matrix_market_array", "matrix_market_array_general",
      "dmig_large",          "dmig_square",
      "dmig_small",          "dmig_free",
      "op4_dense",           "op4_numbers",
      "op4_sparse",          "op4_bigmat",
      "abaqus_coordinate",   "abaqus_matrix_input",
      "abaqus_substructure", "ansys_harwell_boeing",
      "ansys_mmf",           "calculix_spider",
      "calculix_shell",      "calculix_beam"};
  return names;
}

std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void edit(const fs::path& file, const std::string& from,
          const std::string& to) {
  std::string text = read_text(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << file << " has no " << from;
  replace_text(file, text.replace(at, from.size(), to));
}

class Relatives : public ::testing::TestWithParam<std::string> {
 protected:
  void expect_same(const fs::path& folder) const {
    const MatrixModel model = read_matrices({{folder}});
    const MatrixModel reference = read_sample(GetParam());
    EXPECT_EQ(model.tags, reference.tags);
    EXPECT_EQ(model.x, reference.x);
    for (const auto part : {&MatrixModel::stiffness, &MatrixModel::mass})
      EXPECT_EQ(compare_entries(list_entries(model, model.*part),
                                list_entries(reference, reference.*part)),
                0.0);
  }
};

TEST_P(Relatives, WindowsLinesAndBlanksAtTheirEndsChangeNothing) {
  const fs::path folder = copy_sample(GetParam());
  for (const fs::path& file : files_of(folder)) {
    std::string text;
    for (const char c : read_text(file))
      text += c == '\n' ? " \r\n" : std::string(1, c);
    replace_text(file, text);
  }
  expect_same(folder);
}

TEST_P(Relatives, BlankLinesAtTheEndChangeNothing) {
  const fs::path folder = copy_sample(GetParam());
  for (const fs::path& file : files_of(folder))
    replace_text(file, read_text(file) + "\n \n\n");
  expect_same(folder);
}

TEST_P(Relatives, FilesThatEndEarlyAreAnErrorOrWhole) {
  const fs::path folder = copy_sample(GetParam());
  for (const fs::path& file : files_of(folder)) {
    const std::string whole = read_text(file);
    // Every line of small files, some of the others.
    const auto lines =
        static_cast<std::size_t>(std::count(whole.begin(), whole.end(), '\n'));
    const std::size_t step = std::max<std::size_t>(1, lines / 60);
    std::size_t line = 0;
    for (std::size_t end = 0; end < whole.size();
         end = whole.find('\n', end + 1)) {
      if (line++ % step != 0) continue;
      replace_text(file, whole.substr(0, end + 1));
      EXPECT_NO_THROW(static_cast<void>(find_read_error(folder)))
          << file << " line " << line;
    }
    replace_text(file, whole);
  }
}

TEST_P(Relatives, GarbageIsAnErrorOrIsRead) {
  std::mt19937 random(7);
  const auto draw = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const fs::path folder = copy_sample(GetParam());
  for (const fs::path& file : files_of(folder)) {
    const std::string whole = read_text(file);
    for (int i = 0; i < 40; ++i) {
      std::string text = whole;
      const std::string bytes = "0-9.,*$%\n eENaN\t=+99999999999";
      for (int k = 0; k < 4; ++k)
        text.replace(draw(text.size()), draw(6),
                     bytes.substr(draw(bytes.size()), draw(9)));
      replace_text(file, text);
      EXPECT_NO_THROW(static_cast<void>(find_read_error(folder))) << text;
    }
    replace_text(file, whole);
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, Relatives, ::testing::ValuesIn(all_samples()),
                         [](const auto& one) { return one.param; });

/// CalculiX's files belong together by their common name.
std::vector<std::string> samples_of_any_name() {
  std::vector<std::string> samples = all_samples();
  std::erase_if(samples, [](const std::string& one) {
    return one.starts_with("calculix");
  });
  return samples;
}

class ToldByContent : public Relatives {};

TEST_P(ToldByContent, KeepsItsMeaningUnderAnyNames) {
  const fs::path folder = copy_sample(GetParam());
  char name = 'a';
  for (const fs::path& file : files_of(folder))
    fs::rename(file, folder / (std::string(1, name++) +
                               (file.extension() == ".f06" ? ".f06" : "")));
  expect_same(folder);
}

INSTANTIATE_TEST_SUITE_P(Samples, ToldByContent,
                         ::testing::ValuesIn(samples_of_any_name()),
                         [](const auto& one) { return one.param; });

struct Fault {
  const char* name;
  const char* sample;
  const char* file;
  const char* from;
  const char* to;
  const char* error;  ///< behind the folder
};

class Faults : public ::testing::TestWithParam<Fault> {};

TEST_P(Faults, AreOneErrorWithTheirPlace) {
  const Fault& fault = GetParam();
  const fs::path folder = copy_sample(fault.sample);
  edit(folder / fault.file, fault.from, fault.to);
  const std::string error = find_read_error(folder);
  EXPECT_THAT(error, HasSubstr(fault.error));
  EXPECT_THAT(error, HasSubstr("xpected"));
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 0);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Faults,
    ::testing::Values(
        Fault{"NaN", "matrix_market", "K.mtx", "\n1 1 ", "\n1 1 nan ",
              "K.mtx:4: 'nan' is not a finite number"},
        Fault{"Infinity", "matrix_market", "K.mtx", "\n1 1 ", "\n1 1 -inf\n%",
              "K.mtx:4: '-inf' is not a finite number"},
        Fault{"BeyondDouble", "matrix_market", "K.mtx", "e+08", "e+508",
              "is not a finite number"},
        Fault{"RowOutOfRange", "matrix_market", "M.mtx", "\n2 1 ", "\n19 1 ",
              "M.mtx:5: '19' is not a row. Expected an integer from 1 to 18"},
        Fault{"AboveDiagonal", "matrix_market", "M.mtx", "\n2 1 ", "\n1 2 ",
              "M.mtx:5: entry (1, 2) is above the diagonal"},
        Fault{"Twice", "matrix_market", "K.mtx", "\n3 1 ", "\n2 1 ",
              "K.mtx:6: entry (2, 1) is given twice, first on line 5"},
        Fault{"TooFew", "matrix_market", "K.mtx", "18 18 1", "18 18 2",
              "the file ends here. Expected"},
        Fault{"TooMany", "matrix_market_array", "K.mtx", "18 18\n", "17 17\n",
              "more"},
        Fault{"Complex", "matrix_market", "K.mtx", "real", "complex",
              "K.mtx:1: '%%MatrixMarket matrix coordinate complex"},
        Fault{"Banner", "matrix_market", "K.mtx", "%%M", "%M",
              "K.mtx:1: '%MatrixMarket matrix' are not a row and a column"},
        Fault{"Huge", "matrix_market", "K.mtx", "18 18 ", "99999999999 18 ",
              "K.mtx:3: '99999999999' is not a number of rows"},
        Fault{"NotSymmetric", "matrix_market_general", "K.mtx", "\n1 2 ",
              "\n1 2 1", "Expected a symmetric matrix"},
        Fault{"OneMissing", "matrix_market_general", "K.mtx", "\n1 2 ",
              "\n1 18 ", "and its counterpart"},
        Fault{"NodeTwice", "matrix_market", "nodes.csv", "\n20,", "\n10,",
              "nodes.csv:4: node 10 is given twice, first on line 3"},
        Fault{"NodeMissing", "dmig_large", "beam.bdf", "GRID           7",
              "$GRID", "node 7 of row 7.1 has no coordinates"},
        Fault{"NodeNumber", "matrix_market", "nodes.csv", "\n20,", "\n2.5,",
              "nodes.csv:4: '2.5' is not a node"},
        Fault{"Components", "matrix_market", "nodes.csv", "123456", "132",
              "nodes.csv:3: '132' are not components"},
        Fault{"TooFewComponents", "matrix_market", "nodes.csv", "123456", "123",
              "K.mtx: it has 18 rows"},
        Fault{"RowTwice", "op4_dense", "rows.csv", "\n2,", "\n1,",
              "rows.csv:3: row 1 is given twice, first on line 2"},
        Fault{"RowMissing", "op4_dense", "rows.csv", "\n18,", "\n19,",
              "row 18, which is missing"},
        Fault{"LabelTwice", "op4_dense", "rows.csv", "10,2", "10,1",
              "rows 1 and 2 are both 10.1"},
        Fault{"BadComponent", "op4_dense", "rows.csv", "10,2", "10,9",
              "rows.csv:3: '2,10,9'"},
        Fault{"DmigForm", "dmig_large", "beam.pch", "       6       2",
              "       3       2", "beam.pch:2: form (IFO) '3' of KAAX"},
        Fault{"DmigComplex", "dmig_large", "beam.pch", "       6       2",
              "       6       3", "beam.pch:2: type (TIN) '3' of KAAX"},
        Fault{"DmigNoHead", "dmig_large", "beam.pch", "DMIG    KAAX",
              "$DMIG   KAAX", "a column of KAAX before its head"},
        Fault{"DmigTwice", "dmig_large", "beam.pch", "DMIG    MAAX           0",
              "DMIG    KAAX           0",
              "KAAX is given twice, first on line 2"},
        Fault{"DmigComponent", "dmig_large", "beam.pch", "10               1 ",
              "10               7 ", "'7' is not a component"},
        Fault{"DmigDisplacements", "dmig_large", "beam.bdf",
              "  0.5000  0.1000  0.0000", "  0.5000  0.1000  0.0000       3",
              "beam.bdf:6: GRID 20 has displacements in coordinate system 3"},
        Fault{"Op4Length", "op4_dense", "beam.op4", "       1       1      ",
              "       1       1     1", "values before this line"},
        Fault{"Op4Complex", "op4_dense", "beam.op4", "       6       2KGG",
              "       6       4KGG", "beam.op4:1: KGG is complex"},
        Fault{"Op4Run", "op4_bigmat", "beam.op4", "       1       0      ",
              "       1       0     9", "Expected its length and first row"},
        Fault{"SetSize", "op4_sparse", "beam.f06", "7-6", "", "as many"},
        Fault{"AbaqusNode", "abaqus_matrix_input", "beam_STIF1.mtx", "10,2,",
              "0,2,", "beam_STIF1.mtx:3: '0,2'"},
        Fault{"AbaqusTransform", "abaqus_matrix_input", "beam.inp", "*NSET",
              "*TRANSFORM, NSET=TIP\n1,0,0,0,1,0\n*NSET",
              "*TRANSFORM rotates the axes"},
        Fault{"AbaqusGenerated", "abaqus_matrix_input", "beam.inp", "*NSET",
              "*NGEN\n1,3\n*NSET", "*NGEN generates or moves nodes"},
        Fault{"SubstructureNodes", "abaqus_substructure", "beam.mtx", "** 7",
              "**", "2 nodes are listed and NODES=3"},
        Fault{"SubstructureRows", "abaqus_substructure", "beam.mtx",
              "*MATRIX,TYPE=MASS\n", "*MATRIX,TYPE=MASS\n1.0, 2.0\n",
              "Expected the lower triangle"},
        Fault{"BoeingType", "ansys_harwell_boeing", "beam_k.matrix", "RSA",
              "CSA", "beam_k.matrix:3: matrix type 'CSA'"},
        Fault{"BoeingPointer", "ansys_harwell_boeing", "beam_k.matrix",
              "\n             1\n", "\n             2\n",
              "beam_k.matrix:6: '2' is not a pointer to a column"},
        Fault{"AnsysAngles", "ansys_mmf", "nlist.lis", "    0.00    0.00",
              "   30.00    0.00", "node 7 has rotated axes"},
        Fault{"AnsysMap", "ansys_mmf", "map.txt", "3 1\n10\n", "2 1\n",
              "18 rows, and the map of nodes 2 blocks"},
        Fault{"ExpandedDof", "calculix_shell", "shell.dof", "1.2", "1;2",
              "shell.dof:2: '1;2'. Expected node.component"}),
    [](const auto& one) { return one.param.name; });

TEST(MatrixFiles, WhatIsMissingIsSaidWithWhatWasFound) {
  const fs::path folder = copy_sample("matrix_market");
  fs::remove(folder / "M.mtx");
  EXPECT_THAT(find_read_error(folder),
              AllOf(HasSubstr("no mass matrix. Found: K.mtx (Matrix Market, "
                              "18 rows)"),
                    HasSubstr("nodes.csv")));
  fs::remove(folder / "K.mtx");
  EXPECT_THAT(find_read_error(folder),
              HasSubstr("no stiffness and no mass matrix. Found: nodes.csv"));
  const fs::path other = copy_sample("matrix_market");
  fs::remove(other / "nodes.csv");
  EXPECT_THAT(find_read_error(other), HasSubstr("no nodes. Found: K.mtx"));
}

TEST(MatrixFiles, WhatIsThereTwiceIsRefused) {
  const fs::path folder = copy_sample("matrix_market");
  fs::copy(folder / "K.mtx", folder / "K_old.mtx");
  EXPECT_THAT(find_read_error(folder),
              HasSubstr("two stiffness matrices: K.mtx"));
  const fs::path other = copy_sample("abaqus_coordinate");
  fs::copy(test::sample_folder("matrix_market") / "nodes.csv",
           other / "nodes.csv");
  EXPECT_THAT(find_read_error(other), HasSubstr("nodes are in 2 files"));
}

TEST(MatrixFiles, NamesThatContradictTheEntriesAreRefused) {
  const fs::path folder = copy_sample("matrix_market");
  fs::rename(folder / "K.mtx", folder / "x");
  fs::rename(folder / "M.mtx", folder / "K.mtx");
  fs::rename(folder / "x", folder / "M.mtx");
  EXPECT_THAT(find_read_error(folder),
              HasSubstr("Expected them the other way round"));
}

TEST(MatrixFiles, OthersInAFolderArePassedOverAndListed) {
  const fs::path folder = copy_sample("op4_dense");
  replace_text(folder / "README.md", "# A model\n\n* from a run\n\n1. one\n");
  replace_text(folder / "run.log", "*INFO: done\n12:30 1 2 3\n");
  replace_text(folder / "errors",
               "error: node 13 of row 13.1 has no coordinates. Expected it "
               "among the nodes x, y and z.\n");
  replace_text(folder / "run.op2", std::string("\0\1\2", 3));
  replace_text(folder / "empty", "");
  fs::create_directory(folder / "deeper");
  EXPECT_THAT(read_matrices({{folder}}).found,
              Contains("not recognised, not used: README.md, empty, errors, "
                       "run.log, run.op2"));
  EXPECT_THROW(static_cast<void>(
                   read_matrices({{folder / "beam.op4", folder / "run.log"}})),
               InputError);
}

TEST(MatrixFiles, DigitsAreThoseOfNegativeNumbersToo) {
  // A sign takes the place of a digit in fields of one width.
  const fs::path folder = copy_sample("matrix_market");
  const auto digits_with = [&](const char* off_diagonal) {
    replace_text(folder / "K.mtx",
                 std::string("%%MatrixMarket matrix coordinate real symmetric\n"
                             "18 18 2\n1 1 1.234\n2 1 ") +
                     off_diagonal + "\n");
    return read_matrices({{folder}}).stiffness.digits;
  };
  EXPECT_EQ(digits_with("-1.23"), 3);
  EXPECT_EQ(digits_with("-1.234"), 4);
  EXPECT_EQ(digits_with("-1."), 4);
  EXPECT_EQ(digits_with("1"), 4);
}

TEST(MatrixFiles, FilesMayBeNamedOneByOne) {
  const fs::path folder = test::sample_folder("matrix_market");
  const MatrixModel model = read_matrices(
      {{folder / "nodes.csv", folder / "M.mtx", folder / "K.mtx"}});
  EXPECT_THAT(model.rows, SizeIs(18));
}

TEST(MatrixFiles, RowsAreThreeOrSixANodeWithoutATable) {
  const fs::path folder = copy_sample("op4_dense");
  fs::remove(folder / "rows.csv");
  const MatrixModel model = read_matrices({{folder}});
  EXPECT_EQ(model.rows[0].node, 0);  // tag 7: ascending
  EXPECT_THAT(model.found,
              Contains("rows: 6 a node, in the order of ascending numbers"));
}

TEST(MatrixFiles, RowsWithoutANodeAreOfUnknownKind) {
  const fs::path folder = copy_sample("abaqus_matrix_input");
  for (const char* name : {"beam_STIF1.mtx", "beam_MASS1.mtx"})
    replace_text(folder / name, read_text(folder / name) +
                                    "-3,1, -3,1, 1.000000000000000e+36"
                                    "\n");
  const MatrixModel model = read_matrices({{folder}});
  ASSERT_THAT(model.rows, SizeIs(19));
  EXPECT_EQ(model.rows[0].node, -1);
  EXPECT_EQ(model.rows[0].component, -1);
  EXPECT_EQ(model.stiffness.entries.coeff(0, 0), 1e36);
}

TEST(MatrixFiles, WorkbenchsNodesHaveDecimalCommas) {
  const fs::path folder = copy_sample("ansys_mmf");
  fs::remove(folder / "nlist.lis");
  replace_text(folder / "nodes.txt",
               "Knotennummer\tX-Position (m)\tY-Position (m)\tZ-Position "
               "(m)\t\n7\t1,\t0,\t2,e-001\t\n10\t0,\t0,\t0,\t\n"
               "20\t0,5\t1,e-001\t0,\t\n");
  EXPECT_EQ(read_matrices({{folder}}).x, read_sample("ansys_mmf").x);
}

}  // namespace
}  // namespace limber::fem::refused_test
