#pragma once
// The mild contact of deformable bodies with rigid moving tools, with each other
// and with themselves: what the time loop sees of it. The loop predicts, contact corrects the velocities so that
// no pair of features ends the step closer than zero, and moves the nodes.
//
// The method below is the package's own (ContactConfig::method implicit); two
// baselines to compare with stand beside it: the plain explicit form of the
// same law (src/contact/explicit_mild.cpp) and the correction of places alone
// (src/contact/geometric.cpp). They promise nothing: nodes may get through.
//
// Law of a pair: f = E A h0 (1/h - 1/h0) for a gap h < h0 (contact/law.h), taken
// at the end of the step. A is the mean of the areas that the pair's deformable
// nodes stand for; E and A are fixed at
// set-up, h0 but for what closes fast (src/contact/layers.cpp); weights and normals are those of the start of the step.
#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "forming_sim/config/fault.h"
#include "forming_sim/contact/config.h"
#include "forming_sim/contact/contact_times.h"
#include "forming_sim/contact/held_node.h"
#include "forming_sim/contact/shear_waves.h"
#include "forming_sim/mesh/mesh.h"
#include "forming_sim/parallel/team.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// A surface that takes part: a deformable body's, or a tool's.
struct ContactSurface {
  std::string name;
  int dimension = 3;
  bool rigid = false;
  std::vector<Facet> facets;  ///< bodies: joined numbering; tools: the tool mesh's own numbering. Orientation is used of bodies only
  double friction = 0;        ///< tools: Coulomb coefficient against every body
  double friction_limit = 0;  ///< tools: largest shear stress of friction, Pa; 0: none
  bool meets_itself = false;  ///< bodies: contact with itself
  WaveBody waves;             ///< bodies: of a body that is given none, no waves leave
  bool plane = false;         ///< rigid half space without facets
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();  ///< plane, in the tool's frame; normal of length 1 towards the bodies
};

/// A way in which a rigid tool gives way to what presses on it: a point at x moves by so much along guide + axle x (x - centre).
/// As the step begins; along a guide in m and kg, about an axle in rad and kg m2.
struct ToolFreedom {
  Vec3 guide = Vec3::Zero(), axle = Vec3::Zero(), centre = Vec3::Zero();
  double inverse_mass = 0;  ///< 0: it does not give way
  double speed = 0;         ///< in the step, if nothing presses on it
  double last_speed = 0;    ///< in the step before: so far contact looks at first

  Vec3 along(const Vec3& x) const { return guide + axle.cross(x - centre); }
};

/// Where a rigid tool stands at the beginning and the end of a step:
/// x = rotation * (place in the tool's frame) + position.
struct ToolMotion {
  Vec3 position0 = Vec3::Zero(), position1 = Vec3::Zero();
  Mat3 rotation0 = Mat3::Identity(), rotation1 = Mat3::Identity();
  bool present = true;  ///< false: the tool has left
  /// Of one that moves as it is pushed: at the end of the step it stands at position1, rotation1 if nothing presses on it,
  /// and else where contact lets it (ContactStep::tool_push). Method implicit only.
  static constexpr int kFreedoms = 2;
  ToolFreedom freedom[kFreedoms];  ///< along its guide, about its axle
  bool goes_freely() const { return freedom[0].inverse_mass > 0; }
  bool is_told() const { return freedom[0].inverse_mass == 0 && freedom[1].inverse_mass == 0; }
};

inline Vec3 pose0(const ToolMotion& m, const Vec3& p) { return m.rotation0 * p + m.position0; }
inline Vec3 pose1(const ToolMotion& m, const Vec3& p) { return m.rotation1 * p + m.position1; }

struct ContactSetup {
  int dimension = 3;
  bool axisymmetric = false;             ///< dimension 2, turned about the y axis: areas are those of the whole circle, and bodies are parted along the axis
  ContactConfig config;
  std::vector<ContactSurface> bodies, tools;
  std::vector<const Mesh*> tool_meshes;  ///< one per tool, positions in the tool's frame (not looked at for a plane); read in the constructor only
  double softest_modulus = 0;            ///< E of the softest body, Pa
  double thinnest = 0;                   ///< thickness of the thinnest body, m
  bool soft = false;                     ///< a body bears pressures as large as its modulus: rubber
  double wave_speed = 0;                 ///< of the slowest body, m/s
  Team* team = nullptr;                  ///< the threads, for as long as the contact lasts; null: one of its own. They change no result
};

