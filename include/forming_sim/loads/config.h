#pragma once
// What a user says of motion and load: boundary sets, pressures, dead loads, gravity, tools.
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/config/field.h"
#include "forming_sim/mesh/config.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// What holds or drives a set of nodes.
struct BoundaryConfig {
  std::string set;
  std::string kind;                 ///< fixed | symmetric | velocity | trajectory
  std::vector<std::string> axes;    ///< not symmetric: which of x y z; empty: all
  Vec3 normal = Vec3::Zero();       ///< symmetric
  std::vector<double> times;        ///< velocity, trajectory: knots
  std::vector<Vec3> velocities;     ///< velocity: values at the knots
  std::vector<Vec3> spins_deg_s;    ///< velocity: angular velocities at the knots
  std::vector<Vec3> positions;      ///< trajectory: displacements at the knots
  std::vector<Vec3> rotations_deg;  ///< trajectory: rotation vectors at the knots
  Vec3 centre = Vec3::Zero();       ///< velocity, trajectory: about which the set turns
  std::string profile;              ///< between knots: linear | smooth | spline; empty: see shape()
  std::string since, until;         ///< stages at whose beginning it takes hold and lets go; empty: from the start on; it stays

  bool is_driven() const { return kind == "velocity" || kind == "trajectory"; }
  std::string shape() const { return !profile.empty() ? profile : kind == "trajectory" ? "smooth" : "linear"; }

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(set), Field().required().doc("name of a set of this body"));
    visit(FORMING_SIM_FIELD(kind), Field().required().choices({"fixed", "symmetric", "velocity", "trajectory"}).doc("fixed: no motion along the axes; symmetric: no motion along the normal, a plane of symmetry, which is no surface of the body (nor is one that fixed holds along its normal alone); velocity, trajectory: the set moves and turns as a rigid body would, along the axes, with velocities or to places at given times: a gripper"));
    visit(FORMING_SIM_FIELD(axes), Field().choices({"x", "y", "z"}).when("kind", {"fixed", "velocity", "trajectory"}).computed("all").doc("axes that are held or driven; the others stay free. Where the set turns, what drifts along a free axis is turned with it, about the centre: where it drifts far, give the centre's way along that axis too, in velocities or positions, though it is not driven"));
    visit(FORMING_SIM_FIELD(normal), Field().required().when("kind", {"symmetric"}).doc("normal of the plane of symmetry, any direction"));
    visit(FORMING_SIM_FIELD(times), Field().unit("s").at_least(0).required().when("kind", {"velocity", "trajectory"}).doc("times of the knots, increasing; before the first and after the last a velocity stays, and a trajectory rests"));
    visit(FORMING_SIM_FIELD(velocities), Field().unit("m/s").when("kind", {"velocity"}).doc("velocity at each knot, of the centre where the set turns"));
    visit(FORMING_SIM_FIELD(spins_deg_s), Field().unit("deg/s").when("kind", {"velocity"}).doc("angular velocity about the centre at each knot. Give velocities, spins_deg_s or both"));
    visit(FORMING_SIM_FIELD(positions), Field().unit("m").when("kind", {"trajectory"}).doc("displacement at each knot, of the centre where it turns; it counts from that of the first"));
    visit(FORMING_SIM_FIELD(rotations_deg), Field().unit("deg").when("kind", {"trajectory"}).doc("rotation vector (axis times angle) about the centre at each knot, taken from one to the next component by component; it counts from that of the first, and on beyond 180 degrees; in dimension 2 [0, 0, angle]. Give positions, rotations_deg or both"));
    visit(FORMING_SIM_FIELD(centre), Field().unit("m").when("kind", {"velocity", "trajectory"}).doc("centre of rotation when the boundary takes hold; it moves with the velocities or positions"));
    visit(FORMING_SIM_FIELD(profile), Field().choices({"linear", "smooth", "spline"}).when("kind", {"velocity", "trajectory"}).computed("linear; smooth for a trajectory").doc("between knots: linear; smooth: a velocity is a cubic with zero acceleration at the knots, a trajectory goes from rest to rest between them; spline: a trajectory that passes the inner knots without stopping"));
    visit(FORMING_SIM_FIELD(since), Field().computed("the start of the run").doc("name of a stage: the boundary takes hold of its nodes when that begins, and its times count from there"));
    visit(FORMING_SIM_FIELD(until), Field().computed("it stays").doc("name of a later stage: when that begins, the boundary lets its nodes go"));
  }
};

