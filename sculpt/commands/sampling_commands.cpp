#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "io/file_bytes.h"
#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/line_plot.h"
#include "sculpt/line_samples.h"
#include "sculpt/near_names.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

constexpr int k_usual_count = 41, k_most_points = 10000;

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : text + " ")
    if (c == ' ' || c == ',') {
      if (!word.empty()) words.push_back(word);
      word.clear();
    } else {
      word += c;
    }
  return words;
}

ReferenceShape solution_in(const Session& session, const std::string& file) {
  return ReferenceShape(read_compared_mesh(session.path_to_read(file), session.document().limits.cells));
}

void require_ending(const std::string& name, const char* ending, const char* what) {
  if (!name.ends_with(ending))
    throw Error(ErrorCode::bad_input, fmt::format("{} is a {} file, not '{}'", what, ending, name));
}

void sample(Session& session, const Arguments& arguments) {
  require_solid(session);
  const std::string& name = arguments.word("file");
  require_ending(name, ".csv", "a table");
  const std::array<Eigen::Vector3d, 2> ends{arguments.vector("from"), arguments.vector("to")};
  const int count = static_cast<int>(arguments.integer("count", k_usual_count));
  const std::vector<std::string> fields = words_of(arguments.word("fields", ""));
  SampledLine line;
  if (arguments.has("of")) {
    if (!fields.empty() || arguments.has("reference"))
      throw Error(ErrorCode::bad_input,
                  "of a solution in a file displacements are sampled alone; leave out fields and reference");
    line = sample_line(solution_in(session, arguments.word("of")), ends, count);
  } else {
    std::optional<ReferenceShape> reference;
    if (arguments.has("reference")) {
      if (std::find(fields.begin(), fields.end(), "error") == fields.end())
        throw Error(ErrorCode::bad_input, "a reference is for the field error; add `fields error`");
      reference.emplace(solution_in(session, arguments.word("reference")));
    }
    line = sample_line(session.document(), ends, count, fields, reference ? &*reference : nullptr);
  }
  line.name = arguments.word("as", std::filesystem::path(name).stem().string());
  io::write_file(session.path_to_write(name), table_text(line));
  session.sampled(std::move(line));
}

void plot(Session& session, const Arguments& arguments) {
  require_solid(session);
  const std::string& file = arguments.word("file");
  require_ending(file, ".svg", "a plot");
  const std::string &wanted = arguments.word("column"), against = arguments.word("against", "distance");
  if (session.samples().empty())
    throw Error(ErrorCode::bad_input,
                "nothing has been sampled yet; write `sample axis.csv from 0 0.05 0.05 to 0.4 0.05 0.05` first");
  LinePlot made;
  std::vector<std::string> names;
  for (const SampledLine& line : session.samples()) {
    for (const SampledColumn& column : line.columns) names.push_back(column.name);
    const SampledColumn *y = line.column(wanted), *x = line.column(against);
    if (!x || !y) continue;
    if (made.curves.empty()) {
      made.title = arguments.word("title", y->title);
      made.x_title = x->title;
      made.x_unit = x->unit;
      made.y_title = y->title;
      made.y_unit = y->unit;
    }
    made.curves.push_back({line.name, x->values, y->values});
  }
  if (made.curves.empty()) {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    const bool has_wanted = std::binary_search(names.begin(), names.end(), wanted);
    const std::string& missing = has_wanted ? against : wanted;
    throw Error(ErrorCode::not_found, fmt::format("'{}' has not been sampled{}; there are {}", missing,
                                                  near_names_hint(missing, names), fmt::join(names, ", ")));
  }
  io::write_file(session.path_to_write(file), plot_svg(made));
}

}  // namespace

std::vector<Command> sampling_commands() {
  const Parameter end{.name = "from",
                      .help = "one end of the line, by its rest position",
                      .unit = "m",
                      .count = 3,
                      .required = true,
                      .low = -1e9,
                      .high = 1e9};
  Parameter other_end = end;
  other_end.name = "to";
  other_end.help = "the other end";
  return {
      {.name = "sample",
       .summary =
           "Writes what the body does along a straight line of its rest shape, such as its axis, as a table: "
           "distance, rest position, displacement and fields, point by point.",
       .parameters = {{.name = "file",
                       .type = ArgumentType::text,
                       .help = "a .csv beneath the folder given with --out",
                       .positional = true,
                       .required = true},
                      end,
                      other_end,
                      {.name = "count",
                       .type = ArgumentType::integer,
                       .help = "points, in equal steps from end to end; else 41",
                       .low = 2,
                       .high = k_most_points},
                      {.name = "fields",
                       .type = ArgumentType::text,
                       .help = "more columns, those of `render … field`; several in quotes: \"strain stress\""},
                      {.name = "reference",
                       .type = ArgumentType::text,
                       .help = "a mesh file as of measure, for the field error"},
                      {.name = "of",
                       .type = ArgumentType::text,
                       .help = "instead of the body, a solution in a file beneath the session's own folder, with a "
                               "point field displacement as save writes it"},
                      {.name = "as",
                       .type = ArgumentType::text,
                       .help = "its name in plots; else that of the file"}},
       .example = "sample axis.csv from 0 0.05 0.05 to 0.4 0.05 0.05 count 21 fields \"strain stress\"",
       .before = {"new box 8 2 2 size 0.4 0.1 0.1", "levels 1", "rules multilinear", "pin where x < 0.001",
                  "gravity 0 0 -9.81", "step 5"},
       .effect = Effect::output,
       .run = sample},
      {.name = "plot",
       .summary = "Draws a column of every line sampled so far as a curve, in one picture.",
       .parameters = {{.name = "file",
                       .type = ArgumentType::text,
                       .help = "an .svg beneath the folder given with --out",
                       .positional = true,
                       .required = true},
                      {.name = "column",
                       .type = ArgumentType::word,
                       .help = "which: displacement_z, or another that was sampled",
                       .positional = true,
                       .required = true},
                      {.name = "against",
                       .type = ArgumentType::word,
                       .help = "the column to the right; else distance"},
                      {.name = "title", .type = ArgumentType::text, .help = "above the picture"}},
       .example = "plot axis.svg displacement_z title \"A bar under its weight\"",
       .before = {"new box 8 2 2 size 0.4 0.1 0.1", "pin where x < 0.001", "gravity 0 0 -9.81", "step 5",
                  "sample axis.csv from 0 0.05 0.05 to 0.4 0.05 0.05"},
       .effect = Effect::output,
       .run = plot},
  };
}

}  // namespace argil::sculpt
