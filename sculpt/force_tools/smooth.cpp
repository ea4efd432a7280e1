#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "fem/surface_points.h"
#include "sculpt/force_tools/patch_modes.h"
#include "sculpt/force_tools/tool_table.h"

namespace argil::sculpt {

namespace {

constexpr double k_drag_time = 0.05;  // [s]: what is left to itself under the tool comes near the mean in this time
constexpr std::size_t k_fewest = 12;  // points that a mean is taken over, whatever the mesh

// Weights of the mean around a point: by distance and area, made linear in `offsets` so that the mean of a plane
// (of an affine displacement) is the point itself. False where they lie too badly for that.
bool mean_weights(const Eigen::MatrixXd& offsets, Eigen::VectorXd& weights) {
  const Eigen::Index dimension = offsets.rows();
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(dimension, dimension);
  Eigen::VectorXd first = Eigen::VectorXd::Zero(dimension);
  double sum = 0;
  for (Eigen::Index j = 0; j < weights.size(); ++j) {
    for (Eigen::Index a = 0; a < dimension; ++a) {
      first[a] += weights[j] * offsets(a, j);
      for (Eigen::Index b = 0; b < dimension; ++b) moments(a, b) += weights[j] * offsets(a, j) * offsets(b, j);
    }
    sum += weights[j];
  }
  const Eigen::VectorXd slope = moments.fullPivLu().solve(first);
  if (!slope.allFinite()) return false;
  double total = 0;
  for (Eigen::Index j = 0; j < weights.size(); ++j) {
    double along = 0;
    for (Eigen::Index a = 0; a < dimension; ++a) along += slope[a] * offsets(a, j);
    weights[j] *= 1 - along;
    total += weights[j];
  }
  if (!(total > 0.05 * sum)) return false;  // at a rim, with all the others to one side
  weights /= total;
  return true;
}

/// Around one touched point: what it is away from the mean, as a stencil whose weights sum to zero.
struct Bump {
  fem::PointStencil stencil;
  double weight = 0;
  Eigen::Vector3d at_hold = Eigen::Vector3d::Zero();
};

class Smooth : public ForceTool {
 public:
  Smooth(const Document& document, const Tool& tool, const StrokePose& first, const GripOptions& options)
      : tool_(tool), options_(options), held_{first.position}, time_step_(document.state().time_step) {
    hold(document, {tool, first.position}, touch(document, tool, first.position, options.inside));
  }

  void follow(const StrokePose& pose, const Document& document) override {
    if (!wants_new_hold(tool_, held_, pose)) return;
    held_ = pose;
    const LaidTool laid = laid_tool(document, tool_, held_, options_.inside);
    hold(document, laid, touched(document, laid.tool, laid.at, options_.inside));
  }