/// Pressure over time on a surface, normal to the deformed faces.
struct PressureConfig {
  std::string set;
  std::vector<double> times, values;
  std::string profile = "linear";  ///< between knots: linear | smooth
  std::string since;               ///< stage from whose beginning on it acts; empty: from the start on

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(set), Field().required().doc("name of a set: the pressure acts on the surface faces all of whose nodes are in it"));
    visit(FORMING_SIM_FIELD(times), Field().unit("s").at_least(0).required().doc("times of the knots, increasing; level before the first and after the last"));
    visit(FORMING_SIM_FIELD(values), Field().unit("Pa").required().doc("pressure at each knot, positive pushes into the body"));
    visit(FORMING_SIM_FIELD(profile), Field().choices({"linear", "smooth"}).doc("between knots: linear, or smooth (cubic, level at the knots: a load that starts and stops so sets off no swing)"));
    visit(FORMING_SIM_FIELD(since), Field().computed("the start of the run").doc("name of a stage: it acts from when that begins, and its times count from there"));
  }
};

/// As sentences call it.
inline std::string name_of(const PressureConfig& pressure) { return "the pressure on set " + pressure.set; }

/// A load over time that keeps its direction and does not follow the surface.
struct LoadConfig {
  std::string set;
  std::string kind;              ///< traction | force
  std::vector<double> times;
  std::vector<Vec3> tractions;   ///< traction
  std::vector<Vec3> forces;      ///< force
  std::string profile = "linear";  ///< between knots: linear | smooth
  std::string since;               ///< stage from whose beginning on it acts; empty: from the start on

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(set), Field().required().doc("name of a set of this body"));
    visit(FORMING_SIM_FIELD(kind), Field().required().choices({"traction", "force"}).doc("traction: on the surface faces all of whose nodes are in the set, so much per area that they had at the start; force: so much on the whole set, shared by those faces as their areas were at the start, and evenly by the nodes of a set without a face"));
    visit(FORMING_SIM_FIELD(times), Field().unit("s").at_least(0).required().doc("times of the knots, increasing; level before the first and after the last"));
    visit(FORMING_SIM_FIELD(tractions), Field().unit("Pa").required().when("kind", {"traction"}).doc("force per initial area at each knot; it keeps its direction as the surface turns"));
    visit(FORMING_SIM_FIELD(forces), Field().unit("N").required().when("kind", {"force"}).doc("force at each knot; plane strain: N/m; axisymmetric: summed around the whole circle, also what goes outward along x"));
    visit(FORMING_SIM_FIELD(profile), Field().choices({"linear", "smooth"}).doc("between knots: linear, or smooth (cubic, level at the knots: a load that starts and stops so sets off no swing)"));
    visit(FORMING_SIM_FIELD(since), Field().computed("the start of the run").doc("name of a stage: it acts from when that begins, and its times count from there"));
  }
};

/// As sentences call it.
inline std::string name_of(const LoadConfig& load) { return "the load on set " + load.set; }

/// A pose, a velocity or a force over time.
struct MotionConfig {
  std::string kind;                 ///< trajectory | velocity | force
  std::vector<double> times;
  std::vector<Vec3> positions;      ///< trajectory: displacement from the initial pose
  std::vector<Vec3> rotations_deg;  ///< trajectory: rotation vectors, degrees
  std::vector<Vec3> velocities;     ///< velocity
  std::vector<Vec3> spins_deg_s;    ///< velocity, force: angular velocity
  std::vector<Vec3> forces;         ///< force
  Vec3 guide = Vec3::Zero();        ///< force; zero: along the forces
  double stiffness = 0;             ///< force: of a spring between the tool and its guide
  Vec3 initial_velocity = Vec3::Zero();  ///< force
  double mass = 0;                  ///< force; 0: that of the bodies
  Vec3 axle = Vec3::Zero();         ///< about which it turns freely; zero: it does not
  std::vector<double> torques;      ///< about the axle
  double initial_spin_deg_s = 0;    ///< about the axle
  double inertia = 0;               ///< about the axle; 0: of the bodies' mass, as far off as the tool reaches
  double damping = 0;               ///< force
  double stop_ahead = 0, stop_behind = 0;  ///< force; 0: none
  double spin_damping = 0;          ///< about the axle
  double stop_force = 0;            ///< trajectory, velocity; 0: none
  Vec3 centre = Vec3::Zero();
  std::string profile = "smooth";
  std::string since;                ///< stage at whose beginning it begins; empty: at the start

