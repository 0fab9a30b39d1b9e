// SPDX-License-Identifier: BSD-3-Clause
// Decks of solids beside beams, shells and rigid parts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/fem/structural/assemble_structure.hpp"
#include "limber/fem/structural/read_structure.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::mixed_structure_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::write_file;

AssembledStructure read(const std::string& name, const std::string& text,
                        double unit = 1.0) {
  const auto file = write_file(name, text);
  EXPECT_TRUE(is_structure(file)) << text;
  const Structure structure = read_structure(file);
  return assemble_structure(structure, read_structure_solids(structure, unit));
}

std::string find_error(const std::string& name, const std::string& text) {
  try {
    static_cast<void>(read(name, text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

/// A block of 2 x 1 x 1 with a beam of 1 from the middle of its end.
const std::string kBlock =
    "$ block and beam\nGRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,1.,0.\n"
    "GRID,4,,0.,1.,0.\nGRID,5,,0.,0.,1.\nGRID,6,,2.,0.,1.\nGRID,7,,2.,1.,1.\n"
    "GRID,8,,0.,1.,1.\nGRID,11,,2.,.5,.5\nGRID,12,,3.,.5,.5\n"
    "CHEXA,1,1,1,2,3,4,5,6\n,7,8\nPSOLID,1,1\nMAT1,1,7.E+10,,.3,2700.\n"
    "PBARL,2,1,,BAR\n,.1,.2\nCBAR,2,2,11,12,0.,1.,0.\n";
const std::string kSpider = "RBE2,3,11,123,2,3,6,7\n";

/// Of the rows, for a translation u and a rotation theta about the origin.
VectorX move_rigidly(const MatrixModel& model, const Vector3& u,
                     const Vector3& theta) {
  VectorX q(std::ssize(model.rows));
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const MatrixRow& row = model.rows[static_cast<std::size_t>(i)];
    const Vector3 x = model.x.col(row.node);
    q[i] = row.component < 3 ? (u + theta.cross(x))[row.component]
                             : theta[row.component - 3];
  }
  return q;
}

const Vector3 kMove(0.3, -0.7, 0.5);
const Vector3 kTurn(-0.2, 0.9, 0.4);

TEST(MixedStructure, HasItsMassAndNoStiffnessInRigidMotion) {
  for (const char* more :
       {"RBE2,3,11,123,2,3,6,7\n", "RBE2,3,11,123456,2,3,6,7\n",
        "RBE3,3,,11,123456,1.,123,2\n,3,6,7\n"}) {
    const AssembledStructure made =
        read("block.bdf", kBlock + more + "CONM2,4,11,,50.,.1,.2,.3\n");
    const double mass = 2700.0 * (2.0 + 0.1 * 0.2) + 50.0;
    EXPECT_NEAR(made.mass, mass, 1e-11 * mass);
    const MatrixModel& model = made.model;
    const VectorX q = move_rigidly(model, kMove, kTurn);
    const auto& K = model.stiffness.entries;
    EXPECT_LT((K * q).cwiseAbs().maxCoeff(), 1e-12 * K.coeffs().maxCoeff())
        << more;
    // m u^2 in a translation
    const VectorX shift = move_rigidly(model, kMove, Vector3::Zero());
    EXPECT_NEAR(shift.dot(model.mass.entries * shift),
                mass * kMove.squaredNorm(), 1e-11 * mass);
    // The led nodes move as all others do.
    const VectorX led = model.equations * q;
    for (std::size_t i = 0; i < model.condensed.size(); ++i) {
      const MatrixRow& row = model.condensed[i];
      const Vector3 u = kMove + kTurn.cross(Vector3(model.x.col(row.node)));
      EXPECT_NEAR(
          led[static_cast<Eigen::Index>(i)],
          row.component < 3 ? u[row.component] : kTurn[row.component - 3],
          1e-13);
    }
  }
}

TEST(MixedStructure, HasThreeRowsForNodesOfSolidsAlone) {
  const MatrixModel model = read("block.bdf", kBlock + kSpider).model;
  // Four nodes of the block's foot, and two of the beam; its end is led.
  EXPECT_EQ(model.rows.size(), 4U * 3U + 2U * 6U);
  const MatrixModel free =
      read("free.bdf", kBlock + "RBE3,3,,11,123456,1.,123,2\n,3,6,7\n").model;
  EXPECT_EQ(free.rows.size(), 8U * 3U + 6U);
}

/// In a unit of mm all is the same: K in N/mm, mass in t.
TEST(MixedStructure, ConvertsUnits) {
  const MatrixModel metres = read("m.bdf", kBlock + kSpider).model;
  std::string text = kBlock + kSpider;
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"2.,0.,0.\n", "2.+3,0.,0.\n"},
      {"2.,1.,0.\n", "2.+3,1.+3,0.\n"},
      {"0.,1.,0.\nGRID,5", "0.,1.+3,0.\nGRID,5"},
      {"0.,0.,1.\n", "0.,0.,1.+3\n"},
      {"2.,0.,1.\n", "2.+3,0.,1.+3\n"},
      {"2.,1.,1.\n", "2.+3,1.+3,1.+3\n"},
      {"0.,1.,1.\n", "0.,1.+3,1.+3\n"},
      {"2.,.5,.5\n", "2.+3,5.+2,5.+2\n"},
      {"3.,.5,.5\n", "3.+3,5.+2,5.+2\n"},
      {"7.E+10", "7.E+4"},
      {"2700.", "2.7E-9"},
      {",.1,.2\n", ",1.+2,2.+2\n"}};
  for (const auto& [from, to] : changes)
    text.replace(text.find(from), from.size(), to);
  const MatrixModel other = read("mm.bdf", text, 1e-3).model;
  ASSERT_EQ(other.rows.size(), metres.rows.size());
  for (Eigen::Index i = 0; i < std::ssize(metres.rows); ++i) {
    const bool turns = metres.rows[static_cast<std::size_t>(i)].component > 2;
    const double k =
        metres.stiffness.entries.coeff(i, i) * (turns ? 1e3 : 1e-3);
    EXPECT_NEAR(other.stiffness.entries.coeff(i, i), k, 1e-9 * k);
    const double m = metres.mass.entries.coeff(i, i) * (turns ? 1e3 : 1e-3);
    EXPECT_NEAR(other.mass.entries.coeff(i, i), m, 1e-9 * m);
  }
}

/// Weights 1, 1, 1, 3: the displacement of a node has its fraction, and turns.
TEST(MixedStructure, AMeanMovesByTheWeightsOfItsNodes) {
  const MatrixModel model =
      read("mean.bdf", kBlock + "RBE3,3,,11,123456,1.,123,2\n,3,6,3.,123,7\n")
          .model;
  const auto row_of = [&](std::size_t tag, int component) {
    const auto row = std::ranges::find_if(model.rows, [&](const MatrixRow& r) {
      return model.tags[static_cast<std::size_t>(r.node)] == tag &&
             r.component == component;
    });
    return row - model.rows.begin();
  };
  VectorX q = VectorX::Zero(std::ssize(model.rows));
  q[row_of(7, 0)] = 1.0;
  // Corners at y, z of -1/2 or 1/2; centre by weights at (1, 1)/6. J about it,
  // and the moment of u_x = 1 at (1, 1)/3 from it.
  Matrix3 J = Matrix3::Zero();
  for (const auto& [y, z, w] : {std::array{-0.5, -0.5, 1.0},
                                {0.5, -0.5, 1.0},
                                {-0.5, 0.5, 1.0},
                                {0.5, 0.5, 3.0}}) {
    const Matrix3 r = skew(Vector3(0.0, y - 1.0 / 6.0, z - 1.0 / 6.0));
    J -= w * r * r;
  }
  const Vector3 theta =
      J.inverse() *
      Vector3(3.0 * Vector3(0, 1, 1).cross(Vector3(1, 0, 0)) / 3.0);
  const Vector3 u =
      Vector3(0.5, 0.0, 0.0) + theta.cross(Vector3(0.0, -1.0, -1.0) / 6.0);
  const VectorX led = model.equations * q;
  for (std::size_t i = 0; i < model.condensed.size(); ++i) {
    const MatrixRow& row = model.condensed[i];
    if (model.tags[static_cast<std::size_t>(row.node)] != 11) continue;
    EXPECT_NEAR(led[static_cast<Eigen::Index>(i)],
                row.component < 3 ? u[row.component] : theta[row.component - 3],
                1e-14);
  }
}

TEST(MixedStructure, TellsHingesAndSolidsOfFirstOrder) {
  std::string text = kBlock +
                     "CTRIA3,7,9,5,6,7\nCTRIA3,8,9,5,7,8\n"
                     "PSHELL,9,1,.01,1,,1\nRBE2,3,11,123456,2,3,6,7\n";
  const MatrixModel model = read("hinge.bdf", text).model;
  EXPECT_THAT(model.notices,
              Contains(HasSubstr("share 2 nodes with solids, the first is 5")));
  EXPECT_THAT(model.notices, Contains(HasSubstr("1 solids are of first")));
}

TEST(MixedStructure, RefusesWhatIsWrongInANastranDeckWithItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"",
       "its elements are in 2 parts that nothing joins, one with node 1, "
       "another with node 11"},
      {"RBE2,3,11,123,2,12\n", "bad.bdf:19: RBE2 3: CM is not 123456"},
      {"RBE2,3,11,12,2,3\n", "bad.bdf:19: RBE2 3: CM is not 123456"},
      {"RBE2,3,11,123,2,99\n", "bad.bdf:19: RBE2 3 has node 99"},
      {"RBE2,1,11,123,2,3\n", "bad.bdf:19: element 1 is there twice"},
      {"RBE3,3,,11,123,1.,123,2\n,3,6\n", "bad.bdf:19: RBE3 3: REFC is '123'"},
      {"RBE3,3,,11,123456,1.,12,2\n,3,6\n", "bad.bdf:19: RBE3 3: C is '12'"},
      {"RBE3,3,,11,123456,-1.,123,2\n,3,6\n", "a weight is not > 0"},
      {"RBE3,3,,11,123456,1.,123,2\n,2,6\n", "a node twice"},
      {"RBE3,3,,11,123456,1.,123,2\n,3\n",
       "bad.bdf:19: its nodes lie on a line"},
      {"RBE3,3,,11,123456,1.,123,2\n,3,6,UM,2,123\n", "'UM' is in place of"},
      {kSpider + "RBE2,4,12,123456,2\n",
       "bad.bdf:20: node 2 moves with another rigid element already"},
      {"RBE2,3,11,123456,2,3,6,7\nRBE3,4,,2,123456,1.,123,1\n,4,5\n",
       "bad.bdf:20: node 2 moves with another"},
      {kSpider + "CONM2,4,1,,5.,.1\n", "bad.bdf:20: a mass with an offset"},
      {kSpider + "CELAS2,4,1.,1,1\n", "bad.bdf:20: CELAS2 is not read"},
  };
  for (const auto& [more, what] : cases)
    EXPECT_THAT(find_error("bad.bdf", kBlock + more), HasSubstr(what)) << more;
  std::string turned = kBlock + kSpider;
  turned.replace(turned.find("1,2,3,4,5,6\n,7,8"), 16, "5,6,7,8,1,2\n,3,4");
  EXPECT_THAT(find_error("bad.bdf", turned), HasSubstr("is inverted"));
}

