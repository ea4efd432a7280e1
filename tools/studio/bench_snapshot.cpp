// Of bench.h: what frames see of the session.

#include <algorithm>
#include <cmath>

#include "sculpt/force_tools/curve.h"
#include "sculpt/force_tools/touched.h"
#include "sculpt/measures.h"
#include "sculpt/obstacle_picture.h"
#include "sculpt/scene.h"
#include "sculpt/shown_fields.h"
#include "subdiv/error.h"
#include "tools/studio/bench.h"
#include "tools/studio/ghost.h"

namespace argil::studio {

namespace {

bool same_faces(const sculpt::SceneSurface& a, const sculpt::SceneSurface& b) {
  return a.offsets == b.offsets && a.corners == b.corners && a.cut_faces == b.cut_faces &&
         a.cell_from_face == b.cell_from_face && a.sharp_edges == b.sharp_edges &&
         a.vertex_from_surface == b.vertex_from_surface;
}

void bound(Snapshot& next) {
  if (next.scene->surface.positions.empty()) return;  // all is cut away
  Eigen::Vector3f low = Eigen::Vector3f::Constant(HUGE_VALF), high = -low;
  for (const Eigen::Vector3f& position : next.scene->surface.positions) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  next.low = low.cast<double>();
  next.high = high.cast<double>();
}

std::vector<float> on_surface(const sculpt::SceneSurface& surface, const Eigen::VectorXd& values) {
  std::vector<float> result;
  result.reserve(surface.vertex_from_surface.size());
  for (const std::uint32_t v : surface.vertex_from_surface)
    result.push_back(static_cast<float>(values[static_cast<Eigen::Index>(v)]));
  return result;
}

}  // namespace

sculpt::PictureRequest Bench::request() const {
  sculpt::PictureRequest request;
  request.field = shown_.field;
  request.range = shown_.range;
  request.clip = shown_.clip;
  request.cage = shown_.cage;
  request.control_wire = !shown_.finest_wires;
  request.peel = shown_.peel;
  return request;
}

// How deep the solid can be peeled; what is left is at least its innermost layer.
void Bench::mark_layers(Snapshot& next) {
  next.layers = 0;
  const subdiv::Solid& solid = session().document().refinement().solid();
  const auto depth = sculpt::cell_depths(solid);
  for (const subdiv::CellId c : solid.cells()) next.layers = std::max(next.layers, static_cast<int>(depth[c]));
  shown_.peel = std::clamp(shown_.peel, 0, next.layers);
}

void Bench::lay_curve(Snapshot& next) {
  next.curve.reset();
  if (shown_.curve.empty()) return;
  const sculpt::Document& document = session().document();
  auto laid = std::make_shared<CurveOnSurface>();
  try {
    laid->handles = sculpt::nearest_on_surface(document, shown_.curve);
    if (laid->handles.size() > 1) {
      const sculpt::HandleCurve curve(laid->handles);
      constexpr int k_pieces = 12;  // of a span: seen as a smooth line
      const int pieces = k_pieces * static_cast<int>(std::lround(curve.end()));
      std::vector<Eigen::Vector3d> places;
      for (int i = 0; i <= pieces; ++i) {
        places.push_back(curve.point(curve.end() * i / pieces));
        laid->influences.push_back(curve.influences(curve.end() * i / pieces));
      }
      laid->line = sculpt::nearest_on_surface(document, places);
    }
    next.curve = laid;
  } catch (const Error& error) {  // a solid that cannot be simulated as it is, or points that coincide
    say(MessageKind::warning, error.what());
  }
}

void Bench::draw_ghost(Snapshot& next) {
  if (!next.scene) preview({});
  const bool anew = next.layout != (last_ ? last_->layout : 0);
  previewer_.begin(anew, [&] {
    return GhostSubject{.state = detached(session().document().state()),
                        .request = request(),
                        .scene = next.scene,
                        .layout = next.layout,
                        .out = filing_.folder(),
                        .limits = options_.limits};
  });
  next.ghost = previewer_.show();
}

void Bench::draw_scene(Snapshot& next) {
  const sculpt::Document& document = session().document();
  mark_layers(next);
  sculpt::PictureRequest request = this->request();
  std::shared_ptr<sculpt::Scene> scene;
  try {
    scene = std::make_shared<sculpt::Scene>(sculpt::make_scene(document, request));
  } catch (const Error& error) {
    // A field that cannot be shown of this solid; it is still there as clay.
    say(MessageKind::warning, error.what());
    shown_.field.clear();
    request.field.clear();
    request.marks = false;
    scene = std::make_shared<sculpt::Scene>(sculpt::make_scene(document, request));
  }
  const bool same = last_ && last_->scene && same_faces(last_->scene->surface, scene->surface);
  next.layout = last_ ? last_->layout + (same ? 0 : 1) : 1;
  next.scene = scene;
  bound(next);
  next.selectable.reset();
  if (shown_.selectable) next.selectable = std::make_shared<Selectable>(selectable(document, scene->surface));
  next.mask.clear();
  if (sculpt::has_mask(document))
    next.mask = on_surface(scene->surface, (*document.state().fields)[sculpt::FieldName::mask]);
  lay_curve(next);
  next.young_modulus = on_surface(scene->surface, (*document.state().fields)[sculpt::FieldName::young_modulus]);
  try {
    next.strain = on_surface(scene->surface, sculpt::shown_field(document, "strain").values);
  } catch (const Error&) {
    next.strain.clear();  // a solid that cannot be simulated as it is
  }
}

// While the body moves only places and values change.
void Bench::move_scene(Snapshot& next) {
  const sculpt::Document& document = session().document();
  auto scene = std::make_shared<sculpt::Scene>(*last_->scene);
  const Eigen::Matrix3Xd now =
      document.state().level == 0 ? document.positions() : document.surface_nodes(document.positions());
  for (std::size_t i = 0; i < scene->surface.positions.size(); ++i)
    scene->surface.positions[i] =
        now.col(static_cast<Eigen::Index>(scene->surface.vertex_from_surface[i])).cast<float>();
  scene->obstacles.clear();
  sculpt::add_obstacles(*scene, document);
  if (shown_.cage) {
    scene->cage_lines.clear();
    scene->cage_points.clear();
    sculpt::add_cage(*scene, document.solid(), document.positions());
  }
  if (!shown_.field.empty()) {
    const sculpt::ShownField field = sculpt::shown_field(document, shown_.field);
    sculpt::show_field(*scene, {field.values.data(), static_cast<std::size_t>(field.values.size())}, field.title,
                       field.unit, field.map);
    if (shown_.range) {
      scene->legend->low = (*shown_.range)[0];
      scene->legend->high = (*shown_.range)[1];
    }
  }
  next.scene = scene;
  if (last_->state.fields != document.state().fields) {
    next.mask.clear();
    if (sculpt::has_mask(document))
      next.mask = on_surface(scene->surface, (*document.state().fields)[sculpt::FieldName::mask]);
  }
  bound(next);
}

void Bench::read_document(Snapshot& next) {
  const sculpt::Document& document = session().document();
  next.control_cells = document.solid().cell_count();
  const Eigen::Matrix3Xd& rest = document.rest();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL), high = -low;
  for (const subdiv::VertexId v : document.solid().vertices()) {
    low = low.cwiseMin(rest.col(static_cast<Eigen::Index>(v.index())));
    high = high.cwiseMax(rest.col(static_cast<Eigen::Index>(v.index())));
  }
  next.rest_middle = 0.5 * (low + high);
  next.pinned = document.state().pins->control_points.size() + document.state().pins->nodes.size();
  for (std::size_t f = 0; f < next.materials.size(); ++f) {
    const Eigen::VectorXd& values = document.state().fields->values[f];
    Snapshot::Material& material = next.materials[f];
    material = {};
    if (values.size() == 0) continue;
    double sum = 0;
    for (const double value : values) {
      sum += value;
      material.uniform = material.uniform && value == values[0];
    }
    material.mean = material.uniform ? values[0] : sum / static_cast<double>(values.size());
  }
  try {
    const fem::Discretization& d = document.discretization();
    next.elements = d.elements.cubic + d.elements.linear + d.elements.pyramid;
    next.unknowns = static_cast<std::size_t>(sculpt::measure(document, {.name = "unknowns"}));
    next.volume = sculpt::measure(document, {.name = "volume"});
    next.mass = sculpt::measure(document, {.name = "mass"});
  } catch (const Error&) {
    next.elements = next.unknowns = 0;
  }
}

