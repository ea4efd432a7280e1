// The published local frame: what it is, and where it fails, each failure with its figure (METHODS §4).

#include "fem/models/local_frame.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include "fem/models/local_frame_operator.h"
#include "tests/fem/element_bodies.h"
#include "tests/fem/models/model_calls.h"

namespace argil::fem {
namespace {

using test::Body;
using test::forces_at;
using test::largest;

double inner(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cwiseProduct(b).sum();
}

/// R d of the first element.
Eigen::Matrix3Xd seen_displacements(const Body& body, const Eigen::Matrix3Xd& x) {
  const ElementBlock& block = body.blocks[0];
  const LocalTopology& topology = local_topology(*block.kind);
  std::vector<double> measures(topology.measure_count());
  Eigen::Matrix3Xd rest(3, block.kind->node_count), present = rest, result = rest;
  for (int a = 0; a < block.kind->node_count; ++a) {
    rest.col(a) = body.rest.col(block.nodes[static_cast<std::size_t>(a)]);
    present.col(a) = x.col(block.nodes[static_cast<std::size_t>(a)]);
  }
  local_rest_measures(topology, rest.data(), measures.data());
  local_displacements(topology, block.kind->node_count, measures.data(), present.data(), result.data());
  return result;
}

/// Mean gradient of the field that the first element makes of nodal displacements.
Eigen::Matrix3d mean_gradient(const Body& body, const Eigen::Matrix3Xd& displacements) {
  const ElementBlock& block = body.blocks[0];
  const int n = block.kind->node_count;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double volume = 0;
  for (int q = 0; q < block.kind->point_count; ++q) {
    const Eigen::Map<const Eigen::Matrix3Xd> gradients(&block.kind->gradients[static_cast<std::size_t>(3 * q * n)],
                                                       3, n);
    const auto point = block.point_index(0, q);
    sum += block.volumes[point] * displacements * gradients.transpose() * block.inverse_rest_jacobians[point];
    volume += block.volumes[point];
  }
  return sum / volume;
}

Eigen::Matrix3d small_stretch() {
  Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
  strain(0, 0) = 1e-5;
  return strain;
}
Eigen::Matrix3d small_shear() {
  Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
  strain(0, 1) = strain(1, 0) = 0.5e-5;
  return strain;
}

TEST(LocalFrame, SeesTwiceTheStrainOnEightNodesAndAThirdOrTwoOnSixtyFour) {
  struct Case {
    Body body;
    double stretch, shear;
  };
  for (const Case& c : {Case{test::hexahedra(1, 0), 2, 2}, Case{test::bspline(1, 0, 0), 1.0 / 3, 0.638889}}) {
    const auto share = [&](const Eigen::Matrix3d& strain, int row, int column) {
      const Eigen::Matrix3Xd seen = seen_displacements(c.body, c.body.rest + strain * c.body.rest);
      return mean_gradient(c.body, seen)(row, column) / strain(row, column);
    };
    EXPECT_NEAR(share(small_stretch(), 0, 0), c.stretch, 1e-4);  // strain² ~ 1e-5
    EXPECT_NEAR(share(small_shear(), 0, 1), c.shear, 1e-4);
  }
}

TEST(LocalFrame, IsLinearElasticityForSmallUniformStrainOfCubes) {
  const Body body = test::hexahedra(1, 0);
  for (const Eigen::Matrix3d& strain : {small_stretch(), small_shear()}) {
    const Eigen::Matrix3Xd x = body.rest + strain * body.rest;
    const Eigen::Matrix3Xd truth = forces_at(*make_linear(body.blocks, body.rest), x);
    EXPECT_LE(largest(forces_at(*make_local_frame(body.blocks, body.rest), x) - truth), 1e-4 * largest(truth));
  }
}

TEST(LocalFrame, RestMovedTurnedAndMirroredHasNoForce) {
  const Eigen::Matrix3d turn = test::rotation(2.5, {1, -2, 0.5});
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, 1, -1).asDiagonal();
  for (const Body& body : test::all_bodies()) {
    const auto model = make_local_frame(body.blocks, body.rest);
    const Eigen::Vector3d far(3, -5, 7);
    const double bound = 1e-11 * 1060;  // E h², and angles from coordinates of size 10
    EXPECT_LE(largest(forces_at(*model, (turn * body.rest).colwise() + far)), bound) << body.name;
    // A spurious rest state: a model of the continuum pushes back.
    EXPECT_LE(largest(forces_at(*model, turn * mirror * body.rest)), bound) << body.name;
    EXPECT_GT(largest(forces_at(*make_corotational(body.blocks, body.rest), mirror * body.rest)), 1) << body.name;
  }
}

TEST(LocalFrame, TurnsWithTheFrameWherePrintedEquationsDoNot) {
  const Eigen::Matrix3d turn = test::rotation(1.2, {0.3, 1, 2});
  for (const Body& body : test::all_bodies()) {
    const Eigen::Matrix3d stretch = Eigen::Vector3d(1.2, 0.9, 1.1).asDiagonal();
    const Eigen::Matrix3Xd x = stretch * body.rest + test::random_vectors(body.rest.cols(), 0.02, 11);
    const auto model = make_local_frame(body.blocks, body.rest);
    const Eigen::Matrix3Xd f = forces_at(*model, x);
    EXPECT_LE(largest(forces_at(*model, turn * x) - turn * f), 1e-11 * largest(f)) << body.name;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < f.cols(); ++i) sum += f.col(i);
    EXPECT_LE(sum.norm(), 1e-11 * f.cwiseAbs().sum()) << body.name;
    EXPECT_FALSE(model->promises().has_energy);
    // K in fixed axes.
    const auto literal = make_local_frame_literal(body.blocks, body.rest);
    const Eigen::Matrix3Xd printed = forces_at(*literal, x);
    EXPECT_GT(largest(forces_at(*literal, turn * x) - turn * printed), 0.1 * largest(printed)) << body.name;
    EXPECT_FALSE(literal->promises().rotation_invariant);
  }
}

