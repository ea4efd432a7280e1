#include "sculpt/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <sstream>

#include "sculpt/measures.h"
#include "sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

const std::vector<std::string> k_bent = {"new box 3 2 2 size 0.3 0.2 0.2",
                                         "levels 1",
                                         "set density 400 + 100*x",
                                         "set young_modulus 3e4 where x > 0.1",
                                         "pin where x < 0.01",
                                         "force 0 0 -1 where x > 0.29",
                                         "step 5"};

const io::NamedField& field_of(const io::VolumeMesh& mesh, const std::string& name) {
  const auto found = std::find_if(mesh.point_fields.begin(), mesh.point_fields.end(),
                                  [&](const io::NamedField& f) { return f.name == name; });
  if (found == mesh.point_fields.end()) throw std::runtime_error("no field " + name);
  return *found;
}

TEST(Export, AVtuHoldsTheShapeAndEveryField) {
  for (const char* space : {"default", "cubic"}) {
    TestSession session(k_bent);
    session.run({std::string("space ") + space, "save bent.vtu", "save bent.vtk"});
    const Document& document = session.document();
    const Eigen::Matrix3Xd now = document.surface_nodes(document.positions()),
                           rest = document.surface_nodes(document.rest());
    for (const char* file : {"bent.vtu", "bent.vtk"}) {
      const io::VolumeMesh mesh = io::read_volume_mesh(session.folder().path() / file);
      EXPECT_EQ(mesh.cells.cell_count(), 96U);
      EXPECT_EQ(mesh.cells.positions, now);  // doubles survive exactly
      for (const std::string& name : shown_field_names()) {
        if (name.starts_with("displacement") || name == "error") continue;
        const ShownField shown = shown_field(document, name);
        const io::NamedField& held = field_of(mesh, name);
        EXPECT_EQ(held.components, 1);
        EXPECT_EQ(
            (Eigen::Map<const Eigen::VectorXd>(held.values.data(), static_cast<Eigen::Index>(held.values.size()))),
            shown.values)
            << name;
      }
      const io::NamedField& moved = field_of(mesh, "displacement");
      ASSERT_EQ(moved.components, 3);
      EXPECT_EQ((Eigen::Map<const Eigen::Matrix3Xd>(moved.values.data(), 3,
                                                    static_cast<Eigen::Index>(moved.values.size() / 3))),
                now - rest);
      EXPECT_GT((now - rest).norm(), 1e-3);
    }
  }
}

TEST(Export, ASavedSolidOpensAgainWithItsFields) {
  TestSession session(k_bent);
  session.run({"save whole.vtu"});
  const Eigen::VectorXd density = (*session.state().fields)[FieldName::density];
  session.run({"save cage.vtu level 0", "open whole.vtu"});
  EXPECT_EQ(session.document().solid().cell_count(), 96U);
  EXPECT_EQ((*session.state().fields)[FieldName::density], density);
  session.run({"open cage.vtu"});
  EXPECT_EQ(session.document().solid().cell_count(), 12U);
  EXPECT_EQ((*session.state().fields)[FieldName::density], Eigen::VectorXd::Constant(36, 1000));
}

TEST(Export, DeadIdsLeaveNoHoles) {
  TestSession session({"new box 3 2 2 size 3 2 2", "remove where x < 1", "set density 100*x", "save rest.vtu"});
  const io::VolumeMesh mesh = io::read_volume_mesh(session.folder().path() / "rest.vtu");
  ASSERT_EQ(mesh.cells.positions.cols(), 27);
  for (Eigen::Index v = 0; v < 27; ++v)
    EXPECT_EQ(field_of(mesh, "density").values[static_cast<std::size_t>(v)], 100 * mesh.cells.positions(0, v));
}

TEST(Export, AnObjIsClosed) {
  // A solid with a hole through it, a pyramid on it, and two blocks that touch in an edge only.
  for (const std::vector<std::string>& lines :
       {std::vector<std::string>{"new box 3 3 1 size 3 3 1", "remove where x > 1 and x < 2 and y > 1 and y < 2",
                                 "peak 1 where z > 0.9 and x < 1 and y < 1", "levels 2"},
        std::vector<std::string>{"new box 2 2 1 size 2 2 1", "remove where x < 1 and y < 1 or x > 1 and y > 1",
                                 "levels 1"}}) {
    TestSession session(lines);
    session.run({"save a.obj"});
    std::istringstream text(session.folder().text_of("a.obj"));
    std::map<std::pair<int, int>, int> directed;
    std::vector<Eigen::Vector3d> points;
    double volume = 0;
    for (std::string line; std::getline(text, line);) {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      if (kind == "v") {
        Eigen::Vector3d p;
        words >> p[0] >> p[1] >> p[2];
        points.push_back(p);
      } else if (kind == "f") {
        std::vector<int> corners;
        for (std::string corner; words >> corner;) corners.push_back(std::stoi(corner) - 1);
        ASSERT_GE(corners.size(), 3U);
        for (std::size_t i = 0; i < corners.size(); ++i)
          ++directed[{corners[i], corners[(i + 1) % corners.size()]}];
        for (std::size_t i = 1; i + 1 < corners.size(); ++i)
          volume +=
              points[static_cast<std::size_t>(corners[0])].dot(points[static_cast<std::size_t>(corners[i])].cross(
                  points[static_cast<std::size_t>(corners[i + 1])])) /
              6;
      }
    }
    ASSERT_GT(directed.size(), 100U);
    for (const auto& [edge, count] : directed) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(directed.count({edge.second, edge.first}), 1U);
    }
    // Turned outwards, and the faces are those of the solid: fans of them enclose its volume to their own flatness.
    EXPECT_NEAR(volume, session.measure("volume"), 0.02 * volume);
  }
}

TEST(Export, MeditRefusesPolyhedraByName) {
  TestSession session({"new pyramid", "save pyramid.vtk", "levels 1"});
  const Error error = session.fault_of("save refined.mesh");
  EXPECT_EQ(error.code(), ErrorCode::unsupported);
  EXPECT_THAT(error.what(), HasSubstr("polyhedr"));
  EXPECT_FALSE(std::filesystem::exists(session.folder().path() / "refined.mesh"));
  session.run({"save refined.vtu"});
  // What MEDIT cannot hold beside the shape is named.
  std::string printed;
  SessionOptions options;
  options.print = [&](const std::string& message) { printed += message; };
  TestSession hexahedra({"new box 2 2 2", "levels 1"}, options);
  printed.clear();
  hexahedra.run({"save block.mesh"});
  EXPECT_THAT(printed, HasSubstr("MEDIT has no place for fields of the points named 'young_modulus', "));
  EXPECT_EQ(io::read_volume_mesh(hexahedra.folder().path() / "block.mesh").cells.cell_count(), 64U);
}

TEST(Export, WhatCannotBeWrittenIsAnError) {
  TestSession session({"new box 2 2 2"});
  std::filesystem::create_directories(session.folder().path() / "taken.vtu");
  for (const char* line : {"save taken.vtu", "save a.doc", "save a", "save ."}) {
    const Error error = session.fault_of(line);
    EXPECT_NE(std::string(error.what()), "") << line;
  }
}

}  // namespace
}  // namespace argil::sculpt
