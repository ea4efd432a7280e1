#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/volume_formats.h"
#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/commands/reference_argument.h"
#include "sculpt/export.h"
#include "sculpt/measures.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "sculpt/surface_look.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

double measured_value(const Session& session, const Arguments& arguments) {
  require_solid(session);
  MeasureQuery query{.name = arguments.word("measure"), .at = std::nullopt, .where = arguments.expression("where")};
  if (arguments.has("at")) query.at = arguments.vector("at");
  const auto reference = reference_of(session, arguments);
  query.reference = reference.get();
  if (session.tool_force()) query.tool_force = session.tool_force()->force.norm();
  return measure(session.document(), query);
}

std::string unit_of(const std::string& name) {
  for (const MeasureInfo& info : measure_table())
    if (info.name == name) return info.unit.empty() ? "" : " " + info.unit;
  return "";
}

void print_measure(Session& session, const Arguments& arguments) {
  const double value = measured_value(session, arguments);
  const std::string& name = arguments.word("measure");
  session.measured(arguments.word("as", name), value);
  session.print(fmt::format("{} = {:.10g}{}", arguments.word("as", name), value, unit_of(name)));
}

void expect(Session& session, const Arguments& arguments) {
  if (!arguments.has("value") && !arguments.has("above") && !arguments.has("below"))
    throw Error(ErrorCode::bad_input,
                "expect wants a value, `above V` or `below V`, as in `expect volume 0.03 within 1%`");
  if (arguments.has("within") && !arguments.has("value"))
    throw Error(ErrorCode::bad_input, "within wants the value expected, as in `expect volume 0.03 within 1%`");
  const double value = measured_value(session, arguments);
  const std::string& name = arguments.word("measure");
  const std::string unit = unit_of(name);
  ++session.expectations;
  session.measured(name, value);
  const auto fail = [&](const std::string& expected) {
    session.expectation_failed(fmt::format("expected {} {}{}, found {:.10g}{}", name, expected, unit, value, unit));
  };
  if (arguments.has("value")) {
    const double expected = arguments.number("value");
    // "1%" is a share of the expected value, a plain number an absolute bound.
    const bool relative = arguments.has("within") && arguments.at("within").at.text.ends_with('%');
    const double within = arguments.number("within", 0) * (relative ? std::abs(expected) : 1);
    if (!(std::abs(value - expected) <= within))
      fail(fmt::format("{:.10g}{}", expected,
                       arguments.has("within") ? " within " + arguments.at("within").at.text : std::string{}));
  }
  if (arguments.has("above") && !(value > arguments.number("above")))
    fail(fmt::format("above {:.10g}", arguments.number("above")));
  if (arguments.has("below") && !(value < arguments.number("below")))
    fail(fmt::format("below {:.10g}", arguments.number("below")));
}

void save(Session& session, const Arguments& arguments) {
  require_solid(session);
  const auto path = session.path_to_write(arguments.word("file"));
  const int level = static_cast<int>(arguments.integer("level", session.document().state().level));
  if (level > session.document().state().level)
    throw Error(ErrorCode::bad_input, fmt::format("the solid is at level {}; write `levels {}` first",
                                                  session.document().state().level, level));
  if (arguments.has("field")) {
    if (level < session.document().state().level)
      throw Error(ErrorCode::bad_input, "fields belong to the finest level; leave out level");
    if (arguments.has("encoding") || arguments.has("version"))
      throw Error(ErrorCode::bad_input, "encoding and version are those of volume meshes; leave them out here");
    save_coloured(session.document(), path, arguments.word("field"));
    return;
  }
  io::WriteOptions options;
  if (arguments.has("encoding")) options.encoding = io::encoding_by_word(arguments.word("encoding"));
  options.version = arguments.word("version", "");
  const auto reference = reference_of(session, arguments);
  for (const std::string& note : save_document(session.document(), path, level, options, reference.get()))
    session.print(note);
}

}  // namespace

std::vector<Command> output_commands() {
  std::vector<std::string> measures;
  for (const MeasureInfo& info : measure_table()) measures.push_back(info.name);
  const Parameter measure_name{.name = "measure",
                               .type = ArgumentType::word,
                               .help = "what: see the choices",
                               .positional = true,
                               .required = true,
                               .choices = measures};
  const Parameter at{.name = "at", .help = "a material point, by its rest position", .unit = "m", .count = 3};
  const Parameter where{
      .name = "where", .type = ArgumentType::expression, .help = "only these nodes (reactions: control vertices)"};
  return {
      {.name = "measure",
       .summary = "Prints a measure, and keeps it in the summary.",
       .parameters = {measure_name,
                      at,
                      {.name = "as", .type = ArgumentType::text, .help = "its name in the summary"},
                      where,
                      reference_parameter()},
       .example = "measure displacement_z at 0.3 0.3 0.05",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1", "gravity 0 0 -9.81", "pin where z < 0.001",
                  "step 5"},
       .effect = Effect::output,
       .run = print_measure},
      {.name = "expect",
       .summary = "Checks a measure; if it does not hold, the session goes on and ends with exit status 1.",
       .parameters = {measure_name,
                      {.name = "value", .help = "the value expected", .positional = true},
                      {.name = "within",
                       .help = "how far off it may be; with % as a share of the value",
                       .low = 0,
                       .high = 1e300},
                      {.name = "above", .help = "it must be larger"},
                      {.name = "below", .help = "it must be smaller"},
                      at,
                      where,
                      reference_parameter()},
       .example = "expect volume 0.036 within 1%",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .effect = Effect::output,
       .run = expect},
      {.name = "save",
       .summary =
           "Writes the solid with its fields and named sets (.vtu .vtk .msh .inp .ovm .mesh) or its boundary "
           "(.obj .ply .stl .off .glb .gltf), beneath --out; `argil formats` says what each holds.",
       .parameters = {{.name = "file",
                       .type = ArgumentType::text,
                       .help = "beneath the folder given with --out",
                       .positional = true,
                       .required = true},
                      {.name = "level",
                       .type = ArgumentType::integer,
                       .help = "refinement level; else the finest; 0 is the cage",
                       .low = 0,
                       .high = 8},
                      {.name = "encoding",
                       .type = ArgumentType::word,
                       .help = "of .vtu (else raw), .msh (else binary), .vtk (else ascii)",
                       .choices = {"ascii", "binary", "raw", "compressed"}},
                      {.name = "version", .type = ArgumentType::text, .help = "of .msh: 2.2 or 4.1 (else 4.1)"},
                      {.name = "field",
                       .type = ArgumentType::word,
                       .help = "colours of a .glb or .gltf",
                       .choices = shown_field_names()},
                      {.name = "reference",
                       .type = ArgumentType::text,
                       .help = "a mesh file as of measure: the distance to it goes along as the field error"}},
       .example = "save chair.vtu",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1"},
       .effect = Effect::output,
       .run = save},
  };
}

}  // namespace argil::sculpt
