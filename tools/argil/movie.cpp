#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/file_bytes.h"
#include "sculpt/commands/render_request.h"
#include "sculpt/recording.h"
#include "sculpt/scene.h"
#include "sculpt/session.h"
#include "subdiv/error.h"
#include "tools/argil/interruption.h"
#include "tools/argil/program.h"
#include "tools/argil/progress_bar.h"
#include "tools/view/film.h"
#include "tools/view/offscreen_renderer.h"

namespace argil::tools {

namespace {

/// Tells of a film in shares that do not fall.
class Teller {
 public:
  explicit Teller(const Progress::Listener& listener) : listener_(listener) {}
  void tell(double share, const std::string& what) {
    share_ = std::clamp(share, share_, 1.0);
    if (listener_) listener_(share_, what.c_str());
  }
  /// As it was: for what only wants to know whether to go on.
  void go_on() { tell(share_, what_); }
  void picture_done(double from, long done, long of) {
    what_ = fmt::format("picture {} of {}", done, of);
    tell(from + (1 - from) * static_cast<double>(done) / static_cast<double>(of), what_);
  }

 private:
  const Progress::Listener& listener_;
  double share_ = 0;
  std::string what_ = "the film";
};

constexpr double k_first_run = 0.25;  // of the work: the session without pictures

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

/// The first run of the session tells of its part.
void tell_run(sculpt::SessionOptions& options, Teller& teller) {
  options.progress = [&teller](double share, const std::string& what) {
    if (share >= 0)
      teller.tell(k_first_run * share, what);
    else
      teller.go_on();
  };
}

Travel follow(const MovieArguments& arguments, const std::filesystem::path& out, const std::string& text,
              Teller& teller) {
  Travel travel;
  sculpt::FrameClock clock({1, arguments.rate}, 0);
  sculpt::SessionOptions options = session_options(arguments, out);
  tell_run(options, teller);
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

void film_run(const MovieArguments& arguments, const std::filesystem::path& out, const std::string& text,
              sculpt::Renderer& renderer, view::FilmWriter& film, Teller& teller) {
  const Travel travel = follow(arguments, out, text, teller);
  if (travel.frames == 0)
    throw Error(ErrorCode::bad_input,
                "the session takes no step of the simulation that would make a picture; "
                "--turntable shows its last shape from all sides");
  sculpt::PictureFrame frame = sculpt::box_frame(travel.low, travel.high);
  frame.leaves_room = true;
  const Progress::Listener go_on = [&](double, const char*) { teller.go_on(); };
  long done = 0;
  sculpt::FrameClock clock({1, arguments.rate}, 0);
  sculpt::SessionOptions options = session_options(arguments, out);
  std::optional<sculpt::RenderRequest> request;
  sculpt::Session* running = nullptr;
  options.progress = [&](double, const std::string&) { teller.go_on(); };
  options.stepped = [&](const sculpt::Document& document) {
    const long due = clock.due(document.state().motion->time);
    if (due == 0) return;
    if (!request) request = read_request(*running, arguments);
    request->options.contact_shadow = false;  // it would lie under the body wherever that flies
    request->picture.tool_force.reset();      // that of a stroke which is over
    request->options.progress = Progress(go_on);
    if (!request->options.frame) request->options.frame = frame;
    const sculpt::Picture picture = sculpt::make_picture(renderer, document, *request);
    for (long i = 0; i < due; ++i) {
      film.add(picture);
      teller.picture_done(k_first_run, ++done, travel.frames);
    }
  };
  sculpt::Session session(options);
  running = &session;
  session.run_text(text, arguments.session.string());
}

void film_turn(const MovieArguments& arguments, const std::filesystem::path& out, const std::string& text,
               sculpt::Renderer& renderer, view::FilmWriter& film, Teller& teller) {
  sculpt::SessionOptions options = session_options(arguments, out);
  tell_run(options, teller);
  sculpt::Session session(options);
  session.run_text(text, arguments.session.string());
  if (session.document().empty())
    throw Error(ErrorCode::bad_input, "the session makes no solid; begin it with `new box 2 2 2` or `open FILE`");
  sculpt::RenderRequest request = read_request(session, arguments);
  if (request.beside) throw Error(ErrorCode::bad_input, "a turntable shows one body; leave out beside");
  const auto frames = static_cast<int>(std::lround(std::max(1.0, arguments.seconds * arguments.rate)));
  const Progress::Listener go_on = [&](double, const char*) { teller.go_on(); };
  request.options.progress = Progress(go_on);
  long done = 0;
  view::turntable(renderer, sculpt::make_scene(session.document(), request.picture), request.options, frames,
                  [&](const sculpt::Picture& picture) {
                    film.add(picture);
                    teller.picture_done(k_first_run, ++done, frames);
                  });
}

}  // namespace

Movie make_movie(const MovieArguments& arguments, const std::string& session, const Progress::Listener& progress) {
  const std::filesystem::path out =
      arguments.out.empty() ? std::filesystem::path("out") / arguments.session.stem() : arguments.out;
  view::FilmOptions film_options;
  film_options.rate = arguments.rate;
  Movie made;
  std::string name = arguments.file;
  if (name.empty()) {
    made.without_ffmpeg = !view::can_write_films(film_options);
    name = arguments.session.stem().string() + (made.without_ffmpeg ? ".png" : ".mp4");
  }
  // As sessions write: beneath the folder only.
  made.file = sculpt::Session(session_options(arguments, out)).path_to_write(name);
  Teller teller(progress);
  view::FilmWriter film(made.file, film_options);
  const auto renderer = view::make_offscreen_renderer();
  if (arguments.turntable)
    film_turn(arguments, out, session, *renderer, film, teller);
  else
    film_run(arguments, out, session, *renderer, film, teller);
  film.finish();
  made.pictures = film.count();
  return made;
}

int movie(const MovieArguments& arguments) {
  const std::string session = io::read_file(arguments.session);
  ProgressBar bar(arguments.quiet);
  Interruption interruption;
  try {
    const Movie made = make_movie(arguments, session, [&](double share, const char* what) {
      Interruption::check();
      bar.update(share, what);
    });
    bar.clear();
    if (made.without_ffmpeg)
      std::fprintf(stderr,
                   "argil: there is no ffmpeg (Debian, Ubuntu: apt-get install ffmpeg); numbered pictures were "
                   "written instead\n");
    if (!arguments.quiet)
      std::printf("%zu pictures at %g a second in %s\n", made.pictures, arguments.rate, made.file.string().c_str());
  } catch (const Cancelled&) {
    bar.clear();
    interruption.pass_on();
    throw;
  } catch (const Error&) {
    bar.clear();
    throw;
  }
  return k_well;
}

}  // namespace argil::tools
