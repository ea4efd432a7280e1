#pragma once
// What the arguments of the command `render` ask for, for those who make more pictures than one of them.

#include "sculpt/picture.h"
#include "sculpt/session.h"

namespace argil::sculpt {

struct RenderRequest {
  PictureRequest picture;
  PictureOptions options;
  bool beside = false;  // the cage alone in the left half
};

/// All but the file. @throws Error (bad_input) for arguments that do not go together, and what reading meshes
/// throws.
[[nodiscard]] RenderRequest read_render(const Session& session, const Arguments& arguments);

/// The document as it is now.
[[nodiscard]] Picture make_picture(Renderer& renderer, const Document& document, const RenderRequest& request);

}  // namespace argil::sculpt
