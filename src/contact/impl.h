#pragma once
// What a Contact holds, and the parts of a step that its methods share.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/contact/alike.h"
#include "forming_sim/contact/books.h"
#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/contact.h"
#include "forming_sim/contact/friction_delay.h"
#include "forming_sim/contact/layers.h"
#include "forming_sim/contact/list.h"
#include "forming_sim/contact/narrow.h"
#include "forming_sim/contact/shear_limit.h"
#include "forming_sim/contact/shear_waves.h"
#include "forming_sim/contact/sticking.h"
#include "forming_sim/contact/sweeps.h"
#include "forming_sim/contact/ties.h"
#include "forming_sim/contact/tools.h"

namespace forming_sim {

struct Contact::Impl {
  explicit Impl(Team* given) : alone(1), team(given ? *given : alone), sweeps(team) {}

  enum class Method { implicit, explicit_mild, geometric };
  Team alone;               ///< where none is given
  Team& team;
  // ---- what does not change
  ContactConfig config;
  Method method = Method::implicit;
  Features features;
  std::vector<int> body_vertices;  ///< on surfaces
  ToolSet tools;
  std::vector<Tie> ties;
  std::vector<std::string> body_names;
  std::vector<Vec3> body_shifts;
  std::vector<int> sides;   ///< of every facet the bodies' side: +1 that of the normal, -1 the other, 0 unknown (see find_sides)
  std::vector<bool> border; ///< of every vertex: on the border of an open surface
  double both = 1;          ///< 2 where both sides of a pair can be deformable and move
  double layer = 0, ceiling = 0, modulus = 0, push_speed = 0;
  std::vector<std::string> warnings;
  std::unique_ptr<ToolIndex> tool_index;  ///< in the tools' frames
  // ---- masses
  std::vector<double> inverse_mass;
  std::vector<HeldNode> held;
  std::vector<int> held_of;
  double damping = 0;       ///< of the kick, 1/s
  double inertia = 1;       ///< 1 + a/2: by so much the workspace's masses are heavier, since damping acts on what contact does too
  Flush flush;              ///< which writes what of the features is about joints
  // ---- what the next step depends on
  PairRecords records;
  double thickest = 0;      ///< of their layers, at least `layer`
  double potential = 0;
  std::vector<double> slip; ///< of the bodies' nodes, m; empty where nothing rubs
  ShearWaves waves;
  FrictionDelay delay;
  ShearLimit shear_limit;
  std::optional<Sticking> sticking;
  std::vector<char> parted; ///< of every tie: it held what was held already, that has parted, and it is given up
  double previous_dt = 0;   ///< of the step before, s; 0 at the start
  std::vector<ToolMotion> previous_motion;  ///< of the tools: position0, rotation0 at the start of the step before
  // ---- the list and how much of its margin is used
  NearList list;
  Workspace work;
  std::vector<TiePair> tie_pairs;
  std::vector<TiePair> doubled;            ///< ties that do nothing: they hold what is held already (take_out_doubled), or have parted
  std::size_t feet = 0;                    ///< of planes and of ties, the last entries of the workspace
  bool listed = false;
  long builds = 0;
  double travel = 0;        ///< bound on relative motion since the list was built (never falls)
  double used = 0;          ///< of the list's radius
  std::vector<bool> listed_present;
  ContactTimes* times = nullptr;
  NodeField x_at_build;     ///< of the bodies' surface vertices, in their order
  std::vector<ToolMotion> motion_at_build;
  // ---- the running step, and scratch that keeps memory from step to step
  ContactStep step;
  std::vector<ToolMotion> motion;
  std::vector<PlanePose> planes;
  std::vector<DrivenTool> driven;  ///< one for each freedom
  /// Pairs that are booked together, by one thread.
  struct Chunk {
    ContactStep step;
    RelaxedPotential end;
    double normal_work = 0, start = 0, thickest = 0;
    long kept = 0;  ///< records, at the place of the chunk's first pair
  };
  std::vector<Chunk> chunks;
  AlikePairs alike;
  Narrow near;
  Sweeps sweeps;
  PairRecords tried;  ///< pairs of the last attempt at this step that failed
  std::vector<double> moved;
  std::vector<double> told_ways;  ///< per tool
  std::vector<double> sum, weighted, total;  ///< per entry of the workspace
  std::vector<RubbedNode> pressed;
  std::vector<int> place_pressed;  ///< of an entry in `pressed`, -1: nothing rubs there

