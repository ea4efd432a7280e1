// METHODS §7: whatever stands in the table of models is held to what it promises, in each formulation and on each
// element kind that it takes.

#include "fem/models/model_table.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "fem/dynamics/method.h"
#include "subdiv/error.h"
#include "tests/fem/element_bodies.h"
#include "tests/fem/models/model_calls.h"

namespace argil::fem {

/// For the names of the tests.
void PrintTo(const ModelChoice& choice, std::ostream* out) {
  *out << choice.name << '_' << word(choice.formulation);
}

namespace {

using test::Body;
using test::forces_at;
using test::largest;
using test::product_at;

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

/// Smooth large strain, random, turned, flat, mirrored.
std::vector<Eigen::Matrix3Xd> states(const Body& body) {
  const Eigen::Matrix3Xd noise = test::random_vectors(body.rest.cols(), 0.05, 11);
  const Eigen::Matrix3d turn = test::rotation(2.0, {1, 2, -1});
  const Eigen::Matrix3d stretch = Eigen::Vector3d(1.4, 0.8, 1.1).asDiagonal();
  const Eigen::Matrix3d flat = Eigen::Vector3d(1.1, 0.9, 0.02).asDiagonal();
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1.1, 0.9, -0.8).asDiagonal();
  return {stretch * body.rest, body.rest + 4 * noise, turn * (stretch * body.rest + noise),
          turn * (flat * body.rest) + 0.1 * noise, turn * (mirror * body.rest) + 0.1 * noise};
}

std::vector<ModelChoice> choices() {
  std::vector<ModelChoice> result;
  for (const ModelKind& kind : model_table()) {
    result.push_back({std::string(kind.name), Formulation::plain});
    if (kind.has_b_bar) result.push_back({std::string(kind.name), Formulation::b_bar});
    if (kind.has_incompatible_modes) result.push_back({std::string(kind.name), Formulation::incompatible_modes});
  }
  return result;
}

class EveryModel : public testing::TestWithParam<ModelChoice> {
 protected:
  /// Calls check(body, model) for each body whose element kinds the model takes, as it names no others.
  template <class Check>
  void for_bodies(std::vector<Body> bodies, const Check& check) const {
    std::size_t taken = 0;
    for (Body& body : bodies) {
      std::unique_ptr<ForceModel> model;
      try {
        model = make_model(GetParam(), body.blocks, body.rest);
      } catch (const Error& error) {
        ASSERT_EQ(error.code(), ErrorCode::unsupported) << error.what();
        continue;
      }
      ++taken;
      SCOPED_TRACE(body.name);
      check(body, *model);
    }
    EXPECT_GT(taken, 0u);
  }
  template <class Check>
  void for_bodies(const Check& check) const {
    std::vector<Body> bodies = test::all_bodies();
    bodies.push_back(test::tetrahedra(1, 0.1));
    for_bodies(std::move(bodies), check);
  }
};

TEST_P(EveryModel, HasTheNameItIsAskedForBy) {
  for_bodies([&](const Body&, const ForceModel& model) { EXPECT_EQ(model.name(), GetParam().name); });
}

TEST_P(EveryModel, RigidMotionGivesNoForce) {
  const Eigen::Matrix3d turn = test::rotation(2.5, {1, -2, 0.5});
  const Eigen::Vector3d far(3, -5, 7);
  for_bodies([&](const Body& body, const ForceModel& model) {
    const double bound = 1e-12 * 1060;  // E h², h ≤ 1
    EXPECT_LE(largest(forces_at(model, body.rest.colwise() + far)), bound);
    const double turned = largest(forces_at(model, (turn * body.rest).colwise() + far));
    if (model.promises().rotation_invariant) {
      EXPECT_LE(turned, bound);
    } else {
      const Eigen::Matrix3Xd x = 1.1 * body.rest;
      EXPECT_GT(largest(forces_at(model, turn * x) - turn * forces_at(model, x)), 1) << "it feels rotation";
    }
  });
}

TEST_P(EveryModel, TurnsWithTheFrame) {
  const Eigen::Matrix3d turn = test::rotation(1.2, {0.3, 1, 2});
  for_bodies([&](const Body& body, const ForceModel& model) {
    if (!model.promises().rotation_invariant) return;
    for (const Eigen::Matrix3Xd& x : states(body)) {
      const Eigen::Matrix3Xd f = forces_at(model, x);
      // Mirrored states double the rounding through σ₁ + σ₂ of the flattened points.
      EXPECT_LE(largest(forces_at(model, turn * x) - turn * f), 1e-11 * largest(f));
      if (model.promises().has_energy) {
        EXPECT_NEAR(model.energy(turn * x), model.energy(x), 1e-12 * model.energy(x));
      }
    }
  });
}

TEST_P(EveryModel, SumsOfForceAndMomentVanish) {
  for_bodies([&](const Body& body, const ForceModel& model) {
    if (!model.promises().conserves_momentum) return;
    for (const Eigen::Matrix3Xd& x : states(body)) {
      const Eigen::Matrix3Xd f = forces_at(model, x);
      Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
      double forces = 0, moments = 0;
      for (Eigen::Index i = 0; i < f.cols(); ++i) {
        const Eigen::Vector3d fi = f.col(i), xi = x.col(i), torque = xi.cross(fi);
        force += fi;
        moment += torque;
        forces += fi.norm();
        moments += torque.norm();
      }
      EXPECT_LE(force.norm(), 1e-12 * forces);
      EXPECT_LE(moment.norm(), 1e-12 * moments);  // ghost torque
    }
  });
}

TEST_P(EveryModel, EnergyVanishesAtRestAndNotBesideIt) {
  for_bodies([&](const Body& body, const ForceModel& model) {
    if (!model.promises().has_energy) return;
    EXPECT_LE(std::abs(model.energy(body.rest)), 1e-24 * 1060);  // squares of strains of rounding's size
    const Eigen::Matrix3Xd near = body.rest + test::random_vectors(body.rest.cols(), 1e-6, 13);
    // The quadratic form of the tangent at rest: what cancels must cancel exactly.
    const Eigen::Matrix3Xd dx = near - body.rest;
    const double form = 0.5 * dx.cwiseProduct(product_at(*model.tangent(body.rest, Projection::none), dx)).sum();
    EXPECT_NEAR(model.energy(near), form, 1e-3 * form);
  });
}

TEST_P(EveryModel, ForcesAreTheNegativeGradientOfTheEnergy) {
  for_bodies([&](const Body& body, const ForceModel& model) {
    if (!model.promises().has_energy) return;
    for (const Eigen::Matrix3Xd& x : states(body)) {
      const Eigen::Matrix3Xd f = forces_at(model, x);
      const Eigen::Matrix3Xd dx = test::random_vectors(x.cols(), 1, 17);
      const double e = 1e-6;
      const double slope = (model.energy(x + e * dx) - model.energy(x - e * dx)) / (2 * e);
      // Central difference: rounding 1e-16 Ψ/e, truncation e² Ψ‴.
      const double scale = f.cwiseProduct(dx).cwiseAbs().sum();
      EXPECT_NEAR(slope, -f.cwiseProduct(dx).sum(), 1e-7 * scale + 1e-9 * model.energy(x));
    }
  });
}

TEST_P(EveryModel, TangentIsTheNegativeDerivativeOfTheForces) {
  for_bodies([&](const Body& body, const ForceModel& model) {
    if (!model.promises().exact_tangent) return;
    for (const Eigen::Matrix3Xd& x : states(body)) {
      const Eigen::Matrix3Xd dx = test::random_vectors(x.cols(), 1, 19);
      const double e = 1e-7;
      const Eigen::Matrix3Xd difference = (forces_at(model, x - e * dx) - forces_at(model, x + e * dx)) / (2 * e);
      const Eigen::Matrix3Xd product = product_at(*model.tangent(x, Projection::none), dx);
      // Rounding 1e-15 f/e; near mirrored flat points the third derivative grows as 1/(σ₁ + σ₂)².
      EXPECT_LE(largest(product - difference), 1e-5 * largest(product));
    }
  });
}

TEST_P(EveryModel, ElementTangentsAssembleToTheProduct) {
  for_bodies([&](const Body& body, const ForceModel& model) {
    for (const Eigen::Matrix3Xd& x : states(body)) {
      const auto tangent = model.tangent(x, Projection::positive_semidefinite);
      const Eigen::Matrix3Xd dx = test::random_vectors(x.cols(), 1, 23);
      Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, x.cols());
      std::size_t visited = 0;
      tangent->element_tangents([&](std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& stiffness) {
        ++visited;
        ASSERT_EQ(stiffness.rows(), static_cast<Eigen::Index>(3 * nodes.size()));
        Eigen::VectorXd local(stiffness.rows());
        for (std::size_t n = 0; n < nodes.size(); ++n)
          local.segment<3>(static_cast<Eigen::Index>(3 * n)) = dx.col(nodes[n]);
        const Eigen::VectorXd force = stiffness * local;
        for (std::size_t n = 0; n < nodes.size(); ++n)
          sum.col(nodes[n]) += force.segment<3>(static_cast<Eigen::Index>(3 * n));
      });
      std::size_t elements = 0;
      for (const ElementBlock& block : body.blocks) elements += block.element_count();
      EXPECT_EQ(visited, elements);
      EXPECT_LE(largest(sum - product_at(*tangent, dx)), 1e-12 * largest(sum));
    }
  });
}

