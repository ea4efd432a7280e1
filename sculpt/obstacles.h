#pragma once
// The obstacles of a document: by name in its state, and as the simulation meets them at a time.

#include <memory>
#include <string>
#include <vector>

#include "fem/contact/contact.h"
#include "sculpt/document.h"

namespace argil::sculpt {

class Hash;

struct NamedObstacle {
  std::string name;
  fem::Obstacle body;  // where it stands; its id is the document's own, from 1
  /// Keys lead it from there: way [m] and rotation vector [rad] about the pivot; none: it stays.
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
  Track track = {};
};

/// Where the obstacles are at a time [s], and how they move then: the only place that the simulation asks. A step
/// takes them where they are at its end, and in its parts as they moved to there.
[[nodiscard]] std::vector<fem::Obstacle> moving_obstacles(const State& state, double time);

/// An obstacle as its keys have it at a time, standing still.
[[nodiscard]] fem::Obstacle standing_obstacle(const NamedObstacle& obstacle, double time);

/// Contact in a step that ends at a time; null without obstacles.
[[nodiscard]] std::shared_ptr<const fem::Contact> contact_at(const Document& document, double time);

/// The document's loads with the contact forces of its present state among the dead forces: what balances the pins.
[[nodiscard]] fem::Loads standing_loads(const Document& document);

/// Null if there is none of that name.
[[nodiscard]] const NamedObstacle* find_obstacle(const State& state, const std::string& name);
/// Puts an obstacle in, in place of one of its name, or takes that away. What friction held there is let go.
void put_obstacle(State& state, NamedObstacle obstacle);
void remove_obstacle(State& state, const std::string& name);
/// Lets go of what friction holds, as where the points of the surface are others.
void drop_grips(State& state);

/// What acts on a body and is not in its stiffness matrix, "obstacle floor", "pressure wind": those who linearise
/// should say that they leave it out.
[[nodiscard]] std::vector<std::string> left_out_of_linearisation(const State& state);

/// "floor: plane at 0 0 0, normal 0 0 1, friction 0.5", and a line for each for `info`.
[[nodiscard]] std::string description(const NamedObstacle& obstacle);

void hash_obstacles(const std::vector<NamedObstacle>& obstacles, Hash& hash);

}  // namespace argil::sculpt