/// The same of an input file.
const std::string kInput =
    "*NODE\n1, 0, 0, 0\n2, 2, 0, 0\n3, 2, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n"
    "6, 2, 0, 1\n7, 2, 1, 1\n8, 0, 1, 1\n11, 2, .5, .5\n12, 3, .5, .5\n"
    "*ELEMENT, TYPE=C3D8, ELSET=Block\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
    "*ELEMENT, TYPE=B31, ELSET=Beam\n2, 11, 12\n"
    "*MATERIAL, NAME=M\n*ELASTIC\n7e10, .3\n*DENSITY\n2700.\n"
    "*SOLID SECTION, ELSET=Block, MATERIAL=M\n"
    "*BEAM SECTION, ELSET=Beam, MATERIAL=M, SECTION=RECT\n.1, .2\n0, 0, 1\n"
    "*NSET, NSET=Face\n2, 3, 6, 7\n*NSET, NSET=Hub\n11\n"
    "*SURFACE, NAME=End\nBlock, S4\n";  // to line 30

TEST(MixedStructure, RigidPartsOfInputFilesAreAlike) {
  const MatrixModel first =
      read("a.inp", kInput + "*RIGID BODY, NSET=Face, REF NODE=11\n").model;
  const std::string by_nodes =
      "*SURFACE, NAME=Nodes, TYPE=NODE\n2\nFace, 1.\n"
      "*COUPLING, SURFACE=Nodes, REF NODE=11\n*KINEMATIC\n1, 3\n4, 6\n";
  for (const char* tie :
       {"*RIGID BODY, PIN NSET=Face, REF NODE=Hub\n",
        "*RIGID BODY, TIE NSET=Face, REF NODE=11\n",
        "*COUPLING, CONSTRAINT NAME=C, SURFACE=End, REF NODE=Hub\n*KINEMATIC\n",
        "*COUPLING, SURFACE=End, REF NODE=11\n*KINEMATIC\n1, 3\n",
        by_nodes.c_str(), "*MPC\nBEAM, Face, Hub\n"}) {
    const MatrixModel other = read("b.inp", kInput + tie).model;
    ASSERT_EQ(other.rows.size(), first.rows.size()) << tie;
    EXPECT_EQ((other.stiffness.entries - first.stiffness.entries).norm(), 0.0)
        << tie;
    EXPECT_EQ((other.mass.entries - first.mass.entries).norm(), 0.0) << tie;
  }
  // As of the Nastran deck, whose beam has the same axes.
  const MatrixModel deck = read("c.bdf", kBlock + kSpider).model;
  EXPECT_LT((deck.stiffness.entries - first.stiffness.entries).norm(),
            1e-12 * first.stiffness.entries.norm());
}

