#pragma once
// A series of files, one frame after the other, written while a simulation runs: volume meshes with a collection of
// their times (.pvd), numbered surfaces (.obj), or one surface that moves (.glb). What undo takes back is taken out
// of the series when it goes on or ends.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sculpt/document.h"

namespace argil::sculpt {

/// Which steps give a frame: every `every`th, or with `rate` > 0 the first at or after each 1/rate of simulated
/// time.
struct FramePace {
  long every = 1;
  double rate = 0;  // [1/s]
};
/// Counts frames by a pace. Times may go back, as after undo.
class FrameClock {
 public:
  FrameClock(const FramePace& pace, double start) : pace_(pace), start_(start), last_(start) {}
  /// How many frames are due with the step that has come to this time: 1 or 0; with a rate more where a step is
  /// longer than a frame.
  [[nodiscard]] long due(double time);

 private:
  FramePace pace_;
  double start_, last_;
  long steps_ = 0, frames_ = 0;
};

/// Where frames go; one for each kind of file.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// @throws Error if it cannot be written.
  virtual void add(const Document& document, double time) = 0;
  /// Takes back all but the first `count`.
  virtual void keep(std::size_t count) = 0;
  /// Completes what is under the final name.
  virtual void finish() = 0;
  /// Whether frames are all of one topology, so that it ends with that.
  [[nodiscard]] virtual bool keeps_topology() const { return false; }
};

class Recording {
 public:
  /// The document as it is now is the first frame. @throws Error (unsupported) for another ending than .pvd, .obj
  /// or .glb, and what the sink throws.
  Recording(const Document& document, std::string name, const std::filesystem::path& path, const FramePace& pace);

  const std::string& name() const { return name_; }
  std::size_t frames() const { return times_.size(); }
  void step(const Document& document);
  /// What it has written, in words. To be called once.
  [[nodiscard]] std::string finish(const Document& document);

 private:
  void take_back(double time);

  std::string name_;
  FrameClock clock_;
  std::unique_ptr<FrameSink> sink_;
  std::vector<double> times_;
  std::uint64_t topology_ = 0;
  int level_ = 0;
  bool over_ = false;  // its topology has gone
  double over_at_ = 0;
};

/// By the ending of the path.
[[nodiscard]] std::unique_ptr<FrameSink> make_frame_sink(const std::filesystem::path& path);

}  // namespace argil::sculpt