TEST_P(EveryModel, ProjectedTangentsHaveNoNegativeEigenvalue) {
  for_bodies([&](const Body& body, const ForceModel& model) {
    if (!model.promises().symmetric_tangent) return;
    for (const Eigen::Matrix3Xd& x : states(body))
      model.tangent(x, Projection::positive_semidefinite)
          ->element_tangents([&](std::span<const std::uint32_t>, const Eigen::MatrixXd& stiffness) {
            const Eigen::VectorXd values = eigenvalues(stiffness);
            EXPECT_GE(values[0], -2e-13 * values[values.size() - 1]);
          });
  });
}

TEST_P(EveryModel, ProjectionOnlyAddsStiffness) {
  for_bodies([&](const Body& body, const ForceModel& model) {
    if (!model.promises().symmetric_tangent) return;
    for (const Eigen::Matrix3Xd& x : states(body)) {
      std::vector<Eigen::MatrixXd> whole;
      model.tangent(x, Projection::none)
          ->element_tangents([&](std::span<const std::uint32_t>, const Eigen::MatrixXd& stiffness) {
            EXPECT_LE((stiffness - stiffness.transpose()).cwiseAbs().maxCoeff(),
                      1e-12 * stiffness.cwiseAbs().maxCoeff());
            whole.push_back(stiffness);
          });
      std::size_t element = 0;
      model.tangent(x, Projection::positive_semidefinite)
          ->element_tangents([&](std::span<const std::uint32_t>, const Eigen::MatrixXd& stiffness) {
            const Eigen::MatrixXd& before = whole[element++];
            const double top = std::max(stiffness.cwiseAbs().maxCoeff(), before.cwiseAbs().maxCoeff());
            EXPECT_GE(eigenvalues(stiffness - before)[0], -1e-12 * static_cast<double>(before.rows()) * top);
          });
    }
  });
}

