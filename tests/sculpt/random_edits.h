#pragma once
// Random edits that a designer might make: each a few lines that select, and one that edits, at places that the
// solid at hand offers. The same seed gives the same edits.

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "sculpt/document.h"

namespace argil::sculpt {

struct RandomEdit {
  std::string tool;                 // the command's name
  std::vector<std::string> before;  // selections
  std::string line;
};

class RandomEdits {
 public:
  explicit RandomEdits(std::uint32_t seed) : random_(seed) {}

  /// A base shape, or two.
  std::string beginning();
  /// The next edit of a solid.
  RandomEdit next(const Document& document);

  /// Every tool that `next` uses.
  static std::vector<std::string> tools();

 private:
  using Solid = subdiv::Solid;
  std::uint32_t pick(std::size_t n) { return static_cast<std::uint32_t>(random_() % n); }
  double number(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
  }
  std::string vector(double low, double high);
  std::string direction();
  std::string at(const Eigen::Vector3d& place) const;
  Eigen::Vector3d middle(std::span<const subdiv::VertexId> vertices) const;
  std::string point(const Eigen::Vector3d& p) const;
  template <class Range, class Fits>
  auto random_element(const Range& range, Fits fits);
  std::vector<subdiv::FaceId> boundary_faces() const;
  std::vector<subdiv::FaceId> near_pair();
  std::string faces(const std::vector<subdiv::FaceId>& chosen) const;
  std::string cells(std::size_t count);

  RandomEdit extrude();
  RandomEdit remove();
  RandomEdit cut();
  RandomEdit collapse();
  RandomEdit fill();
  RandomEdit sharpen();
  RandomEdit mirror();

  std::mt19937 random_;
  const Document* document_ = nullptr;
};

}  // namespace argil::sculpt