  bool turns_freely() const { return !axle.isZero(0); }
  bool by_force() const { return kind == "force"; }
  /// What is told is places and orientations; else velocities and spins.
  bool by_places() const { return kind == "trajectory" || (by_force() && (!positions.empty() || !rotations_deg.empty())); }

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(kind), Field().required().choices({"trajectory", "velocity", "force"}).doc("trajectory: displacements and rotations at given times; velocity: velocities and spins at given times; force: forces at given times, and the tool goes where they and the bodies push it, along a guide; across that, and how it turns, as a trajectory (positions, rotations_deg) or a velocity (velocities, spins_deg_s) says, or not at all: a blank holder, a hammer, a roll that is pressed on a sheet and driven along it"));
    visit(FORMING_SIM_FIELD(times), Field().unit("s").at_least(0).required().doc("times of the knots, increasing; a trajectory rests before the first and after the last, a velocity or a force stays as at the nearest knot"));
    visit(FORMING_SIM_FIELD(positions), Field().unit("m").when("kind", {"trajectory", "force"}).doc("displacement from the initial place at each knot; of kind force across the guide, with a stiffness along it too"));
    visit(FORMING_SIM_FIELD(rotations_deg), Field().unit("deg").when("kind", {"trajectory", "force"}).doc("rotation vector (axis times angle) about the centre at each knot, taken from one to the next component by component: angles count on beyond 180; in dimension 2 [0, 0, angle]"));
    visit(FORMING_SIM_FIELD(velocities), Field().unit("m/s").when("kind", {"velocity", "force"}).doc("velocity at each knot; of kind force across the guide, with a stiffness along it too"));
    visit(FORMING_SIM_FIELD(spins_deg_s), Field().unit("deg/s").when("kind", {"velocity", "force"}).doc("angular velocity about the centre at each knot"));
    visit(FORMING_SIM_FIELD(forces), Field().unit("N").required().when("kind", {"force"}).doc("force on the tool at each knot, all along one line, the guide; plane strain: N/m; axisymmetric: of the whole circle; the weight of the tool is one of them, gravity acts on bodies only"));
    visit(FORMING_SIM_FIELD(guide), Field().above(0).when("kind", {"force"}).computed("along the forces; where all are 0 along initial_velocity").doc("direction of the line along which the tool is guided"));
    visit(FORMING_SIM_FIELD(stiffness), Field().unit("N/m").at_least(0).when("kind", {"force"}).doc("spring between the tool and its guide, beside the forces: it pulls the tool back by so much for each metre along the guide that it is away from its place at the start, or from where positions or velocities take the other end of the spring: a gas spring under a holder, which pushes the more the farther it is pushed back (its force at the start is in forces; nothing stops it at its place, and freed it goes on to where its spring bears its force); a robot that yields. Plane strain: N/m per metre of width"));
    visit(FORMING_SIM_FIELD(initial_velocity), Field().unit("m/s").when("kind", {"force"}).doc("velocity that the tool starts with, along its guide: a hammer"));
    visit(FORMING_SIM_FIELD(mass), Field().unit("kg").at_least(0).computed("that of all bodies").when("kind", {"force"}).doc("mass of the tool, kg/m in plane strain; at least a thousandth of that of all bodies, mass scaling included"));
    visit(FORMING_SIM_FIELD(axle), Field().above(0).computed("none").doc("direction at the start of an axle through the centre, about which the tool turns freely, as what touches it makes it: an idle roll, whose centre of mass is on the axle. It goes and turns with what the motion says, without what that turns about the axle, and turns on while it is withdrawn (a velocity without velocities and spins_deg_s stays where it is). In dimension 2 [0, 0, 1]"));
    visit(FORMING_SIM_FIELD(torques), Field().unit("N m").doc("torque about the axle at each knot, in its right-hand sense; plane strain: N m per m"));
    visit(FORMING_SIM_FIELD(initial_spin_deg_s), Field().unit("deg/s").doc("how fast it turns about the axle at the start"));
    visit(FORMING_SIM_FIELD(inertia), Field().unit("kg m2").at_least(0).computed("the mass of all bodies times the square of the farthest that the tool reaches from the axle").doc("moment of inertia about the axle, plane strain: kg m; at least a thousandth of the default, with what mass scaling adds"));
    visit(FORMING_SIM_FIELD(damping), Field().unit("1/s").at_least(0).when("kind", {"force"}).doc("rate at which the tool loses speed to its guide: a force of damping times mass times velocity (against that of the other end of its spring)"));
    visit(FORMING_SIM_FIELD(stop_ahead), Field().unit("m").at_least(0).when("kind", {"force"}).computed("none").doc("how far the tool can go along its guide, from its place at the start in the direction of the guide (without one of the largest force), until it comes against a stop: spacers under a blank holder, the end of a gas spring. It stands there, whatever drives it, until it is pushed or drawn back"));
    visit(FORMING_SIM_FIELD(stop_behind), Field().unit("m").at_least(0).when("kind", {"force"}).computed("none").doc("likewise the other way. 0 is no stop: a tool that starts on one has a little way to it, 1e-9"));
    visit(FORMING_SIM_FIELD(spin_damping), Field().unit("1/s").at_least(0).doc("rate at which a tool that turns about an axle loses spin to its bearing: a torque of spin_damping times inertia times spin"));
    visit(FORMING_SIM_FIELD(stop_force), Field().unit("N").at_least(0).when("kind", {"trajectory", "velocity"}).computed("it goes its whole way").doc("the tool stops for good where it is when the force against its way (of a tool that only turns: the whole force), the mean over some 50 steps, has reached this; plane strain: N/m; axisymmetric: along the axis, of the whole circle. stages[].until_stopped ends a stage with it. About an axle it turns on"));
    visit(FORMING_SIM_FIELD(centre), Field().unit("m").doc("centre of rotation at the start; it moves with the tool"));
    visit(FORMING_SIM_FIELD(profile), Field().choices({"smooth", "linear", "spline"}).doc("smooth: from rest to rest between knots (quintic trajectory, cubic velocity and force); linear: straight lines; spline: a trajectory that passes the inner knots without stopping"));
    visit(FORMING_SIM_FIELD(since), Field().computed("the start of the run").doc("name of a stage: the tool stands still until that begins, at its first position, and its times count from there"));
  }
};