TEST(MixedStructure, ADistributionOfAFaceWeighsItsNodesByArea) {
  const MatrixModel face =
      read("a.inp",
           kInput + "*COUPLING, SURFACE=End, REF NODE=11\n*DISTRIBUTING\n")
          .model;
  const MatrixModel deck =
      read("c.bdf", kBlock + "RBE3,3,,11,123456,1.,123,2\n,3,6,7\n").model;
  EXPECT_LT((deck.stiffness.entries - face.stiffness.entries).norm(),
            1e-12 * face.stiffness.entries.norm());
}

TEST(MixedStructure, RefusesWhatIsWrongInAnInputFileWithItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"*TIE, NAME=T\nA, B\n", "bad.inp:31: *TIE would be lost"},
      {"*RIGID BODY, NSET=Face\n", "bad.inp:31: *RIGID BODY. Expected NSET"},
      {"*RIGID BODY, NSET=No, REF NODE=11\n", "its set of nodes NO is missing"},
      {"*RIGID BODY, NSET=Face, REF NODE=Face\n", "a set of 4 nodes"},
      {"*RIGID BODY, NSET=Face, REF NODE=99\n", "bad.inp:31: node 99"},
      {"*RIGID BODY, NSET=Face, REF NODE=11, POSITION=INPUT\n",
       "bad.inp:31: *RIGID BODY has POSITION"},
      {"*COUPLING, SURFACE=End, REF NODE=11\n",
       "bad.inp:31: *COUPLING has no kind"},
      {"*COUPLING, SURFACE=No, REF NODE=11\n*KINEMATIC\n",
       "bad.inp:31: its surface NO is missing"},
      {"*COUPLING, SURFACE=End, REF NODE=11\n*KINEMATIC\n1, 2\n",
       "bad.inp:31: components 12 are held"},
      {"*COUPLING, SURFACE=End, REF NODE=11\n*DISTRIBUTING\n1, 3\n",
       "bad.inp:31: components 123 are held"},
      {"*COUPLING, SURFACE=End, REF NODE=11\n*KINEMATIC\n1, 7\n",
       "bad.inp:33: *KINEMATIC has no components"},
      {"*COUPLING, SURFACE=End, REF NODE=11\n*DISTRIBUTING, WEIGHTING "
       "METHOD=LINEAR\n",
       "bad.inp:32: *DISTRIBUTING of another kind"},
      {"*KINEMATIC\n", "bad.inp:31: *KINEMATIC without *COUPLING"},
      {"*MPC\nPIN, 11, 2\n", "bad.inp:32: *MPC PIN is not read"},
      {"*SURFACE, NAME=X\nBeam, S1\n*COUPLING, SURFACE=X, REF NODE=11\n"
       "*KINEMATIC\n",
       "bad.inp:32: S1 of elements B31 is not read"},
      {"*ELEMENT, TYPE=S8R, ELSET=S\n9, 1, 2, 3, 4, 5, 6, 7, 8\n",
       "bad.inp:31: elements S8R would be lost"},
      {"*RIGID BODY, NSET=Face, REF NODE=11\n*SHELL SECTION, ELSET=Block, "
       "MATERIAL=M\n.1\n",
       "bad.inp:32: element 1 is a C3D8"},
  };
  for (const auto& [more, what] : cases)
    EXPECT_THAT(find_error("bad.inp", kInput + more), HasSubstr(what)) << more;
}

