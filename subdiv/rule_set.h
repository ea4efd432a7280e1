#pragma once
// Which subdivision scheme places the new points. Both split cells alike; they differ at extraordinary places.

namespace argil::subdiv {

enum class RuleSet {
  maccracken_joy,         // maccracken_joy.h
  multilinear_averaging,  // multilinear_averaging.h
};

}  // namespace argil::subdiv
