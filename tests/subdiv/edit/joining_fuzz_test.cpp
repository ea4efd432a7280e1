#include <algorithm>
#include <array>
#include <map>
#include <random>

#include "subdiv/edit/bridge.h"
#include "subdiv/edit/collapse.h"
#include "subdiv/edit/extrude.h"
#include "subdiv/edit/fill.h"
#include "subdiv/edit/merge.h"
#include "subdiv/edit/regions.h"
#include "subdiv/edit/weld.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/edit/edit_model.h"

namespace argil::subdiv {
namespace {

using namespace test;

class RandomEdits {
 public:
  RandomEdits(EditModel& model, unsigned seed, std::map<std::string, int>& accepted)
      : model_(model), random_(seed), accepted_(accepted) {}

  void one() {
    const Solid& solid = model_.solid;
    if (solid.cell_count() > 40) return thin_out();
    switch (below(8)) {
      case 0:
        return run("merge", [&](Transaction& t, const Eigen::Matrix3Xd& p) {
          const auto [a, b] = regions();
          return merge(t, p, a, b, static_cast<MergeAt>(below(3)));
        });
      case 1:
        lay_a_face_on_another();
        return run("weld", [&](Transaction& t, const Eigen::Matrix3Xd& p) {
          Weld done = weld(t, p, every(solid.vertices()), below(4) == 0 ? 0.2 : 1e-9);
          if (done.vertices_gone == 0) throw Error(ErrorCode::bad_input, "nothing to weld");
          return done.edit;
        });
      case 2:
        return run("bridge", [&](Transaction& t, const Eigen::Matrix3Xd& p) {
          const auto [a, b] = regions();
          return bridge(t, p, a, b,
                        {static_cast<int>(1 + below(2)), static_cast<int>(below(3)) - 1, below(2) == 0});
        });
      case 3:
        return run("collapse edges", [&](Transaction& t, const Eigen::Matrix3Xd&) {
          return collapse(t, some(every(solid.edges()), 1 + below(3)));
        });
      case 4:
        return run("collapse faces", [&](Transaction& t, const Eigen::Matrix3Xd&) {
          return collapse(t, some(every(solid.faces()), 1));
        });
      case 5:
        return run("collapse cells", [&](Transaction& t, const Eigen::Matrix3Xd&) {
          return collapse(t, some(every(solid.cells()), 1));
        });
      case 6:
        return run("fill", [&](Transaction& t, const Eigen::Matrix3Xd& p) { return fill(t, p, around()); });
      default:
        return below(3) == 0 ? thin_out() : grow();
    }
  }

 private:
  std::size_t below(std::size_t n) { return random_() % n; }

  template <class IdType>
  static std::vector<IdType> every(const Solid::LiveRange<IdType>& range) {
    std::vector<IdType> ids;
    for (const IdType id : range) ids.push_back(id);
    return ids;
  }
  template <class IdType>
  std::vector<IdType> some(const std::vector<IdType>& from, std::size_t count) {
    std::vector<IdType> ids;
    for (std::size_t i = 0; i < count && !from.empty(); ++i) ids.push_back(from[below(from.size())]);
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }
  std::vector<FaceId> boundary() const {
    return model_.boundary_faces([](const Eigen::Vector3d&) { return true; });
  }
  // Two faces, or two faces with a neighbour each.
  std::array<std::vector<FaceId>, 2> regions() {
    std::array<std::vector<FaceId>, 2> result{some(boundary(), 1), some(boundary(), 1)};
    if (below(3) > 0) return result;
    for (auto& region : result) {
      const auto near = boundary_about(model_.solid.face_vertices(region[0]));
      const FaceId other = near[below(near.size())];
      if (other != region[0]) region.push_back(other);
    }
    return result;
  }
  std::vector<FaceId> boundary_about(std::span<const VertexId> vertices) const {
    std::vector<FaceId> faces;
    for (const VertexId v : vertices)
      for (const FaceId f : vertex_faces(model_.solid, v))
        if (model_.solid.is_boundary(f)) faces.push_back(f);
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }
  std::vector<FaceId> around() {
    const FaceId seed = some(boundary(), 1)[0];
    auto near = boundary_about(model_.solid.face_vertices(seed).first(1 + below(2)));
    std::erase_if(near, [&](FaceId) { return below(4) == 0; });
    return near;
  }