/// Two plates of one part, one turned upright, that share nothing.
TEST(MixedStructure, InstancesOfShellsAreMovedAndJoined) {
  const std::string parts =
      "*PART, NAME=Plate\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 2, 0\n4, 0, 2, "
      "0\n*ELEMENT, TYPE=S4, ELSET=All\n1, 1, 2, 3, 4\n*NSET, NSET=Edge\n1, 4\n"
      "*ORIENTATION, NAME=Fibre\n1, 0, 0, 0, 1, 0\n"
      "*SHELL SECTION, ELSET=All, MATERIAL=M, ORIENTATION=Fibre\n.01\n"
      "*END PART\n*MATERIAL, NAME=M\n*ELASTIC, TYPE=LAMINA\n"
      "1e11, 1e10, .3, 5e9, 5e9, 4e9\n*DENSITY\n1000.\n"
      "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=Flat, PART=Plate\n*END INSTANCE\n"
      "*INSTANCE, NAME=Wall, PART=Plate\n0, 0, 1\n0, 0, 1, 0, 1, 1, 90\n"
      "*END INSTANCE\n";
  EXPECT_THAT(find_error("bad.inp", parts), HasSubstr("in 2 parts"));
  const MatrixModel model =
      read("walls.inp", parts +
                            "*NODE\n1, 0, 1, .5\n*NSET, NSET=Edges\n"
                            "Flat.Edge, Wall.Edge\n"
                            "*RIGID BODY, NSET=Edges, REF NODE=1\n")
          .model;
  // (1, 2, 0) lifted by 1 and turned by 90 degrees about y there.
  const auto tag = std::ranges::find(model.tags, 13U) - model.tags.begin();
  ASSERT_LT(tag, std::ssize(model.tags));
  EXPECT_LT((model.x.col(tag) - Vector3(0, 2, 0)).norm(), 1e-14);
  std::vector<std::string> names;
  for (const MatrixNodeSet& set : model.sets) names.push_back(set.name);
  EXPECT_THAT(names, Contains("Wall.Edge"));
  EXPECT_THAT(names, Contains("Flat.All"));
  // The wall is the flat plate, turned: its fibres turn, too.
  const auto stiffness = [&](std::size_t of, const Vector3& along) {
    const auto row = std::ranges::find_if(model.rows, [&](const MatrixRow& r) {
      return model.tags[static_cast<std::size_t>(r.node)] == of &&
             r.component == 0;
    });
    const auto at = row - model.rows.begin();
    const Matrix3 K = MatrixX(model.stiffness.entries).block<3, 3>(at, at);
    return along.dot(K * along);
  };
  const double fibre = stiffness(2, Vector3::UnitX());
  EXPECT_NEAR(stiffness(12, Vector3::UnitZ()), fibre, 1e-9 * fibre);
  EXPECT_GT(fibre, 3.0 * stiffness(2, Vector3::UnitY()));
}

}  // namespace
}  // namespace limber::fem::mixed_structure_test
