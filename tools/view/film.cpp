#include "tools/view/film.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <system_error>

#include "io/image.h"
#include "subdiv/error.h"

extern char** environ;

namespace argil::view {

namespace {

/// The program's path, or nothing.
std::filesystem::path found(const std::string& program) {
  const auto runs = [](const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
  };
  if (program.find('/') != std::string::npos)
    return runs(program) ? std::filesystem::path(program) : std::filesystem::path{};
  const char* variable = std::getenv("PATH");
  std::string folders = variable ? variable : "/usr/local/bin:/usr/bin:/bin";
  for (std::size_t begin = 0; begin <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', begin), folders.size());
    const std::filesystem::path path = std::filesystem::path(folders.substr(begin, end - begin)) / program;
    if (path.is_absolute() && runs(path)) return path;
    begin = end + 1;
  }
  return {};
}

std::filesystem::path new_folder_beside(const std::filesystem::path& path) {
  std::error_code fault;
  for (int attempt = 0; !fault; ++attempt) {
    const std::filesystem::path folder = path.string() + fmt::format(".partial{}", attempt);
    if (std::filesystem::create_directory(folder, fault)) return folder;
  }
  throw Error(ErrorCode::bad_input, "cannot write the pictures: " + fault.message() + "; choose another folder",
              path.string());
}

std::vector<std::string> encoder_arguments(const std::filesystem::path& path, const std::string& partial, int width,
                                           int height, double rate) {
  std::vector<std::string> arguments{"ffmpeg",     "-hide_banner",
                                     "-loglevel",  "error",
                                     "-nostats",   "-y",
                                     "-f",         "rawvideo",
                                     "-pix_fmt",   "rgb24",
                                     "-s",         fmt::format("{}x{}", width, height),
                                     "-framerate", fmt::format("{:.6f}", rate),
                                     "-i",         "pipe:0"};
  const std::vector<std::string> of_gif{
      "-vf", "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=sierra2_4a:diff_mode=rectangle",
      "-f", "gif"};
  // Players want halved colours, and those even sizes.
  const std::vector<std::string> of_mp4{"-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                        "-c:v",      "libx264",
                                        "-crf",      "18",
                                        "-pix_fmt",  "yuv420p",
                                        "-movflags", "+faststart",
                                        "-f",        "mp4"};
  const auto& more = path.extension() == ".gif" ? of_gif : of_mp4;
  arguments.insert(arguments.end(), more.begin(), more.end());
  arguments.push_back("file:" + partial);
  return arguments;
}

}  // namespace

bool can_write_films(const FilmOptions& options) {
  return !found(options.program).empty();
}

/// The running ffmpeg: pictures go in by a socket, since a pipe that has no reader any more would end this program.
struct FilmWriter::Encoder {
  Encoder(const std::filesystem::path& path, const std::filesystem::path& program, int width, int height,
          double rate) {
    for (int attempt = 0; partial.empty() || std::filesystem::exists(partial); ++attempt)
      partial = std::filesystem::absolute(path.string() + fmt::format(".partial{}", attempt));
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0 || !(complaints = std::tmpfile()))
      throw Error(ErrorCode::bad_input, "no pipe to ffmpeg can be had: " + std::generic_category().message(errno));
    input = ends[0];
    std::vector<std::string> arguments = encoder_arguments(path, partial.string(), width, height, rate);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, fileno(complaints), STDERR_FILENO);
    // In a group of its own, so that Ctrl-C reaches this program alone, which knows what to take away.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    const int fault = posix_spawn(&process, program.c_str(), &actions, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (fault != 0) {
      process = -1;
      throw Error(ErrorCode::bad_input,
                  fmt::format("'{}' cannot be run: {}", program.string(), std::generic_category().message(fault)));
    }
  }

  ~Encoder() {
    if (process > 0) kill(process, SIGKILL);
    (void)wait();
    if (complaints) std::fclose(complaints);
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
  }

  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  bool write(const std::vector<std::uint8_t>& bytes) const {
    for (std::size_t at = 0; at < bytes.size();) {
      const ssize_t sent = send(input, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) return false;
      at += static_cast<std::size_t>(sent);
    }
    return true;
  }

  /// Its exit status.
  int wait() {
    if (input >= 0) close(input);
    input = -1;
    if (process <= 0) return status;
    int result = 0;
    while (waitpid(process, &result, 0) < 0 && errno == EINTR) {
    }
    process = -1;
    return status = WIFEXITED(result) ? WEXITSTATUS(result) : 128;
  }

  [[noreturn]] void fail() {
    (void)wait();
    std::string said(2000, '\0');
    std::rewind(complaints);
    said.resize(std::fread(said.data(), 1, said.size(), complaints));
    while (!said.empty() && said.back() == '\n') said.pop_back();
    throw Error(ErrorCode::bad_input,
                fmt::format("ffmpeg ended with status {}: {}; numbered pictures (.png) need no ffmpeg", status,
                            said.empty() ? "it said nothing" : said));
  }

  std::filesystem::path partial;
  std::FILE* complaints = nullptr;
  pid_t process = -1;
  int input = -1, status = 0;
};

