#pragma once
// Dialogues of files: to open and to save, the samples, and work that was not saved.

#include "tools/studio/desk.h"

namespace argil::studio {

void draw_file(Desk& desk, bool saves, int width, int height);
void draw_samples(Desk& desk, int width, int height);
void draw_unsaved(Desk& desk, int width, int height);

}  // namespace argil::studio