/// What one step of contact did. Energies in J (J/m in plane strain), of this step.
///
/// They close to rounding: with J the impulses on the nodes and vm the mean of
/// the velocities before the kick and after contact (leapfrog),
///   sum J.vm (free directions) + held_work + (potential - potential before)
///     + dissipated + friction_work = tool_work + soft_start_work.
struct ContactStep {
  double dt = 0;                  ///< the step taken; the asked one over 2^halvings
  int halvings = 0;
  int sweeps = 0;
  bool settled = true;            ///< in the step taken they came to their end, not to max_sweeps
  long active = 0;                ///< pairs that carried an impulse
  double min_gap_over_layer = 1;  ///< smallest end-of-step gap / h0, at most 1
  double friction_work = 0;       ///< dissipated by friction
  double soft_start_work = 0;     ///< of layers that grew (or shrank back) at a fixed gap
  double tool_work = 0;           ///< of the tools on the bodies
  double held_work = 0;           ///< of contact against prescribed motion of held nodes (taken up by what drives them)
  double dissipated = 0;          ///< by the implicit step and the change of features; geometric: by the velocity taken from nodes found inside; explicit: none, so that
                                  ///< the sum above does not close, by what the explicit form makes or loses
  double potential = 0;           ///< of the mild layer at the end of the step (a level, not a change); explicit: at its middle, where energies are read
  double stable_dt = 0;           ///< explicit only: the step up to which the layer as it stands is stable, s; 0: nothing is in it
  std::vector<Vec3> tool_impulse;          ///< on each tool by the bodies, N s
  std::vector<Vec3> tool_angular_impulse;  ///< about the world's origin, N m s
  std::vector<std::array<double, ToolMotion::kFreedoms>> tool_push;  ///< velocity that contact gave each tool in its freedoms, m/s, rad/s; 0 of others
  std::string told;                        ///< what is to be warned of; mostly nothing

  /// As a new one of so many tools, in the memory of the last.
  void begin(std::size_t tools) {
    ContactStep next;
    next.tool_impulse.swap(tool_impulse);  // with their memory
    next.tool_angular_impulse.swap(tool_angular_impulse);
    next.tool_push.swap(tool_push);
    next.tool_impulse.assign(tools, Vec3::Zero());
    next.tool_angular_impulse.assign(tools, Vec3::Zero());
    next.tool_push.assign(tools, {});
    *this = std::move(next);
  }
};

/// Two surfaces that can meet, or are tied.
struct SurfacePair {
  std::string first, second;
  double friction = 0;       ///< the largest double: sticking
  double friction_limit = 0; ///< Pa; 0: none
  bool tied = false;
};

class Contact {
 public:
  /// Chooses h0, stiffness and push speed; sets the tools back by h0; backs off
  /// tools that touch (warnings); at_start: position0, rotation0 count.
  /// Throws Error(initial_penetration) with the pairs and depths.
  /// For a resumed run construct with the positions at the start of the run,
  /// then restore().
  Contact(const ContactSetup& setup, const NodeField& x, const std::vector<ToolMotion>& at_start);
  ~Contact();
  Contact(Contact&&) noexcept;
  Contact& operator=(Contact&&) noexcept;

  /// Inverse masses of all nodes (1/kg) and the nodes with held directions.
  /// Call before the first step, and again whenever they change.
  void set_masses(const std::vector<double>& inverse_mass, const std::vector<HeldNode>& held);

  /// Fills the velocities after the kick of all nodes for a step of this dt:
  /// v_star = v + (dt_prev + dt)/2 f/m, prescribed components inserted; with damping as Kick has it (element/nodes.h).
  using Predict = std::function<void(double dt, NodeField& v_star)>;
  /// x += dt v.
  using Move = std::function<void(double dt, const NodeField& v, NodeField& x)>;
  /// The tools' poses now and after dt, in the place of what is there.
  using ToolsAt = std::function<void(double dt, std::vector<ToolMotion>& motion)>;

  /// Finishes the step that starts at `time` (named in messages only).
  /// In: x at n, v before the kick. Out: v after kick and contact, x + dt v, and in
  /// v_before what v was. On an error x and v stay as they were, v_before does not. What it returns holds until the next call.
  /// The step is halved, and `predict` and `tools` asked again, while a pair
  /// would cross. Throws Error(contact_error) naming the pair when that does
  /// not help, or when a node that nothing can move is run over.
  /// full_dt: the step that could be taken had none been halved lately, 0: dt. All halvings since count.
  /// damping: alpha of the kick, 1/s. It acts on what contact makes of the velocities too, m v (1 + a/2) = m v_before (1 - a/2) + kick f + J,
  /// a = alpha kick: so J is kick times the force that f is balanced by, however alpha changes, and what damping takes is a m ((v_before + v)/2)^2.
  const ContactStep& advance(double time, double dt, NodeField& x, NodeField& v, NodeField& v_before, const Predict& predict, const Move& move, const ToolsAt& tools, double full_dt = 0, double damping = 0);

