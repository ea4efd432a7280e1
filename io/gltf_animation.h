#pragma once
// A surface that moves, as one binary glTF (.glb): the first frame is the mesh, every further one a morph target
// (glTF 2.0 §3.7.2.2) of differences of positions and normals, and an animation of the weights goes straight from
// each to the next, so that a viewer shows what lies between two frames as their mean. Frames wait in a file
// without a name in the folder of the result, which holds them whatever their number and goes with the program.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "io/gltf_points.h"

namespace argil::io {

/// Weights are frames × frames numbers, for which this is 64 MB; and viewers slow down far below.
inline constexpr std::size_t k_gltf_most_frames = 4096;

class GltfAnimation {
 public:
  /// @throws Error (bad_input) if nothing can be written in the folder of `path`.
  explicit GltfAnimation(std::filesystem::path path);

  /// The surface at a time [s] after the others; faces are those of the first frame, whose look counts.
  /// @throws Error (limit_exceeded) beyond k_gltf_most_frames, (unsupported) out of the range of single precision,
  /// (bad_input) where the disk is full: the frames before stay.
  void add(const SurfaceMesh& mesh, const SurfaceLook& look, double time);
  std::size_t frames() const { return frames_.size(); }
  /// Takes back all but the first `count` frames.
  void keep(std::size_t count);
  /// Writes the file at one stroke. @throws Error as write_file, (unsupported) beyond 4 GB.
  void finish() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct Frame {
    double time = 0;
    Eigen::Vector3f low = Eigen::Vector3f::Zero(), high = Eigen::Vector3f::Zero();  // of the differences
  };
  [[nodiscard]] std::size_t frame_bytes() const { return 2 * 12 * points_.count(); }

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> waiting_;
  GltfPoints points_;
  SurfaceMesh first_;
  SurfaceLook look_;
  std::vector<Eigen::Vector3d> first_normals_;
  std::vector<Frame> frames_;
};

}  // namespace argil::io
