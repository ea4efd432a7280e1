#include "tools/atlas/scene.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "fem/measure/energy.h"
#include "fem/spectrum/largest_frequency.h"
#include "fem/spectrum/modes.h"
#include "fem/spectrum/start_vectors.h"
#include "sculpt/hash.h"
#include "sculpt/obstacles.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::atlas {

namespace {

constexpr double k_length = 0.1;            // side of a control cell [m]
constexpr double k_stretch = 0.05;          // of `release`
constexpr double k_inversion_noise = 0.01;  // of a cell
/// Kinetic energy of the disturbance that every start gets, so that each frequency is there to grow.
constexpr double k_disturbance = 1e-4;
constexpr double k_spin_duration = 0.5;  // [s]

constexpr int k_modes = 30;

struct Yielding {
  double square = 0;  // [1/s²]
  double energy = 0;  // [J]
};

/// The session commands that make one of the atlas's own bodies.
std::vector<std::string> body_lines(const Scene& scene) {
  const double height = k_length / scene.aspect;
  std::vector<std::string> lines;
  double length = 0.4, width = k_length;
  if (scene.body == "box") {
    length = width = 2 * k_length;
    lines.push_back(fmt::format("new box 2 2 2 size {} {} {}", length, width, 2 * height));
  } else if (scene.body == "l") {
    length = 3 * k_length;
    lines.push_back(fmt::format("new box 3 1 3 size {} {} {}", length, width, 3 * height));
    lines.push_back(fmt::format("remove where x > {} and z < {}", k_length, 2 * height));
  } else {
    lines.push_back(fmt::format("new box 4 1 1 size {} {} {}", length, width, height));
  }
  const double section = (scene.body == "box" ? 2 : 1) * height * width;
  lines.insert(lines.end(), {"select edges angle 30", "sharpen 10", "levels 1",
                             fmt::format("set young_modulus {}", scene.young_modulus),
                             fmt::format("set poisson_ratio {}", 0.5 - scene.poisson_gap), "set density 1000"});
  if (scene.contrast != 1)
    lines.push_back(fmt::format("paint young_modulus scale {} where x > {}", scene.contrast, 0.49 * length));
  switch (scene.motion) {
    case Motion::release:
      lines.push_back("pin where x < 1e-6");
      break;
    case Motion::weight:
      lines.push_back(scene.body == "l" ? "pin where z < 1e-6" : "pin where x < 1e-6");
      lines.push_back("gravity 0 0 -9.81");
      break;
    case Motion::pull:
      lines.push_back("pin where x < 1e-6");
      lines.push_back(fmt::format("force {} 0 0 where x > {}", scene.pull * scene.young_modulus * section,
                                  length * (1 - 1e-6)));
      break;
    default:
      break;
  }
  return lines;
}

}  // namespace

const std::array<ParameterInfo, 8>& parameter_table() {
  static const std::array<ParameterInfo, 8> table{{
      {"time_step", "time step Δt [s]", "s", &Scene::time_step},
      {"young_modulus", "Young's modulus E [Pa]", "Pa", &Scene::young_modulus},
      {"poisson_gap", "½ − ν (0: incompressible)", "", &Scene::poisson_gap},
      {"contrast", "contrast of the painted stiffness", "", &Scene::contrast},
      {"aspect", "aspect ratio of the cells", "", &Scene::aspect},
      {"rotation", "rotation per step [rad]", "rad", &Scene::rotation},
      {"inversion", "initial inversion (1: flat, 2: mirrored)", "", &Scene::inversion},
      {"pull", "pull force / (E · section)", "", &Scene::pull},
  }};
  return table;
}

const ParameterInfo& parameter(double Scene::*value) {
  for (const ParameterInfo& info : parameter_table())
    if (info.value == value) return info;
  throw Error(ErrorCode::not_found, "the scene has no such parameter");
}

std::uint64_t scene_hash(const Scene& scene) {
  sculpt::Hash hash;
  hash.add(std::string_view(scene.body)).add(static_cast<std::uint64_t>(scene.motion));
  for (const ParameterInfo& info : parameter_table()) hash.add(scene.*info.value);
  hash.add(std::string_view(scene.session_text));
  return hash.value();
}

