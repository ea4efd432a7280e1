#include "fem/models/model_table.h"

#include <fmt/format.h>

#include "fem/models/hyperelastic.h"
#include "fem/models/linear.h"
#include "fem/models/local_frame.h"
#include "fem/models/mass_spring.h"
#include "fem/models/prestress.h"
#include "fem/models/warped_stiffness.h"
#include "subdiv/error.h"

namespace argil::fem {

namespace {

/// Plain corotational elements have kernels of their own, which are faster.
template <Law law>
std::unique_ptr<ForceModel> make_law(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
                                     Formulation formulation) {
  const bool mean_dilatation = formulation == Formulation::b_bar;
  if (law == Law::corotational && !mean_dilatation) return make_corotational(blocks, rest_nodes);
  return make_hyperelastic(law, blocks, rest_nodes, mean_dilatation);
}

}  // namespace

std::string_view word(Formulation formulation) {
  switch (formulation) {
    case Formulation::plain:
      return "plain";
    case Formulation::b_bar:
      return "b_bar";
    case Formulation::incompatible_modes:
      return "incompatible_modes";
  }
  return "";
}

std::span<const ModelKind> model_table() {
  static constexpr ModelKind table[] = {
      {.name = "corotational",
       .summary = "the default, linear in the strain that is left when the rotation is taken off",
       .make = make_law<Law::corotational>,
       .has_b_bar = true,
       .can_flow = true},
      {.name = "linear",
       .summary = "small strain in fixed axes, wrong under rotation",
       .make = make_linear_as,
       .has_b_bar = true,
       .has_incompatible_modes = true},
      {.name = "stable_neo_hookean",
       .summary = "resists compression without limit and recovers from inversion; needs the line search",
       .make = make_law<Law::stable_neo_hookean>,
       .has_b_bar = true,
       .can_flow = true},
      {.name = "st_venant_kirchhoff",
       .summary =
           "linear in the Green strain, as in reference solutions; turns soft and collapses under compression",
       .make = make_law<Law::st_venant_kirchhoff>,
       .has_b_bar = true,
       .can_flow = true},
      {.name = "warped_stiffness",
       .summary =
           "one rotation an element about its linear stiffness; no energy, and ghost torque where it is distorted",
       .make = make_warped_stiffness,
       .has_b_bar = true,
       .has_incompatible_modes = true},
      {.name = "mass_spring",
       .summary = "cubes of springs along edges and face diagonals with a volume energy, exact for uniform strain",
       .make = [](std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
                  Formulation) { return make_mass_spring(blocks, rest_nodes); },
       .takes_prestress = false,
       .springs = DiagonalSprings::faces},
      {.name = "mass_spring_m2",
       .summary = "cubes of springs along edges and inner diagonals, held against hourglasses by more springs",
       .make = [](std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
                  Formulation) { return make_mass_spring(blocks, rest_nodes, {DiagonalSprings::inner}); },
       .takes_prestress = false,
       .springs = DiagonalSprings::inner},
      {.name = "mass_spring_m3",
       .summary = "cubes of springs along edges, face and inner diagonals with a volume energy",
       .make = [](std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
                  Formulation) { return make_mass_spring(blocks, rest_nodes, {DiagonalSprings::both}); },
       .takes_prestress = false,
       .springs = DiagonalSprings::both},
      {.name = "mass_spring_published",
       .summary = "mass_spring_m2 with the corrective force as printed, which is half of what is needed",
       .make =
           [](std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes, Formulation) {
             return make_mass_spring(blocks, rest_nodes, {DiagonalSprings::inner, SpringCorrection::printed});
           },
       .takes_prestress = false,
       .springs = DiagonalSprings::inner},
      {.name = "published",
       .summary =
           "papers/004's forces from edge lengths and face angles, made precise; for explicit steps with damping",
       .make = [](std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
                  Formulation) { return make_local_frame(blocks, rest_nodes); },
       .takes_prestress = false,
       .of_published_method = true},
      {.name = "published_literal",
       .summary = "the same as its equations are printed, without force inside a body under uniform strain",
       .make = [](std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
                  Formulation) { return make_local_frame_literal(blocks, rest_nodes); },
       .takes_prestress = false},
      {.name = "neo_hookean",
       .summary =
           "the law of Abaqus and CalculiX (C10 = mu/2, D1 = 2/K), continued below a tenth of the rest volume "
           "so that flat and inside-out cells have a finite energy and come back; needs the line search",
       .make = make_law<Law::neo_hookean>,
       .has_b_bar = true,
       .can_flow = true},
  };
  return table;
}

const ModelKind& model_by_name(std::string_view name) {
  std::string names;
  for (const ModelKind& kind : model_table()) {
    if (kind.name == name) return kind;
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  }
  throw Error(ErrorCode::not_found, fmt::format("'{}' is not a force model; there are {}", name, names));
}

void check_model(const ModelChoice& choice) {
  const ModelKind& kind = model_by_name(choice.name);
  const bool lacks = (choice.formulation == Formulation::b_bar && !kind.has_b_bar) ||
                     (choice.formulation == Formulation::incompatible_modes && !kind.has_incompatible_modes);
  if (lacks)
    throw Error(ErrorCode::unsupported, fmt::format("the model {} has no formulation {}; leave the formulation out",
                                                    kind.name, word(choice.formulation)));
}

std::unique_ptr<ForceModel> make_model(const ModelChoice& choice, std::span<const ElementBlock> blocks,
                                       const Eigen::Matrix3Xd& rest_nodes,
                                       std::shared_ptr<const double> prestress_share) {
  check_model(choice);
  const ModelKind& kind = model_by_name(choice.name);
  bool prestressed = false;
  for (const ElementBlock& block : blocks) prestressed = prestressed || !block.prestress.empty();
  if (prestressed && !kind.takes_prestress)
    throw Error(ErrorCode::unsupported,
                fmt::format("the model {} takes no initial stress; set the prestress to 0 or choose another model",
                            kind.name));
  std::unique_ptr<ForceModel> model = kind.make(blocks, rest_nodes, choice.formulation);
  if (!prestressed) return model;
  return make_prestressed(std::move(model), blocks, rest_nodes, {}, std::move(prestress_share));
}

}  // namespace argil::fem
