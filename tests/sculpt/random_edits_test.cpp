// Random edits over random seeds: after each, the solid is whole by two books, Euler's relation holds, undo gives
// the identical state and redo the other; a refused edit changes nothing and says what to do. ARGIL_FUZZ_EDITS asks
// for more than the few of every day (README), ARGIL_FUZZ_SEED for others.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <cstdlib>
#include <map>
#include <mutex>

#include "random_edits.h"
#include "sessions.h"
#include "subdiv/build.h"
#include "subdiv/validate.h"
#include "tests/subdiv/slow_check.h"

namespace argil::sculpt {
namespace {

struct Tally {
  struct Tool {
    long tried = 0, accepted = 0;
  };
  std::map<std::string, Tool> tools;
  long cells_most = 0, solids_of_polyhedra = 0, contacts = 0, creases = 0, genus_3 = 0, genus_most = 0;
  std::map<std::string, long> refusals;               // by the beginning of the message
  std::map<std::string, std::string> without_remedy;  // the same, and a place

  void add(const Tally& other) {
    for (const auto& [name, tool] : other.tools) {
      tools[name].tried += tool.tried;
      tools[name].accepted += tool.accepted;
    }
    cells_most = std::max(cells_most, other.cells_most);
    genus_most = std::max(genus_most, other.genus_most);
    solids_of_polyhedra += other.solids_of_polyhedra;
    contacts += other.contacts;
    creases += other.creases;
    genus_3 += other.genus_3;
    for (const auto& [message, count] : other.refusals) refusals[message] += count;
    without_remedy.insert(other.without_remedy.begin(), other.without_remedy.end());
  }
  Tool total() const {
    Tool sum;
    for (const auto& [name, tool] : tools) {
      sum.tried += tool.tried;
      sum.accepted += tool.accepted;
    }
    return sum;
  }
};

bool has_dangling(const subdiv::Solid& solid) {
  for (const subdiv::FaceId f : solid.faces())
    if (!solid.owner(subdiv::face_use(f, false)).valid() && !solid.owner(subdiv::face_use(f, true)).valid())
      return true;
  for (const subdiv::EdgeId e : solid.edges())
    if (solid.edge_valence(e) == 0) return true;
  for (const subdiv::VertexId v : solid.vertices())
    if (solid.vertex_valence(v) == 0) return true;
  return false;
}

void check_solid(const subdiv::Solid& solid, const std::string& line, Tally& tally) {
  const bool dangling = has_dangling(solid);
  EXPECT_THAT(subdiv::validate(solid), testing::IsEmpty()) << line;
  EXPECT_THAT(subdiv::test::slow_check(solid, dangling), testing::IsEmpty()) << line;
  const auto euler = subdiv::test::euler_relation(solid);
  EXPECT_EQ(euler.solid, euler.boundary) << line;
  tally.cells_most = std::max(tally.cells_most, static_cast<long>(solid.cell_count()));
  tally.genus_most = std::max(tally.genus_most, static_cast<long>(euler.genus));
  tally.genus_3 += euler.genus >= 3 ? 1 : 0;
  tally.contacts += euler.contacts ? 1 : 0;
  bool crease = false, polyhedron = false;
  for (const subdiv::EdgeId e : solid.edges()) crease = crease || solid.edge_sharpness(e) > 0;
  for (const subdiv::CellId c : solid.cells())
    polyhedron = polyhedron || subdiv::cell_kind(solid, c) != subdiv::CellKind::hexahedron;
  tally.creases += crease ? 1 : 0;
  tally.solids_of_polyhedra += polyhedron ? 1 : 0;
}

// The numbers of a message left out, so that like ones are counted together.
std::string kind_of(const std::string& message) {
  std::string kind;
  for (const char c : message)
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) kind += c;
  return kind.substr(0, 110);
}

// Some edits of one solid. Returns false if a check failed.
void edit_one_solid(std::uint32_t seed, int count, Tally& tally, const std::vector<std::string>& more = {}) {
  RandomEdits edits(seed);
  TestSession test;
  test.run({edits.beginning()});
  test.run(more);
  std::uint64_t hash = test.hash();
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const RandomEdit edit = edits.next(test.document());
    const std::string place = fmt::format("seed {}, edit {}: {}", seed, i, edit.line);
    std::size_t selections = 0;
    bool accepted = false;
    try {
      for (const std::string& line : edit.before) {
        test.run({line});
        ++selections;
      }
      hash = test.hash();
      ++tally.tools[edit.tool].tried;
      test.run({edit.line});
      accepted = true;
    } catch (const Error& error) {
      EXPECT_EQ(test.hash(), hash) << place << "\n" << error.what();
      const std::string message = error.what();
      if (message.find(';') == std::string::npos) tally.without_remedy[edit.tool + ": " + kind_of(message)] = place;
      ++tally.refusals[edit.tool + ": " + kind_of(message)];
    } catch (const std::exception& fault) {
      ADD_FAILURE() << place << "\nis a bug of ours: " << fault.what();
      return;
    }
    if (!accepted) continue;
    ++tally.tools[edit.tool].accepted;
    check_solid(test.document().solid(), place, tally);
    const std::uint64_t after = test.hash();
    test.run({"undo"});
    EXPECT_EQ(test.hash(), hash) << place;
    test.run({"redo"});
    EXPECT_EQ(test.hash(), after) << place;
    hash = after;
  }
}

