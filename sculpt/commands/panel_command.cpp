#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "io/image.h"
#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

constexpr std::size_t k_most_pictures = 64;
constexpr long k_most_pixels = 64'000'000;  // of the sheet, and of all pictures together
constexpr std::array<std::uint8_t, 4> k_light_ground{255, 255, 255, 255}, k_dark_ground{14, 16, 19, 255};

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  std::string name;
  for (const char c : text + " ") {
    if (c != ' ') {
      name += c;
      continue;
    }
    if (!name.empty()) names.push_back(name);
    name.clear();
  }
  if (names.empty() || names.size() > k_most_pictures)
    throw Error(ErrorCode::bad_input,
                fmt::format("expected the names of 1 to {} pictures with blanks between them, "
                            "found {}; as in `panels both.png \"left.png right.png\"`",
                            k_most_pictures, names.size()));
  return names;
}

std::vector<io::Image> read_pictures(const Session& session, const std::vector<std::string>& names) {
  std::vector<io::Image> pictures;
  long pixels = 0;
  for (const std::string& name : names) {
    const std::filesystem::path path = session.path_to_write(name);
    if (!name.ends_with(".png") || !std::filesystem::is_regular_file(path))
      throw Error(ErrorCode::bad_input, fmt::format("there is no picture '{}' yet; make it first, `render {}`",
                                                    name, name.ends_with(".png") ? name : name + ".png"));
    pictures.push_back(io::read_png(path));
    pixels += long{pictures.back().width} * pictures.back().height;
    if (pixels > k_most_pixels)
      throw Error(ErrorCode::limit_exceeded, fmt::format("the pictures have more than {} pixels together; render "
                                                         "them smaller, as in `size 640 480`",
                                                         k_most_pixels));
  }
  return pictures;
}

/// Row by row, each in the middle of a cell that the largest fits into.
io::Image sheet_of(const std::vector<io::Image>& pictures, int columns, int gap,
                   const std::array<std::uint8_t, 4>& ground) {
  const int count = static_cast<int>(pictures.size()), rows = (count + columns - 1) / columns;
  int width = 0, height = 0;
  for (const io::Image& picture : pictures) {
    width = std::max(width, picture.width);
    height = std::max(height, picture.height);
  }
  const long across = long{columns} * (width + gap) - gap, down = long{rows} * (height + gap) - gap;
  if (across * down > k_most_pixels)
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("a sheet of {} x {} pixels is too large; render the pictures smaller, as in `size 640 "
                            "480`",
                            across, down));
  io::Image sheet{.width = static_cast<int>(across), .height = static_cast<int>(down), .rgba = {}};
  sheet.rgba.resize(4 * static_cast<std::size_t>(across * down));
  for (std::size_t i = 0; i < sheet.rgba.size(); ++i) sheet.rgba[i] = ground[i % 4];
  for (int p = 0; p < count; ++p) {
    const io::Image& picture = pictures[static_cast<std::size_t>(p)];
    const int left = p % columns * (width + gap) + (width - picture.width) / 2;
    const int top = p / columns * (height + gap) + (height - picture.height) / 2;
    for (int y = 0; y < picture.height; ++y) {
      const auto row = picture.rgba.begin() + std::ptrdiff_t{4} * picture.width * y;
      std::copy(row, row + std::ptrdiff_t{4} * picture.width,
                sheet.rgba.begin() + std::ptrdiff_t{4} * (std::ptrdiff_t{sheet.width} * (top + y) + left));
    }
  }
  return sheet;
}

void panels(Session& session, const Arguments& arguments) {
  require_solid(session);
  const std::string& name = arguments.word("file");
  if (!name.ends_with(".png"))
    throw Error(ErrorCode::bad_input, fmt::format("a picture is a .png file, not '{}'", name));
  const auto path = session.path_to_write(name);
  const std::vector<std::string> names = names_in(arguments.word("pictures"));
  for (const std::string& part : names) static_cast<void>(session.path_to_write(part));
  if (!session.options().renderer) {
    ++session.skipped_pictures;
    session.print(fmt::format("{} skipped: there is no renderer", name));
    return;
  }
  const int columns = static_cast<int>(
      std::min(arguments.integer("columns", static_cast<long>(names.size())), static_cast<long>(names.size())));
  const io::Image sheet =
      sheet_of(read_pictures(session, names), columns, static_cast<int>(arguments.integer("gap", 6)),
               arguments.has("light") ? k_light_ground : k_dark_ground);
  io::write_png(path, sheet.width, sheet.height, sheet.rgba);
}

}  // namespace

std::vector<Command> panel_commands() {
  return {
      {.name = "panels",
       .summary = "Puts pictures that this session has made side by side, as one picture.",
       .parameters = {{.name = "file",
                       .type = ArgumentType::text,
                       .help = "a .png beneath the folder given with --out",
                       .positional = true,
                       .required = true},
                      {.name = "pictures",
                       .type = ArgumentType::text,
                       .help = "their names there, in quotes, with blanks between them, row by row",
                       .positional = true,
                       .required = true},
                      {.name = "columns",
                       .type = ArgumentType::integer,
                       .help = "pictures in a row; else all",
                       .low = 1,
                       .high = static_cast<double>(k_most_pictures)},
                      {.name = "gap",
                       .type = ArgumentType::integer,
                       .help = "between them; else 6",
                       .unit = "px",
                       .low = 0,
                       .high = 1000},
                      {.name = "light", .help = "white between them, else nearly black", .flag = true}},
       .example = "panels both.png \"front.png side.png\" columns 2",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "render front.png size 320 240 from 0 -1 0.3",
                  "render side.png size 320 240 from 1 0 0.3"},
       .effect = Effect::output,
       .run = panels},
  };
}

}  // namespace argil::sculpt
