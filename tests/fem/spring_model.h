#pragma once
// A mass on a spring as the smallest body there is, for integrators alone.

#include <Eigen/Dense>
#include <array>

#include "fem/system.h"

namespace argil::fem::test {

/// Energy k/2 |x₁ − x₀ − l e_x|²: linear, so that motion along x is cos ωt exactly.
class SpringModel : public ForceModel {
 public:
  SpringModel(double stiffness, double length) : stiffness_(stiffness), rest_(length, 0, 0) {}
  std::string_view name() const override { return "spring"; }
  Promises promises() const override { return {}; }
  double energy(const Eigen::Matrix3Xd& x) const override { return 0.5 * stiffness_ * stretch(x).squaredNorm(); }
  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    forces.resize(3, 2);
    forces.col(0) = stiffness_ * stretch(x);
    forces.col(1) = -forces.col(0);
  }
  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd&, Projection) const override {
    return std::make_unique<SpringTangent>(stiffness_);
  }

 private:
  class SpringTangent : public Tangent {
   public:
    explicit SpringTangent(double stiffness) : stiffness_(stiffness) {}
    void stiffness_product(const Eigen::Matrix3Xd& dx, Eigen::Matrix3Xd& result) const override {
      result.resize(3, 2);
      result.col(1) = stiffness_ * (dx.col(1) - dx.col(0));
      result.col(0) = -result.col(1);
    }
    void element_tangents(const Visit& visit) const override {
      Eigen::MatrixXd k(6, 6);
      k << Eigen::Matrix3d::Identity(), -Eigen::Matrix3d::Identity(), -Eigen::Matrix3d::Identity(),
          Eigen::Matrix3d::Identity();
      const std::array<std::uint32_t, 2> nodes{0, 1};
      visit(nodes, stiffness_ * k);
    }

   private:
    double stiffness_;
  };
  Eigen::Vector3d stretch(const Eigen::Matrix3Xd& x) const { return x.col(1) - x.col(0) - rest_; }

  double stiffness_;
  Eigen::Vector3d rest_;
};

/// Control point 0 fixed at the origin, 1 with a mass.
struct SpringBody {
  SpringBody(double point_mass, double stiffness, double length)
      : rows(subdiv::Stencils::identity(2)), model(stiffness, length), mass(2, 2), damping(2, 2) {
    rest.setZero(3, 2);
    rest(0, 1) = length;
    mass.insert(0, 0) = mass.insert(1, 1) = point_mass;
    system = {&rows, &rows, &model, &rest, &mass, &damping, {1, 0}};
    state.positions = rest;
    state.velocities.setZero(3, 2);
  }
  SpringBody(const SpringBody&) = delete;
  SpringBody& operator=(const SpringBody&) = delete;

  subdiv::Stencils rows;
  SpringModel model;
  Eigen::Matrix3Xd rest;
  Eigen::SparseMatrix<double> mass, damping;
  System system;
  BodyState state;
};

}  // namespace argil::fem::test
