#include "io/gltf_animation.h"

#include <fmt/format.h>

#include <bit>
#include <cassert>
#include <cerrno>
#include <functional>
#include <limits>
#include <system_error>

#include "io/file_bytes.h"
#include "io/gltf_asset.h"
#include "subdiv/error.h"

namespace argil::io {

namespace {

[[noreturn]] void cannot_wait(const std::filesystem::path& path) {
  throw Error(ErrorCode::bad_input,
              fmt::format("frames cannot be kept here: {}; make room, or choose another folder",
                          std::generic_category().message(errno)),
              path.parent_path().string());
}

/// A file of this program alone, without a name.
std::FILE* nameless_file(const std::filesystem::path& path) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::filesystem::path name = path;
    name += ".frames" + std::to_string(attempt);
    if (std::FILE* file = std::fopen(name.c_str(), "wb+x")) {
      std::error_code ignored;
      std::filesystem::remove(name, ignored);
      return file;
    }
    if (errno != EEXIST) break;
  }
  cannot_wait(path);
}

}  // namespace

GltfAnimation::GltfAnimation(std::filesystem::path path) : path_(std::move(path)), waiting_(nameless_file(path_)) {}

void GltfAnimation::add(const SurfaceMesh& mesh, const SurfaceLook& look, double time) {
  check_gltf_range(mesh);
  if (frames_.empty()) {
    points_ = split_at_creases(mesh, look);
    first_ = mesh;
    look_ = look;
    first_normals_ = point_normals(mesh, points_);
    frames_.emplace_back().time = time;
    return;
  }
  assert(mesh.corners == first_.corners && time > frames_.back().time);
  if (frames_.size() == k_gltf_most_frames)
    throw Error(
        ErrorCode::limit_exceeded,
        fmt::format("an animated .glb holds at most {} frames; record fewer a second (fps, every), or a .obj or "
                    ".pvd series",
                    k_gltf_most_frames));
  std::string bytes;
  bytes.reserve(frame_bytes());
  Frame frame;
  frame.time = time;
  frame.low.setConstant(std::numeric_limits<float>::max());
  frame.high = -frame.low;
  // Differences of what the file holds, so that sums are as near to this frame as single precision is.
  for (const std::uint32_t v : points_.vertex_from_point) {
    const Eigen::Vector3f difference =
        (mesh.positions.col(v) - first_.positions.col(v).cast<float>().cast<double>()).cast<float>();
    frame.low = frame.low.cwiseMin(difference);
    frame.high = frame.high.cwiseMax(difference);
    append_vector(bytes, difference);
  }
  const std::vector<Eigen::Vector3d> normals = point_normals(mesh, points_);
  for (std::size_t i = 0; i < normals.size(); ++i)
    append_vector(bytes, Eigen::Vector3d(normals[i] - first_normals_[i]).cast<float>());
  const std::size_t at = (frames_.size() - 1) * frame_bytes();
  if (std::fseek(waiting_.get(), static_cast<long>(at), SEEK_SET) != 0 ||
      std::fwrite(bytes.data(), 1, bytes.size(), waiting_.get()) != bytes.size() ||
      std::fflush(waiting_.get()) != 0)
    cannot_wait(path_);
  frames_.push_back(frame);
}

void GltfAnimation::keep(std::size_t count) {
  if (count < frames_.size()) frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(count), frames_.end());
}

void GltfAnimation::finish() const {
  GltfAsset asset = gltf_asset(first_, look_, points_);
  const std::size_t targets = frames_.size() - 1, surface = asset.binary.size();
  std::string of_primitive, of_mesh, animation, tail;
  if (targets > 0) {
    std::string names, zeros;
    for (std::size_t k = 0; k < targets; ++k) {
      const Frame& frame = frames_[k + 1];
      const std::size_t at = surface + k * frame_bytes(), half = frame_bytes() / 2;
      const std::size_t moved =
          asset.add(at, half, k_gltf_vertices, gltf_vectors(points_.count()) + gltf_bounds(frame.low, frame.high));
      const std::size_t turned = asset.add(at + half, half, k_gltf_vertices, gltf_vectors(points_.count()));
      const char* comma = k == 0 ? "" : ",";
      of_primitive += fmt::format("{}{{\"POSITION\":{},\"NORMAL\":{}}}", comma, moved, turned);
      names += fmt::format("{}\"{:.6g} s\"", comma, frame.time - frames_.front().time);
      zeros += k == 0 ? "0" : ",0";
    }
    of_primitive = ",\"targets\":[" + of_primitive + "]";
    of_mesh = fmt::format(",\"weights\":[{}],\"extras\":{{\"targetNames\":[{}]}}", zeros, names);
    float last = 0;
    for (const Frame& frame : frames_) {
      last = static_cast<float>(frame.time - frames_.front().time);
      append_word(tail, std::bit_cast<std::uint32_t>(last));
    }
    const std::size_t after = surface + targets * frame_bytes(), of_times = tail.size();
    for (std::size_t frame = 0; frame < frames_.size(); ++frame)
      for (std::size_t k = 0; k < targets; ++k)
        append_word(tail, std::bit_cast<std::uint32_t>(frame == k + 1 ? 1.0F : 0.0F));
    const char* scalars = "\"componentType\":5126,\"type\":\"SCALAR\",\"count\":{}";
    const std::size_t times = asset.add(
        after, of_times, k_gltf_plain,
        fmt::format(fmt::runtime(scalars), frames_.size()) + fmt::format(",\"min\":[0],\"max\":[{}]", last));
    const std::size_t weights = asset.add(after + of_times, tail.size() - of_times, k_gltf_plain,
                                          fmt::format(fmt::runtime(scalars), frames_.size() * targets));
    animation = fmt::format(
        ",\"animations\":[{{\"name\":\"simulation\",\"channels\":[{{\"sampler\":0,\"target\":{{\"node\":0,\"path\":"
        "\"weights\"}}}}],\"samplers\":[{{\"input\":{},\"output\":{},\"interpolation\":\"LINEAR\"}}]}}]",
        times, weights);
  }
  const std::size_t binary = surface + targets * frame_bytes() + tail.size();
  const std::string head = glb_head(gltf_json(asset, binary, {}, of_primitive, of_mesh, animation), binary);
  write_file(path_, [&](const std::function<void(std::string_view)>& write) {
    write(head);
    write(asset.binary);
    std::string block(std::size_t{1} << 20, '\0');
    std::rewind(waiting_.get());
    for (std::size_t left = targets * frame_bytes(); left > 0;) {
      const std::size_t size = std::min(left, block.size());
      if (std::fread(block.data(), 1, size, waiting_.get()) != size) cannot_wait(path_);
      write(std::string_view(block).substr(0, size));
      left -= size;
    }
    write(tail);
  });
}

}  // namespace argil::io