struct Body::Parts {
  std::unique_ptr<sculpt::Session> session;
  fem::System system;
  fem::Loads loads;
  fem::BodyState start;
  double duration = 0, largest_frequency = 0, start_energy = 0;

  void make_session(const Scene& scene, const fem::ModelChoice& model) {
    sculpt::SessionOptions options;
    options.out = ".";  // where nothing is written
    options.write_journal = false;
    options.print = [](const std::string&) {};
    if (scene.motion == Motion::session) options.read_root = scene.session_file.parent_path();
    session = std::make_unique<sculpt::Session>(options);
    if (scene.motion == Motion::session) {
      for (const io::SessionLine& line : io::parse_session(scene.session_text, scene.session_file.string())) {
        if (sculpt::find_command(line).effect != sculpt::Effect::output) session->run_line(line);
      }
      if (session->document().empty())
        throw Error(ErrorCode::bad_input, "the session ends without a solid; it wants `new` or `open`",
                    scene.session_file.string());
      if (const auto left_out = sculpt::left_out_of_linearisation(session->document().state()); !left_out.empty())
        throw Error(
            ErrorCode::unsupported,
            fmt::format("the atlas judges methods by the body alone, and the session has {}; map a copy of the "
                        "session that ends with `obstacle NAME remove` and `pressure clear`",
                        fmt::join(left_out, ", ")),
            scene.session_file.string());
      if (scene.young_modulus != 1)
        session->run_line(fmt::format("paint young_modulus scale {}", scene.young_modulus));
    } else {
      try {
        for (const std::string& line : body_lines(scene)) session->run_line(line);
      } catch (const Error& error) {  // no fault of the model's
        throw std::logic_error(std::string("a scene of the atlas cannot be made: ") + error.what());
      }
    }
    sculpt::State state = session->document().state();
    state.model = model;
    session->document().assign(std::move(state));
  }

  void set_in_motion(const Scene& scene) {
    const Eigen::Matrix3Xd& rest = session->document().rest();
    fem::StartVectors noise;
    if (scene.motion == Motion::session) {
      start = *session->document().state().motion;
      start.previous_positions.resize(3, 0);
      start.previous_velocities.resize(3, 0);
      start.previous_step = 0;
      start.time = 0;
      return;
    }
    start.positions = rest;
    start.velocities.setZero(3, rest.cols());
    const Eigen::Vector3d centre = 0.5 * (rest.rowwise().minCoeff() + rest.rowwise().maxCoeff());
    if (scene.motion == Motion::release) start.positions.row(0) *= 1 + k_stretch;
    if (scene.motion == Motion::spin) {
      const Eigen::Vector3d speed(0, 0, scene.rotation / scene.time_step);
      for (Eigen::Index i = 0; i < rest.cols(); ++i) start.velocities.col(i) = speed.cross(rest.col(i) - centre);
    }
    if (scene.motion == Motion::invert)
      for (Eigen::Index i = 0; i < rest.cols(); ++i) {
        start.positions(0, i) = centre.x() + (1 - scene.inversion) * (rest(0, i) - centre.x());
        for (int axis = 0; axis < 3; ++axis)
          start.positions(axis, i) += k_inversion_noise * k_length * noise.next();
      }
  }

  /// What the start and the loads excite, by the lowest modes at rest: ω² of the motion as the Rayleigh quotient of
  /// the displacement that is let go or that the loads would hold, and the energy of the latter.
  Yielding yielding(const fem::Modes& modes) const {
    const Eigen::Matrix3Xd moved = start.positions - session->document().rest();
    const Eigen::Matrix3Xd momentum = moved * *system.mass, drift = start.velocities * *system.mass;
    Yielding result;
    double lowest = 0, above = 0, below = 0;
    for (std::size_t m = 0; m < modes.squares.size(); ++m) {
      const double square = modes.squares[m];
      if (square <= modes.rounding) continue;
      if (lowest == 0) lowest = square;
      double share = momentum.cwiseProduct(modes.shapes[m]).sum();
      if (loads.forces.cols() > 0) {
        const double push = loads.forces.cwiseProduct(modes.shapes[m]).sum();
        share -= push / square;  // from where it is to where it would rest
        result.energy += push * push / (2 * square);
      }
      const double speed = drift.cwiseProduct(modes.shapes[m]).sum();
      above += square * share * share + speed * speed;
      below += share * share + speed * speed / square;
    }
    result.square = below > 0 ? above / below : lowest;
    return result;
  }

