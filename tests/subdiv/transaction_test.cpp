#include "subdiv/transaction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "subdiv/boundary.h"
#include "subdiv/edit/extrude.h"
#include "subdiv/edit/remove.h"
#include "subdiv/edit/sharpen.h"
#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "subdiv/validate.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv {
namespace {

using namespace test;

std::array<std::size_t, 8> sizes(const Solid& s) {
  return {s.vertex_count(),    s.edge_count(),    s.face_count(),    s.cell_count(),
          s.vertex_capacity(), s.edge_capacity(), s.face_capacity(), s.cell_capacity()};
}

long euler(const Solid& s) {
  return static_cast<long>(s.vertex_count()) - static_cast<long>(s.edge_count()) +
         static_cast<long>(s.face_count()) - static_cast<long>(s.cell_count());
}

TEST(Transaction, BuildsACubeFromLoopsWithoutABuilder) {
  Solid solid;
  Transaction transaction(solid);
  std::vector<VertexId> v;
  for (int i = 0; i < 8; ++i) v.push_back(transaction.add_vertex());
  transaction.add_cell({{v[0], v[3], v[2], v[1]},
                        {v[4], v[5], v[6], v[7]},
                        {v[0], v[1], v[5], v[4]},
                        {v[1], v[2], v[6], v[5]},
                        {v[2], v[3], v[7], v[6]},
                        {v[3], v[0], v[4], v[7]}});
  const Delta delta = transaction.commit();
  EXPECT_THAT(sizes(solid), testing::ElementsAre(8, 12, 6, 1, 8, 12, 6, 1));
  EXPECT_THAT(validate(solid), testing::IsEmpty());
  undo(solid, delta);
  EXPECT_THAT(sizes(solid), testing::Each(0u));
  EXPECT_EQ(solid.topology_hash(), Solid{}.topology_hash());
}

TEST(Transaction, FaceThatIsThereIsFoundFromBothSides) {
  Solid solid = box_grid(1, 1, 1, {1, 1, 1}).solid;
  Transaction transaction(solid);
  const auto loop = solid.face_vertices(FaceId{0u});
  const std::vector<VertexId> rotated{loop[2], loop[3], loop[0], loop[1]},
      reversed{loop[1], loop[0], loop[3], loop[2]};
  EXPECT_EQ(transaction.add_face(rotated), face_use(FaceId{0u}, false));
  EXPECT_EQ(transaction.add_face(reversed), face_use(FaceId{0u}, true));
  EXPECT_TRUE(transaction.commit().empty());
}

TEST(Transaction, NotCommittedLeavesEverythingAsItWas) {
  Solid solid = box_grid(2, 1, 1, {1, 1, 1}).solid;
  const std::uint64_t hash = solid.topology_hash();
  const auto before = sizes(solid);
  {
    Transaction transaction(solid);
    transaction.remove_cell(CellId{0u});
    (void)extrude(transaction, std::array{FaceId{10u}}, 2);
    EXPECT_NE(solid.topology_hash(), hash);
  }
  EXPECT_EQ(solid.topology_hash(), hash);
  EXPECT_EQ(sizes(solid), before);
  EXPECT_THAT(validate(solid), testing::IsEmpty());
}

TEST(Transaction, FailedAdditionLeavesTheTransactionAsItWas) {
  Solid solid = box_grid(1, 1, 1, {1, 1, 1}).solid;
  Transaction transaction(solid);
  const VertexId apex = transaction.add_vertex();
  const std::uint64_t hash = solid.topology_hash();
  const auto before = sizes(solid);
  const auto refused = [&](const std::vector<std::vector<VertexId>>& loops, const std::string& message) {
    try {
      transaction.add_cell(loops);
      ADD_FAILURE() << "expected: " << message;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::bad_topology);
      EXPECT_THAT(error.what(), testing::HasSubstr(message));
    }
    EXPECT_EQ(solid.topology_hash(), hash);
    EXPECT_EQ(sizes(solid), before);
  };
  const VertexId a{0u}, b{1u}, c{2u}, d{3u};  // the bottom of the box is a c-d square: 0 1 3 2
  refused({{a, b, d, c}, {b, a, apex}, {d, b, apex}, {c, d, apex}}, "the cell is open");
  refused({{a, b, b}, {b, a, apex}, {a, apex, b}}, "twice");
  refused({{a, b}, {b, a, apex}, {a, apex, b}}, "at least 3 vertices");
  refused({{a, VertexId{77u}, b}, {b, a, apex}, {a, apex, b}}, "removed");
  refused({{a, c, d, b}, {a, b, apex}, {b, d, apex}, {d, c, apex}, {c, a, apex}}, "would lie in cell 0");
  transaction.add_cell({{a, b, d, c}, {b, a, apex}, {d, b, apex}, {c, d, apex}, {a, c, apex}});
  (void)transaction.commit();
  EXPECT_THAT(validate(solid), testing::IsEmpty());
}

