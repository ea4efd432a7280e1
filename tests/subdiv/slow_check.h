#pragma once
// A second, slow way to tell whether a solid is whole, from its public face alone: what the incidence lists, cells
// and links say is counted anew. validate() keeps its own books; the two must agree.

#include <string>
#include <vector>

#include "subdiv/solid.h"

namespace argil::subdiv::test {

/// What is wrong; empty if nothing. `dangling`: elements that no cell holds are no fault.
std::vector<std::string> slow_check(const Solid& solid, bool dangling = false);

/// Euler's relation, V' − E' + F − C = components of the boundary − genus, V' and E' counted once for every fan of
/// cells: both sides. The boundary side is of the boundary cut along where it touches itself.
struct EulerRelation {
  long long solid = 0, boundary = 0;
  long long genus = 0;
  bool contacts = false;  // edges or vertices at which cells meet that share no face there
};
EulerRelation euler_relation(const Solid& solid);

}  // namespace argil::subdiv::test