  // search.cpp
  double fastest(const NodeField& v) const;
  /// Into told_ways how far any point of each present tool goes in the step as it is told, m; returns the largest.
  double step_way(const NodeField& x, double dt);
  /// Throws Error(contact_error) where a body vertex, or this reach, is farther than numbers go.
  void check_reach(const NodeField& x, double radius) const;
  /// A list that holds every pair of features nearer than `reach`.
  void ensure_list(const NodeField& x, double reach, double step_bound);
  /// The ties of the list: those that act, and those that do not.
  void link_ties();
  /// Of those that do not act, at the start of a step; a warning tells it, once for two surfaces.
  void give_up_parted_ties();
  void set_inertia(double wanted);
  /// Into the workspace: x at the start, v_star, v before the kick (of tools: over the step before).
  void gather(const NodeField& x, const NodeField& v, const NodeField& v_star, double dt);
  PairConstants constants() const { return {features, work, modulus, layer, &waves}; }
  /// Counts `way` of relative motion towards the list's margin.
  void moved_by(double way);

  // contact.cpp
  /// Velocities back from the workspace, their means for the books, and x + dt v; v and v_star change places.
  void end(double dt, const Move& move, NodeField& x, NodeField& v, NodeField& v_star);
  /// Those of the step, to whose nodes it adds its slip (step.dt: the step taken), with the ties booked; the
  /// caller adds the pairs.
  Books open_books();
  Books empty_books(ContactStep& of) const { return Books(work, near.rubs, features.bodies, of); }

  /// Of a pair in the last step, along its normal and along the surfaces, N s.
  Node impulse_of(const ContactPair& pair) const {
    const Node along = pair.impulse * pair.normal;
    return pair.rub < 0 || pair.impulse == 0 ? along : Node(along + near.rubs[pair.rub].slip);
  }
  /// What of the bodies' motion lasts, after a step from `before` to v.
  void follow_steady_motion(double dt, const NodeField& x, const NodeField& before, const NodeField& v);

  // surface_fields.cpp
  /// Adds to the slip of every node that rubs what its pairs slid in the step,
  /// the mean by their normal impulses.
  void add_slip(double dt);

  // One file each; v_star: memory for the velocities after the kick, afterwards those before it.
  void advance_implicit(double time, double dt, double full_dt, NodeField& x, NodeField& v, NodeField& v_star, const Predict& predict, const Move& move, const ToolsAt& tools_at);
  void advance_explicit(double time, double dt, NodeField& x, NodeField& v, NodeField& v_star, const Predict& predict, const Move& move, const ToolsAt& tools_at);
  void advance_geometric(double dt, NodeField& x, NodeField& v, NodeField& v_star, const Predict& predict, const Move& move, const ToolsAt& tools_at);

  // geometric.cpp
  /// Sides of the bodies' facets, borders of open surfaces.
  void know_sides();
  /// The pair of a vertex and the nearest point of a surface, its gap negative
  /// inside; no nodes where it counts for nothing. Returns the distance.
  double nearest_side(const NearList::VertexGroup& group, double deepest, ContactPair& pair) const;
  /// To a gap of h0, with no closing velocity left.
  void put_back(ContactPair pair);

  // driven.cpp
  /// The freedoms of the present tools, and what is of each in the step that has been gathered.
  void find_driven_tools();
  void gather_driven(DrivenTool& tool) const;
  /// The largest of the tools' ways: `most` of what they are told, or one's own with those of its freedoms.
  template <class Way> double farthest_tool(double most, Way&& way) const {
    double sum = 0;
    int of = -1;
    for (const DrivenTool& tool : driven) {
      sum = (tool.tool == of ? sum : told_ways[tool.tool]) + way(tool);
      of = tool.tool;
      most = std::max(most, sum);
    }
    return most;
  }

  // implicit.cpp
  /// Books the pairs of a step that was taken, lets their layers grow, keeps their records.
  void close_books();
  bool touches(double dt, const ClosePair& close) const;
  bool pushed_in(double dt) const;
  int first_touch(double dt);
  std::string name_of_vertex(int v) const;
  std::string name_of_entry(int entry) const;
  std::string name_of_surface(int surface) const;
  void check_unmovable(double time);
  void check_resolution(double time, double dt, double gap) const;
  [[noreturn]] void give_up(double time, double dt, int touch) const;

 private:
  template <class From, class To> double farthest(const NodeField& x, From&& from, To&& to, std::vector<double>* ways = nullptr) const;
};

}  // namespace forming_sim
