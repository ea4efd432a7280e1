#pragma once
// What every test of an edit asks: the solid stays valid, undo and redo come back to the same bits, positions
// follow.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/edit/edit.h"
#include "subdiv/edit/rewrite.h"
#include "subdiv/error.h"
#include "subdiv/solid_measures.h"
#include "subdiv/validate.h"

namespace argil::subdiv::test {

inline Eigen::Vector3d point(const Eigen::Matrix3Xd& positions, VertexId v) {
  return positions.col(static_cast<Eigen::Index>(v.index()));
}

/// Positions after an edit, as a session places them.
inline Eigen::Matrix3Xd placed(const Solid& solid, const Eigen::Matrix3Xd& before, const Edit& edit) {
  Eigen::Matrix3Xd after = before;
  after.conservativeResize(3, static_cast<Eigen::Index>(solid.vertex_capacity()));
  for (Eigen::Index i = before.cols(); i < after.cols(); ++i) after.col(i).setConstant(std::nan(""));
  for (const PlacedVertex& p : edit.placed) {
    Eigen::Vector3d at = p.offset;
    double weights = 0;
    for (const auto& [source, weight] : p.sources) {
      EXPECT_LT(source.index(), static_cast<std::size_t>(before.cols())) << "a source that was not there before";
      at += weight * point(before, source);
      weights += weight;
    }
    EXPECT_NEAR(weights, 1, 1e-12);
    after.col(static_cast<Eigen::Index>(p.vertex.index())) = at;
  }
  return after;
}

inline double volume(const Solid& solid, const Eigen::Matrix3Xd& positions) {
  double sum = 0;
  for (const CellId c : solid.cells()) sum += cell_volume(solid, positions, c);
  return sum;
}

inline void expect_valid(const Solid& solid) {
  EXPECT_THAT(validate(solid), testing::IsEmpty());
  for (const VertexId v : solid.vertices()) EXPECT_EQ(link_fault(solid, v), "");
}

/// Does it, undoes it and does it again; moves the positions. @throws what `edit` throws, after the roll back.
template <class Do>
Edit edited(Solid& solid, Eigen::Matrix3Xd& positions, Do edit) {
  const std::uint64_t before = solid.topology_hash();
  Edit made;
  Delta delta;
  try {
    Transaction transaction(solid);
    made = edit(transaction, positions);
    delta = transaction.commit();
  } catch (const Error& error) {
    EXPECT_EQ(solid.topology_hash(), before) << error.what();
    throw;
  }
  const std::uint64_t after = solid.topology_hash();
  undo(solid, delta);
  EXPECT_EQ(solid.topology_hash(), before);
  redo(solid, delta);
  EXPECT_EQ(solid.topology_hash(), after);
  expect_valid(solid);
  positions = placed(solid, positions, made);
  return made;
}

/// The code of what an edit throws.
template <class Do>
ErrorCode fault(Solid& solid, const Eigen::Matrix3Xd& positions, Do edit) {
  Eigen::Matrix3Xd unmoved = positions;
  try {
    (void)edited(solid, unmoved, edit);
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "accepted";
  return ErrorCode::refused;
}

}  // namespace argil::subdiv::test