void Bench::tell_session(Snapshot& next) {
  const sculpt::Document& document = session().document();
  next.state = document.state();
  next.tool = document.state().tool;
  next.tool_number = sitting_.tool_lines;
  if (history_changed_ || !shown_history_) {
    for (HistoryEntry& entry : sitting_.history) entry.undone = entry.depth > session().undo_depth();
    shown_history_ = std::make_shared<const std::vector<HistoryEntry>>(sitting_.history);
  }
  next.history = shown_history_;
  next.undo_depth = session().undo_depth();
  next.redo_depth = session().redo_depth();
  next.journal_lines = sitting_.lines;
  next.saved = sitting_.lines == sitting_.saved_lines;
  filing_.show(next);
  next.file = sitting_.file.string();
  next.solid_number = sitting_.solids;
  next.playing = playing_;
  next.stroke.reset();
  if (stroke_) {
    if (!stroke_from_) stroke_from_ = stroke_->force().at;
    next.stroke = stroke_now();
  }
  const auto& steps = session().steps();
  next.steps = static_cast<long>(steps.size());
  if (!steps.empty()) {
    double sum = 0;
    const std::size_t count = std::min<std::size_t>(steps.size(), 30);
    for (std::size_t i = steps.size() - count; i < steps.size(); ++i) sum += steps[i].ms;
    next.step_ms = sum / static_cast<double>(count);
  }
  next.missed_ticks = missed_ticks_;
  next.messages = messages_;
}

std::shared_ptr<const Snapshot> Bench::snapshot() {
  for (const Message& news : darkroom_.take_news()) say(news.kind, news.text);
  auto next = std::make_shared<Snapshot>();
  if (last_) *next = *last_;
  ++next->version;
  next->shade_again = false;
  const sculpt::Document& document = session().document();
  const bool empty = document.empty();
  const bool moving = stroke_ || playing_;
  if (empty) {
    next->scene.reset();
    next->selectable.reset();
    next->curve.reset();
    next->mask.clear();
    next->layers = 0;
    next->control_cells = next->elements = next->unknowns = next->pinned = 0;
  } else if (whole_ || !moving || !last_ || !last_->scene) {
    if (whole_ || !last_ || !last_->scene) {
      draw_scene(*next);
      read_document(*next);
      next->shade_again = shade_again_;
      shade_again_ = false;
    }
  } else if (last_->state.motion != document.state().motion || last_->state.fields != document.state().fields) {
    move_scene(*next);
  }
  draw_ghost(*next);
  if (empty || !shown_.energy) {
    next->energy = -1;
  } else if (!last_ || last_->energy < 0 || last_->state.motion != document.state().motion) {
    try {
      next->energy = sculpt::measure(document, {.name = "energy"});
    } catch (const Error&) {
      next->energy = -1;  // a solid that cannot be simulated, a model without an energy
    }
  }
  tell_session(*next);
  changed_ = whole_ = history_changed_ = false;
  last_ = next;
  return next;
}

}  // namespace argil::studio
