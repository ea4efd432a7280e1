#include "fem/discretization.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cassert>
#include <cmath>

#include "fem/discretization/linear_mesh.h"
#include "fem/discretization/materials.h"
#include "fem/discretization/numbering.h"
#include "fem/discretization/tricubic_choice.h"
#include "fem/parallel.h"
#include "subdiv/error.h"
#include "subdiv/limit.h"

namespace argil::fem {

namespace {

using subdiv::CellClass;
using subdiv::CellId;
using subdiv::Solid;
using subdiv::Stencils;
using subdiv::VertexId;

ElementBlock& add_block(Discretization& to, const ElementKind& kind) {
  to.blocks.emplace_back().kind = &kind;
  to.field_samples.corners.emplace_back();
  return to.blocks.back();
}

/// Appends the linear mesh as blocks: its vertex v becomes node node_from_vertex[v] and sample
/// sample_from_vertex[v], its centre c node first_centre + c and sample first_centre_sample + c.
void add_linear_blocks(Discretization& to, const LinearMesh& mesh,
                       const std::vector<std::uint32_t>& node_from_vertex,
                       const std::vector<std::uint32_t>& sample_from_vertex, std::size_t first_centre,
                       std::size_t first_centre_sample) {
  if (!mesh.hexahedra.empty()) {
    ElementBlock& block = add_block(to, trilinear_hexahedron());
    block.origins = mesh.hexahedron_origins;
    for (const std::uint32_t v : mesh.hexahedra) {
      block.nodes.push_back(node_from_vertex[v]);
      to.field_samples.corners.back().push_back(sample_from_vertex[v]);
    }
  }
  if (!mesh.pyramids.empty()) {
    ElementBlock& block = add_block(to, pyramid());
    block.origins = mesh.pyramid_origins;
    for (std::size_t i = 0; i < mesh.pyramids.size(); ++i) {
      const std::uint32_t v = mesh.pyramids[i];
      const bool apex = i % 5 == 4;
      block.nodes.push_back(apex ? static_cast<std::uint32_t>(first_centre + v) : node_from_vertex[v]);
      to.field_samples.corners.back().push_back(apex ? static_cast<std::uint32_t>(first_centre_sample + v)
                                                     : sample_from_vertex[v]);
    }
  }
}

std::vector<std::uint32_t> counting(std::size_t first, std::size_t count) {
  std::vector<std::uint32_t> result(count);
  for (std::size_t i = 0; i < count; ++i) result[i] = static_cast<std::uint32_t>(first + i);
  return result;
}

Stencils select_rows(const Stencils& from, const std::vector<std::uint32_t>& rows) {
  Stencils result;
  result.column_count = from.column_count;
  for (const std::uint32_t r : rows) result.append(from.row(r).columns, from.row(r).weights);
  return result;
}

/// Cells of the published criterion, on the vertices of the finest level; those that are left.
std::vector<std::uint8_t> add_published_block(Discretization& to, const subdiv::Refinement& refinement) {
  const Solid& solid = refinement.solid();
  auto classes = subdiv::classify_cells(solid);
  for (const CellId c : solid.cells())
    if (classes[c] != CellClass::regular_published) classes[c] = CellClass::extraordinary;
  const subdiv::RegularNets nets = subdiv::regular_nets(solid, classes);
  assert(nets.phantoms.row_count() == 0);
  std::vector<std::uint8_t> left(solid.cell_capacity(), 1);
  if (nets.cells.empty()) return left;
  ElementBlock& block = add_block(to, bspline_hexahedron());
  for (std::size_t n = 0; n < nets.cells.size(); ++n) {
    left[nets.cells[n].index()] = 0;
    block.nodes.insert(block.nodes.end(), nets.nodes[n].begin(), nets.nodes[n].end());
    block.origins.push_back({static_cast<std::uint16_t>(refinement.finest()), nets.cells[n].value, 0});
    for (const VertexId v : subdiv::box_vertices(solid, nets.cells[n]))
      to.field_samples.corners.back().push_back(v.value);
  }
  return left;
}

/// All elements on the vertices of the finest level: trilinear ones, or where `published`, tricubic ones as well.
void build_on_finest(Discretization& to, const subdiv::Refinement& refinement, bool published,
                     const Progress& progress) {
  LinearCells cells{&refinement.solid(), refinement.finest(), {}};
  const std::vector<std::uint8_t> left =
      published ? add_published_block(to, refinement) : std::vector<std::uint8_t>();
  for (const CellId c : refinement.solid().cells())
    if (left.empty() || left[c.index()]) cells.cells.push_back(c);
  const LinearMesh mesh = mesh_linearly(cells);
  progress.at(0.5);
  const std::size_t vertices = refinement.solid().vertex_capacity();
  NodeTable& table = to.nodes;
  table.rows = refinement.stencils.back();
  table.level_begin.assign(refinement.levels.size() + 1, 0);
  table.level_begin.back() = table.virtual_centre_begin = vertices;
  table.rows.append(subdiv::compose(mesh.centres, refinement.stencils.back(), progress.part(0.5, 1)));
  table.phantom_begin = table.limit_begin = table.node_count();
  to.field_samples.rows = Stencils::identity(vertices);
  to.field_samples.rows.append(mesh.centres);
  to.surface_node_from_vertex = counting(0, vertices);
  add_linear_blocks(to, mesh, to.surface_node_from_vertex, to.surface_node_from_vertex, table.virtual_centre_begin,
                    vertices);
}

/// The finest level refined `split` times more, with its vertices in those of the finest level by subdivision and,
/// for fields, by midpoints; and the cells that descend from `left`.
struct SplitLevels {
  std::vector<Solid> solids;
  std::vector<Stencils> steps;
  Stencils fields;                           // split vertices in finest vertices
  std::vector<std::uint32_t> vertex_points;  // finest vertex → split vertex
  LinearCells cells;
};

SplitLevels split_finest(const subdiv::Refinement& refinement, int split, const std::vector<std::uint8_t>& left,
                         const Progress& progress) {
  SplitLevels result;
  const Solid* solid = &refinement.solid();
  result.fields = Stencils::identity(solid->vertex_capacity());
  result.vertex_points = counting(0, solid->vertex_capacity());
  std::vector<std::uint8_t> open = left;
  result.solids.reserve(static_cast<std::size_t>(split));
  for (int s = 0; s < split; ++s) {
    const NextLevel next(*solid);
    for (std::uint32_t& v : result.vertex_points) v = next.vertex_point(VertexId{v});
    const Progress part = progress.part(std::pow(8.0, s - split) * (s > 0 ? 1 : 0), std::pow(8.0, s + 1 - split));
    result.fields = subdiv::compose(midpoint_stencils(*solid), result.fields, part.part(0, 0.3));
    subdiv::RefinementStep step = subdiv::refine(*solid, refinement.rules, part.part(0.3, 1));
    std::vector<std::uint8_t> open_below(step.coarse_from_fine.size());
    for (std::size_t c = 0; c < open_below.size(); ++c)
      open_below[c] = open[step.coarse_from_fine.raw()[c].index()];
    open = std::move(open_below);
    result.solids.push_back(std::move(step.fine));
    result.steps.push_back(std::move(step.stencils));
    solid = &result.solids.back();
  }
  result.cells = {solid, refinement.finest() + split, {}};
  for (const CellId c : solid->cells())
    if (open[c.index()]) result.cells.cells.push_back(c);
  return result;
}

/// Tricubic elements of all levels as one block; the vertices and phantoms that they name go into the table.
/// Returns the phantoms in control points, which stand after the virtual centres.
Stencils add_tricubic_block(Discretization& to, const subdiv::Refinement& refinement, const TricubicChoice& choice,
                            const Progress& progress) {
  const auto finest = finest_vertices(refinement);
  ElementBlock block;
  block.kind = &bspline_hexahedron();
  std::vector<std::uint32_t> samples;
  Stencils phantoms;
  phantoms.column_count = refinement.stencils[0].column_count;
  // Phantoms get their place when the virtual centres are known: until then they are numbered from the top.
  for (std::size_t level = 0; level < refinement.levels.size(); ++level) {
    to.nodes.level_begin.push_back(to.nodes.node_count());
    if (choice.cells[level].empty()) continue;
    const Solid& solid = refinement.levels[level];
    subdiv::CellData<CellClass> classes(solid.cell_capacity(), CellClass::extraordinary);
    for (const CellId c : choice.cells[level]) classes[c] = CellClass::regular_boundary;
    const subdiv::RegularNets nets = subdiv::regular_nets(solid, classes);
    assert(nets.cells == choice.cells[level]);
    const auto first = static_cast<std::uint32_t>(to.nodes.node_count());
    const auto capacity = static_cast<std::uint32_t>(solid.vertex_capacity());
    for (std::size_t n = 0; n < nets.cells.size(); ++n) {
      for (const std::uint32_t node : nets.nodes[n])
        block.nodes.push_back(node < capacity
                                  ? first + node
                                  : VertexId::k_invalid - static_cast<std::uint32_t>(phantoms.row_count()) -
                                        (node - capacity));
      block.origins.push_back({static_cast<std::uint16_t>(level), nets.cells[n].value, 0});
      for (const VertexId v : subdiv::box_vertices(solid, nets.cells[n]))
        samples.push_back(finest[level][v.index()]);
    }
    to.nodes.rows.append(refinement.stencils[level]);
    phantoms.append(subdiv::compose(nets.phantoms, refinement.stencils[level]));
    progress.at(std::pow(8.0, static_cast<double>(level) + 1 - static_cast<double>(refinement.levels.size())));
  }
  to.nodes.level_begin.push_back(to.nodes.node_count());
  if (!block.origins.empty()) {
    to.blocks.push_back(std::move(block));
    to.field_samples.corners.push_back(std::move(samples));
  }
  return phantoms;
}

void build_cubic(Discretization& to, const subdiv::Refinement& refinement, const NodalFields& fields, int split,
                 const Progress& progress) {
  const TricubicChoice choice = choose_tricubic(refinement, fields);
  progress.at(0.1);
  bool any_left = false;
  for (const std::uint8_t l : choice.left) any_left = any_left || l != 0;

  NodeTable& table = to.nodes;
  table.rows.column_count = refinement.stencils[0].column_count;
  const Stencils phantoms = add_tricubic_block(to, refinement, choice, progress.part(0.1, 0.2));

  const SplitLevels levels = split_finest(refinement, any_left ? split : 0, choice.left, progress.part(0.2, 0.5));
  const LinearMesh mesh = mesh_linearly(levels.cells);
  progress.at(0.6);
  const Solid& solid = *levels.cells.solid;

  // Limit points that elements or the surface name, through the split levels to the control points.
  std::vector<std::uint8_t> named(solid.vertex_capacity(), 0);
  for (const std::uint32_t v : mesh.hexahedra) named[v] = 1;
  for (std::size_t i = 0; i < mesh.pyramids.size(); ++i)
    if (i % 5 != 4) named[mesh.pyramids[i]] = 1;
  for (const std::uint32_t v : mesh.centres.columns) named[v] = 1;
  for (const VertexId v : refinement.solid().vertices()) named[levels.vertex_points[v.index()]] = 1;
  std::vector<std::uint32_t> vertices, number(named.size(), VertexId::k_invalid);
  for (std::size_t v = 0; v < named.size(); ++v) {
    if (!named[v]) continue;
    number[v] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(static_cast<std::uint32_t>(v));
  }
  Stencils limits = select_rows(subdiv::limit_stencils(solid, refinement.rules, progress.part(0.6, 0.7)), vertices);
  progress.at(0.7);
  for (std::size_t s = levels.steps.size(); s-- > 0;)
    limits = subdiv::compose(limits, levels.steps[s], progress.part(0.7, 0.8));
  limits = subdiv::compose(limits, refinement.stencils.back(), progress.part(0.8, 0.9));
  Stencils centres = mesh.centres;
  for (std::uint32_t& column : centres.columns) column = number[column];
  centres.column_count = vertices.size();

  table.virtual_centre_begin = table.node_count();
  table.rows.append(subdiv::compose(centres, limits, progress.part(0.9, 1)));
  table.phantom_begin = table.node_count();
  table.rows.append(phantoms);
  table.limit_begin = table.node_count();
  table.rows.append(limits);
  const auto first_phantom = static_cast<std::uint32_t>(table.phantom_begin);
  for (ElementBlock& block : to.blocks)
    for (std::uint32_t& node : block.nodes)
      if (node >= table.node_count()) node = first_phantom + (VertexId::k_invalid - node);
  for (std::uint32_t& n : number)
    if (n != VertexId::k_invalid) n += static_cast<std::uint32_t>(table.limit_begin);
  to.surface_node_from_vertex.resize(refinement.solid().vertex_capacity());
  for (std::size_t v = 0; v < to.surface_node_from_vertex.size(); ++v)
    to.surface_node_from_vertex[v] = number[levels.vertex_points[v]];

  // Samples: the finest vertices, then the split vertices, then the virtual centres.
  const std::size_t finest = refinement.solid().vertex_capacity();
  to.field_samples.rows = Stencils::identity(finest);
  to.field_samples.rows.append(levels.fields);
  to.field_samples.rows.append(subdiv::compose(mesh.centres, levels.fields));
  add_linear_blocks(to, mesh, number, counting(finest, solid.vertex_capacity()), table.virtual_centre_begin,
                    finest + solid.vertex_capacity());
}

void set_geometry(Discretization& to) {
  for (ElementBlock& block : to.blocks) {
    const std::size_t bad = set_rest_geometry(block, to.rest_nodes);
    if (bad == k_no_point) continue;
    const ElementOrigin& origin = block.origins[bad / static_cast<std::size_t>(block.kind->point_count)];
    throw Error(
        ErrorCode::bad_geometry,
        fmt::format("Cells must not be flat or inside out, but cell {} of level {} has a rest Jacobian that is "
                    "not positive at a quadrature point ({}). Move the control points around it apart, split "
                    "it, or sharpen the edges where the boundary folds.",
                    origin.cell, origin.level, block.kind->name),
        fmt::format("level {}, cell {}", origin.level, origin.cell));
  }
}

}  // namespace

std::span<const SpaceKind> space_table() {
  static constexpr SpaceKind table[] = {
      {Space::standard, "default", "trilinear functions on the refined nodes"},
      {Space::cubic, "cubic", "tricubic B-splines where cells are regular"},
      {Space::published, "published",
       "tricubic and trilinear elements mixed as in papers/004, which leaves gaps between them: for comparison "
       "only"},
  };
  return table;
}

std::string_view word(Space space) {
  for (const SpaceKind& kind : space_table())
    if (kind.space == space) return kind.name;
  return "";
}

Space space_by_name(std::string_view name) {
  std::string names;
  for (const SpaceKind& kind : space_table()) {
    if (kind.name == name) return kind.space;
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  }
  throw Error(ErrorCode::not_found, fmt::format("'{}' is not a space; there are {}", name, names));
}

CellCounts count_cells(const Solid& finest) {
  CellCounts counts;
  const auto classes = subdiv::classify_cells(finest);
  for (const CellId c : finest.cells()) switch (classes[c]) {
      case CellClass::irregular:
        ++counts.irregular;
        break;
      case CellClass::extraordinary:
        ++counts.extraordinary;
        break;
      case CellClass::regular_published:
        ++counts.regular_published;
        [[fallthrough]];
      case CellClass::regular_boundary:
        ++counts.regular;
        break;
    }
  return counts;
}

Discretization discretize(const subdiv::Refinement& refinement, const Eigen::Matrix3Xd& rest_control_points,
                          const NodalFields& fields, const DiscretizationOptions& options,
                          const Progress& progress) {
  assert(static_cast<std::size_t>(rest_control_points.cols()) == refinement.levels[0].vertex_capacity());
  assert(static_cast<std::size_t>(fields.young_modulus.size()) == refinement.solid().vertex_capacity());
  assert(options.split >= 0);
  progress.at(0);
  Discretization result;
  result.space = options.space;
  result.level = refinement.finest();
  result.cells = count_cells(refinement.solid());
  // Loads and tools act on the quadrilaterals of the finest level; only level 0 has other faces.
  if (refinement.finest() == 0) check_quadrilaterals(refinement.solid());
  if (options.space == Space::cubic)
    build_cubic(result, refinement, fields, options.split, progress.part(0.05, 0.4));
  else
    build_on_finest(result, refinement, options.space == Space::published, progress.part(0.05, 0.4));
  for (const ElementBlock& block : result.blocks) {
    if (block.kind == &bspline_hexahedron()) result.elements.cubic += block.element_count();
    if (block.kind == &trilinear_hexahedron()) result.elements.linear += block.element_count();
    if (block.kind == &pyramid()) result.elements.pyramid += block.element_count();
  }
  progress.at(0.4);
  result.rows_transposed = subdiv::transpose(result.nodes.rows);
  progress.at(0.45);
  result.rest_nodes = subdiv::apply(result.nodes.rows, rest_control_points);
  set_geometry(result);
  set_materials(result, fields, progress.part(0.5, 1));
  return result;
}

bool update_fields(Discretization& discretization, const subdiv::Refinement& refinement, const NodalFields& fields,
                   const Progress& progress) {
  progress.at(0);
  if (discretization.space == Space::cubic) {
    const TricubicChoice choice = choose_tricubic(refinement, fields);
    std::size_t chosen = 0;
    for (const auto& cells : choice.cells) chosen += cells.size();
    if (chosen != discretization.elements.cubic) return false;
    std::size_t e = 0;
    for (std::size_t level = 0; level < choice.cells.size(); ++level)
      for (const CellId c : choice.cells[level]) {
        const ElementOrigin& origin = discretization.blocks.front().origins[e++];
        if (origin.level != level || origin.cell != c.value) return false;
      }
  }
  set_materials(discretization, fields, progress);
  return true;
}

double volume(const Discretization& discretization, const Eigen::Matrix3Xd& nodes) {
  double total = 0;
  for (const ElementBlock& block : discretization.blocks) {
    const auto n = static_cast<std::size_t>(block.kind->node_count);
    total += parallel_sum(block.element_count(), 64, [&](std::size_t e) {
      double sum = 0;
      for (int q = 0; q < block.kind->point_count; ++q) {
        Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
        for (std::size_t a = 0; a < n; ++a) {
          const double* gradient = block.kind->gradients.data() + (static_cast<std::size_t>(q) * n + a) * 3;
          for (int axis = 0; axis < 3; ++axis)
            jacobian.col(axis) += gradient[axis] * nodes.col(static_cast<Eigen::Index>(block.nodes[e * n + a]));
        }
        const std::size_t i = block.point_index(e, q);
        sum += block.volumes[i] * (jacobian * block.inverse_rest_jacobians[i]).determinant();
      }
      return sum;
    });
  }
  return total;
}

}  // namespace argil::fem
