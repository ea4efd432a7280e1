#include "fem/spectrum/modes.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "fem/spectrum/largest_frequency.h"
#include "io/volume_mesh.h"
#include "sculpt/obstacles.h"
#include "subdiv/build.h"
#include "subdiv/error.h"
#include "tools/argil/program.h"

namespace argil::tools {

namespace {

/// The body at rest with one displacement field a mode, the largest displacement of each a tenth of its size.
void write_shapes(const std::filesystem::path& path, const sculpt::Document& document, const fem::Modes& modes,
                  const Eigen::Matrix3Xd& control_points) {
  const subdiv::Solid& solid = document.refinement().solid();
  const Eigen::Matrix3Xd nodes = document.surface_nodes(control_points);
  io::VolumeMesh mesh;
  mesh.cells = subdiv::cell_lists(solid, nodes);
  const double size = (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).norm();
  const int digits = static_cast<int>(std::to_string(modes.shapes.size()).size());
  for (std::size_t m = 0; m < modes.shapes.size(); ++m) {
    Eigen::Matrix3Xd shape = document.surface_nodes(modes.shapes[m]);
    shape *= 0.1 * size / shape.colwise().norm().maxCoeff();
    io::NamedField field{.name = fmt::format("mode_{:0{}}", m + 1, digits), .components = 3, .values = {}};
    for (const subdiv::VertexId v : solid.vertices())
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        field.values.push_back(shape(axis, static_cast<Eigen::Index>(v.index())));
    mesh.point_fields.push_back(std::move(field));
  }
  io::write_volume_mesh(path, mesh);
}

}  // namespace

int modes(const ModesArguments& arguments) {
  const auto session = run_body(arguments.body);
  const sculpt::Document& document = session->document();
  const bool at_rest = arguments.at == "rest";
  const Eigen::Matrix3Xd& positions = at_rest ? document.rest() : document.positions();
  const fem::System system = document.system();
  const auto& springs = document.loads().springs;
  const fem::Pencil pencil =
      fem::pencil(system, springs, positions, static_cast<double>(arguments.body.limits.memory));
  const fem::Modes found = fem::lowest_modes(pencil, system.rows->column_count, arguments.count);
  const fem::LargestFrequency largest = fem::largest_frequency(system, springs, positions);

  if (!arguments.out.empty()) {
    std::error_code failure;
    std::filesystem::create_directories(arguments.out, failure);
    if (failure)
      throw Error(ErrorCode::bad_input,
                  fmt::format("the folder '{}' cannot be made ({}); choose another with --out",
                              arguments.out.string(), failure.message()));
    write_shapes(arguments.out / "modes.vtu", document, found, positions);
  }
  const double largest_step = 2 / largest.value;
  nlohmann::ordered_json json;
  json["model"] = document.state().model.name;
  json["space"] = document.state().space == fem::Space::cubic ? "cubic" : "default";
  json["level"] = document.state().level;
  json["linearised_at"] = at_rest ? "rest" : "present";
  const std::vector<std::string> left_out = sculpt::left_out_of_linearisation(document.state());
  if (!left_out.empty()) json["left_out"] = left_out;
  json["unknowns"] = pencil.mass.rows();
  json["pinned_control_points"] = document.state().pins->control_points.size();
  json["modes"] = nlohmann::ordered_json::array();
  for (std::size_t m = 0; m < found.squares.size(); ++m)
    json["modes"].push_back({{"frequency", fem::frequency(found, m)},
                             {"omega_squared", found.squares[m]},
                             {"residual", found.residuals[m]}});
  json["omega_max"] = largest.value;
  json["largest_explicit_step"] = largest_step;
  if (!arguments.out.empty()) json["shapes"] = (arguments.out / "modes.vtu").string();
  if (arguments.json) {
    fmt::print("{}\n", json.dump(2));
    return k_well;
  }
  fmt::print("{}, {} space, level {}, {} unknowns, {} control points pinned; linearised {}\n",
             json["model"].get<std::string>(), json["space"].get<std::string>(), document.state().level,
             pencil.mass.rows(), document.state().pins->control_points.size(),
             at_rest ? "at rest" : "at the present state");
  if (!left_out.empty())
    fmt::print("without {}: contact and pressure that follows add a stiffness which these modes do not have\n",
               fmt::join(left_out, ", "));
  fmt::print("mode  frequency [Hz]\n");
  bool unstable = false;
  for (std::size_t m = 0; m < found.squares.size(); ++m) {
    const double value = fem::frequency(found, m);
    unstable = unstable || value < 0;
    fmt::print("{:4}  {:.6g}{}\n", m + 1, std::abs(value),
               value == 0 ? "  (moves freely)"
               : value < 0
                   ? fmt::format("  (unstable: grows by e in {:.3g} s)", 1 / (2 * std::numbers::pi * -value))
                   : "");
  }
  fmt::print("largest  {:.6g} Hz: explicit methods want steps below 2/ω_max = {:.4g} s\n",
             largest.value / (2 * std::numbers::pi), largest_step);
  if (unstable)
    std::fprintf(stderr, "argil: the body is not stable as it stands; --at rest asks about its rest shape\n");
  if (!arguments.out.empty()) fmt::print("shapes in {}\n", (arguments.out / "modes.vtu").string());
  return k_well;
}

}  // namespace argil::tools