/// Up to where a tool is put before the run.
struct ApproachConfig {
  Vec3 along = Vec3::Zero();
  std::vector<std::string> to;  ///< bodies and tools; empty: all bodies
  double gap = 0;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(along), Field().required().above(0).doc("direction in which the tool comes from far away, of any length"));
    visit(FORMING_SIM_FIELD(to), Field().computed("all bodies").doc("names of the bodies, and of tools before it in the list, that it is laid against: it stops at the first of them that it would touch"));
    visit(FORMING_SIM_FIELD(gap), Field().unit("m").at_least(0).doc("how far along its way it stops before that"));
  }
};

/// A rigid tool.
struct ToolConfig {
  std::string name;
  std::optional<MeshConfig> mesh;
  std::optional<ProfileConfig> profile;
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();  ///< plane without a mesh
  Vec3 position = Vec3::Zero(), rotation_deg = Vec3::Zero();
  std::optional<ApproachConfig> approach;
  std::optional<MotionConfig> motion;
  double friction = 0;
  double friction_limit = 0;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(name), Field().required().doc("name of the tool"));
    visit(FORMING_SIM_FIELD(mesh), Field().doc("surface of a tool of dimension 3. Give one of mesh, profile, normal"));
    visit(FORMING_SIM_FIELD(profile), Field().doc("section of a tool: in dimension 2 in the x-y plane, turned about the axis y in an axisymmetric scene; in dimension 3 in the x-z plane, and swept"));
    visit(FORMING_SIM_FIELD(point), Field().unit("m").doc("rigid plane: a point of it"));
    visit(FORMING_SIM_FIELD(normal), Field().doc("rigid plane: its normal, towards the side of the blank; no mesh is needed. Axisymmetric: turned about the axis y a normal along y stays a plane, one along x makes a cylinder, others make cones"));
    visit(FORMING_SIM_FIELD(position), Field().unit("m").doc("where the origin of the tool's mesh or profile is put at the start"));
    visit(FORMING_SIM_FIELD(rotation_deg), Field().unit("deg").doc("rotation vector of the tool's mesh or profile about its origin at the start"));
    visit(FORMING_SIM_FIELD(approach), Field().doc("moves the tool, with the centre of its motion, from its position along a line to where it first touches the bodies as they lie at the start: on a formed part, say, whose height nobody knows. What it would only graze counts as touched"));
    visit(FORMING_SIM_FIELD(motion), Field().doc("how the tool moves; absent: it rests"));
    visit(FORMING_SIM_FIELD(friction), Field().at_least(0).at_most(10).doc("Coulomb friction of every body against this tool; 0: frictionless"));
    visit(FORMING_SIM_FIELD(friction_limit), Field().unit("Pa").at_least(0).computed("no limit").doc("largest shear stress of that friction: min(friction p, friction_limit) where the pressure is p; in bulk forming m Y/sqrt(3), with a friction factor m above 0, at most 1, and the yield stress Y; 0 is no limit"));
  }
};

}  // namespace forming_sim
