#pragma once
// The letters of the window: Inter in two weights and the icons of Font Awesome 4, found at run time. Where Inter
// is not there DejaVu Sans stands in, then Dear ImGui's own; an icon without its font is written as a letter.

struct ImFont;

namespace argil::studio {

/// A sign of Font Awesome, and the letter that stands in for it.
struct Icon {
  const char* sign;
  const char* letter;
};

namespace icons {
inline constexpr Icon hand{"\xef\x89\x96", "P"}, grab{"\xef\x89\x95", "G"}, expand{"\xef\x82\xb2", "I"},
    deflate{"\xef\x84\x91", "D"}, branch{"\xef\x84\xa6", "C"}, twist{"\xef\x80\x9e", "T"},
    pinch{"\xef\x81\xa6", "N"}, drop{"\xef\x81\x83", "S"}, brush{"\xef\x87\xbc", "B"}, balance{"\xef\x89\x8e", "M"},
    damping{"\xef\x83\xa4", "V"}, pin{"\xef\x82\x8d", "H"}, cube{"\xef\x86\xb2", "E"}, link{"\xef\x83\x81", "J"},
    scissors{"\xef\x83\x84", "X"}, grid{"\xef\x80\x89", "L"}, probe{"\xef\x81\x9b", "O"}, play{"\xef\x81\x8b", ">"},
    pause{"\xef\x81\x8c", "="}, step{"\xef\x81\x91", "|"}, rewind{"\xef\x81\x88", "<"}, search{"\xef\x80\x82", "?"},
    undo{"\xef\x83\xa2", "u"}, redo{"\xef\x80\x9e", "r"}, check{"\xef\x80\x8c", "v"}, cross{"\xef\x80\x8d", "x"},
    caret{"\xef\x83\x97", "v"}, eye{"\xef\x81\xae", "o"}, cubes{"\xef\x86\xb3", "c"}, keyboard{"\xef\x84\x9c", "K"},
    warning{"\xef\x81\xb1", "!"}, camera{"\xef\x80\xb0", "c"}, file{"\xef\x80\x96", "f"},
    terminal{"\xef\x84\xa0", ">"}, bolt{"\xef\x83\xa7", "b"}, sliders{"\xef\x87\x9e", "s"},
    layers{"\xef\x89\x8d", "l"}, key{"\xef\x82\x84", "K"};
}  // namespace icons

struct Fonts {
  ImFont *text = nullptr, *strong = nullptr, *small = nullptr, *small_strong = nullptr;
  ImFont *icons = nullptr, *small_icons = nullptr;  // null: letters
};

/// Fills the atlas of the current Dear ImGui context for this size of a pixel.
[[nodiscard]] Fonts load_fonts(float scale);

}  // namespace argil::studio