TEST_P(EveryModel, TangentAtRestEqualsTheLinearStiffness) {
  for_bodies([&](const Body& body, const ForceModel& model) {
    if (!model.promises().rest_tangent_is_linear) return;
    const Eigen::Matrix3Xd dx = test::random_vectors(body.rest.cols(), 1, 31);
    const auto linear = make_model({"linear", GetParam().formulation}, body.blocks, body.rest);
    const Eigen::Matrix3Xd expected = product_at(*linear->tangent(body.rest, Projection::none), dx);
    EXPECT_LE(largest(product_at(*model.tangent(body.rest, Projection::none), dx) - expected),
              2e-14 * largest(expected));
  });
}

TEST_P(EveryModel, EachElementHasSixZeroModesAtRest) {
  for_bodies([&](const Body& body, const ForceModel& model) {
    if (!model.promises().symmetric_tangent) return;
    model.tangent(body.rest, Projection::none)
        ->element_tangents([&](std::span<const std::uint32_t>, const Eigen::MatrixXd& stiffness) {
          const Eigen::VectorXd values = eigenvalues(stiffness);
          const double top = values[values.size() - 1];
          EXPECT_LE(values.head(6).cwiseAbs().maxCoeff(), 1e-13 * top);
          // 64 B-spline control points: the softest true mode is a corner that the cell hardly feels.
          EXPECT_GE(values[6], 1e-10 * top);
        });
  });
}

TEST_P(EveryModel, PatchTestIsExactInsideOfMixedMeshes) {
  Eigen::Matrix3d affine;
  affine << 1.1, 0.05, -0.02, 0.03, 0.95, 0.1, -0.04, 0.02, 1.05;
  std::vector<Body> bodies = {test::hexahedra(4, 0.2),    test::pyramids(2, 0.15),   test::mixed(4, 0.15),
                              test::irregular_cell(0.05), test::tetrahedra(2, 0.15), test::bspline(4, 0)};
  // Unequal layers, sheared: Jacobians that differ from point to point.
  Eigen::Matrix3d shear;
  shear << 1, 0.3, 0, 0.1, 1.2, -0.2, 0, 0.4, 0.9;
  bodies.back().rest = shear * bodies.back().rest;
  for (Body& body : bodies) test::finish(body, 0.3, true);
  for_bodies(bodies, [&](const Body& body, const ForceModel& model) {
    if (!model.promises().passes_patch_test) return;
    ASSERT_FALSE(body.interior.empty());
    const Eigen::Matrix3Xd f = forces_at(model, affine * body.rest);
    const double stress = 100;  // ≈ E · strain, and boundary nodes carry it
    EXPECT_GT(largest(f), 1e-3 * stress);
    double residual = 0;
    for (const auto node : body.interior) residual = std::max(residual, f.col(node).cwiseAbs().maxCoeff());
    EXPECT_LE(residual, 1e-13 * stress);
  });
}