TEST(LocalFrame, PrintedEquationsPointElsewhereThanTheTrueForces) {
  // One unit cube, where the missing factor h is 1, stretched along an axis: cosine 0.73, three times the size.
  Body body = test::hexahedra(1, 0);
  test::finish(body, 0.3, true);
  const Eigen::Matrix3Xd x = body.rest + small_stretch() * body.rest;
  const Eigen::Matrix3Xd truth = forces_at(*make_linear(body.blocks, body.rest), x);
  const Eigen::Matrix3Xd printed = forces_at(*make_local_frame_literal(body.blocks, body.rest), x);
  EXPECT_NEAR(inner(truth, printed) / std::sqrt(inner(truth, truth) * inner(printed, printed)), 0.731, 0.001);
  // Twice from R, twice from the printed K, less what goes astray.
  EXPECT_NEAR(inner(truth, printed) / inner(truth, truth), 2.93, 0.01);
}

TEST(LocalFrame, SummedDisplacementsLeaveTheInteriorWithoutForce) {
  // Rows of neighbours cancel under uniform strain, so that cells off the boundary feel nothing however they are
  // strained; taken element by element they do.
  Body body = test::hexahedra(5, 0);
  test::finish(body, 0.3, true);
  const Eigen::Matrix3Xd x = body.rest + 1e3 * (small_stretch() + small_shear()) * body.rest;
  const Eigen::Matrix3Xd f = forces_at(*make_local_frame_literal(body.blocks, body.rest), x);
  double inside = 0;
  for (Eigen::Index i = 0; i < f.cols(); ++i) {
    const Eigen::Vector3d at = body.rest.col(i);
    if (at.minCoeff() > 0.3 && at.maxCoeff() < 0.7) inside = std::max(inside, f.col(i).norm());
  }
  EXPECT_LE(inside, 1e-12 * largest(f));
  EXPECT_GT(largest(f), 1);
  // The stress there is real: cut the middle cell out, and its nodes carry it.
  Body middle = test::hexahedra(1, 0);
  test::finish(middle, 0.3, true);
  const Eigen::Matrix3Xd y = middle.rest + 1e3 * (small_stretch() + small_shear()) * middle.rest;
  EXPECT_GT(largest(forces_at(*make_local_frame(middle.blocks, middle.rest), y)), 1);
}

/// The Jacobian −∂f/∂x at rest by central differences, divided by lumped masses of density 1.
struct Pencil {
  Eigen::MatrixXd stiffness;
  Eigen::VectorXd mass;  // per coordinate
};
Pencil pencil(const Body& body, const ForceModel& model) {
  const Eigen::Index size = body.rest.size();
  Pencil result{Eigen::MatrixXd(size, size), Eigen::VectorXd::Zero(size)};
  const double e = 1e-5;
  for (Eigen::Index i = 0; i < size; ++i) {
    Eigen::Matrix3Xd plus = body.rest, minus = body.rest;
    plus.data()[i] += e;
    minus.data()[i] -= e;
    const Eigen::Matrix3Xd difference = (forces_at(model, minus) - forces_at(model, plus)) / (2 * e);
    result.stiffness.col(i) = Eigen::Map<const Eigen::VectorXd>(difference.data(), size);
  }
  for (const ElementBlock& block : body.blocks)
    for (std::size_t element = 0; element < block.element_count(); ++element)
      for (int q = 0; q < 8; ++q)
        for (int a = 0; a < 8; ++a)
          for (int axis = 0; axis < 3; ++axis)
            result.mass[3 * block.nodes[8 * element + static_cast<std::size_t>(a)] + axis] +=
                block.volumes[block.point_index(element, q)] / 8;
  return result;
}
Eigen::VectorXcd squared_frequencies(const Pencil& pencil) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(pencil.mass.cwiseInverse().asDiagonal() * pencil.stiffness, false)
      .eigenvalues();
}