  /// Independent check: edges of one surface that pierce facets of another
  /// (2D: crossing segments), nodes behind a plane, and parts wholly inside.
  /// Tools stand at position0, rotation0, where contact sees them (set back).
  long count_crossings(const NodeField& x, const std::vector<ToolMotion>& tools) const;
  /// Of a body that does not meet itself (self_contact false): a node of its surface that lies where it has passed through itself; -1: it has not.
  int passed_through_itself(int body, const NodeField& x) const;

  /// Bodies that are tied, or pressed on each other in the last step.
  std::set<std::pair<int, int>> bodies_that_hold_each_other() const;
  /// Of a body: tools that pressed on it in the last step, or whose ties to it act, rising.
  std::vector<int> tools_on(int body) const;
  /// Is anything tied?
  bool ties() const;
  /// Adds the normal impulses that the last step put on the bodies' nodes, N s, below 0 where ties pull; sum: one per node.
  void add_normal_impulses(std::vector<double>& sum) const;
  /// Adds the impulses of the last step on the nodes given to set_masses as held, in their order, along the
  /// directions that are held: what holds them bears these. N s.
  void add_held_impulses(std::vector<Vec3>& sum) const;
  /// What acted on a node of a body in the last step: one of the tools that are asked for, or something else.
  struct ActedOn {
    int node = -1;
    bool asked = false;          ///< near or tied to one of the tools, which pressed or pulled somewhere
    bool others = false;         ///< something else pressed on it, or ties it
    Node impulse = Node::Zero(); ///< of the tools, N s
  };
  /// tools: 1 for those asked for. In the order of the nodes.
  std::vector<ActedOn> acted_on(const std::vector<char>& tools) const;
  /// A tool that presses on a face of a body, or on an edge of it, and not at one of its nodes: a corner or an edge of the tool.
  struct PressedInside {
    int tool = -1;
    std::array<int, 3> nodes{-1, -1, -1};    ///< of the body, 2 of an edge and in the plane
    std::array<double, 3> weights{0, 0, 0};  ///< of the place between them, sum 1
    Vec3 impulse = Vec3::Zero();             ///< normal, on the body, N s
  };
  /// Those of the last step. Of tools that are planes there are none.
  std::vector<PressedInside> pressed_inside() const;
  const std::vector<double>& nodal_area() const;      ///< of the bodies' nodes at the start, m^2 (m in plane strain); 0 inside

  /// Distance of every node of the bodies' surfaces from the nearest other surface
  /// that it can meet, m; at most gap_reach(), also inside. Of tools from the
  /// surface that was given: 0 where the node lies on it, less where it is pressed in.
  /// Searched anew at every call.
  std::vector<double> gaps(const NodeField& x, const std::vector<ToolMotion>& tools) const;
  double gap_reach() const;                           ///< two mean edges of the bodies' surfaces, m
  /// How far each node has slid along what it is pressed against, m; empty where nothing rubs.
  const std::vector<double>& slip() const;

  double layer() const;                               ///< h0, m
  double stiffness() const;                           ///< E of the layer, Pa
  double push_speed() const;                          ///< m/s
  long listed_pairs() const;                          ///< pairs of features near enough to be watched
  long list_builds() const;                           ///< how often the list was built
  /// From now on adds to `times` what its parts take; nullptr: no more.
  void time_parts(ContactTimes* times);
  /// Bodies that touched each other at the start are moved apart by so much, m: one
  /// per body, mostly zero. The caller moves their nodes before the first step.
  const std::vector<Vec3>& body_shifts() const;
  bool touches_at_start(int tool) const;  ///< a body, before tools and bodies were set back
  std::vector<SurfacePair> surface_pairs() const;
  const std::vector<std::string>& warnings() const;   ///< "tool die was backed off by 1e-6 m along (0, -1, 0) ..."

  /// All that the next steps depend on beside x, v and the tools' motion.
  std::vector<char> save() const;
  /// Throws Error(resume_error) when the data is not of this contact.
  void restore(const std::vector<char>& data);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace forming_sim
