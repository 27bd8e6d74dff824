#pragma once
// The impact of section 3.4: two elastic bodies 4 m long and 2 m high, rho 2800,
// G 26.5 GPa, K 65.1 GPa, fly at each other with 5 m/s; or one at a rigid wall.
//
// What the paper leaves out and is chosen here: square cells of .1 m (its Delta y),
// each two triangles, the diagonals of a body all the same way, the other body its
// mirror image ("the impact plane also serves as a symmetry plane"); pressure per
// element and the law as printed (3.5); plane strain; no viscosity; .9 of the stable
// step of the elements. A body starts 5 mm from the wall, the bodies 10 mm and h0
// from each other, so that the contact (its layer) begins at .001 s.
#include <string>
#include <utility>
#include <vector>

#include "figure.h"
#include "forming_sim/contact/config.h"
#include "forming_sim/mesh/mesh.h"
#include "rows.h"

namespace forming_sim::bench {

constexpr double kImpactStress = 70e6, kImpactDuration = 1.6e-3, kImpactStart = 1e-3;  // (3.72): Pa, s, s

struct ImpactCase {
  ContactConfig contact;
  double safety = 0.9;   ///< of the stable step of the elements
  bool wall = false;     ///< one body against a rigid wall, which carries contact.layer like a body
  int through = 20;      ///< cells over the 2 m
  int through_left = 20; ///< of the other body
  bool mirror = true;    ///< the other body's diagonals are the mirror image, not parallel
  double until = 3.4e-3; ///< s
};

struct ImpactFound {
  std::vector<double> time, stress;  ///< mean contact stress of every step, Pa, at its middle
  double start = 0, duration = 0;    ///< first step with contact; first to last, s
  double mean = 0, rms = 0;          ///< of the stress from .4 to 1.4 ms after the start, and of what it swings about that, Pa
  double peak = 0;                   ///< Pa
  double rise = 0;                   ///< from the first contact until 70 MPa are first passed, s
  double fall = 0;                   ///< most that the stress falls within one bulk step after 2.4 ms, Pa
  double restitution = 0;            ///< momentum of a body at the end over that at the start
  double energy = 0;                 ///< kinetic + elastic at the end over that at the start, less 1
  double momentum = 0;               ///< of both bodies over that of one; wall: less what the wall was given
  double bulk_dt = 0, dt = 0;        ///< stable step of the elements with safety 1, step taken, s
  double layer_dt = 0;               ///< explicit: up to which its layer was stable, s
  long steps = 0, crossings = 0, halvings = 0;
  double balance = 0;                ///< of the energy ledger
  double wall_time = 0;              ///< s
  std::string error;                 ///< that ended the run
  /// It ended, nothing crossed, and no more than `bound` of the energy was made or lost.
  bool sound(double bound) const { return error.empty() && crossings == 0 && energy > -bound && energy < bound; }
};

/// Of body 0, to the right of x = 0, or 1, to its left, at the start.
Mesh impact_mesh(const ImpactCase& c, int side);

ImpactFound collide(const ImpactCase& c);

/// A contact.method with its layer, m.
ContactConfig mild(const std::string& method, double layer);
/// The paper's algorithm 2: pairing node_node is the first, node_side the second of its two cases.
ContactConfig algorithm_2(const std::string& pairing, double layer, double coefficient);

/// The largest fraction of the bulk step, from .9 down to .025, at which algorithm 2 is
/// sound within `bound`, with what was found there; fraction 0 where it is at none.
struct Tried {
  double fraction = 0;
  ImpactFound found;
};
Tried largest_sound_step(const ContactConfig& contact, double bound);

/// Means over the bulk step, so that runs with any step can be compared: s, Pa.
std::vector<std::pair<double, double>> averaged(const ImpactFound& found);
/// The same as a curve, MPa over ms.
void add_stress(Figure& figure, const std::string& series, const ImpactFound& found);
/// 70 MPa from 1 to 2.6 ms.
void add_analytic(Figure& figure);

}  // namespace forming_sim::bench