FilmWriter::FilmWriter(std::filesystem::path path, const FilmOptions& options)
    : path_(std::move(path)), options_(options) {
  const std::string ending = path_.extension().string();
  if (ending != ".mp4" && ending != ".gif" && ending != ".png")
    throw Error(ErrorCode::unsupported,
                fmt::format("expected a film that ends in .mp4, .gif or .png (numbered pictures), found '{}'",
                            path_.filename().string()));
  if (ending != ".png" && !can_write_films(options_))
    throw Error(
        ErrorCode::unsupported,
        fmt::format("a {} needs the program ffmpeg, and there is none: install it (Debian, Ubuntu: apt-get install "
                    "ffmpeg), or write numbered pictures (.png)",
                    ending));
}

FilmWriter::~FilmWriter() {
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

std::filesystem::path FilmWriter::numbered(const std::filesystem::path& folder, std::size_t picture) const {
  return folder / fmt::format("{}_{:04}.png", path_.stem().string(), picture);
}

void FilmWriter::add(const sculpt::Picture& picture) {
  if (path_.extension() == ".png") {
    if (folder_.empty()) folder_ = new_folder_beside(path_);
    io::write_png(numbered(folder_, count_), picture.width, picture.height, picture.rgba);
    ++count_;
    return;
  }
  if (!encoder_) {
    width_ = picture.width;
    height_ = picture.height;
    encoder_ = std::make_unique<Encoder>(path_, found(options_.program), width_, height_, options_.rate);
  }
  if (picture.width != width_ || picture.height != height_)
    throw Error(ErrorCode::bad_input, fmt::format("a film of {} x {} pixels cannot take a picture of {} x {}",
                                                  width_, height_, picture.width, picture.height));
  std::vector<std::uint8_t> rgb;
  rgb.reserve(picture.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4)
    rgb.insert(rgb.end(), {picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]});
  if (!encoder_->write(rgb)) encoder_->fail();
  ++count_;
}

void FilmWriter::finish() {
  if (count_ == 0) throw Error(ErrorCode::bad_input, "a film wants at least one picture");
  std::error_code fault;
  if (encoder_) {
    if (encoder_->wait() != 0) encoder_->fail();
    std::filesystem::rename(encoder_->partial, path_, fault);
  }
  for (std::size_t i = 0; i < count_ && !encoder_ && !fault; ++i)
    std::filesystem::rename(numbered(folder_, i), numbered(path_.parent_path(), i), fault);
  if (fault)
    throw Error(ErrorCode::bad_input, "cannot write the film: " + fault.message() + "; choose another folder",
                path_.string());
}

void turntable(sculpt::Renderer& renderer, const sculpt::Scene& scene, sculpt::PictureOptions options, int pictures,
               const std::function<void(const sculpt::Picture&)>& take) {
  const auto& points = scene.surface.positions;
  if (points.empty()) throw Error(ErrorCode::bad_input, "there is nothing to turn about; begin with a solid");
  Eigen::Vector3f low = points.front(), high = low;
  for (const Eigen::Vector3f& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Eigen::Vector3f middle = 0.5F * (low + high);
  float radius = 0;
  for (const Eigen::Vector3f& point : points) radius = std::max(radius, (point - middle).head<2>().norm());
  // The cylinder about it looks the same from all sides.
  constexpr int k_sides = 64;
  sculpt::PictureFrame frame{.places = {}, .leaves_room = true};
  for (int side = 0; side < k_sides; ++side)
    for (const float z : {low.z(), high.z()}) {
      const double angle = 2 * std::numbers::pi * side / k_sides;
      frame.places.emplace_back(middle.x() + radius * static_cast<float>(std::cos(angle)),
                                middle.y() + radius * static_cast<float>(std::sin(angle)), z);
    }
  if (!options.frame) options.frame = std::move(frame);
  const Eigen::Vector3d from = options.view_from;
  for (int picture = 0; picture < pictures; ++picture) {
    const double angle = 2 * std::numbers::pi * picture / pictures;
    options.view_from = {std::cos(angle) * from.x() - std::sin(angle) * from.y(),
                         std::sin(angle) * from.x() + std::cos(angle) * from.y(), from.z()};
    take(renderer.render(scene, options));
  }
}

}  // namespace argil::view
