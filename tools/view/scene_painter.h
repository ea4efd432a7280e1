#pragma once
// Draws a scene with OpenGL into whatever target is bound, off the screen or in a window. The picture may be drawn
// in tiles and at several samples a pixel.

#include <memory>
#include <optional>
#include <vector>

#include "tools/view/ground_shadow.h"
#include "tools/view/openness.h"
#include "tools/view/wires.h"

namespace argil::view {

/// Where a brush lies on the surface, in picture coordinates.
struct BrushMark {
  std::vector<Eigen::Vector3f> middles;  // up to two: a brush and its mirror image
  float radius = 0;
  Colour tint;
  int falloff = 0;  // smooth, linear, constant
};

class ScenePainter {
 public:
  /// `gl` must outlive the painter, its context being current whenever a function is called.
  explicit ScenePainter(const Gl& gl);

  /// Takes a scene in picture coordinates to the graphics card. Binds other targets. What is dark in hollows is not
  /// known yet (shade_on).
  void load(const sculpt::Scene& scene, const Place& place, const sculpt::PictureOptions& options);
  /// Takes a scene that differs from the one loaded only in places and values. With `shade_again` what is dark in
  /// hollows is measured anew, and stays as it was until that is done.
  void move(const sculpt::Scene& scene, const Place& place, bool shade_again);
  /// Measures what is dark in hollows, for about as long as a frame takes. True if the picture is another now.
  bool shade_on();
  bool is_shaded() const { return shaded_; }
  /// Arrows in place of the scene's, in picture coordinates.
  void set_arrows(std::vector<sculpt::SceneArrow> arrows, const Colour& tint);
  void set_brush(BrushMark brush) { brush_ = std::move(brush); }
  /// What load took from its options; pins behind the surface are left out if so asked.
  void set_look(bool wireframe, bool light_theme, bool hidden_pins = true);
  /// A picture of the inside in place of the surface: colours multiplied by opacity, top row first (volume_rays.h).
  void set_volume(const std::vector<float>& picture, int width, int height);
  /// Draws the part of the picture whose lower left sample is (x, y) into the bound target.
  void paint(const Camera& camera, const Sampling& sampling, int x, int y) const;
  /// The same part with the surface's cell ids as bytes, 255 where nothing is; no antialiasing, factor 1.
  void paint_ids(const Camera& camera, const Sampling& sampling, int x, int y) const;
  /// The same part with the surface's depth as three bytes, lowest first; 255 where nothing is.
  void paint_depth(const Camera& camera, const Sampling& sampling, int x, int y) const;

 private:
  void paint_bytes(const Program& program, const Camera& camera, const Sampling& sampling, int x, int y) const;
  void load_lines(const sculpt::Scene& scene, const Place& place);
  /// Takes a program of surfaces and hands it the camera.
  void look_from(const Program& program, const Camera& camera) const;
  /// Those drawn beneath the body, or above it.
  void draw_obstacles(const Camera& camera, bool beneath) const;
  void draw_background(const Sampling& sampling, int x, int y) const;
  void draw_surface(const Camera& camera, const Sampling& sampling) const;
  void draw_shapes(const Camera& camera, const Sampling& sampling) const;
  void draw_volume(const Sampling& sampling, int x, int y) const;
  void draw_line_sets(const Camera& camera, const Sampling& sampling, float opacity) const;
  void hide_behind_surface(bool hide) const;

  const Gl* gl_;
  Program background_program_, surface_program_, id_program_, depth_program_, image_program_, obstacle_program_;
  ShapePainter shapes_;
  OpennessMeasure openness_;
  bool shaded_ = true;
  GroundShadow shadow_;
  Wires wires_;
  VertexArray nothing_, surface_, cage_lines_, cage_points_, handles_, pins_;
  struct LineSet {
    sculpt::LineLook look;
    std::unique_ptr<VertexArray> lines;
  };
  std::vector<LineSet> line_sets_;
  struct Obstacle {
    bool is_ground;
    Eigen::Vector3f at, normal;  // of a ground
    std::unique_ptr<VertexArray> surface;
  };
  std::vector<Obstacle> obstacles_;
  std::unique_ptr<Image> volume_;
  std::vector<sculpt::SceneArrow> arrow_ends_;
  std::optional<sculpt::SceneLegend> field_;
  std::optional<Colour> arrow_tint_;
  float felt_ = 0;  // share of the background's colour
  SurfaceMesh mesh_;
  IndexRange all_triangles_, shown_triangles_;  // of surface_
  BrushMark brush_;
  bool draws_hidden_pins_ = true;
  bool has_shadow_ = false, draws_surface_ = true, draws_wire_ = true;
  const Theme* theme_ = &k_dark_theme;
};

}  // namespace argil::view
