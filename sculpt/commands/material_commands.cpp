#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/document_loads.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

const FieldInfo& field_info(const Arguments& arguments) {
  return field_table()[static_cast<std::size_t>(field_by_word(arguments.word("field")))];
}

void check_range(const FieldInfo& info, double value, const std::string& where) {
  if (!(value >= info.low && value <= info.high))
    throw Error(ErrorCode::bad_input, fmt::format("{} must lie between {:g} and {:g} {}, found {:g}{}", info.word,
                                                  info.low, info.high, info.unit, value, where));
}

// Nodes that a command covers; all without a condition.
std::vector<std::uint32_t> covered_nodes(const Session& session, const Arguments& arguments) {
  const auto nodes = matching(session.document(), ElementType::nodes, arguments.expression("where"));
  if (nodes.empty()) throw Error(ErrorCode::bad_input, "no node fits the condition; nothing would change");
  return nodes;
}

void set_field(Session& session, const Arguments& arguments) {
  require_solid(session);
  const FieldInfo& info = field_info(arguments);
  const Expression& formula = *arguments.expression("value");
  if (formula.is_boolean())
    throw Error(ErrorCode::bad_input, "set wants a number or a formula, and this is a condition");
  const auto nodes = covered_nodes(session, arguments);
  const Eigen::VectorXd values = values_at_nodes(session.document(), formula, nodes);
  State next = session.document().state();
  auto fields = std::make_shared<Fields>(*next.fields);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double value = values[static_cast<Eigen::Index>(i)];
    check_range(info, value, fmt::format(" at node {}", nodes[i]));
    (*fields)[info.name][nodes[i]] = value;
  }
  next.fields = fields;
  session.change(std::move(next));
}

void paint(Session& session, const Arguments& arguments) {
  require_solid(session);
  const FieldInfo& info = field_info(arguments);
  const bool scales = arguments.has("scale"), sets = arguments.has("value");
  if (scales == sets)
    throw Error(ErrorCode::bad_input,
                "paint wants either `value V` or `scale S`, as in `paint young_modulus scale 10`");
  if (arguments.has("at") != arguments.has("radius"))
    throw Error(ErrorCode::bad_input, "a brush wants both `at X Y Z` and `radius R`");
  if (arguments.has("falloff") && !arguments.has("at"))
    throw Error(ErrorCode::bad_input, "a falloff is a brush's; add `at X Y Z radius R`");
  if (sets) check_range(info, arguments.number("value"), "");
  const Document& document = session.document();
  const Eigen::Matrix3Xd nodes = subdiv::apply(document.refinement().stencils.back(), document.positions());
  const fem::Falloff falloff = falloff_by_word(arguments.word("falloff", "smooth"));
  State next = document.state();
  auto fields = std::make_shared<Fields>(*next.fields);
  Eigen::VectorXd& values = (*fields)[info.name];
  std::size_t touched = 0;
  for (const std::uint32_t node : covered_nodes(session, arguments)) {
    double weight = info.name == FieldName::mask ? 1 : 1 - (*fields)[FieldName::mask][node];
    if (arguments.has("at"))
      weight *=
          falloff_weight(falloff, (nodes.col(node) - arguments.vector("at")).norm() / arguments.number("radius"));
    if (weight <= 0) continue;
    ++touched;
    values[node] = scales ? values[node] * std::pow(arguments.number("scale"), weight)
                          : values[node] + weight * (arguments.number("value") - values[node]);
    check_range(info, values[node], fmt::format(" at node {}; use a smaller scale", node));
  }
  if (touched == 0)
    throw Error(ErrorCode::bad_input, "the brush touches no node; move it or make its radius larger");
  session.print(fmt::format("{} painted on {}", info.word, count_of(touched, ElementType::nodes)));
  next.fields = fields;
  session.change(std::move(next));
}

void set_model(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  next.model.name = arguments.word("model");
  next.model.formulation = fem::Formulation::plain;
  if (arguments.has("formulation"))
    for (const fem::Formulation f : fem::k_formulations)
      if (arguments.word("formulation") == fem::word(f)) next.model.formulation = f;
  fem::check_model(next.model);
  if (next.plasticity.on || next.flow) fem::check_flow(next.model);
  session.change(std::move(next));
}

}  // namespace

std::vector<Command> material_commands() {
  std::vector<std::string> names;
  std::string field_help;
  for (const FieldInfo& info : field_table()) {
    names.emplace_back(info.word);
    const std::string unit = info.unit;
    field_help += (field_help.empty() ? "" : ", ") + names.back() + (unit.empty() ? "" : " [" + unit + "]");
  }
  std::vector<std::string> models, formulations;
  std::string model_summaries;
  for (const fem::ModelKind& kind : fem::model_table()) {
    models.emplace_back(kind.name);
    model_summaries += (model_summaries.empty() ? "" : " ") + fmt::format("{}: {}.", kind.name, kind.summary);
  }
  for (const fem::Formulation f : fem::k_formulations) formulations.emplace_back(fem::word(f));
  const Parameter field{.name = "field",
                        .type = ArgumentType::word,
                        .help = field_help,
                        .positional = true,
                        .required = true,
                        .choices = names};
  const Parameter where{.name = "where", .type = ArgumentType::expression, .help = "only nodes that fit"};
  return {
      {.name = "set",
       .summary = "Gives a field a number, or a formula of x y z px py pz, boundary, valence and the fields.",
       .parameters = {field,
                      {.name = "value",
                       .type = ArgumentType::expression,
                       .help = "a number or a formula",
                       .positional = true,
                       .required = true},
                      where},
       .example = "set density 300 + 100*z where z < 0.5",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1"},
       .run = set_field},
      {.name = "paint",
       .summary =
           "Changes a field on part of the solid, by a condition, a round brush, or both. The mask protects.",
       .parameters = {field,
                      {.name = "value", .help = "the value to reach"},
                      {.name = "scale", .help = "the factor to multiply by", .low = 1e-9, .high = 1e9},
                      {.name = "at", .help = "middle of the brush", .unit = "m", .count = 3},
                      {.name = "radius", .help = "of the brush", .unit = "m", .low = 1e-12, .high = 1e9},
                      {.name = "falloff",
                       .type = ArgumentType::word,
                       .help = "towards the rim of the brush",
                       .choices = {"smooth", "linear", "constant"}},
                      where},
       .example = "paint young_modulus scale 10 where x < 0.2",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1"},
       .run = paint},
      {.name = "model",
       .summary = "The force model. " + model_summaries,
       .parameters = {{.name = "model",
                       .type = ArgumentType::word,
                       .help = "the model",
                       .positional = true,
                       .required = true,
                       .choices = models},
                      {.name = "formulation",
                       .type = ArgumentType::word,
                       .help = "of hexahedra: plain, b_bar (against locking near ν = 0.5), incompatible_modes (for "
                               "bending); a model names those that it has",
                       .choices = formulations}},
       .example = "model linear",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1"},
       .run = set_model},
  };
}

}  // namespace argil::sculpt
