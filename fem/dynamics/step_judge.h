#pragma once
// By what the guard judges a step (the rules are said in guard.h): what a state is worth, and what has come of it
// since the last good one.

#include <cstdint>
#include <vector>

#include "fem/dynamics/guard.h"

namespace argil::fem {

/// What a state is worth [J].
struct Worth {
  double kinetic = 0, elastic = 0;
  double surplus = 0;        // made of nothing until here and not yet paid back
  std::size_t inverted = 0;  // quadrature points
  [[nodiscard]] double energy() const { return kinetic + elastic; }
};

/// Of models without an energy, the elastic part is what it would be were forces linear in the displacement from
/// the rest shape turned along, −½ f · (x − R X).
class StepJudge {
 public:
  explicit StepJudge(Integrator& integrator);

  [[nodiscard]] Worth worth(const BodyState& state, double surplus);
  /// Takes `before`, of the state `from`, on to `to`, unless something is found. The work is that of `loads`,
  /// their forces, targets and obstacles standing still where they are at the end, and of what leads points;
  /// `given` [J] is what among it is to be counted as made of nothing.
  [[nodiscard]] GuardFinding judge(const Loads& loads, const BodyState& from, const BodyState& to, double given,
                                   Worth& before);

 private:
  Integrator* integrator_;
  bool has_energy_ = true, counts_inverted_ = false;
  double negligible_ = 0;  // [J]
};

/// Work of the forces of `loads`, without springs, on the way [J].
[[nodiscard]] double dead_work(const Loads& loads, const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

/// Marks control points of elements with a quadrature point whose det F is positive at `from` and is not at `to`:
/// those whose weights, summed over the element's nodes, come to more than `influence` of the largest such sum in
/// the element (0: all that it depends on). Cost O(points).
void mark_turned(const System& system, const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, double influence,
                 std::vector<std::uint8_t>& marks);

}  // namespace argil::fem
