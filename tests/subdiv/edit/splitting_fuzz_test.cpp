// Random splitting and growing on the catalogue of nasty shapes: each operation leaves a valid solid that undoes
// and redoes to the same bits, or is an Error that leaves it as it was; splitting and cutting keep the volume of
// cells with planar faces. ARGIL_FUZZ_EDITS asks for more.

#include <cstdlib>
#include <random>

#include "subdiv/edit/cut_face.h"
#include "subdiv/edit/cut_plane.h"
#include "subdiv/edit/cut_ring.h"
#include "subdiv/edit/peak.h"
#include "subdiv/edit/remove.h"
#include "subdiv/edit/split_cells.h"
#include "subdiv/edit/sweep.h"
#include "subdiv/primitives.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/edit/edited.h"

namespace argil::subdiv {
namespace {

using namespace test;

enum class Kinds { splitting, all };

class RandomEdits {
 public:
  RandomEdits(Solid solid, Eigen::Matrix3Xd positions, std::uint32_t seed)
      : solid_(std::move(solid)), positions_(std::move(positions)), random_(seed) {}

  /// True if it was done, false if it was refused.
  bool step(Kinds kinds) {
    try {
      const std::uint32_t kind = pick(kinds == Kinds::all ? 8 : 4);
      (void)edited(solid_, positions_,
                   [&](Transaction& t, const Eigen::Matrix3Xd& rest) { return run(kind, t, rest); });
      return true;
    } catch (const Error& error) {
      EXPECT_FALSE(std::string(error.what()).empty());
      return false;
    }
  }
  const Solid& solid() const { return solid_; }
  double total() const { return volume(solid_, positions_); }

 private:
  std::uint32_t pick(std::size_t count) { return static_cast<std::uint32_t>(random_() % count); }
  double number() { return static_cast<double>(random_()) / 4294967295.0; }
  template <class Range>
  auto some(Range live, std::size_t most) {
    std::vector<std::decay_t<decltype(*live.begin())>> all(live.begin(), live.end()), chosen;
    for (std::size_t i = 0, count = 1 + pick(most); i < count && !all.empty(); ++i) {
      const std::uint32_t at = pick(all.size());
      chosen.push_back(all[at]);
      all.erase(all.begin() + at);
    }
    return chosen;
  }
  std::vector<FaceId> some_boundary(std::size_t most) {
    std::vector<FaceId> faces;
    for (const FaceId f : some(solid_.faces(), 3 * most))
      if (solid_.is_boundary(f) && faces.size() < most) faces.push_back(f);
    return faces;
  }

  Edit run(std::uint32_t kind, Transaction& t, const Eigen::Matrix3Xd& rest) {
    switch (kind) {
      case 0:
        return split_cells(t, some(solid_.cells(), 2));
      case 1: {
        const Eigen::Vector3d normal(number() - 0.5, number() - 0.5, pick(2) ? 0 : number() - 0.5);
        const auto cells = some(solid_.cells(), 6);
        const auto anchor = some(solid_.vertices(), 1)[0];
        Eigen::Vector3d at = point(rest, anchor);
        if (pick(2)) at = (at + point(rest, some(solid_.vertices(), 1)[0])) / 2;
        return cut_plane(t, rest, cells, {normal, at}, pick(2) ? 1e-9 : 0.02);
      }
      case 2: {
        const FaceId face = some(solid_.faces(), 1)[0];
        const auto loop = solid_.face_vertices(face);
        return cut_face(t, face, loop[pick(loop.size())], loop[pick(loop.size())]);
      }
      case 3:
        return cut_rings(t, some(solid_.edges(), 2), pick(2) ? 0.5 : 0.1 + 0.8 * number());
      case 4:
      case 5: {
        Sweep how;
        how.way = static_cast<Sweep::Way>(pick(3));
        how.vector = {number() - 0.5, number() - 0.5, number() - 0.5};
        how.distance = number();
        how.path = {{number(), number(), 3 * number()}, {3 * number(), number(), 3}};
        how.curve = pick(2) != 0;
        how.steps = 1 + static_cast<int>(pick(3));
        how.scale = 0.5 + number();
        how.twist = pick(2) ? number() : 0;
        return sweep(t, rest, some_boundary(3), how);
      }
      case 6:
        return raise_peaks(t, rest, some_boundary(2), 0.1);
      default:
        if (solid_.cell_count() > 3) remove_cells(t, some(solid_.cells(), 1));
        return {};
    }
  }

  Solid solid_;
  Eigen::Matrix3Xd positions_;
  std::mt19937 random_;
};

int fuzz_edits() {
  const char* more = std::getenv("ARGIL_FUZZ_EDITS");
  return more ? std::atoi(more) : 2000;
}

TEST(SplittingFuzz, RandomEditsOfNastyShapesStayValid) {
  const int wanted = fuzz_edits();
  int done = 0, refused = 0;
  for (std::uint32_t seed = 1; done + refused < wanted; ++seed)
    for (Shape& shape : catalogue()) {
      SCOPED_TRACE(shape.name + ", seed " + std::to_string(seed));
      RandomEdits edits(std::move(shape.solid), std::move(shape.positions), seed);
      for (int i = 0; i < 12 && edits.solid().cell_count() < 150; ++i) ++(edits.step(Kinds::all) ? done : refused);
      if (testing::Test::HasFailure() || done + refused >= wanted) break;
    }
  EXPECT_GT(done, refused) << "most of what is tried should work";
}

TEST(SplittingFuzz, SplittingAndCuttingKeepTheVolumeOfPlanarCells) {
  const int wanted = fuzz_edits() / 2;
  int count = 0;
  for (std::uint32_t seed = 1; count < wanted; ++seed)
    for (const Built& built : {box_grid(2, 2, 2, {1, 2, 1}), build(dodecahedron()), build(cube_of_pyramids()),
                               build(hanging_nodes()), tetrahedron({1, 1, 1}), wedge({1, 1, 1}), build(ring())}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(built.solid.vertex_count()) +
                   " vertices");
      RandomEdits edits(built.solid, built.positions, seed);
      const double before = edits.total();
      for (int i = 0; i < 6 && edits.solid().cell_count() < 150; ++i, ++count) (void)edits.step(Kinds::splitting);
      // Vertices within the coarse tolerance are cut through where they stand: faces bend by less than that.
      EXPECT_NEAR(edits.total(), before, 1e-12 * before);
      if (testing::Test::HasFailure()) return;
    }
}

}  // namespace
}  // namespace argil::subdiv
