#include "sculpt/line_samples.h"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <sstream>

#include "sculpt/line_plot.h"
#include "sculpt/shown_unit.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

const std::vector<std::string> k_bar{"new box 4 2 2 size 0.4 0.1 0.1",
                                     "set young_modulus 2e4",
                                     "set density 300",
                                     "pin where x < 0.001",
                                     "gravity 0 0 -9.81",
                                     "solve"};
const std::array<Eigen::Vector3d, 2> k_axis{Eigen::Vector3d(0, 0.05, 0.05), Eigen::Vector3d(0.4, 0.05, 0.05)};

class LinearField : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(LinearField, IsSampledExactlyOnAnyLineThroughAnyKindOfElement) {
  TestSession session(GetParam());
  Eigen::Matrix3d map;
  map << 1.2, 0.3, -0.1, 0.05, 0.9, 0.2, -0.15, 0.1, 1.1;
  session.deform(map);
  // About the middle, which no refinement draws the surface over.
  const Eigen::Vector3d middle = session.document().rest().rowwise().mean();
  const std::vector<std::string> fields{"displacement_y", "distortion"};
  for (const Eigen::Vector3d& half : {Eigen::Vector3d(0.11, 0, 0), Eigen::Vector3d(0.03, -0.07, 0.1),
                                      Eigen::Vector3d(0, 0.0123, 0), Eigen::Vector3d(-0.1, -0.1, 0.1)}) {
    const std::array<Eigen::Vector3d, 2> ends{middle - half, middle + 0.8 * half};
    const SampledLine line = sample_line(session.document(), ends, 17, fields);
    ASSERT_EQ(line.columns.size(), 9U);
    for (std::size_t i = 0; i < 17; ++i) {
      const Eigen::Vector3d at = ends[0] + static_cast<double>(i) / 16 * (ends[1] - ends[0]);
      const Eigen::Vector3d moved = map * at - at;
      EXPECT_NEAR(line.column("distance")->values[i], (at - ends[0]).norm(), 1e-15);
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const std::string name(1, "xyz"[axis]);
        EXPECT_NEAR(line.column(name)->values[i], at[axis], 1e-15);
        // Rounding of weights that find a point to 1e-12 of its coordinates.
        EXPECT_NEAR(line.column("displacement_" + name)->values[i], moved[axis], 2e-11) << i;
      }
      EXPECT_NEAR(line.columns[7].values[i], moved.y(), 1e-11);
      EXPECT_NEAR(line.columns[8].values[i], map.determinant() - 1, 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, LinearField,
                         testing::Values(std::vector<std::string>{"new box 3 3 3"},
                                         std::vector<std::string>{"new box 4 4 4",
                                                                  "move 0.03 0.02 -0.02 where x > 0.4 and z > 0.4",
                                                                  "levels 1"},
                                         std::vector<std::string>{"new box 4 4 4", "levels 1", "space cubic"},
                                         std::vector<std::string>{"new box 4 4 4", "levels 1", "space published"},
                                         std::vector<std::string>{"new cylinder", "levels 1"},
                                         std::vector<std::string>{"new dodecahedron radius 1", "levels 2"},
                                         std::vector<std::string>{"new octahedron radius 1", "levels 2"}));

TEST(LineSamples, AreWhatMeasuresSayAtTheSamePoints) {
  TestSession session(k_bar);
  const SampledLine line = sample_line(session.document(), k_axis, 9, {});
  for (std::size_t i = 0; i < 9; ++i) {
    const double x = 0.05 * static_cast<double>(i);
    EXPECT_NEAR(line.column("displacement_z")->values[i],
                session.measure("displacement_z at " + std::to_string(x) + " 0.05 0.05"), 1e-12);
  }
  EXPECT_LT(line.column("displacement_z")->values[8], -0.01);
}

TEST(LineSamples, OfAFileAreThoseOfTheBodyThatWasSaved) {
  TestSession session(k_bar);
  session.run({"save bar.vtu"});
  const SampledLine now = sample_line(session.document(), k_axis, 5, {});  // at vertices, where both must agree
  session.run({"new box 1 1 1", "sample a.csv from 0 0.05 0.05 to 0.4 0.05 0.05 count 5 of bar.vtu as saved"});
  const SampledLine& saved = session->samples().at(0);
  EXPECT_EQ(saved.name, "saved");
  for (const char* name : {"x", "displacement_x", "displacement_z"})
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_NEAR(saved.column(name)->values[i], now.column(name)->values[i], 1e-14) << name;
}

TEST(LineSamples, WriteATableThatReadsBackAsTheSameNumbers) {
  TestSession session(k_bar);
  session.run({"sample axis.csv from 0 0.05 0.05 to 0.4 0.05 0.05 count 5 fields \"strain, stress\""});
  std::istringstream text(session.folder().text_of("axis.csv"));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "distance_m,x_m,y_m,z_m,displacement_x_m,displacement_y_m,displacement_z_m,strain,stress_Pa");
  const SampledLine& kept = session->samples().at(0);
  EXPECT_EQ(kept.name, "axis");
  for (std::size_t i = 0; i < 5; ++i) {
    ASSERT_TRUE(std::getline(text, line));
    std::istringstream row(line);
    std::string cell;
    for (const SampledColumn& column : kept.columns) {
      ASSERT_TRUE(std::getline(row, cell, ','));
      EXPECT_EQ(std::stod(cell), column.values[i]) << column.name;
    }
  }
  EXPECT_FALSE(std::getline(text, line));
}

TEST(LineSamples, FieldErrorOnTheWayIsTheDistanceToTheReference) {
  TestSession session(k_bar);
  session.run({"save bar.vtu", "gravity 0 0 0", "solve",
               "sample a.csv from 0 0.05 0.05 to 0.4 0.05 0.05 count 5 fields error reference bar.vtu",
               "sample b.csv from 0 0.05 0.05 to 0.4 0.05 0.05 count 5 of bar.vtu"});
  const SampledLine &error = session->samples().at(0), &bent = session->samples().at(1);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(error.column("error")->values[i],
                std::hypot(bent.column("displacement_x")->values[i], bent.column("displacement_y")->values[i],
                           bent.column("displacement_z")->values[i]),
                1e-8);  // the body is back at rest to Newton's tolerance
}

TEST(FieldError, PassesOverVerticesThatWereRemoved) {
  // At level 0 their ids stay behind, at places that the reference does not reach.
  TestSession session({"new box 3 1 3 size 0.3 0.1 0.3", "remove where x > 0.1 and z < 0.2", "pin where z < 0.001",
                       "set young_modulus 1e5", "force 0 1 0 where x > 0.299", "solve", "save l.vtu"});
  EXPECT_NEAR(session.measure("error_max reference l.vtu"), 0, 1e-14);
  const double tip = session.measure("max_displacement");
  session.run({"force clear", "solve"});
  EXPECT_NEAR(session.measure("error_max reference l.vtu"), tip, 1e-8);
}

TEST(LineSamples, DoNotChangeTheState) {
  TestSession session(k_bar);
  const auto before = session.hash();
  const std::size_t depth = session->undo_depth();
  session.run({"sample a.csv from 0 0 0 to 0.4 0 0", "plot a.svg displacement_z"});
  EXPECT_EQ(session.hash(), before);
  EXPECT_EQ(session->undo_depth(), depth);
}

TEST(LineSamples, SayWhatIsWrongWithALine) {
  TestSession session(k_bar);
  session.run({"save plain.obj"});
  const std::pair<const char*, const char*> bad[] = {
      {"sample a.csv from 0 0 0 to 0 0 0", "at both ends"},
      {"sample a.csv from 0 0 0 to 0.5 0 0", "not inside the solid"},
      {"sample a.csv from 5 0 0 to 6 0 0", "(5, 0, 0) is not inside"},
      {"sample a.csv from 0 0 0 to 1e300 0 0", "must lie between"},
      {"sample a.csv from nan 0 0 to 0.4 0 0", "wants a number"},
      {"sample a.csv from 0 0 0 to 0.4 0 0 count 0", "between 2 and 10000"},
      {"sample a.csv from 0 0 0 to 0.4 0 0 count 1e9", "between 2 and 10000"},
      {"sample a.csv from 0 0 0 to 0.4 0 0 fields strian", "did you mean `strain`"},
      {"sample a.csv from 0 0 0 to 0.4 0 0 fields error", "add `reference FILE`"},
      {"sample a.csv from 0 0 0 to 0.4 0 0 reference plain.obj", "add `fields error`"},
      {"sample a.csv from 0 0 0 to 0.4 0 0 of plain.obj", "no displacements"},
      {"sample a.csv from 0 0 0 to 0.4 0 0 of plain.obj fields strain", "leave out fields"},
      {"sample a.txt from 0 0 0 to 0.4 0 0", "is a .csv file"},
      {"sample ../a.csv from 0 0 0 to 0.4 0 0", "climbs out"},
      {"sample a.csv from 0 0 0", "to"},
      {"plot a.svg displacement_z", "nothing has been sampled"},
      {"plot a.png displacement_z", "is a .svg file"}};
  for (const auto& [line, what] : bad)
    EXPECT_THAT(std::string(session.fault_of(line).what()), HasSubstr(what)) << line;
  EXPECT_TRUE(session->samples().empty());
  session.run({"sample a.csv from 0 0 0 to 0.4 0 0"});
  EXPECT_THAT(std::string(session.fault_of("plot a.svg displacement_w").what()), HasSubstr("displacement_"));
  EXPECT_THAT(std::string(session.fault_of("plot a.svg z against strain").what()), HasSubstr("'strain'"));
  EXPECT_THAT(std::string(session.fault_of("plot ../a.svg z").what()), HasSubstr("climbs out"));
}

std::size_t count_in(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(LinePlot, HasACurveForEveryLineAndANewOneOfANameReplacesTheOld) {
  TestSession session(k_bar);
  session.run({"sample a.csv from 0 0 0 to 0.4 0 0 as low", "sample b.csv from 0 0 0.1 to 0.4 0 0.1 as high",
               "sample c.csv from 0 0 0.05 to 0.4 0 0.05 as low", "plot a.svg displacement_z title \"a < b & c\""});
  const std::string svg = session.folder().text_of("a.svg");
  EXPECT_EQ(count_in(svg, "class=\"curve\""), 2U);
  EXPECT_THAT(svg, HasSubstr("a &lt; b &amp; c"));
  EXPECT_THAT(svg, HasSubstr(">low</text>"));
  EXPECT_THAT(svg, HasSubstr("displacement along z [mm]"));
  EXPECT_EQ(count_in(svg, "<g "), count_in(svg, "</g>"));
}

TEST(LinePlot, PutsPointsWhereTheirValuesAre) {
  const LinePlot plot{"t", "a", "m",
                      "b", "",  {{"rising", {0, 0.5, 1}, {0, 10, 20}}, {"same end", {0, 1}, {5, 20}}}};
  const std::string svg = plot_svg(plot);
  // The frame goes from (84, 420) to (700, 58), both ranges are round and reach its corners.
  EXPECT_THAT(svg, HasSubstr("M84.0 420.0L392.0 239.0L700.0 58.0"));
  EXPECT_THAT(svg, HasSubstr("M84.0 329.5L700.0 58.0"));
  // Labels of curves that end at one place stand a line apart.
  EXPECT_THAT(svg, HasSubstr("y=\"68.0\""));
  EXPECT_THAT(svg, HasSubstr("y=\"85.0\""));
  EXPECT_NO_THROW((void)plot_svg({"flat", "a", "m", "b", "m", {{"", {1, 1}, {3, 3}}}}));
  EXPECT_THROW((void)plot_svg({"bad", "a", "m", "b", "m", {{"", {0, 1}, {0, NAN}}}}), Error);
}

TEST(ShownUnit, KeepsNumbersShort) {
  EXPECT_EQ(shown_unit("m", 0.05).unit, "mm");
  EXPECT_EQ(shown_unit("Pa", 12e3).unit, "kPa");
  EXPECT_EQ(shown_unit("kg", 12e3).unit, "kg");
  EXPECT_EQ(shown_unit("%", 0.1).per_value, 100);
  EXPECT_EQ(tick_text(-0.25, 0.05), "−0.25");
  EXPECT_EQ(tick_text(1e-18, 0.05), "0");
}

}  // namespace
}  // namespace argil::sculpt
