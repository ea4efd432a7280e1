#pragma once
// Edits as transactions of inverse deltas: what a transaction did is recorded as a Delta that undoes and redoes it
// at a cost that grows with the edit, not with the solid. A transaction that is not committed leaves the solid as
// it was, the allocator of ids and the topology hash included.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "subdiv/solid.h"

namespace argil::subdiv {

/// What one transaction did, in order. Opaque; hand it to undo() and redo() of the solid that it came from.
class Delta {
 public:
  bool empty() const { return steps_.empty(); }
  std::size_t memory() const {
    return steps_.capacity() * sizeof(Step) + payload_.capacity() * sizeof(std::uint32_t);
  }

 private:
  friend class Transaction;
  enum class Kind : std::uint8_t {
    add_vertex,
    add_edge,
    add_face,
    add_cell,
    remove_vertex,
    remove_edge,
    remove_face,
    remove_cell,
    edge_sharpness,
    vertex_sharpness,
    face_sharpness
  };
  struct Step {
    Kind kind;
    std::uint32_t id;
    std::size_t payload_begin = 0, payload_end = 0;  // what an addition was made of
    double before = 0, after = 0;                    // sharpness
  };
  std::vector<Step> steps_;
  std::vector<std::uint32_t> payload_;
};

class Transaction {
 public:
  explicit Transaction(Solid& solid) : solid_(&solid) {}
  ~Transaction();  // rolls back what was not committed
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  const Solid& solid() const { return *solid_; }
  /// Whether nothing has been changed yet.
  bool empty() const { return delta_.empty(); }

  VertexId add_vertex();
  /// The edge between two vertices, added if there is none.
  EdgeId add_edge(VertexId a, VertexId b);
  /// The face with this loop, added (with its edges) if there is none; the use whose loop is `loop`.
  /// @throws Error (bad_topology) for fewer than 3 vertices, a repeated or a dead one.
  FaceUseId add_face(std::span<const VertexId> loop);
  /// A cell from uses that no cell owns. @throws Error (bad_topology) if they do not close to one sphere, or one is
  /// owned; the transaction is then as it was before the call.
  CellId add_cell(std::span<const FaceUseId> uses);
  /// Adds the faces as well: each loop is seen counter-clockwise from outside the cell. Throws as above.
  CellId add_cell(const std::vector<std::vector<VertexId>>& loops);

  /// Removes a cell and, with `dangling`, the faces, edges and vertices that no cell holds any more.
  void remove_cell(CellId c, bool dangling = true);
  void remove_face(FaceId f);      // owned by no cell
  void remove_edge(EdgeId e);      // of no face
  void remove_vertex(VertexId v);  // of no edge

  /// 0 (smooth) to k_infinitely_sharp.
  void set_sharpness(EdgeId e, double sharpness);
  void set_sharpness(VertexId v, double sharpness);
  void set_sharpness(FaceId f, double sharpness);

  /// Ends the transaction and returns what it did.
  [[nodiscard]] Delta commit();
  /// Ends it by taking everything back.
  void roll_back();

  /// `solid` must be as the delta left it (undo) or found it (redo); asserted where that shows.
  static void undo(Solid& solid, const Delta& delta);
  static void redo(Solid& solid, const Delta& delta);

 private:
  Delta::Step& record(Delta::Kind kind, std::uint32_t id);
  void take_back_to(std::size_t step_count);
  static void undo_step(Solid& solid, const Delta::Step& step);
  static void redo_step(Solid& solid, const Delta::Step& step, std::span<const std::uint32_t> payload);
  static void assign_sharpness(Solid& solid, EdgeId e, double sharpness);
  static void assign_sharpness(Solid& solid, VertexId v, double sharpness);
  static void assign_sharpness(Solid& solid, FaceId f, double sharpness);
  template <class IdType>
  void change_sharpness(Delta::Kind kind, IdType id, double before, double after);

  Solid* solid_;
  Delta delta_;
};

inline void undo(Solid& solid, const Delta& delta) {
  Transaction::undo(solid, delta);
}
inline void redo(Solid& solid, const Delta& delta) {
  Transaction::redo(solid, delta);
}

}  // namespace argil::subdiv
