#include "sculpt/commands/reference_argument.h"

#include "sculpt/document.h"
#include "sculpt/session.h"

namespace argil::sculpt {

Parameter reference_parameter() {
  return {.name = "reference",
          .type = ArgumentType::text,
          .help =
              "of an error: a mesh file beneath the session's own folder. With a point field "
              "displacement, as save writes it, it is compared at common material points, else "
              "by the distance to its surface"};
}

std::shared_ptr<const ReferenceShape> reference_of(const Session& session, const Arguments& arguments) {
  if (!arguments.has("reference")) return nullptr;
  const ComparedMesh mesh =
      read_compared_mesh(session.path_to_read(arguments.word("reference")), session.document().limits.cells);
  return std::make_shared<const ReferenceShape>(mesh);
}

}  // namespace argil::sculpt
