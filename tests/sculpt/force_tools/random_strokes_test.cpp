// Random strokes of all tools, on small bodies: each is taken back and brought again to the same state, bit for
// bit. ARGIL_FUZZ_STROKES asks for more of them, ARGIL_FUZZ_SEED for others.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "sculpt/force_tools/tool_table.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

class RandomStrokes {
 public:
  explicit RandomStrokes(std::uint32_t seed) : engine_(seed) {}

  std::vector<std::string> body() {
    static const std::vector<std::string> k_bodies[] = {
        {"new box 2 2 2 size 0.2 0.2 0.2", "levels 1"},
        {"new box 3 1 1 size 0.3 0.1 0.1", "levels 0"},
        {"new wedge size 0.2 0.2 0.2", "levels 1"},
        {"new box 2 2 1 size 0.2 0.2 0.1", "levels 1", "space cubic"},
    };
    std::vector<std::string> lines = k_bodies[pick(std::size(k_bodies))];
    if (pick(2)) lines.push_back("pin where x < 0.02");
    if (pick(2)) lines.push_back("set damping 10");
    lines.push_back(fmt::format("step 1 dt {:.4g}", number(0.004, 0.02)));
    return lines;
  }

  // The tool and its stroke, from somewhere on the surface of the body as it stands.
  std::pair<std::string, std::string> next(const Document& document) {
    const auto tools = tool_table();
    const std::size_t which = pick(tools.size() + 1);
    std::string tool = fmt::format("tool {} radius {:.4g} strength {:.4g} symmetry {}",
                                   which < tools.size() ? tools[which].name : "grab", number(0.02, 0.15),
                                   std::exp(number(0, 7)), pick(6) == 0 ? std::string(1, "xyz"[pick(3)]) : "none");
    if (which < tools.size() && tools[which].name.starts_with("paint"))
      tool += fmt::format(" scale {:.4g}", std::exp(number(-1, 1)));
    const Eigen::Matrix3Xd nodes = document.surface_nodes(document.positions());
    const Eigen::Vector3d at = nodes.col(static_cast<Eigen::Index>(pick(static_cast<std::size_t>(nodes.cols()))));
    const std::string path =
        fmt::format("path 0 {} {} {} {} {} {} {}", at.x(), at.y(), at.z(), 5 + pick(40), at.x() + number(-0.1, 0.1),
                    at.y() + number(-0.1, 0.1), at.z() + number(-0.1, 0.1));
    if (which == tools.size()) {
      const Eigen::Vector3d other =
          nodes.col(static_cast<Eigen::Index>(pick(static_cast<std::size_t>(nodes.cols())))) +
          Eigen::Vector3d(1e-3, 0, 0);
      return {tool, fmt::format("curve through {} {} {} {} {} {} handle 1 {}", at.x(), at.y(), at.z(), other.x(),
                                other.y(), other.z(), path)};
    }
    std::string stroke = "stroke " + path;
    if (pick(3) == 0) stroke += " turns 1 0 0 0 0.6 0 0.8 0";
    if (pick(3) == 0)
      stroke += fmt::format(" pressures {:.3g} {:.3g}{}", number(0, 1), number(0, 1),
                            pick(2) == 0 ? " scales radius" : "");
    for (const char* flag : {"invert", "smoothing", "inside"})
      if (pick(5) == 0) stroke += fmt::format(" {}", flag);
    return {tool, stroke};
  }

 private:
  std::size_t pick(std::size_t count) { return engine_() % count; }
  double number(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 4294967295.0;
  }
  std::mt19937 engine_;
};

long asked(const char* name, long otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atol(text) : otherwise;
}

TEST(RandomStrokesSlow, UndoneAndRedoneTheyAreTheSame) {
  const long strokes = asked("ARGIL_FUZZ_STROKES", 1000);
  constexpr long k_of_a_session = 25;
  const auto first_seed = static_cast<std::uint32_t>(asked("ARGIL_FUZZ_SEED", 1));
  long made = 0, refused = 0;
  for (std::uint32_t seed = first_seed; made < strokes; ++seed) {
    RandomStrokes random(seed);
    SessionOptions options;
    options.write_journal = false;
    TestSession session(random.body(), options);
    std::vector<std::uint64_t> hashes{session.hash()};
    for (long i = 0; i < k_of_a_session; ++i) {
      const auto [tool, stroke] = random.next(session.document());
      const std::string place = fmt::format("seed {}: {}; {}", seed, tool, stroke);
      session.run({tool});
      const std::uint64_t before = session.hash();
      const std::size_t depth = session->undo_depth();
      try {
        session.run({stroke});
      } catch (const Error& error) {
        ++refused;  // nothing there to touch; then nothing has changed
        ASSERT_EQ(session.hash(), before) << place << "\n" << error.what();
        session.run({"undo"});
        continue;
      }
      ++made;
      const std::uint64_t after = session.hash();
      ASSERT_TRUE(session.document().positions().allFinite()) << place;
      if (session->undo_depth() > depth) {
        session.run({"undo"});
        ASSERT_EQ(session.hash(), before) << place;
        session.run({"redo"});
        ASSERT_EQ(session.hash(), after) << place;
        // And taken anew from the same state.
        if (i % 5 == 0) {
          session.run({"undo", stroke});
          ASSERT_EQ(session.hash(), after) << place;
        }
      }
      hashes.push_back(after);
    }
    // A stroke that was refused at the end has left its tool to be redone.
    const std::uint64_t end = session.hash();
    const std::size_t depth = session->undo_depth();
    session.run({"undo all"});
    if (depth > 0) session.run({fmt::format("redo {}", depth)});
    ASSERT_EQ(session.hash(), end) << "seed " << seed;
  }
  fmt::print("{} strokes, {} touched nothing\n", made, refused);
  EXPECT_LT(refused, made);
}

}  // namespace
}  // namespace argil::sculpt
