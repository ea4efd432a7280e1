#pragma once
// Distinct types for the elements of a solid, and arrays that accept only their own kind of id.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace argil::subdiv {

template <class Tag>
struct Id {
  static constexpr std::uint32_t k_invalid = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t value = k_invalid;

  constexpr Id() = default;
  constexpr explicit Id(std::size_t index) : value(static_cast<std::uint32_t>(index)) {}
  constexpr bool valid() const { return value != k_invalid; }
  constexpr std::size_t index() const { return value; }
  friend constexpr auto operator<=>(const Id&, const Id&) = default;
};

using VertexId = Id<struct VertexTag>;
using EdgeId = Id<struct EdgeTag>;
using FaceId = Id<struct FaceTag>;
using CellId = Id<struct CellTag>;
/// One side of a face: 2 * face + (0 front, 1 back). The cell that owns the front use sees the stored loop from
/// outside.
using FaceUseId = Id<struct FaceUseTag>;

constexpr FaceUseId face_use(FaceId face, bool back) {
  return FaceUseId{2 * face.index() + (back ? 1 : 0)};
}
constexpr FaceId face_of(FaceUseId use) {
  return FaceId{use.index() / 2};
}
constexpr bool is_back(FaceUseId use) {
  return (use.value & 1U) != 0;
}
constexpr FaceUseId other_side(FaceUseId use) {
  return FaceUseId{use.index() ^ 1U};
}

/// An array indexed by one kind of id only.
template <class IdType, class T>
class ElementData {
 public:
  ElementData() = default;
  explicit ElementData(std::size_t size, const T& value = T{}) : values_(size, value) {}
  decltype(auto) operator[](IdType id) { return values_[id.index()]; }
  decltype(auto) operator[](IdType id) const { return values_[id.index()]; }
  std::size_t size() const { return values_.size(); }
  void resize(std::size_t size, const T& value = T{}) { values_.resize(size, value); }
  void push_back(const T& value) { values_.push_back(value); }
  const std::vector<T>& raw() const { return values_; }
  std::vector<T>& raw() { return values_; }
  friend bool operator==(const ElementData&, const ElementData&) = default;

 private:
  std::vector<T> values_;
};

template <class T>
using VertexData = ElementData<VertexId, T>;
template <class T>
using EdgeData = ElementData<EdgeId, T>;
template <class T>
using FaceData = ElementData<FaceId, T>;
template <class T>
using CellData = ElementData<CellId, T>;

}  // namespace argil::subdiv

template <class Tag>
struct std::hash<argil::subdiv::Id<Tag>> {
  std::size_t operator()(argil::subdiv::Id<Tag> id) const { return std::hash<std::uint32_t>{}(id.value); }
};
