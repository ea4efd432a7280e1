#include "tools/view/scene_painter.h"

#include <algorithm>

#include "tools/view/shaders.h"

namespace argil::view {

namespace {

constexpr std::size_t k_fine = 20'000;  // faces
constexpr float k_unmeasured = 0.85F;   // openness, until it is known

using Line = std::array<Eigen::Vector3f, 2>;

}  // namespace

ScenePainter::ScenePainter(const Gl& gl)
    : gl_(&gl),
      background_program_(gl, shaders::k_whole_vertex, shaders::k_background_fragment),
      surface_program_(gl, shaders::k_surface_vertex, shaders::k_surface_fragment),
      id_program_(gl, shaders::k_surface_vertex, shaders::k_id_fragment),
      depth_program_(gl, shaders::k_surface_vertex, shaders::k_depth_fragment),
      image_program_(gl, shaders::k_whole_vertex, shaders::k_image_fragment),
      obstacle_program_(gl, shaders::k_surface_vertex, shaders::k_obstacle_fragment),
      shapes_(gl),
      openness_(gl, depth_program_),
      shadow_(gl),
      wires_(gl),
      nothing_(gl),
      surface_(gl),
      cage_lines_(gl),
      cage_points_(gl),
      handles_(gl),
      pins_(gl) {
  nothing_.set(std::vector<float>(4, 0.0F), std::array<Attribute, 1>{{{0, 1}}});
}

void ScenePainter::load(const sculpt::Scene& scene, const Place& place, const sculpt::PictureOptions& options) {
  set_look(options.wireframe, options.light_theme);
  draws_surface_ = scene.draw_surface;

  std::vector<Eigen::Vector3f> positions;
  for (const Eigen::Vector3f& position : scene.surface.positions) positions.push_back(place(position));
  mesh_ = surface_mesh(scene.surface, positions);
  openness_.begin(draws_surface_ ? mesh_ : SurfaceMesh{});
  shaded_ = false;
  for (SurfaceVertex& vertex : mesh_.vertices) vertex.openness = k_unmeasured;
  std::vector<std::uint32_t> indices = mesh_.triangles;
  indices.insert(indices.end(), mesh_.simple_triangles.begin(), mesh_.simple_triangles.end());
  surface_.set(mesh_.vertices, k_surface_attributes, 0, indices);
  all_triangles_ = {0, mesh_.triangles.size()};
  // Middles of faces shade coarse ones better; of fine ones nobody sees them.
  shown_triangles_ = scene.surface.cell_from_face.size() < k_fine
                         ? all_triangles_
                         : IndexRange{mesh_.triangles.size(), mesh_.simple_triangles.size()};
  has_shadow_ = options.contact_shadow && (draws_surface_ || scene.volume) && !mesh_.triangles.empty();
  if (has_shadow_) shadow_.prepare(mesh_, surface_, shown_triangles_);
  draws_surface_ = draws_surface_ && !mesh_.triangles.empty();
  volume_.reset();
  wires_.load(scene.surface, positions);
  load_lines(scene, place);
}

void ScenePainter::move(const sculpt::Scene& scene, const Place& place, bool shade_again) {
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(scene.surface.positions.size());
  for (const Eigen::Vector3f& position : scene.surface.positions) positions.push_back(place(position));
  argil::view::move(mesh_, scene.surface, positions);
  if (draws_surface_ && shade_again) {
    openness_.begin(mesh_);
    shaded_ = false;
  }
  if (!mesh_.vertices.empty()) surface_.refill(mesh_.vertices);
  if (has_shadow_) shadow_.prepare(mesh_, surface_, shown_triangles_);
  wires_.move(scene.surface, positions);
  load_lines(scene, place);
}

bool ScenePainter::shade_on() {
  if (shaded_) return false;
  openness_.look_on();
  if (!openness_.is_done()) return false;
  shaded_ = true;
  if (!draws_surface_) return false;
  openness_.write(mesh_);
  surface_.refill(mesh_.vertices);
  return true;
}

void ScenePainter::set_look(bool wireframe, bool light_theme, bool hidden_pins) {
  draws_hidden_pins_ = hidden_pins;
  theme_ = light_theme ? &k_light_theme : &k_dark_theme;
  draws_wire_ = wireframe;
}

void ScenePainter::set_arrows(std::vector<sculpt::SceneArrow> arrows, const Colour& tint) {
  arrow_ends_ = std::move(arrows);
  arrow_tint_ = tint;
}

void ScenePainter::load_lines(const sculpt::Scene& scene, const Place& place) {
  field_.reset();
  if (!scene.surface.values.empty()) field_ = scene.legend;
  std::vector<Line> lines;
  for (const auto& ends : scene.cage_lines) lines.push_back({place(ends[0]), place(ends[1])});
  cage_lines_.set(lines, k_line_attributes, 1);

  line_sets_.clear();
  for (const sculpt::SceneLines& set : scene.lines) {
    lines.clear();
    for (const auto& ends : set.lines) lines.push_back({place(ends[0]), place(ends[1])});
    line_sets_.push_back({set.look, std::make_unique<VertexArray>(*gl_)});
    line_sets_.back().lines->set(lines, k_line_attributes, 1);
  }

  obstacles_.clear();
  for (const sculpt::SceneObstacle& obstacle : scene.obstacles) {
    std::vector<Eigen::Vector3f> there;
    for (const Eigen::Vector3f& position : obstacle.surface.positions) there.push_back(place(position));
    const SurfaceMesh mesh = surface_mesh(obstacle.surface, there);
    if (mesh.triangles.empty()) continue;
    const SurfaceVertex& first = mesh.vertices.front();
    obstacles_.push_back({obstacle.is_ground, first.position, first.normal, std::make_unique<VertexArray>(*gl_)});
    obstacles_.back().surface->set(mesh.vertices, k_surface_attributes, 0, mesh.triangles);
  }

  const auto placed = [&](const std::vector<Eigen::Vector3f>& all) {
    std::vector<Eigen::Vector3f> result;
    for (const Eigen::Vector3f& position : all) result.push_back(place(position));
    return result;
  };
  cage_points_.set(placed(scene.cage_points), k_place_attributes, 1);
  handles_.set(placed(scene.handles), k_place_attributes, 1);
  pins_.set(placed(scene.pins), k_place_attributes, 1);
  felt_ = scene.felt ? static_cast<float>(std::clamp(scene.felt->share, 0.0, 1.0)) : 0.0F;
  arrow_tint_.reset();
  arrow_ends_.clear();
  for (const sculpt::SceneArrow& arrow : scene.arrows) arrow_ends_.push_back({place(arrow.from), place(arrow.to)});
}

void ScenePainter::set_volume(const std::vector<float>& picture, int width, int height) {
  std::vector<std::uint8_t> rgba(picture.size());
  const std::size_t row = 4 * static_cast<std::size_t>(width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y)
    for (std::size_t i = 0; i < row; ++i)
      rgba[(static_cast<std::size_t>(height) - 1 - y) * row + i] =
          static_cast<std::uint8_t>(255 * picture[y * row + i] + 0.5F);
  volume_ = std::make_unique<Image>(*gl_, width, height, rgba);
}

}  // namespace argil::view
