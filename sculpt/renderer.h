#pragma once
// The seam through which a command shows a picture; tools/view fills it with OpenGL. Everything here is plain data,
// so that a picture can be made of any state and tested without a window.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "subdiv/progress.h"

namespace argil::sculpt {

/// A polygonal surface or set of cells' faces. Faces are quadrilaterals or polygons as CSR corners.
struct SceneSurface {
  std::vector<Eigen::Vector3f> positions;  // surface vertices [m]
  std::vector<std::size_t> offsets{0};     // faces
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> cell_from_face;              // id for the id buffer
  std::vector<std::uint8_t> cut_faces;                    // 1 a face that a cut laid open; empty: none
  std::vector<std::uint32_t> vertex_from_surface;         // the solid's vertex; may be empty
  std::vector<float> values;                              // field per surface vertex; empty: clay
  std::vector<std::array<std::uint32_t, 2>> sharp_edges;  // creases: normals are split there
  std::vector<std::array<std::uint32_t, 2>> wire;         // cell edges drawn as thin lines
};

struct SceneArrow {
  Eigen::Vector3f from, to;
};
struct SceneLabel {
  Eigen::Vector3f at;
  std::string text;
};
/// viridis for magnitudes; cividis for material; balanced (blue, white, red) for what has a sign, white at 0;
/// green_red from soft to stiff as in papers/004, Fig. 8; kinds: one colour for each whole number.
enum class ColourMap { viridis, cividis, balanced, green_red, kinds };

/// low and high are in the unit of the values. Numbers are written with their unit: 12e3 "Pa" as 12 kPa; with the
/// unit "%" fractions are written as per cent (0.12: 12 %).
struct SceneLegend {
  std::string title, unit;
  double low = 0, high = 1;
  ColourMap map = ColourMap::viridis;
  std::vector<std::string> names{};  // of kinds, which range from 0 to 10: a list in place of the bar
};

/// Lines over the picture, what lies behind the surface faintly.
enum class LineLook {
  overlay,
  axis_u,
  axis_v,
  axis_w,
  side,
  rest_side,
  edge_spring,
  face_spring,
  inner_spring,
  material_line,
  curve
};
struct SceneLines {
  LineLook look = LineLook::overlay;
  std::vector<std::array<Eigen::Vector3f, 2>> lines;
  std::string name{};  // empty: not in the key of the picture
};

/// A field inside a body, for a volume rendering: linear in each tetrahedron. Light is emitted in the legend's
/// colours and absorbed with an extinction that rises linearly with the value, from a twentieth at the low end of
/// the legend to the whole at its high end; with the balanced map from the middle to both ends. The whole is
/// `opacity` times 12 over the radius of the scene (half its diagonal).
struct SceneVolume {
  std::vector<Eigen::Vector3f> positions;  // [m]
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  std::vector<float> values;  // per position
  double opacity = 1;
};

/// What the body may lie on, in a quiet grey that lets it shine through; values are opacities, 1 where empty. It
/// counts for nothing that is picked.
struct SceneObstacle {
  SceneSurface surface;
  bool is_ground = false;  // drawn beneath the body where it faces the eye, and not framed
};

/// What the hand feels: the ground of the picture takes colour with it, grey at 0 and full at 1, and the text
/// stands at its foot.
struct SceneFelt {
  double share = 0;
  std::string text;
};

struct Scene {
  SceneSurface surface;  // the boundary, or with a clip plane the faces of the cells kept
  std::vector<std::array<Eigen::Vector3f, 2>> cage_lines;
  std::vector<Eigen::Vector3f> cage_points;
  std::vector<SceneArrow> arrows;  // loads
  std::vector<Eigen::Vector3f> pins;
  std::vector<SceneLines> lines;
  std::vector<SceneObstacle> obstacles;
  std::optional<SceneVolume> volume;       // instead of the surface; with a legend
  std::vector<SceneLabel> labels;          // drawn with a small dot and a halo
  std::vector<Eigen::Vector3f> handles{};  // of a curve
  std::optional<SceneFelt> felt{};
  std::optional<SceneLegend> legend;  // with values: its map between low and high
  bool draw_surface = true;
};

/// What a picture takes in, in place of all that it shows: pictures of one frame have one scale.
struct PictureFrame {
  std::vector<Eigen::Vector3f> places;  // [m], not all the same
  bool leaves_room = false;             // beside them for the legend and what else is written; else they fill it
};

struct PictureOptions {
  int width = 1280, height = 800;             // 1 … 4096
  Eigen::Vector3d view_from{1.0, -1.6, 0.9};  // direction from the model's middle to the eye; z is up
  double zoom = 1;                            // 1 frames the whole scene
  bool wireframe = true;
  bool contact_shadow = true;
  bool light_theme = false;
  int samples = 4;      // a pixel, on a square grid: 1, 4, 9 or 16
  std::string title{};  // above the picture, at the left
  std::optional<PictureFrame> frame{};
  Progress progress{};  // told as the picture is drawn
};

struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;       // top row first
  std::vector<std::uint32_t> cell_ids;  // id buffer, 0xffffffff where nothing is; same layout
};

class Renderer {
 public:
  virtual ~Renderer() = default;
  /// Deterministic on one machine. One thread at a time.
  /// @throws Error (unsupported) where no OpenGL 3.3 context can be had; (bad_input) for a size, zoom or number of
  /// samples out of range; (bad_geometry) for a coordinate or value that is not finite.
  [[nodiscard]] virtual Picture render(const Scene& scene, const PictureOptions& options) = 0;
};

}  // namespace argil::sculpt
