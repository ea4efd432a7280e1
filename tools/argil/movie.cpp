#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "io/file_bytes.h"
#include "sculpt/commands/render_request.h"
#include "sculpt/recording.h"
#include "sculpt/session.h"
#include "subdiv/error.h"
#include "tools/argil/program.h"
#include "tools/view/film.h"
#include "tools/view/offscreen_renderer.h"

namespace argil::tools {

namespace {

using Stepped = std::function<void(const sculpt::Document&)>;

sculpt::SessionOptions session_options(const MovieArguments& arguments, const std::filesystem::path& out) {
  sculpt::SessionOptions options;
  options.read_root = arguments.read_root.empty() ? arguments.session.parent_path() : arguments.read_root;
  options.out = out;
  options.limits = arguments.limits;
  options.write_journal = false;
  return options;
}

/// Where the body has been in the frames of a run.
struct Travel {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY), high = -low;
  long frames = 0;
};

Travel follow(const MovieArguments& arguments, const std::filesystem::path& out, const std::string& text) {
  Travel travel;
  sculpt::FrameClock clock({1, arguments.rate}, 0);
  sculpt::SessionOptions options = session_options(arguments, out);
  options.stepped = [&](const sculpt::Document& document) {
    const long due = clock.due(document.state().motion->time);
    if (due == 0) return;
    travel.frames += due;
    const Eigen::Matrix3Xd nodes = document.surface_nodes(document.positions());
    for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
      travel.low = travel.low.cwiseMin(nodes.col(i));
      travel.high = travel.high.cwiseMax(nodes.col(i));
    }
  };
  sculpt::Session(options).run_text(text, arguments.session.string());
  return travel;
}

/// Of the arguments of `render` that `--with` gives.
sculpt::RenderRequest read_request(const sculpt::Session& session, const MovieArguments& arguments) {
  const auto line = io::parse_session_line("render film.png " + arguments.options, "--with", 1);
  return sculpt::read_render(session, sculpt::bind(sculpt::find_command(line), line));
}

class Progress {
 public:
  Progress(bool quiet, long frames) : quiet_(quiet), frames_(frames) {}
  void next() {
    ++done_;
    if (quiet_ || 10 * done_ / frames_ == 10 * (done_ - 1) / frames_) return;
    std::fprintf(stderr, "%3ld %%  picture %ld of %ld\n", 100 * done_ / frames_, done_, frames_);
  }

 private:
  bool quiet_;
  long frames_, done_ = 0;
};

void film_run(const MovieArguments& arguments, const std::filesystem::path& out, const std::string& text,
              sculpt::Renderer& renderer, view::FilmWriter& film) {
  const Travel travel = follow(arguments, out, text);
  if (travel.frames == 0)
    throw Error(ErrorCode::bad_input,
                "the session takes no step of the simulation that would make a picture; "
                "--turntable shows its last shape from all sides");
  const std::vector<Eigen::Vector3f> framed = view::box_corners(travel.low, travel.high);
  Progress progress(arguments.quiet, travel.frames);
  sculpt::FrameClock clock({1, arguments.rate}, 0);
  sculpt::SessionOptions options = session_options(arguments, out);
  std::optional<sculpt::RenderRequest> request;
  sculpt::Session* running = nullptr;
  options.stepped = [&](const sculpt::Document& document) {
    const long due = clock.due(document.state().motion->time);
    if (due == 0) return;
    if (!request) request = read_request(*running, arguments);
    request->options.contact_shadow = false;  // it would lie under the body wherever that flies
    request->picture.tool_force.reset();      // that of a stroke which is over
    const sculpt::Picture picture = sculpt::make_picture(renderer, document, *request, framed);
    for (long i = 0; i < due; ++i) {
      film.add(picture);
      progress.next();
    }
  };
  sculpt::Session session(options);
  running = &session;
  session.run_text(text, arguments.session.string());
}

void film_turn(const MovieArguments& arguments, const std::filesystem::path& out, const std::string& text,
               sculpt::Renderer& renderer, view::FilmWriter& film) {
  sculpt::Session session(session_options(arguments, out));
  session.run_text(text, arguments.session.string());
  if (session.document().empty())
    throw Error(ErrorCode::bad_input, "the session makes no solid; begin it with `new box 2 2 2` or `open FILE`");
  const sculpt::RenderRequest request = read_request(session, arguments);
  if (request.beside) throw Error(ErrorCode::bad_input, "a turntable shows one body; leave out beside");
  const auto frames = static_cast<int>(std::lround(std::max(1.0, arguments.seconds * arguments.rate)));
  Progress progress(arguments.quiet, frames);
  view::turntable(renderer, sculpt::make_scene(session.document(), request.picture), request.options, frames,
                  [&](const sculpt::Picture& picture) {
                    film.add(picture);
                    progress.next();
                    return true;
                  });
}

}  // namespace

int movie(const MovieArguments& arguments) {
  const std::filesystem::path out =
      arguments.out.empty() ? std::filesystem::path("out") / arguments.session.stem() : arguments.out;
  const std::string text = io::read_file(arguments.session);
  view::FilmOptions film_options;
  film_options.rate = arguments.rate;
  std::string name = arguments.file;
  if (name.empty()) {
    const bool can = view::can_write_films(film_options);
    name = arguments.session.stem().string() + (can ? ".mp4" : ".png");
    if (!can)
      std::fprintf(stderr,
                   "argil: there is no ffmpeg (Debian, Ubuntu: apt-get install ffmpeg); numbered pictures are "
                   "written instead\n");
  }
  // As sessions write: beneath the folder only.
  const std::filesystem::path path = sculpt::Session(session_options(arguments, out)).path_to_write(name);
  view::FilmWriter film(path, film_options);
  const auto renderer = view::make_offscreen_renderer();
  if (arguments.turntable)
    film_turn(arguments, out, text, *renderer, film);
  else
    film_run(arguments, out, text, *renderer, film);
  film.finish();
  if (!arguments.quiet)
    std::printf("%zu pictures at %g a second in %s\n", film.count(), arguments.rate, path.string().c_str());
  return k_well;
}

}  // namespace argil::tools
