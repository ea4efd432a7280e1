#include "tools/view/volume_rays.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "subdiv/parallel.h"
#include "tools/view/colour.h"

namespace argil::view {

namespace {

constexpr int k_band = 4;  // rows that are gathered together
constexpr double k_whole_extinction = 12, k_haze = 0.05;

/// Rays from the eye through pixels: place = eye + depth · (corner + x · right + y · down), y downwards.
struct Rays {
  Eigen::Vector3d eye, corner, right, down;

  Rays(const Camera& camera, int width, int height) {
    const Eigen::Matrix4d clip = camera.clip_from_world.cast<double>();
    Eigen::Matrix3d linear;
    linear << clip.block<1, 3>(0, 0), clip.block<1, 3>(1, 0), clip.block<1, 3>(3, 0);
    const Eigen::Vector3d constant(clip(0, 3), clip(1, 3), clip(3, 3));
    const Eigen::Matrix3d inverse = linear.inverse();
    eye = -inverse * constant;
    right = inverse.col(0) * (2.0 / width);
    down = -inverse.col(1) * (2.0 / height);
    // The middle of the first pixel.
    corner = inverse.col(2) - inverse.col(0) + inverse.col(1) + 0.5 * right + 0.5 * down;
  }
  Eigen::Vector3d direction(int x, int y) const { return corner + x * right + y * down; }
};

/// A tetrahedron as rays meet it: the weight of corner k at eye + depth · direction is
/// at_eye[k] + depth · (slope · direction)[k].
struct Cell {
  std::array<double, 4> at_eye, of_corner, per_column, per_row, value;
  int left, right, top, bottom;  // pixels that it may cover
};

std::vector<Cell> cells_of(const sculpt::SceneVolume& volume, const Place& place, const Camera& camera,
                           const Rays& rays, int width, int height) {
  std::vector<Cell> cells(volume.tetrahedra.size());
  std::vector<std::uint8_t> empty(cells.size(), 0);
  subdiv::parallel_for(cells.size(), 256, [&](std::size_t t) {
    std::array<Eigen::Vector3d, 4> p;
    Cell& cell = cells[t];
    float left = HUGE_VALF, right = -HUGE_VALF, top = HUGE_VALF, bottom = -HUGE_VALF;
    bool before_eye = true;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t corner = volume.tetrahedra[t][k];
      const Eigen::Vector3f world = place(volume.positions[corner]);
      p[k] = world.cast<double>();
      cell.value[k] = static_cast<double>(volume.values[corner]);
      before_eye = before_eye && camera.distance(world) > 1e-4F;
      const Eigen::Vector2f pixel = camera.pixel(world, width, height);
      left = std::min(left, pixel.x());
      right = std::max(right, pixel.x());
      top = std::min(top, pixel.y());
      bottom = std::max(bottom, pixel.y());
    }
    Eigen::Matrix3d sides;
    sides << p[1] - p[0], p[2] - p[0], p[3] - p[0];
    const double six_volumes = sides.determinant();
    if (std::abs(six_volumes) < 1e-18 || !before_eye) {
      empty[t] = 1;
      return;
    }
    const Eigen::Matrix3d gradients = sides.inverse();  // rows: of the weights of corners 1, 2, 3
    const Eigen::Vector3d eye = gradients * (rays.eye - p[0]), corner = gradients * rays.corner,
                          column = gradients * rays.right, row = gradients * rays.down;
    const auto spread = [](const Eigen::Vector3d& three, double sum) {
      return std::array<double, 4>{sum - three[0] - three[1] - three[2], three[0], three[1], three[2]};
    };
    cell.at_eye = spread(eye, 1);
    cell.of_corner = spread(corner, 0);
    cell.per_column = spread(column, 0);
    cell.per_row = spread(row, 0);
    const auto within = [](float value, int end) {
      return static_cast<int>(std::clamp(value, -1.0F, static_cast<float>(end)));
    };
    cell.left = std::max(0, within(left - 1, width));
    cell.right = std::min(width - 1, within(right + 1, width));
    cell.top = std::max(0, within(top - 1, height));
    cell.bottom = std::min(height - 1, within(bottom + 1, height));
  });
  std::size_t kept = 0;
  for (std::size_t t = 0; t < cells.size(); ++t)
    if (!empty[t]) cells[kept++] = cells[t];
  cells.resize(kept);
  return cells;
}

/// A ray inside a tetrahedron.
struct Segment {
  double enter, exit;  // depths
  double value_in, value_out;
};

/// Calls row(y, segments of each pixel) for every row. Rows of a band are gathered together.
template <class Row>
void for_rows(const std::vector<Cell>& cells, int width, int height, const Row& row) {
  const auto bands = static_cast<std::size_t>((height + k_band - 1) / k_band);
  std::vector<std::vector<std::uint32_t>> of_band(bands);
  for (std::size_t t = 0; t < cells.size(); ++t)
    for (int band = cells[t].top / k_band; band <= cells[t].bottom / k_band; ++band)
      of_band[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(t));
  subdiv::parallel_for(bands, 1, [&](std::size_t band) {
    std::vector<std::vector<Segment>> pixels(static_cast<std::size_t>(width));
    const int first = static_cast<int>(band) * k_band;
    for (int y = first; y < std::min(height, first + k_band); ++y) {
      for (std::vector<Segment>& pixel : pixels) pixel.clear();
      for (const std::uint32_t t : of_band[band]) {
        const Cell& cell = cells[t];
        if (y < cell.top || y > cell.bottom) continue;
        for (int x = cell.left; x <= cell.right; ++x) {
          double enter = 0, exit = HUGE_VAL;
          std::array<double, 4> slope;
          for (std::size_t k = 0; k < 4; ++k) {
            slope[k] = cell.of_corner[k] + x * cell.per_column[k] + y * cell.per_row[k];
            const double at = -cell.at_eye[k] / slope[k];
            if (slope[k] > 0)
              enter = std::max(enter, at);
            else if (slope[k] < 0)
              exit = std::min(exit, at);
            else if (cell.at_eye[k] < 0)
              exit = 0;
          }
          if (!(exit > enter)) continue;
          double value_in = 0, value_out = 0;
          for (std::size_t k = 0; k < 4; ++k) {
            value_in += cell.value[k] * (cell.at_eye[k] + enter * slope[k]);
            value_out += cell.value[k] * (cell.at_eye[k] + exit * slope[k]);
          }
          pixels[static_cast<std::size_t>(x)].push_back({enter, exit, value_in, value_out});
        }
      }
      row(y, pixels);
    }
  });
}

/// Adds a piece in which map and extinction are linear to a ray.
struct Light {
  std::array<double, 3> colour{};
  double left = 1;  // of the light from behind

