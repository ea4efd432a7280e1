#include "fem/discretization/materials.h"

#include "fem/material.h"
#include "fem/solvers/block_accumulator.h"
#include "fem/solvers/rest_operator.h"

namespace argil::fem {

namespace {

/// A pyramid below this share of its cell's volume gives no stiffness (METHODS §3).
constexpr double k_flat_pyramid = 1e-3;
constexpr std::size_t k_elements_between = 512;  // two words of progress

/// [point * corner_count + corner]: weights of the corners' values at a kind's quadrature points.
std::vector<double> corner_weights(const ElementKind& kind) {
  if (field_corner_count(kind) == kind.node_count) return kind.shapes;
  const ElementKind& trilinear = trilinear_hexahedron();
  std::vector<double> result;
  Eigen::VectorXd shapes;
  Eigen::Matrix3Xd gradients;
  for (const Eigen::Vector3d& point : kind.points) {
    trilinear.evaluate(point, shapes, gradients);
    result.insert(result.end(), shapes.data(), shapes.data() + shapes.size());
  }
  return result;
}

/// Values at the points of a field that may be absent: empty if it is zero.
std::vector<double> interpolate(const ElementBlock& block, const std::vector<std::uint32_t>& corners,
                                const std::vector<double>& weights, const Eigen::VectorXd& samples) {
  if (samples.size() == 0 || samples.isZero(0)) return {};
  const auto corner_count = static_cast<std::size_t>(field_corner_count(*block.kind));
  const auto points = static_cast<std::size_t>(block.kind->point_count);
  std::vector<double> result(block.element_count() * points, 0.0);
  for (std::size_t e = 0; e < block.element_count(); ++e)
    for (std::size_t q = 0; q < points; ++q)
      for (std::size_t c = 0; c < corner_count; ++c)
        result[e * points + q] += weights[q * corner_count + c] * samples[corners[e * corner_count + c]];
  return result;
}

void interpolate(ElementBlock& block, const std::vector<std::uint32_t>& corners, const NodalFields& samples) {
  const auto corner_count = static_cast<std::size_t>(field_corner_count(*block.kind));
  const auto points = static_cast<std::size_t>(block.kind->point_count);
  const std::vector<double> weights = corner_weights(*block.kind);
  const std::size_t size = block.element_count() * points;
  block.mu.resize(size);
  block.lambda.resize(size);
  block.density.resize(size);
  block.damping.resize(size);
  for (std::size_t e = 0; e < block.element_count(); ++e)
    for (std::size_t q = 0; q < points; ++q) {
      double young = 0, poisson = 0, density = 0, damping = 0;
      for (std::size_t c = 0; c < corner_count; ++c) {
        const double w = weights[q * corner_count + c];
        const std::uint32_t s = corners[e * corner_count + c];
        young += w * samples.young_modulus[s];
        poisson += w * samples.poisson_ratio[s];
        density += w * samples.density[s];
        damping += w * samples.damping[s];
      }
      const std::size_t i = e * points + q;
      const Lame constants = lame(young, poisson);
      block.mu[i] = constants.mu;
      block.lambda[i] = constants.lambda;
      block.density[i] = density;
      block.damping[i] = damping;
    }
  block.stiffness_damping = interpolate(block, corners, weights, samples.stiffness_damping);
  block.prestress = interpolate(block, corners, weights, samples.prestress);
}

double element_volume(const ElementBlock& block, std::size_t element) {
  double sum = 0;
  for (int q = 0; q < block.kind->point_count; ++q) sum += block.volumes[block.point_index(element, q)];
  return sum;
}

/// Pyramids of one cell lie together in their block.
std::size_t soften_flat_pyramids(ElementBlock& block) {
  std::size_t count = 0, begin = 0;
  while (begin < block.element_count()) {
    const ElementOrigin& origin = block.origins[begin];
    std::size_t end = begin;
    double cell_volume = 0;
    while (end < block.element_count() && block.origins[end].cell == origin.cell &&
           block.origins[end].level == origin.level)
      cell_volume += element_volume(block, end++);
    for (std::size_t e = begin; e < end; ++e) {
      if (element_volume(block, e) >= k_flat_pyramid * cell_volume) continue;
      ++count;
      for (int q = 0; q < block.kind->point_count; ++q)
        block.mu[block.point_index(e, q)] = block.lambda[block.point_index(e, q)] = 0;
    }
    begin = end;
  }
  return count;
}

}  // namespace

int field_corner_count(const ElementKind& kind) {
  return kind.node_count > 8 ? 8 : kind.node_count;
}

void set_materials(Discretization& discretization, const NodalFields& fields, const Progress& progress) {
  const subdiv::Stencils& rows = discretization.field_samples.rows;
  const auto sampled = [&](const Eigen::VectorXd& values) {
    return values.size() > 0 ? subdiv::apply(rows, values) : Eigen::VectorXd();
  };
  const NodalFields samples{sampled(fields.young_modulus),     sampled(fields.poisson_ratio),
                            sampled(fields.density),           sampled(fields.damping),
                            sampled(fields.stiffness_damping), sampled(fields.prestress)};
  BlockAccumulator mass(1), damping(1);
  ElementReduction element(discretization.nodes.rows);
  Eigen::MatrixXd element_mass, element_damping, reduced;
  const auto add = [&](BlockAccumulator& sums, const Eigen::MatrixXd& matrix) {
    reduced.noalias() = element.weights.transpose() * (matrix * element.weights);
    for (std::size_t j = 0; j < element.columns.size(); ++j)
      for (std::size_t i = 0; i < element.columns.size(); ++i)
        *sums.block(element.columns[i], element.columns[j]) +=
            reduced(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  };
  const bool damped = fields.damping.size() > 0 && !fields.damping.isZero(0);
  discretization.rest_volume = discretization.total_mass = 0;
  discretization.elements.pyramids_without_stiffness = 0;
  std::size_t count = 0, done = 0;
  for (const ElementBlock& block : discretization.blocks) count += block.element_count();
  for (std::size_t b = 0; b < discretization.blocks.size(); ++b) {
    ElementBlock& block = discretization.blocks[b];
    interpolate(block, discretization.field_samples.corners[b], samples);
    if (block.kind == &pyramid()) discretization.elements.pyramids_without_stiffness += soften_flat_pyramids(block);
    const auto n = static_cast<std::size_t>(block.kind->node_count);
    for (std::size_t e = 0; e < block.element_count(); ++e) {
      if (done++ % k_elements_between == 0) progress.at(static_cast<double>(done) / static_cast<double>(count));
      element.gather({block.nodes.data() + e * n, n});
      element_mass.setZero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
      element_damping = element_mass;
      for (int q = 0; q < block.kind->point_count; ++q) {
        const std::size_t i = block.point_index(e, q);
        const Eigen::Map<const Eigen::VectorXd> shapes(block.kind->shapes.data() + static_cast<std::size_t>(q) * n,
                                                       static_cast<Eigen::Index>(n));
        const double m = block.density[i] * block.volumes[i];
        element_mass.noalias() += shapes * (m * shapes.transpose());
        if (damped) element_damping.noalias() += shapes * (block.damping[i] * m * shapes.transpose());
        discretization.total_mass += m;
        discretization.rest_volume += block.volumes[i];
      }
      add(mass, element_mass);
      if (damped) add(damping, element_damping);
    }
  }
  discretization.mass = mass.matrix(discretization.nodes.rows.column_count);
  discretization.damping = damping.matrix(discretization.nodes.rows.column_count);
}

}  // namespace argil::fem