TEST(Transaction, RemovalMayKeepWhatDangles) {
  Solid solid = box_grid(1, 1, 1, {1, 1, 1}).solid;
  Transaction transaction(solid);
  transaction.remove_cell(CellId{0u}, false);
  EXPECT_THAT(sizes(solid), testing::ElementsAre(8, 12, 6, 0, 8, 12, 6, 1));
  transaction.remove_face(FaceId{0u});
  EXPECT_THAT(validate(solid), testing::IsEmpty());
}

// Random edits of a small solid, with everything that was done on a stack.
class Fuzz {
 public:
  explicit Fuzz(unsigned seed) : random_(seed) {
    solid_ = seed % 3 == 0   ? build(dodecahedron()).solid
             : seed % 3 == 1 ? build(ring()).solid
                             : box_grid(2, 2, 2, {1, 1, 1}).solid;
    first_hash_ = solid_.topology_hash();
    first_sizes_ = sizes(solid_);
  }

  void edit() {
    const unsigned kind = below(10);
    const std::uint64_t hash = solid_.topology_hash();
    if (kind < 3 && solid_.cell_count() < 60) {
      commit(hash, [&](Transaction& t) { grow(t); });
    } else if (kind < 5) {
      commit(hash, [&](Transaction& t) { shrink(t); });
    } else if (kind < 6) {
      commit(hash, [&](Transaction& t) { sharpen_some(t); });
    } else if (kind < 7) {
      Transaction abandoned(solid_);
      grow(abandoned);
      shrink(abandoned);
      sharpen_some(abandoned);
      abandoned.roll_back();
      ASSERT_EQ(solid_.topology_hash(), hash);
    } else {
      travel(static_cast<int>(below(6)) - 3);
    }
    ASSERT_THAT(validate(solid_), testing::IsEmpty());
    check_surface();
  }

  void undo_and_redo_everything() {
    travel(static_cast<int>(done_.size() - at_));
    const std::uint64_t last = solid_.topology_hash();
    const auto last_sizes = sizes(solid_);
    travel(-static_cast<int>(at_));
    EXPECT_EQ(solid_.topology_hash(), first_hash_);
    EXPECT_EQ(sizes(solid_), first_sizes_);
    EXPECT_THAT(validate(solid_), testing::IsEmpty());
    travel(static_cast<int>(done_.size()));
    EXPECT_EQ(solid_.topology_hash(), last);
    EXPECT_EQ(sizes(solid_), last_sizes);
    EXPECT_THAT(validate(solid_), testing::IsEmpty());
  }

 private:
  struct Done {
    Delta delta;
    std::uint64_t before, after;
  };

  unsigned below(unsigned n) { return static_cast<unsigned>(random_() % n); }