  void add(const Colour& emitted, double optical_depth) {
    const double absorbed = left * -std::expm1(-optical_depth);
    colour[0] += absorbed * static_cast<double>(emitted.red);
    colour[1] += absorbed * static_cast<double>(emitted.green);
    colour[2] += absorbed * static_cast<double>(emitted.blue);
    left -= absorbed;
  }
};

}  // namespace

double extinction(sculpt::ColourMap map, double t) {
  t = std::clamp(t, 0.0, 1.0);
  const double part = map == sculpt::ColourMap::balanced ? std::abs(2 * t - 1) : t;
  return k_whole_extinction * (k_haze + (1 - k_haze) * part);
}

std::vector<double> line_integrals(const sculpt::SceneVolume& volume, const Place& place, const Camera& camera,
                                   int width, int height) {
  const Rays rays(camera, width, height);
  std::vector<double> integrals(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0);
  for_rows(
      cells_of(volume, place, camera, rays, width, height), width, height,
      [&](int y, const std::vector<std::vector<Segment>>& pixels) {
        for (int x = 0; x < width; ++x) {
          const double metres = rays.direction(x, y).norm() * place.radius;
          double sum = 0;
          for (const Segment& s : pixels[static_cast<std::size_t>(x)])
            sum += 0.5 * (s.value_in + s.value_out) * (s.exit - s.enter) * metres;
          integrals[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
              sum;
        }
      });
  return integrals;
}

std::vector<float> volume_picture(const sculpt::SceneVolume& volume, const sculpt::SceneLegend& legend,
                                  const Place& place, const Camera& camera, int width, int height) {
  const Rays rays(camera, width, height);
  const MapColours& colours = map_colours(legend.map);
  const double range = std::max(legend.high - legend.low, 1e-300);
  constexpr auto k_parts = static_cast<double>(k_map_size - 1);
  // A ray sees the pieces of a segment between the kinks of the map, at tenths, among them 0, 1/2 and 1.
  const auto add_segment = [&](Light& light, double length, double t_in, double t_out) {
    const double low = std::clamp(std::min(t_in, t_out), -1.0, 2.0),
                 high = std::clamp(std::max(t_in, t_out), -1.0, 2.0);
    const bool rises = t_out > t_in;
    const int first = static_cast<int>(std::floor(std::clamp(low, 0.0, 1.0) * k_parts)),
              last = static_cast<int>(std::ceil(std::clamp(high, 0.0, 1.0) * k_parts));
    const auto add_piece = [&](double from, double to) {
      if (!(to > from) && high > low) return;
      const double share = high > low ? (to - from) / (high - low) : 1;
      const double depth = 0.5 * (extinction(legend.map, from) + extinction(legend.map, to)) * share * length;
      light.add(field_colour(colours, 0.5 * (from + to)), depth * volume.opacity);
    };
    if (high <= low || last <= first) return add_piece(low, high);
    // Kinks at first, first + 1 … last, tenths; beyond 0 and 1 all stays as it is there.
    std::array<double, k_map_size + 2> ends{};
    std::size_t count = 0;
    ends[count++] = low;
    for (int kink = first; kink <= last; ++kink)
      if (kink / k_parts > low && kink / k_parts < high) ends[count++] = kink / k_parts;
    ends[count++] = high;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const std::size_t piece = rises ? i : count - 2 - i;
      add_piece(ends[piece], ends[piece + 1]);
    }
  };
  std::vector<float> picture(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F);
  for_rows(cells_of(volume, place, camera, rays, width, height), width, height,
           [&](int y, const std::vector<std::vector<Segment>>& pixels) {
             std::vector<Segment> sorted;
             for (int x = 0; x < width; ++x) {
               sorted = pixels[static_cast<std::size_t>(x)];
               if (sorted.empty()) continue;
               std::stable_sort(sorted.begin(), sorted.end(), [](const Segment& a, const Segment& b) {
                 return a.enter + a.exit < b.enter + b.exit;
               });
               const double length = rays.direction(x, y).norm();
               Light light;
               for (const Segment& s : sorted) {
                 add_segment(light, (s.exit - s.enter) * length, (s.value_in - legend.low) / range,
                             (s.value_out - legend.low) / range);
                 if (light.left < 1e-4) break;
               }
               float* pixel = &picture[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                            static_cast<std::size_t>(x))];
               for (std::size_t k = 0; k < 3; ++k) pixel[k] = static_cast<float>(light.colour[k]);
               pixel[3] = static_cast<float>(1 - light.left);
             }
           });
  return picture;
}

}  // namespace argil::view