// Above the control solid fields live on the refined nodes, and what cannot be refined is refused.
TEST(RandomEdits, AboveTheControlSolidToo) {
  Tally tally;
  for (std::uint32_t seed = 1; seed <= 20; ++seed)
    edit_one_solid(seed, 25, tally,
                   {"levels 1", "set density 300 + 100*x", "pin where z < 0.01", "select cells as all"});
  const Tally::Tool total = tally.total();
  fmt::print("{} of {} edits accepted\n", total.accepted, total.tried);
  for (const auto& [message, place] : tally.without_remedy)
    ADD_FAILURE() << place << "\nsays not what to do: " << message;
  EXPECT_GE(3 * total.accepted, total.tried);
}

long asked(const char* name, long otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atol(text) : otherwise;
}

TEST(RandomEdits, LeaveAWholeSolidAndAreUndoneToTheSameState) {
  const long edits = asked("ARGIL_FUZZ_EDITS", 3000);
  const auto first_seed = static_cast<std::uint32_t>(asked("ARGIL_FUZZ_SEED", 1));
  constexpr int k_edits_of_a_solid = 60;
  const long solids = (edits + k_edits_of_a_solid - 1) / k_edits_of_a_solid;
  Tally tally;
  std::mutex mutex;
  tbb::parallel_for(0L, solids, [&](long i) {
    Tally one;
    edit_one_solid(first_seed + static_cast<std::uint32_t>(i), k_edits_of_a_solid, one);
    const std::lock_guard lock(mutex);
    tally.add(one);
  });
  const Tally::Tool total = tally.total();
  fmt::print("{:<10} {:>9} {:>9}\n", "tool", "tried", "accepted");
  for (const auto& [name, tool] : tally.tools)
    fmt::print("{:<10} {:>9} {:>9} {:>5.1f} %\n", name, tool.tried, tool.accepted,
               100.0 * static_cast<double>(tool.accepted) / static_cast<double>(std::max(1L, tool.tried)));
  fmt::print("{:<10} {:>9} {:>9} {:>5.1f} %\n", "all", total.tried, total.accepted,
             100.0 * static_cast<double>(total.accepted) / static_cast<double>(total.tried));
  fmt::print(
      "solids: at most {} cells, genus up to {}; after {} edits polyhedra, {} contacts, {} creases, {} genus 3 "
      "and more\n",
      tally.cells_most, tally.genus_most, tally.solids_of_polyhedra, tally.contacts, tally.creases, tally.genus_3);
  if (std::getenv("ARGIL_FUZZ_REFUSALS"))
    for (const auto& [message, count] : tally.refusals) fmt::print("{:>7} {}\n", count, message);
  for (const auto& [message, place] : tally.without_remedy)
    ADD_FAILURE() << place << "\nsays not what to do: " << message;
  EXPECT_GE(2 * total.accepted, total.tried);
  EXPECT_EQ(tally.tools.size(), RandomEdits::tools().size());
  for (const auto& [name, tool] : tally.tools) EXPECT_GT(tool.accepted, 0) << name;
  EXPECT_GT(tally.contacts, 0);
  EXPECT_GT(tally.creases, 0);
  EXPECT_GT(tally.genus_3, 0);
  EXPECT_GT(tally.solids_of_polyhedra, 0);
  if (edits < 1000000) return;
  for (const auto& [name, tool] : tally.tools) EXPECT_GE(tool.tried, 1000) << name;
}

}  // namespace
}  // namespace argil::sculpt