  fem::Loads loads(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const override {
    std::vector<Eigen::Vector3d> bumps, forces;
    double sizes = 0;
    for (const Bump& bump : bumps_) {
      const Eigen::Vector3d now = fem::position(bump.stencil, positions);
      const double length = now.norm();
      // Along the bump itself, so that there is no moment.
      const double way = !options_.invert ? -1 : length > 0 ? 2 * bump.at_hold.norm() / length - 1 : 0;
      bumps.push_back(now);
      forces.push_back(pose.pressure * tool_.strength * bump.weight * way * now);
      sizes += forces.back().norm();
    }
    const double share = sizes > tool_.largest_force ? tool_.largest_force / sizes : 1;
    fem::Loads loads;
    // A dashpot beside the spring is a spring from where the step begins: strength · drag time [N s/m].
    const double stiffness = tool_.strength * (1 + k_drag_time / time_step_);
    for (std::size_t i = 0; i < bumps_.size(); ++i)
      loads.springs.push_back(fem::anchor_spring(bumps_[i].stencil,
                                                 bumps[i] + (share / (stiffness * bumps_[i].weight)) * forces[i],
                                                 stiffness * bumps_[i].weight));
    return loads;
  }

  Eigen::Vector3d held(const Eigen::Matrix3Xd& positions) const override {
    return touches_ ? fem::position(middle_, positions) : held_.position;
  }

 private:
  void hold(const Document& document, const LaidTool& laid, const Touched& touched) {
    bumps_.clear();
    touches_ = !touched.empty();
    if (!touches_) return;
    middle_ = middle_of(touched);
    // Means reach beyond what is touched, and what is there feels the opposite force.
    Tool wide = laid.tool;
    wide.radius *= 2;
    wide.falloff = "constant";
    const Touched around = sculpt::touched(document, wide, laid.at, touched.inside, Masks::ignored);
    const Eigen::Matrix3Xd nodes = subdiv::apply(document.discretization().nodes.rows, document.positions());
    const Eigen::Matrix3Xd normals = touched.inside ? Eigen::Matrix3Xd() : normals_of(around, nodes);
    const Eigen::Matrix3Xd own = touched.inside ? Eigen::Matrix3Xd() : normals_of(touched, nodes);
    const Eigen::Matrix3Xd places = touched.inside ? at_rest(document, around) : around.positions;
    const Eigen::Matrix3Xd centres = touched.inside ? at_rest(document, touched) : touched.positions;
    for (std::size_t i = 0; i < touched.points.size(); ++i) {
      const auto c = static_cast<Eigen::Index>(i);
      add_bump(laid.tool.radius, touched, i, around, places, centres.col(c), normals,
               touched.inside ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : Eigen::Vector3d(own.col(c)));
    }
  }

  void add_bump(double radius, const Touched& touched, std::size_t i, const Touched& around,
                const Eigen::Matrix3Xd& places, const Eigen::Vector3d& centre, const Eigen::Matrix3Xd& normals,
                const Eigen::Vector3d& normal) {
    struct Near {
      double distance;
      std::size_t index;
      bool operator<(const Near& other) const {
        return distance != other.distance ? distance < other.distance : index < other.index;
      }
    };
    std::vector<Near> near;
    for (std::size_t j = 0; j < around.points.size(); ++j) {
      const auto c = static_cast<Eigen::Index>(j);
      if (!touched.inside && normals.col(c).dot(normal) <= 0) continue;
      near.push_back({(places.col(c) - centre).norm(), j});
    }
    std::sort(near.begin(), near.end());
    if (near.size() < 4) return;
    const double reach = std::max(radius, 1.2 * near[std::min(near.size(), k_fewest) - 1].distance);
    std::size_t count = 0;
    while (count < near.size() && near[count].distance < reach) ++count;

    Eigen::Matrix3Xd frame = Eigen::Matrix3d::Identity();
    if (!touched.inside) {
      frame.resize(3, 2);
      frame.col(0) = rightwards(normal);
      frame.col(1) = normal.cross(frame.col(0));
    }
    const auto n = static_cast<Eigen::Index>(count);
    Eigen::MatrixXd offsets(frame.cols(), n);
    Eigen::VectorXd weights(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Near& other = near[static_cast<std::size_t>(j)];
      const auto at = static_cast<Eigen::Index>(other.index);
      const Eigen::Vector3d offset = places.col(at) - centre;
      for (Eigen::Index a = 0; a < frame.cols(); ++a) offsets(a, j) = frame.col(a).dot(offset) / reach;
      const double s = other.distance / reach;
      weights[j] = around.weights[at] * (1 - s * s) * (1 - s * s);
      // Not the other side of a thin sheet, and beyond an edge the less the sharper it is.
      if (!touched.inside) weights[j] *= normals.col(at).dot(normal);
    }
    if (!mean_weights(offsets, weights)) return;
    std::vector<fem::PointStencil> points{touched.points[i]};
    std::vector<double> factors{1};
    for (Eigen::Index j = 0; j < n; ++j) {
      points.push_back(around.points[near[static_cast<std::size_t>(j)].index]);
      factors.push_back(-weights[j]);
    }
    Bump bump{combination(points, factors), touched.share * touched.weights[static_cast<Eigen::Index>(i)], {}};
    bump.at_hold = touched.positions.col(static_cast<Eigen::Index>(i));
    for (Eigen::Index j = 0; j < n; ++j)
      bump.at_hold -=
          weights[j] * around.positions.col(static_cast<Eigen::Index>(near[static_cast<std::size_t>(j)].index));
    bumps_.push_back(std::move(bump));
  }

  static Eigen::Matrix3Xd normals_of(const Touched& touched, const Eigen::Matrix3Xd& nodes) {
    Eigen::Matrix3Xd normals(3, static_cast<Eigen::Index>(touched.places.size()));
    for (std::size_t i = 0; i < touched.places.size(); ++i)
      normals.col(static_cast<Eigen::Index>(i)) =
          fem::surface_point(touched.places[i].quad, touched.places[i].which, nodes).area_vector.normalized();
    return normals;
  }

  static Eigen::Matrix3Xd at_rest(const Document& document, const Touched& touched) {
    Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(touched.points.size()));
    for (std::size_t i = 0; i < touched.points.size(); ++i)
      places.col(static_cast<Eigen::Index>(i)) = fem::position(touched.points[i], document.rest());
    return places;
  }

  Tool tool_;
  GripOptions options_;
  StrokePose held_;  // where it took hold
  double time_step_;
  std::vector<Bump> bumps_;
  fem::PointStencil middle_;
  bool touches_ = true;
};

}  // namespace

std::unique_ptr<ForceTool> take_smooth(const Document& document, const Tool& tool, const StrokePose& first,
                                       const GripOptions& options) {
  return std::make_unique<Smooth>(document, tool, first, options);
}

}  // namespace argil::sculpt
