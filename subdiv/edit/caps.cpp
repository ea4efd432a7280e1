#include "subdiv/edit/caps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace argil::subdiv {

namespace {

using Loop = std::vector<VertexId>;

constexpr std::size_t k_longest = 24;
constexpr int k_most_chords = 3, k_most_trials = 100000;
constexpr double k_flat = 0.1;  // distance from the mean plane, in diameters

struct Division {
  std::vector<Loop> pieces;
  double volume = 0;  // six times, under the pieces, from a fixed point
};

class Divider {
 public:
  Divider(const Solid& solid, const Eigen::Matrix3Xd& positions, const Loop& loop)
      : solid_(solid), positions_(positions), origin_(mean(loop)) {}

  // The best division by exactly so many chords.
  std::optional<Division> divide(const Loop& loop, int chords) {
    if (++trials_ > k_most_trials) return {};
    if (chords == 0) {
      if (!flat(loop)) return {};
      return Division{{loop}, volume(loop)};
    }
    std::optional<Division> best;
    for (std::size_t i = 0; i < loop.size(); ++i)
      for (std::size_t j = i + 2; j < loop.size() && j < i + loop.size() - 1; ++j) {
        if (solid_.find_edge(loop[i], loop[j])) continue;
        const Loop inner(loop.begin() + static_cast<long>(i), loop.begin() + static_cast<long>(j) + 1);
        Loop outer(loop.begin() + static_cast<long>(j), loop.end());
        outer.insert(outer.end(), loop.begin(), loop.begin() + static_cast<long>(i) + 1);
        for (int here = 0; here < chords; ++here) {
          auto a = divide(inner, here);
          if (!a) continue;
          const auto b = divide(outer, chords - 1 - here);
          if (!b || (best && a->volume + b->volume <= best->volume + 1e-9 * std::abs(best->volume))) continue;
          a->pieces.insert(a->pieces.end(), b->pieces.begin(), b->pieces.end());
          a->volume += b->volume;
          best = std::move(a);
        }
      }
    return best;
  }

 private:
  Eigen::Vector3d at(VertexId v) const { return positions_.col(static_cast<Eigen::Index>(v.index())); }
  Eigen::Vector3d mean(const Loop& loop) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const VertexId v : loop) sum += at(v);
    return sum / static_cast<double>(loop.size());
  }
  bool flat(const Loop& loop) const {
    const Eigen::Vector3d middle = mean(loop);
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    double radius = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      area += (at(loop[i]) - middle).cross(at(loop[(i + 1) % loop.size()]) - middle) / 2;
      radius = std::max(radius, (at(loop[i]) - middle).norm());
    }
    if (area.norm() < 0.01 * radius * radius) return false;  // a sliver
    const Eigen::Vector3d normal = area.normalized();
    return std::all_of(loop.begin(), loop.end(),
                       [&](VertexId v) { return std::abs(normal.dot(at(v) - middle)) <= k_flat * 2 * radius; });
  }
  double volume(const Loop& loop) const {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      sum += (at(loop[0]) - origin_).dot((at(loop[i]) - origin_).cross(at(loop[i + 1]) - origin_));
    return sum;
  }

  const Solid& solid_;
  const Eigen::Matrix3Xd& positions_;
  Eigen::Vector3d origin_;
  int trials_ = 0;
};

}  // namespace

std::vector<Loop> caps_over(const Solid& solid, const Eigen::Matrix3Xd& positions, const Loop& loop) {
  if (loop.size() > k_longest || solid.find_face(loop)) return {loop};
  Divider divider(solid, positions, loop);
  for (int chords = 0; chords <= k_most_chords; ++chords)
    if (auto division = divider.divide(loop, chords)) return std::move(division->pieces);
  return {loop};
}

}  // namespace argil::subdiv
