// Where the frames of a recording go, by kind of file.

#include <fmt/format.h>

#include "io/file_bytes.h"
#include "io/gltf_animation.h"
#include "io/surface.h"
#include "io/xml_text.h"
#include "sculpt/export.h"
#include "sculpt/recording.h"
#include "sculpt/surface_look.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

io::SurfaceMesh surface_now(const Document& document) {
  const bool refined = document.state().level > 0;
  return surface_mesh(document.refinement().solid(),
                      refined ? document.surface_nodes(document.positions()) : document.positions());
}

/// NAME_0000.obj, NAME_0001.obj, …
class NumberedFiles : public FrameSink {
 public:
  NumberedFiles(const std::filesystem::path& path, std::string ending)
      : folder_(path.parent_path()), stem_(path.stem().string()), ending_(std::move(ending)) {}

  void add(const Document& document, double time) override {
    write(document, folder_ / name_of(times_.size()));
    times_.push_back(time);
    written_ = std::max(written_, times_.size());
  }
  void keep(std::size_t count) override { times_.resize(std::min(count, times_.size())); }
  void finish() override {
    std::error_code ignored;
    for (std::size_t frame = times_.size(); frame < written_; ++frame)
      std::filesystem::remove(folder_ / name_of(frame), ignored);
    written_ = times_.size();
  }

 protected:
  virtual void write(const Document& document, const std::filesystem::path& path) = 0;
  [[nodiscard]] std::string name_of(std::size_t frame) const {
    return fmt::format("{}_{:04}{}", stem_, frame, ending_);
  }

  std::filesystem::path folder_;
  std::string stem_, ending_;
  std::vector<double> times_;
  std::size_t written_ = 0;  // files, some of which may have been taken back
};

class ObjSeries : public NumberedFiles {
 public:
  explicit ObjSeries(const std::filesystem::path& path) : NumberedFiles(path, ".obj") {}

 protected:
  void write(const Document& document, const std::filesystem::path& path) override {
    io::write_surface(path, surface_now(document));
  }
};

/// The collection is written anew as the series doubles, so that one that is broken off can be looked at.
class VtuSeries : public NumberedFiles {
 public:
  explicit VtuSeries(std::filesystem::path path) : NumberedFiles(path, ".vtu"), collection_(std::move(path)) {}
  void add(const Document& document, double time) override {
    NumberedFiles::add(document, time);
    if ((times_.size() & (times_.size() - 1)) == 0) write_collection();
  }
  void finish() override {
    write_collection();
    NumberedFiles::finish();
  }

 protected:
  void write(const Document& document, const std::filesystem::path& path) override {
    (void)save_document(document, path, document.state().level);
  }

 private:
  void write_collection() const {
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
        "  <Collection>\n";
    for (std::size_t frame = 0; frame < times_.size(); ++frame)
      text += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", times_[frame],
                          io::xml_text(name_of(frame)));
    io::write_file(collection_, text + "  </Collection>\n</VTKFile>\n");
  }

  std::filesystem::path collection_;
};

class GlbAnimation : public FrameSink {
 public:
  explicit GlbAnimation(const std::filesystem::path& path) : animation_(path) {}
  void add(const Document& document, double time) override {
    const bool first = animation_.frames() == 0;
    animation_.add(surface_now(document), first ? surface_look(document.refinement().solid()) : io::SurfaceLook{},
                   time);
  }
  void keep(std::size_t count) override { animation_.keep(count); }
  void finish() override { animation_.finish(); }
  bool keeps_topology() const override { return true; }

 private:
  io::GltfAnimation animation_;
};

}  // namespace

std::unique_ptr<FrameSink> make_frame_sink(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".pvd") return std::make_unique<VtuSeries>(path);
  if (ending == ".obj") return std::make_unique<ObjSeries>(path);
  if (ending == ".glb") return std::make_unique<GlbAnimation>(path);
  throw Error(ErrorCode::unsupported,
              fmt::format("expected a name that ends in .pvd (volume meshes .vtu and their times), .obj (numbered "
                          "surfaces) or .glb (one animated surface), found '{}'",
                          ending));
}

}  // namespace argil::sculpt
