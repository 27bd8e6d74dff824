#pragma once
// Where a sheet's surface turns most from one cell to the next: what bends by much in few cells is neither as stiff as it should be, nor springs back as it should.
#include "forming_sim/simulation/model.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

struct SharpBend {
  double degrees = 0;       ///< between the normals of two faces of the surface that share an edge, on the outside of a bend, more than at the start
  Vec3 place = Vec3::Zero();  ///< of that edge, m
};
/// Of a body that is a sheet, at x; of one that is none, 0. What is about as narrow as the sheet is thick (1.5 times) between faces that stand across it at the start is a cut edge, whose shape is no bend.
SharpBend sharpest_bend(const BodyModel& body, const NodeField& x);

}  // namespace forming_sim
