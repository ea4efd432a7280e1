#include "tools/chart/picture.h"

#include <gmock/gmock.h>

#include <pugixml.hpp>
#include <random>

#include "tools/chart/findings.h"
#include "tools/chart/label_layout.h"
#include "tools/chart/log_axis.h"
#include "tools/chart/page.h"

namespace argil::chart {
namespace {

Row row(const std::string& model, const std::string& space, int resolution, double ms, double error,
        double sign = -1) {
  Row result;
  result.problem = "made_up";
  result.model = model;
  result.formulation = "plain";
  result.space = space;
  result.resolution = resolution;
  result.unknowns = static_cast<std::size_t>(100 * resolution);
  result.ms = ms;
  result.error = error;
  result.signed_error = sign * error;
  result.threads = 2;
  result.version = "0.1.0";
  result.commit = "0123456789ab";
  return result;
}

Panel made_up() {
  Panel panel;
  panel.name = "made_up";
  panel.title = "A <made-up> problem & its \"answer\"";
  panel.quantity = "length [m]";
  panel.source = "nowhere";
  panel.uncertainty = 2e-4;
  panel.rows = {row("soft", "default", 1, 1, 0.2),    row("soft", "default", 2, 10, 0.05),
                row("soft", "default", 4, 100, 0.02), row("hard", "cubic", 1, 2, 0.3),
                row("hard", "cubic", 2, 20, 0.009),   row("hard", "cubic", 4, 300, 1e-5),
                row("wild", "nodes", 1, 5, 50, 1),    row("off", "nodes", 1, 3, 0.4)};
  panel.rows.back().same_law = false;
  Row failed = row("wild", "nodes", 2, k_nothing, k_nothing);
  failed.status = Status::refused;
  failed.message = "no such <element>";
  panel.rows.push_back(failed);
  return panel;
}

TEST(Pareto, FrontIsWhatNoOtherBeats) {
  // Slower and no better, equal in time, equal in both: none of them is on the front.
  EXPECT_THAT(pareto_front({{1, 10}, {2, 10}, {3, 5}, {3, 7}, {4, 6}, {5, 1}, {5, 1}, {0.5, 20}}),
              testing::ElementsAre(7, 0, 2, 5));
  EXPECT_TRUE(pareto_front(std::vector<Point>{}).empty());
}

TEST(Pareto, FrontOfRandomPointsHoldsAgainstEveryPair) {
  std::mt19937 random(3);
  std::vector<Point> points;
  for (int i = 0; i < 200; ++i)
    points.push_back({static_cast<double>(random() % 40), static_cast<double>(random() % 40)});
  const auto front = pareto_front(points);
  const auto beats = [](const Point& a, const Point& b) {
    return a.time <= b.time && a.error <= b.error && (a.time < b.time || a.error < b.error);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool beaten = false, shown = false;
    for (const Point& other : points) beaten = beaten || beats(other, points[i]);
    for (const std::size_t f : front)
      shown = shown || (points[f].time == points[i].time && points[f].error == points[i].error);
    EXPECT_EQ(shown, !beaten) << points[i].time << ' ' << points[i].error;
  }
}

TEST(Pareto, ErrorsBelowTheUncertaintyAreAlike) {
  Panel panel = made_up();
  panel.rows = {row("a", "default", 1, 1, 1e-4), row("a", "default", 2, 2, 1e-6)};
  EXPECT_THAT(pareto_front(panel), testing::ElementsAre(0));
}

TEST(LogAxisTest, TicksAreDecadesAndLieWithin) {
  const LogAxis axis(0.003, 40, 100, 500);
  EXPECT_THAT(axis.ticks(), testing::Pointwise(testing::DoubleNear(1e-12), {0.01, 0.1, 1.0, 10.0}));
  EXPECT_NEAR(axis.place(axis.low()), 100, 1e-9);
  EXPECT_NEAR(axis.place(axis.high()), 500, 1e-9);
  EXPECT_NEAR(axis.place(1) - axis.place(0.1), axis.place(10) - axis.place(1), 1e-9);
  for (const double value : axis.minor()) EXPECT_TRUE(axis.holds(value));
  EXPECT_GE(LogAxis(5, 5, 0, 1).ticks().size(), 2U);  // a single value has an axis too
}

TEST(LabelLayoutTest, NothingCoversAnything) {
  const Box frame{0, 0, 400, 300};
  LabelLayout layout(frame);
  std::mt19937 random(5);
  std::vector<Box> points;
  for (int i = 0; i < 60; ++i) {
    const double x = random() % 400, y = random() % 300;
    points.push_back({x - 4, y - 4, 8, 8});
    layout.keep_free(points.back());
  }
  std::vector<Box> labels;
  for (const Box& point : points)
    if (const auto place = layout.place(point.x + 4, point.y + 4, 60, 14)) labels.push_back(place->box);
  EXPECT_GT(labels.size(), 10U);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    for (const Box& point : points) EXPECT_FALSE(labels[i].meets(point));
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(labels[i].meets(labels[j]));
    EXPECT_GE(labels[i].x, 0);
    EXPECT_LE(labels[i].x + labels[i].width, frame.width);
  }
}

TEST(ChartPicture, IsWellFormedAndHasATooltipForEveryRun) {
  const Panel panel = made_up();
  const std::string svg = picture(panel, Colours({panel}));
  pugi::xml_document document;
  const auto result = document.load_string(svg.c_str());
  ASSERT_TRUE(result) << result.description();
  const pugi::xml_node root = document.document_element();
  EXPECT_STREQ(root.name(), "svg");
  EXPECT_STREQ(root.attribute("xmlns").value(), "http://www.w3.org/2000/svg");
  EXPECT_THAT(root.attribute("aria-label").value(), testing::StrEq(panel.title));
  int tooltips = 0, hollow = 0, fronts = 0;
  for (const pugi::xml_node path : root.children("path")) {
    tooltips += path.child("title") ? 1 : 0;
    hollow += std::string(path.attribute("class").value()).starts_with("hollow") ? 1 : 0;
    fronts += std::string(path.attribute("class").value()) == "front" && path.child("title") ? 1 : 0;
  }
  EXPECT_EQ(tooltips, 8 + 1);  // the runs that ended well, and the front
  EXPECT_EQ(fronts, 1);
  EXPECT_EQ(hollow, 1);
  EXPECT_THAT(svg, testing::Not(testing::HasSubstr("nan")));
  EXPECT_THAT(svg, testing::HasSubstr("Pareto front"));
}

TEST(ChartPicture, APanelOfFailuresHasAPictureToo) {
  Panel panel = made_up();
  panel.rows = {panel.rows.back()};
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(picture(panel, Colours({panel})).c_str()));
  EXPECT_THAT(findings(panel).choice, testing::ElementsAre(testing::HasSubstr("No run")));
}