TEST_P(EveryModel, PaintedMaterialIsFeltWithoutANewModel) {
  std::vector<Body> bodies = {test::hexahedra(2, 0.1), test::mixed(2, 0.1)};
  for (Body& body : bodies) {
    std::unique_ptr<ForceModel> model;
    try {
      model = make_model(GetParam(), body.blocks, body.rest);
    } catch (const Error&) {
      continue;
    }
    const Eigen::Matrix3Xd x = 1.2 * body.rest + test::random_vectors(body.rest.cols(), 0.05, 37);
    const Eigen::Matrix3Xd before = forces_at(*model, x);
    const auto tangent = model->tangent(x, Projection::none);
    const Eigen::Matrix3Xd product = product_at(*tangent, x);
    for (ElementBlock& block : body.blocks) {
      for (double& mu : block.mu) mu *= 4;
      for (double& lambda : block.lambda) lambda *= 4;
    }
    EXPECT_LE(largest(forces_at(*model, x) - 4 * before), 1e-12 * largest(before));
    EXPECT_EQ(largest(product_at(*tangent, x) - product), 0) << "a tangent keeps its material";
    EXPECT_LE(largest(product_at(*model->tangent(x, Projection::none), x) - 4 * product), 1e-12 * largest(product));
  }
}

TEST_P(EveryModel, PointsWithoutMaterialGiveNoForce) {
  std::vector<Body> bodies = {test::hexahedra(1, 0.1), test::pyramids(1, 0.1)};
  for (Body& body : bodies)
    for (ElementBlock& block : body.blocks)
      for (auto* values : {&block.mu, &block.lambda}) std::fill(values->begin(), values->end(), 0.0);
  for_bodies(bodies, [&](const Body& body, const ForceModel& model) {
    for (const Eigen::Matrix3Xd& x : {Eigen::Matrix3Xd(0.0 * body.rest), Eigen::Matrix3Xd(2.0 * body.rest)}) {
      EXPECT_EQ(largest(forces_at(model, x)), 0);
      EXPECT_EQ(largest(product_at(*model.tangent(x, Projection::positive_semidefinite), body.rest)), 0);
    }
  });
}

TEST_P(EveryModel, CollapseToAPointOrALineStaysFinite) {
  for_bodies([&](const Body& body, const ForceModel& model) {
    Eigen::Matrix3Xd line = Eigen::Matrix3Xd::Zero(3, body.rest.cols());
    line.row(1) = body.rest.row(0);
    for (const Eigen::Matrix3Xd& x : {Eigen::Matrix3Xd(0.0 * body.rest), line}) {
      EXPECT_TRUE(forces_at(model, x).allFinite());
      EXPECT_TRUE(product_at(*model.tangent(x, Projection::positive_semidefinite), body.rest).allFinite());
      if (model.promises().has_energy) {
        EXPECT_TRUE(std::isfinite(model.energy(x)));
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(ModelTable, EveryModel, testing::ValuesIn(choices()), [](const auto& test_info) {
  return test_info.param.name + "_" + std::string(word(test_info.param.formulation));
});

TEST(ModelTable, RefusesWhatAModelLacks) {
  EXPECT_THROW(static_cast<void>(model_by_name("rubber")), Error);
  for (const ModelKind& kind : model_table()) {
    const std::string name(kind.name);
    if (!kind.has_b_bar) {
      EXPECT_THROW(check_model({name, Formulation::b_bar}), Error);
    }
    if (!kind.has_incompatible_modes) {
      EXPECT_THROW(check_model({name, Formulation::incompatible_modes}), Error);
    }
  }
}

TEST(ModelTable, OneModelAndOneIntegratorMakeUpThePublishedMethod) {
  const auto of = [](const auto& kind) { return kind.of_published_method; };
  const auto models = model_table();
  const auto methods = method_table();
  ASSERT_EQ(std::count_if(models.begin(), models.end(), of), 1);
  ASSERT_EQ(std::count_if(methods.begin(), methods.end(), of), 1);
  EXPECT_EQ(std::find_if(models.begin(), models.end(), of)->name, "published");
  EXPECT_EQ(std::find_if(methods.begin(), methods.end(), of)->method, Method::published);
}

}  // namespace
}  // namespace argil::fem
