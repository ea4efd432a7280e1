#pragma once
// A solid in space that edits are tried on as a session does it; everything that any edit promises is checked.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "subdiv/edit/edit.h"
#include "subdiv/edit/rewrite.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"
#include "subdiv/solid_measures.h"
#include "subdiv/validate.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv::test {

struct EditModel {
  using Tool = std::function<Edit(Transaction&, const Eigen::Matrix3Xd&)>;

  explicit EditModel(Built built) : solid(std::move(built.solid)), positions(std::move(built.positions)) {}
  EditModel(Solid of, Eigen::Matrix3Xd at) : solid(std::move(of)), positions(std::move(at)) {}

  Eigen::Vector3d at(VertexId v) const { return positions.col(static_cast<Eigen::Index>(v.index())); }
  VertexId vertex_at(const Eigen::Vector3d& p) const {
    for (const VertexId v : solid.vertices())
      if ((at(v) - p).norm() < 1e-12) return v;
    ADD_FAILURE() << "no vertex at " << p.transpose();
    return VertexId{};
  }
  EdgeId edge(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    return solid.find_edge(vertex_at(a), vertex_at(b)).value();
  }
  Eigen::Vector3d middle(std::span<const VertexId> vertices) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const VertexId v : vertices) sum += at(v);
    return sum / static_cast<double>(vertices.size());
  }
  std::vector<FaceId> boundary_faces(const std::function<bool(const Eigen::Vector3d&)>& where) const {
    std::vector<FaceId> result;
    for (const FaceId f : solid.faces())
      if (solid.is_boundary(f) && where(middle(solid.face_vertices(f)))) result.push_back(f);
    return result;
  }
  FaceId face_at(const Eigen::Vector3d& p) const {
    const auto found = boundary_faces([&](const Eigen::Vector3d& m) { return (m - p).norm() < 1e-12; });
    EXPECT_EQ(found.size(), 1u) << "boundary faces at " << p.transpose();
    return found.empty() ? FaceId{} : found[0];
  }
  double volume() const { return mass_properties(solid, positions).volume; }

  /// Runs the tool, checks what it left and said, and that it can be undone and redone.
  Edit apply(const Tool& tool) {
    const Solid old = solid;
    Transaction transaction(solid);
    const Edit edit = tool(transaction, positions);
    const Delta delta = transaction.commit();
    check(old, edit);
    const std::uint64_t after = solid.topology_hash();
    undo(solid, delta);
    EXPECT_EQ(solid.topology_hash(), old.topology_hash());
    redo(solid, delta);
    EXPECT_EQ(solid.topology_hash(), after);
    place(edit);
    return edit;
  }
  /// The message of the refusal; nothing may change.
  std::string refusal(const Tool& tool) {
    const std::uint64_t before = solid.topology_hash();
    std::string message;
    try {
      Transaction transaction(solid);
      (void)tool(transaction, positions);
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      message = error.what();
    }
    EXPECT_EQ(solid.topology_hash(), before);
    EXPECT_THAT(validate(solid), testing::IsEmpty());
    return message;
  }

  Solid solid;
  Eigen::Matrix3Xd positions;

 private:
  void check(const Solid& old, const Edit& edit) const {
    EXPECT_THAT(validate(solid), testing::IsEmpty());
    for (const VertexId v : solid.vertices()) EXPECT_EQ(link_fault(solid, v), "");
    std::vector<int> placed(solid.vertex_capacity(), 0);
    for (const PlacedVertex& p : edit.placed) {
      EXPECT_TRUE(solid.is_live(p.vertex));
      ++placed[p.vertex.index()];
      double sum = 0;
      for (const auto& [source, weight] : p.sources) {
        EXPECT_TRUE(old.is_live(source));
        sum += weight;
      }
      EXPECT_NEAR(sum, 1, 1e-14);
    }
    for (const VertexId v : solid.vertices())
      EXPECT_EQ(placed[v.index()] > 0 || v.index() < old.vertex_capacity(), true) << "not placed: " << v.value;
    EXPECT_LE(*std::max_element(placed.begin(), placed.end()), 1);
    for (const auto& [kept, gone] : edit.merged)
      EXPECT_TRUE(solid.is_live(kept) && !solid.is_live(gone) && old.is_live(gone));
    check_descent(old, edit.edges);
    check_descent(old, edit.faces);
    check_descent(old, edit.cells);
  }
  template <class IdType>
  void check_descent(const Solid& old, const std::vector<Descent<IdType>>& descent) const {
    for (const auto& [made, source] : descent) EXPECT_TRUE(solid.is_live(made) && old.is_live(source));
  }
  void place(const Edit& edit) {
    const Eigen::Matrix3Xd old = positions;
    positions.conservativeResize(3, static_cast<Eigen::Index>(solid.vertex_capacity()));
    for (Eigen::Index i = old.cols(); i < positions.cols(); ++i) positions.col(i).setZero();
    for (const PlacedVertex& p : edit.placed) {
      Eigen::Vector3d sum = p.offset;
      for (const auto& [source, weight] : p.sources)
        sum += weight * old.col(static_cast<Eigen::Index>(source.index()));
      positions.col(static_cast<Eigen::Index>(p.vertex.index())) = sum;
    }
  }
};

}  // namespace argil::subdiv::test