  /// Random velocities with a small share of the energy that is about.
  void disturb(double energy) {
    Eigen::Matrix3Xd v = Eigen::Matrix3Xd::Zero(3, start.positions.cols());
    fem::StartVectors noise;
    for (const std::uint32_t i : fem::moving_control_points(system))
      for (int axis = 0; axis < 3; ++axis) v(axis, static_cast<Eigen::Index>(i)) = noise.next();
    const double kinetic = 0.5 * v.cwiseProduct(v * *system.mass).sum();
    start.velocities += v * std::sqrt(k_disturbance * energy / kinetic);
  }
};

Body::Body(const Scene& scene, const fem::ModelChoice& model) : parts_(std::make_unique<Parts>()) {
  Parts& parts = *parts_;
  parts.make_session(scene, model);
  const sculpt::Document& document = parts.session->document();
  parts.system = document.system();
  parts.loads = document.loads();
  parts.set_in_motion(scene);

  const fem::Pencil pencil = fem::pencil(parts.system, parts.loads.springs, document.rest());
  const fem::Modes modes = fem::lowest_modes(pencil, parts.system.rows->column_count, k_modes);
  const Yielding yielding = parts.yielding(modes);
  if (yielding.square == 0)
    throw Error(ErrorCode::unsupported,
                "the model has no frequency above zero at rest, so that no time step is long or short for it");
  parts.duration = scene.motion == Motion::spin ? k_spin_duration : 2 * EIGEN_PI / std::sqrt(yielding.square);
  try {
    parts.largest_frequency = fem::largest_frequency(parts.system, parts.loads.springs, document.rest()).value;
  } catch (const Error&) {  // a tangent that is not symmetric: no limit is known
  }
  const double kinetic = fem::energy(parts.system, parts.start).kinetic;
  if (parts.system.model->promises().has_energy) {
    parts.start_energy = kinetic + parts.system.model->energy(fem::nodes(parts.system, parts.start.positions));
  } else {
    Eigen::Matrix3Xd product;
    const Eigen::Matrix3Xd moved = fem::nodes(parts.system, parts.start.positions - document.rest());
    parts.system.model->tangent(*parts.system.rest_nodes, fem::Projection::none)->stiffness_product(moved, product);
    parts.start_energy = kinetic + 0.5 * std::abs(moved.cwiseProduct(product).sum());
  }
  if (scene.motion != Motion::invert) parts.disturb(std::max(parts.start_energy, yielding.energy));
}
Body::~Body() = default;

const fem::System& Body::system() const {
  return parts_->system;
}
const fem::Loads& Body::loads() const {
  return parts_->loads;
}
const fem::BodyState& Body::start() const {
  return parts_->start;
}
const Eigen::Matrix3Xd& Body::rest() const {
  return parts_->session->document().rest();
}
double Body::duration() const {
  return parts_->duration;
}
double Body::largest_frequency() const {
  return parts_->largest_frequency;
}
double Body::start_energy() const {
  return parts_->start_energy;
}

bool Body::is_inverted(const Eigen::Matrix3Xd& positions) const {
  const Eigen::Matrix3Xd nodes = fem::nodes(parts_->system, positions);
  for (const fem::ElementBlock& block : parts_->session->document().discretization().blocks) {
    const auto n = static_cast<std::size_t>(block.kind->node_count);
    for (std::size_t e = 0; e < block.element_count(); ++e)
      for (int q = 0; q < block.kind->point_count; ++q) {
        Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();  // ∂x/∂(u, v, w)
        for (std::size_t a = 0; a < n; ++a) {
          const double* gradient = block.kind->gradients.data() + (static_cast<std::size_t>(q) * n + a) * 3;
          jacobian += nodes.col(block.nodes[e * n + a]) * Eigen::RowVector3d(gradient[0], gradient[1], gradient[2]);
        }
        if (!(jacobian.determinant() > 0)) return true;
      }
  }
  return false;
}

}  // namespace argil::atlas