  void lay_a_face_on_another() {
    const auto here = model_.solid.face_vertices(some(boundary(), 1)[0]);
    const auto there = model_.solid.face_vertices(some(boundary(), 1)[0]);
    for (std::size_t i = 0; i < std::min(here.size(), there.size()); ++i)
      model_.positions.col(static_cast<Eigen::Index>(here[i].index())) =
          Eigen::Vector3d(model_.at(there[there.size() - 1 - i]));
  }

  void thin_out() {
    if (model_.solid.cell_count() < 2) return;
    run("remove", [&](Transaction& t, const Eigen::Matrix3Xd&) {
      for (const CellId c : some(every(model_.solid.cells()), 1 + model_.solid.cell_count() / 6)) t.remove_cell(c);
      for (const VertexId v : t.solid().vertices())
        if (!link_fault(t.solid(), v).empty()) throw Error(ErrorCode::bad_topology, "a ring about a vertex");
      return Edit{};
    });
  }
  void grow() {
    run("extrude", [&](Transaction& t, const Eigen::Matrix3Xd&) {
      const Extrusion grown = extrude(t, some(boundary(), 1 + below(3)), 1);
      Edit edit;
      for (std::size_t i = 0; i < grown.new_vertices.size(); ++i)
        edit.placed.push_back({grown.new_vertices[i], {{grown.source_of_new[i], 1.0}}, shift()});
      for (const VertexId v : grown.new_vertices)
        if (!link_fault(t.solid(), v).empty()) throw Error(ErrorCode::bad_topology, "a ring about a vertex");
      return edit;
    });
  }
  Eigen::Vector3d shift() {
    Eigen::Vector3d by;
    for (double& x : by) x = static_cast<double>(below(2001)) / 1000 - 1;
    return by;
  }

  void run(const std::string& name, const EditModel::Tool& tool) {
    SCOPED_TRACE(name);
    const std::uint64_t before = model_.solid.topology_hash();
    try {
      model_.apply(tool);
      ++accepted_[name];
    } catch (const Error& error) {
      EXPECT_EQ(model_.solid.topology_hash(), before) << error.what();
      EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("a new cell would lie in")));
    }
  }

  EditModel& model_;
  std::mt19937 random_;
  std::map<std::string, int>& accepted_;
};

std::map<std::string, int> accepted_edits(unsigned first_seed, unsigned seeds, int edits) {
  std::map<std::string, int> accepted;
  for (unsigned seed = first_seed; seed < first_seed + seeds; ++seed)
    for (const Shape& shape : catalogue()) {
      EditModel model(shape.solid, shape.positions);
      RandomEdits random(model, seed, accepted);
      for (int i = 0; i < edits && !testing::Test::HasFailure(); ++i) {
        SCOPED_TRACE(shape.name + ", seed " + std::to_string(seed) + ", edit " + std::to_string(i));
        random.one();
      }
    }
  return accepted;
}

TEST(JoiningFuzz, RandomEditsLeaveValidSolidsAndCanBeUndone) {
  const auto accepted = accepted_edits(1, 3, 40);
  // So that the random choices keep meeting what the tools take.
  for (const char* tool : {"merge", "weld", "bridge", "collapse edges", "collapse faces", "collapse cells", "fill"})
    EXPECT_GE(accepted.count(tool) ? accepted.at(tool) : 0, 20) << tool;
}

}  // namespace
}  // namespace argil::subdiv