TEST(ChartPage, IsWellFormedAndHoldsEveryPanel) {
  const Panel panel = made_up();
  Panel other = made_up();
  other.name = "other";
  const std::string html = page({panel, other}, Colours({panel, other}));
  pugi::xml_document document;
  const auto result = document.load_string(html.c_str(), pugi::parse_default | pugi::parse_doctype);
  ASSERT_TRUE(result) << result.description();
  EXPECT_EQ(document.document_element().child("body").select_nodes("figure/svg").size(), 2U);
  EXPECT_EQ(document.document_element().child("body").select_nodes("h2").size(), 2U);
  EXPECT_THAT(html, testing::HasSubstr("no such &lt;element&gt;"));
}

TEST(ChartFindings, SayWhatTheRowsShow) {
  const Findings found = findings(made_up());
  std::string text;
  for (const std::string& sentence : found.choice) text += sentence + "\n";
  EXPECT_THAT(text, testing::HasSubstr("For an error below 10 % the fastest is soft, default 2: 5 % in 10 ms"));
  EXPECT_THAT(text, testing::HasSubstr("For an error below 1 % the fastest is hard, cubic 2: 0.9 % in 20 ms"));
  EXPECT_THAT(text, testing::HasSubstr("For an error below 0.1 % the fastest is hard, cubic 4"));
  EXPECT_THAT(text, testing::HasSubstr("The fewest unknowns that reach 1 % are the 200 of hard, cubic 2"));
  EXPECT_THAT(text, testing::HasSubstr("hard, cubic 2 is as accurate 5.0 times faster"));
  EXPECT_THAT(text, testing::HasSubstr("off 40 %"));
  ASSERT_EQ(found.failures.size(), 1U);
  EXPECT_THAT(found.failures[0], testing::HasSubstr("wild: 1 of 2 runs refused (nodes 2): no such <element>"));

  Panel lucky = made_up();
  lucky.rows = {row("a", "default", 1, 1, 0.1, -1), row("a", "default", 2, 2, 0.05, 1)};
  text.clear();
  for (const std::string& sentence : findings(lucky).choice) text += sentence;
  EXPECT_THAT(text, testing::HasSubstr("changes its sign along the way for a in default space"));
  EXPECT_THAT(text, testing::HasSubstr("No run came below 1 %"));
}

}  // namespace
}  // namespace argil::chart