  template <class Edit>
  void commit(std::uint64_t before, Edit edit) {
    done_.resize(at_);
    Transaction transaction(solid_);
    edit(transaction);
    done_.push_back({transaction.commit(), before, solid_.topology_hash()});
    ++at_;
  }

  template <class IdType, class Range, class Keep>
  std::vector<IdType> sample(Range range, unsigned one_in, Keep keep) {
    std::vector<IdType> result;
    for (const IdType id : range)
      if (keep(id) && below(one_in) == 0) result.push_back(id);
    return result;
  }

  void grow(Transaction& t) {
    auto faces = sample<FaceId>(solid_.faces(), 1 + below(20), [&](FaceId f) { return solid_.is_boundary(f); });
    if (faces.size() > 12) faces.resize(12);
    if (faces.empty()) return;
    std::shuffle(faces.begin(), faces.end(), random_);
    const long before = euler(solid_);
    const std::uint64_t hash = solid_.topology_hash();
    try {
      (void)extrude(t, faces, 1 + static_cast<int>(below(2)));
      // What grows is the region times an interval: it can be pressed back into the region.
      EXPECT_EQ(euler(solid_), before);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::bad_topology);
      EXPECT_EQ(solid_.topology_hash(), hash);
    }
  }
  void shrink(Transaction& t) {
    remove_cells(t, sample<CellId>(solid_.cells(), 1 + below(8) + (solid_.cell_count() < 4 ? 8 : 0),
                                   [](CellId) { return true; }));
  }
  void sharpen_some(Transaction& t) {
    const double sharpness = below(3) ? k_infinitely_sharp : 0;
    sharpen(t, sample<EdgeId>(solid_.edges(), 5, [&](EdgeId e) { return solid_.is_boundary(e); }), sharpness);
    sharpen(t, sample<VertexId>(solid_.vertices(), 5, [&](VertexId v) { return solid_.is_boundary(v); }),
            sharpness);
  }

  void travel(int steps) {
    for (; steps < 0 && at_ > 0; ++steps) {
      --at_;
      undo(solid_, done_[at_].delta);
      ASSERT_EQ(solid_.topology_hash(), done_[at_].before);
    }
    for (; steps > 0 && at_ < done_.size(); --steps) {
      redo(solid_, done_[at_].delta);
      ASSERT_EQ(solid_.topology_hash(), done_[at_].after);
      ++at_;
    }
  }

  // The Euler characteristic of the boundary is twice that of the solid wherever the boundary is a manifold.
  void check_surface() {
    const BoundarySurface surface = boundary_surface(solid_);
    ASSERT_GE(surface.genus, 0);
    for (std::size_t i = 1; i < surface.vertex_from_surface.size(); ++i)
      if (surface.vertex_from_surface[i] == surface.vertex_from_surface[i - 1]) return;
    for (const EdgeId e : solid_.edges()) {
      int boundary_faces = 0;
      solid_.for_each_face(e, [&](FaceId f) { boundary_faces += solid_.is_boundary(f); });
      if (boundary_faces > 2) return;
    }
    ASSERT_EQ(2 * static_cast<long>(surface.component_count) - 2 * surface.genus, 2 * euler(solid_));
    ++manifold_count;
  }

  std::mt19937 random_;
  Solid solid_;
  std::uint64_t first_hash_;
  std::array<std::size_t, 8> first_sizes_;
  std::vector<Done> done_;
  std::size_t at_ = 0;

 public:
  int manifold_count = 0;
};

TEST(Transaction, TwentyThousandRandomEditsStayValidAndUndo) {
  int manifold_count = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    Fuzz fuzz(seed);
    for (int i = 0; i < 50 && !testing::Test::HasFailure(); ++i) fuzz.edit();
    fuzz.undo_and_redo_everything();
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
    manifold_count += fuzz.manifold_count;
  }
  EXPECT_GT(manifold_count, 2000) << "else the relation of Euler is hardly tested";
}

}  // namespace
}  // namespace argil::subdiv