TEST(LocalFrame, StiffnessIsNotSymmetricAndHasComplexFrequencies) {
  struct Case {
    double distortion, asymmetry, imaginary;
  };
  for (const Case& c : {Case{0, 0.1, 1e-3}, Case{0.15, 0.2, 0.02}}) {
    const Body body = test::hexahedra(2, c.distortion);
    const Pencil at = pencil(body, *make_local_frame(body.blocks, body.rest));
    const double asymmetry = (at.stiffness - at.stiffness.transpose()).norm() / at.stiffness.norm();
    double imaginary = 0, top = 0;
    for (const auto& value : squared_frequencies(at)) {
      imaginary = std::max(imaginary, std::abs(value.imag()));
      top = std::max(top, std::abs(value));
    }
    EXPECT_GE(asymmetry, c.asymmetry);
    EXPECT_GE(imaginary / top, c.imaginary);
  }
}

/// Largest |x − rest| while central differences go on: M a = f − γ M v + load.
double largest_excursion(const Body& body, const ForceModel& model, const Eigen::VectorXd& mass, double step,
                         int steps, double damping, double acceleration) {
  const Eigen::Index size = body.rest.size();
  const Eigen::Matrix3Xd start = test::random_vectors(body.rest.cols(), 1e-6, 41);
  Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(body.rest.data(), size), before = x;
  x += Eigen::Map<const Eigen::VectorXd>(start.data(), size);
  before = x;
  const Eigen::VectorXd rest = Eigen::Map<const Eigen::VectorXd>(body.rest.data(), size);
  double excursion = 0;
  for (int s = 0; s < steps && excursion < 10; ++s) {
    const Eigen::Matrix3Xd f = forces_at(model, Eigen::Map<const Eigen::Matrix3Xd>(x.data(), 3, body.rest.cols()));
    Eigen::VectorXd next(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const double a = f.data()[i] / mass[i] + (i % 3 == 2 ? acceleration : 0);
      next[i] = (2 * x[i] - (1 - 0.5 * damping * step) * before[i] + step * step * a) / (1 + 0.5 * damping * step);
      if (rest[i - i % 3] < 0.1) next[i] = rest[i];  // held at one end
    }
    before = x;
    x = next;
    excursion = std::max(excursion, (x - rest).cwiseAbs().maxCoeff());
  }
  return excursion;
}

TEST(LocalFrame, DivergesWithoutDampingAtAnyTimeStepAndIsBoundedAsPublished) {
  Body body = test::hexahedra(2, 0.15);
  for (Eigen::Index i = 0; i < body.rest.cols(); ++i)
    if (body.rest(0, i) < 0.2) body.rest(0, i) = 0;
  test::finish(body, 0.3, true);
  const auto model = make_local_frame(body.blocks, body.rest);
  const Pencil at = pencil(body, *model);
  double top = 0;
  for (const auto& value : squared_frequencies(at)) top = std::max(top, std::abs(value));
  const double frequency = std::sqrt(top), limit = 2 / frequency;
  for (const double share : {0.4, 0.1})  // from a start of 1e-6 beyond the size of the body
    EXPECT_GT(largest_excursion(body, *model, at.mass, share * limit, static_cast<int>(4000 / share), 0, 0), 1);
  const double damped = largest_excursion(body, *model, at.mass, 0.4 * limit, 10000, 0.1 * frequency, -20);
  EXPECT_GT(damped, 0.01);
  EXPECT_LT(damped, 0.1);
}

TEST(LocalFrame, TangentIsThatOfTurnedLinearElasticity) {
  const Eigen::Matrix3d turn = test::rotation(0.7, {1, 1, 0});
  for (const Body& body : test::all_bodies()) {
    const Eigen::Matrix3Xd dx = test::random_vectors(body.rest.cols(), 1, 31);
    Eigen::Matrix3Xd linear, turned;
    make_linear(body.blocks, body.rest)->tangent(body.rest, Projection::none)->stiffness_product(dx, linear);
    make_local_frame(body.blocks, body.rest)
        ->tangent(turn * body.rest, Projection::none)
        ->stiffness_product(turn * dx, turned);
    EXPECT_LE(largest(turned - turn * linear), 1e-11 * largest(linear)) << body.name;
  }
}

}  // namespace
}  // namespace argil::fem
