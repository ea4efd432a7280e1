#include "sculpt/force_tools/probe.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <array>
#include <limits>

#include "fem/solvers/pcg.h"
#include "fem/solvers/rest_operator.h"
#include "fem/solvers/solver_choice.h"
#include "fem/solvers/stencil_product.h"
#include "sculpt/force_tools/touched.h"

namespace argil::sculpt {

namespace {

// A held body rests in much less time; what is left of inertia keeps a hinge from being infinitely soft.
constexpr double k_long_time = 10;  // [s]
constexpr double k_tolerance = 1e-8;
constexpr int k_iterations = 5000;

using RigidFields = std::array<Eigen::Matrix3Xd, 6>;

// Sum by columns, so that the bits do not depend on where the arrays lie.
double product(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  double sum = 0;
  for (Eigen::Index c = 0; c < a.cols(); ++c) sum += a(0, c) * b(0, c) + a(1, c) * b(1, c) + a(2, c) * b(2, c);
  return sum;
}

RigidFields rigid_fields(const Eigen::Matrix3Xd& positions, const Eigen::Vector3d& centre, double size) {
  RigidFields fields;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
    Eigen::Matrix3Xd& move = fields[static_cast<std::size_t>(axis)];
    Eigen::Matrix3Xd& turn = fields[static_cast<std::size_t>(axis + 3)];
    move = along.replicate(1, positions.cols());
    turn.resize(3, positions.cols());
    for (Eigen::Index c = 0; c < positions.cols(); ++c) turn.col(c) = along.cross(positions.col(c) - centre) / size;
  }
  return fields;
}

}  // namespace

struct Probe::Impl {
  const Document& document;
  fem::System system;
  std::vector<fem::AnchorSpring> springs;
  std::vector<std::uint8_t> free;
  fem::RestOperator rest;
  Eigen::SparseMatrix<double> inertia;
  std::unique_ptr<fem::Tangent> tangent;
  std::unique_ptr<fem::Preconditioner> preconditioner;
  bool held = false;

  explicit Impl(const Document& of) : document(of), system(of.system()), springs(of.loads().springs) {
    free.assign(system.fixed.size(), 0);
    for (std::size_t i = 0; i < free.size(); ++i) {
      const auto c = static_cast<Eigen::Index>(i);
      free[i] = !system.fixed[i] && system.mass->coeff(c, c) > 0 ? 1 : 0;
    }
    held = !document.state().pins->control_points.empty() || !springs.empty();
    fem::SolverInputs inputs{3 * system.rows->column_count, fem::stiffness_contrast(system), 0};
    const fem::PreconditionerKind small = fem::choose_solver(inputs);
    rest = fem::rest_operator(system, small != fem::PreconditionerKind::jacobi);
    inputs.stiffness_number = fem::stiffness_number(system, rest, k_long_time * k_long_time, free);
    const fem::PreconditionerKind kind = fem::choose_solver(inputs);
    if (kind != fem::PreconditionerKind::jacobi && rest.stiffness.size() == 0)
      rest = fem::rest_operator(system, true);
    inertia = *system.mass / (k_long_time * k_long_time);
    preconditioner = fem::make_preconditioner(kind, rest, inertia, springs, free);
    tangent =
        system.model->tangent(fem::nodes(system, document.positions()), fem::Projection::positive_semidefinite);
  }

  void multiply(const Eigen::Matrix3Xd& direction, Eigen::Matrix3Xd& result) const {
    Eigen::Matrix3Xd nodes, forces;
    fem::multiply(rest.rows, direction, nodes);
    tangent->stiffness_product(nodes, forces);
    fem::multiply(rest.rows_transposed, forces, result);
    result += direction * inertia;  // the matrix is symmetric
    for (const fem::AnchorSpring& spring : springs) {
      const Eigen::Vector3d force = spring.stiffness * fem::held_point(spring, direction);
      for (std::size_t e = 0; e < spring.control_points.size(); ++e)
        result.col(static_cast<Eigen::Index>(spring.control_points[e])) += spring.weights[e] * force;
    }
    for (std::size_t i = 0; i < free.size(); ++i)
      if (!free[i]) result.col(static_cast<Eigen::Index>(i)).setZero();
  }

  // Less the force that accelerates the body as a whole.
  void balance(Eigen::Matrix3Xd& forces) const {
    const Eigen::Matrix3Xd& positions = document.positions();
    const Eigen::Vector3d low = positions.rowwise().minCoeff(), high = positions.rowwise().maxCoeff();
    const RigidFields fields = rigid_fields(positions, 0.5 * (low + high), 0.5 * (high - low).norm());
    Eigen::Matrix<double, 6, 6> masses;
    Eigen::Matrix<double, 6, 1> push;
    RigidFields heavy;
    for (std::size_t a = 0; a < 6; ++a) heavy[a] = fields[a] * *system.mass;
    for (std::size_t a = 0; a < 6; ++a) {
      push[static_cast<Eigen::Index>(a)] = product(fields[a], forces);
      for (std::size_t b = 0; b < 6; ++b)
        masses(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) = product(fields[a], heavy[b]);
    }
    const Eigen::Matrix<double, 6, 1> acceleration = masses.ldlt().solve(push);
    for (std::size_t a = 0; a < 6; ++a) forces -= acceleration[static_cast<Eigen::Index>(a)] * heavy[a];
  }
};

Probe::Probe(const Document& document) : impl_(std::make_unique<Impl>(document)) {}
Probe::~Probe() = default;

ProbeReading Probe::read(const Tool& tool, const Eigen::Vector3d& at, bool inside) const {
  const Document& document = impl_->document;
  const Touched here = touch(document, tool, at, inside, Masks::ignored);
  const fem::PointStencil middle = middle_of(here);
  Eigen::Matrix3Xd forces =
      fem::point_forces(middle, static_cast<std::size_t>(document.positions().cols()), here.normal);
  if (!impl_->held) impl_->balance(forces);
  for (std::size_t i = 0; i < impl_->free.size(); ++i)
    if (!impl_->free[i]) forces.col(static_cast<Eigen::Index>(i)).setZero();
  Eigen::Matrix3Xd moved;
  static_cast<void>(
      fem::pcg([&](const Eigen::Matrix3Xd& d, Eigen::Matrix3Xd& result) { impl_->multiply(d, result); },
               *impl_->preconditioner, forces, moved, k_tolerance, k_iterations));
  const double compliance = here.normal.dot(fem::position(middle, moved));
  // Where everything under the brush is pinned, nothing gives.
  return {here.middle, here.normal, compliance > 0 ? 1 / compliance : std::numeric_limits<double>::infinity()};
}

}  // namespace argil::sculpt
