#include "sculpt/import.h"

#include <gmock/gmock.h>

#include "sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

// Two unit cubes beside each other; the second one's corners in the order of `second`.
std::string two_cubes(const char* second) {
  return std::string("*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n") +
         "9,2,0,0\n10,2,1,0\n11,2,0,1\n12,2,1,1\n*ELEMENT,TYPE=C3D8,ELSET=body\n1,1,2,3,4,5,6,7,8\n2," + second +
         "\n";
}

std::string printed_by(TestSession& session, std::string& printed, const std::string& line) {
  printed.clear();
  session.run({line});
  return printed;
}

TEST(Import, CellsInsideOutAreReportedAndTurnedRoundOnRequest) {
  std::string printed;
  SessionOptions options;
  options.print = [&](const std::string& message) { printed += message + "\n"; };
  TestSession session({}, options);
  write_text(session.folder().path() / "sound.inp", two_cubes("2,9,10,3,6,11,12,7"));
  write_text(session.folder().path() / "turned.inp", two_cubes("2,3,10,9,6,7,12,11"));
  EXPECT_EQ(printed_by(session, printed, "open sound.inp"), "");
  // Beside a sound one it makes no solid, and the message says why.
  const Error error = session.fault_of("open turned.inp");
  EXPECT_EQ(error.code(), ErrorCode::bad_topology);
  EXPECT_THAT(error.what(), HasSubstr("cell 1 is inside out; `open FILE repair` turns such cells round"));
  EXPECT_NEAR(session.measure("volume"), 2, 1e-12);  // the document is as it was
  EXPECT_THAT(printed_by(session, printed, "open turned.inp repair"),
              HasSubstr("cell 1 is inside out; it was turned"));
  EXPECT_NEAR(session.measure("volume"), 2, 1e-12);
}

TEST(Import, AHangingNodeIsRefusedByName) {
  TestSession session;
  // A cube of 2 beside cubes of 1 that share two of its corners.
  write_text(session.folder().path() / "hanging.inp",
             "*NODE\n1,0,0,0\n2,2,0,0\n3,2,2,0\n4,0,2,0\n5,0,0,2\n6,2,0,2\n7,2,2,2\n8,0,2,2\n"
             "9,2,1,0\n10,2,1,2\n11,4,0,0\n12,4,1,0\n13,4,0,2\n14,4,1,2\n*ELEMENT,TYPE=C3D8\n"
             "1,1,2,3,4,5,6,7,8\n2,2,11,12,9,6,13,14,10\n");
  const Error error = session.fault_of("open hanging.inp");
  EXPECT_EQ(error.code(), ErrorCode::bad_topology);
  EXPECT_THAT(error.what(), HasSubstr("point 8 at 2 1 0 lies on a face of cell 0"));
}

TEST(Import, NamedSetsComeBackFromTheFormatsThatHoldThem) {
  TestSession session({"new box 3 2 2 size 3 2 2", "remove where x < 1 and y < 1",
                       "select vertices as top where z > 1.9", "select faces as wall where x > 2.9",
                       "select cells as end where x > 2"});
  const auto sets = *session.state().sets;
  std::vector<std::vector<Eigen::Vector3d>> places;
  const auto vertices_of = [](const Document& document, const Selection& set) {
    std::vector<Eigen::Vector3d> at;
    for (const std::uint32_t id : set.ids) at.push_back(document.rest().col(id));
    return at;
  };
  const auto top = vertices_of(session.document(), sets.at("top"));
  for (const char* file : {"a.msh", "a.ovm", "a.vtu", "a.vtk", "a.inp"}) {
    SCOPED_TRACE(file);
    session.run({std::string("save ") + file, std::string("open ") + file});
    const auto& back = *session.state().sets;
    EXPECT_EQ(vertices_of(session.document(), back.at("top")), top);
    EXPECT_EQ(back.at("end").ids.size(), sets.at("end").ids.size());
    const bool faces = std::string(file) == "a.msh" || std::string(file) == "a.ovm";
    EXPECT_EQ(back.count("wall"), faces ? 1U : 0U);
    if (faces) {
      for (const std::uint32_t id : back.at("wall").ids)
        for (const subdiv::VertexId v : session.document().solid().face_vertices(subdiv::FaceId{id}))
          EXPECT_EQ(session.document().rest()(0, v.value), 3);
    } else {
      session.run({"open a.msh"});
    }
  }
}

TEST(Import, AFinerLevelHoldsTheCellsOfASetAndSaysWhatItLeavesOut) {
  std::string printed;
  SessionOptions options;
  options.print = [&](const std::string& message) { printed += message + "\n"; };
  TestSession session(
      {"new box 2 2 2", "select edges where z > 0.9", "sharpen 10", "select cells as right where x > 0.5",
       "select vertices as top where z > 0.9", "select edges as all_edges", "levels 1"},
      options);
  printed.clear();
  session.run({"save fine.vtu"});
  EXPECT_THAT(printed, HasSubstr("the set 'top' of vertices is left out"));
  EXPECT_THAT(printed, HasSubstr("the set 'all_edges' of edges is left out: no file format"));
  EXPECT_THAT(printed, HasSubstr("the sharpness of "));
  session.run({"open fine.vtu"});
  EXPECT_EQ(session.state().sets->at("right").ids.size(), 32U);
}

TEST(Import, SetsOfOneNameAreToldApartByTheirKind) {
  std::string printed;
  SessionOptions options;
  options.print = [&](const std::string& message) { printed += message + "\n"; };
  TestSession session({}, options);
  write_text(session.folder().path() / "two.inp", two_cubes("2,9,10,3,6,11,12,7") + "*NSET,NSET=body\n1,2\n");
  session.run({"open two.inp"});
  EXPECT_THAT(printed, HasSubstr("two sets have the name 'body'; the one of vertices is now 'body_vertices'"));
  EXPECT_EQ(session.state().sets->at("body_vertices").ids.size(), 2U);
}

TEST(Import, EncodingsAreChosenAndRefused) {
  TestSession session({"new box 2 2 2", "save a.msh version 2.2 encoding ascii", "save b.vtu encoding compressed"});
  EXPECT_THAT(session.folder().text_of("a.msh"), testing::StartsWith("$MeshFormat\n2.2 0 8\n"));
  EXPECT_THAT(session.folder().text_of("b.vtu"), HasSubstr("vtkZLibDataCompressor"));
  EXPECT_THAT(session.fault_of("save c.inp encoding binary").what(), HasSubstr("not written binary"));
  EXPECT_THAT(session.fault_of("save c.obj encoding ascii").what(), HasSubstr("leave them out"));
  session.run({"open a.msh", "open b.vtu"});
}

}  // namespace
}  // namespace argil::sculpt
