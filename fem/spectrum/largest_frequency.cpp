#include "fem/spectrum/largest_frequency.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "fem/solvers/stencil_product.h"
#include "fem/spectrum/start_vectors.h"
#include "subdiv/error.h"

namespace argil::fem {

namespace {

constexpr int k_cap = 1000;
constexpr int k_first_check = 8;
/// Two vectors and a tangent agree to this much where it is symmetric.
constexpr double k_symmetric = 1e-8;

double dot(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cwiseProduct(b).sum();
}

LargestFrequency of_pencil(const System& system, std::span<const AnchorSpring> springs,
                           const Eigen::Matrix3Xd& node_positions, double tolerance) {
  const auto free = moving_control_points(system);
  const InverseMass mass(*system.mass, free);
  const auto size = static_cast<Eigen::Index>(system.rows->column_count);
  const auto tangent = system.model->tangent(node_positions, Projection::none);
  Eigen::Matrix3Xd node_direction, node_product;
  const auto multiply_stiffness = [&](const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) {
    multiply(*system.rows, v, node_direction);
    tangent->stiffness_product(node_direction, node_product);
    multiply(*system.rows_transposed, node_product, result);
    for (const AnchorSpring& spring : springs) {
      const Eigen::Vector3d force = spring.stiffness * held_point(spring, v);
      for (std::size_t e = 0; e < spring.control_points.size(); ++e)
        result.col(static_cast<Eigen::Index>(spring.control_points[e])) += spring.weights[e] * force;
    }
  };
  StartVectors start;
  const auto random = [&] {
    Eigen::Matrix3Xd v = Eigen::Matrix3Xd::Zero(3, size);
    for (const std::uint32_t i : free)
      for (int axis = 0; axis < 3; ++axis) v(axis, static_cast<Eigen::Index>(i)) = start.next();
    return v;
  };

  Eigen::Matrix3Xd v = random(), previous = Eigen::Matrix3Xd::Zero(3, size), force, solved;
  {
    const Eigen::Matrix3Xd other = random();
    Eigen::Matrix3Xd product;
    multiply_stiffness(v, force);
    multiply_stiffness(other, product);
    const double a = dot(other, force), b = dot(v, product);
    if (std::abs(a - b) > k_symmetric * std::sqrt(force.squaredNorm() * other.squaredNorm()))
      throw Error(ErrorCode::unsupported,
                  "the tangent of this force model is not symmetric, so that it has no "
                  "spectrum of real frequencies; choose another model");
  }
  v /= std::sqrt(dot(v, v * *system.mass));
  std::vector<double> diagonal, off_diagonal;
  LargestFrequency result;
  double beta = 0;
  for (int check = k_first_check; result.iterations < k_cap;) {
    multiply_stiffness(v, force);
    mass.solve(force, solved);  // also takes out the pinned
    const double alpha = dot(v, force);
    solved -= alpha * v + beta * previous;
    beta = std::sqrt(std::max(0.0, dot(solved, solved * *system.mass)));
    diagonal.push_back(alpha);
    ++result.iterations;
    const bool exhausted = beta <= 1e-14 * std::abs(alpha);
    if (result.iterations == check || exhausted || result.iterations == k_cap) {
      check += std::max(4, check / 4);
      const Eigen::Map<const Eigen::VectorXd> d(diagonal.data(), static_cast<Eigen::Index>(diagonal.size()));
      const Eigen::Map<const Eigen::VectorXd> e(off_diagonal.data(),
                                                static_cast<Eigen::Index>(off_diagonal.size()));
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
      ritz.computeFromTridiagonal(Eigen::VectorXd(d), Eigen::VectorXd(e));
      const Eigen::Index last = d.size() - 1;
      const double square = ritz.eigenvalues()[last];
      result.value = std::sqrt(std::max(0.0, square));
      result.residual = square > 0 ? beta * std::abs(ritz.eigenvectors()(last, last)) / square : 0;
      if (result.residual <= tolerance || exhausted) return result;
    }
    off_diagonal.push_back(beta);
    previous = std::move(v);
    v = solved / beta;
  }
  throw Error(ErrorCode::not_converged,
              "the largest frequency was not found in 1000 iterations; look for cells that "
              "are nearly flat, or lower the contrast of the stiffness");
}

}  // namespace

LargestFrequency largest_frequency(const System& system, std::span<const AnchorSpring> springs,
                                   const Eigen::Matrix3Xd& positions, double tolerance) {
  return of_pencil(system, springs, nodes(system, positions), tolerance);
}

LargestFrequency largest_frequency_at_rest(const System& system, std::span<const AnchorSpring> springs,
                                           double tolerance) {
  return of_pencil(system, springs, *system.rest_nodes, tolerance);
}

}  // namespace argil::fem
