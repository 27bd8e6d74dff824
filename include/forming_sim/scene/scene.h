#pragma once
// A scene: all that a user says of a run. It composes the rooms' Configs.
// YAML (scene/yaml.h) and the action goal (ros/) map to it one to one.
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/config/fault.h"
#include "forming_sim/config/field.h"
#include "forming_sim/contact/config.h"
#include "forming_sim/loads/config.h"
#include "forming_sim/material/config.h"
#include "forming_sim/mesh/config.h"
#include "forming_sim/results/config.h"
#include "forming_sim/simulation/config.h"

namespace forming_sim {

/// A deformable body.
struct BodyConfig {
  std::string name;
  std::optional<BlankConfig> blank;
  std::optional<MeshConfig> mesh;
  std::optional<FormedConfig> formed;
  std::vector<TrimConfig> trim;
  std::vector<std::string> imperfection;
  std::string pressure_average = "cell";
  MaterialConfig material;
  bool self_contact = false;
  std::vector<SetConfig> sets;
  Vec3 initial_velocity = Vec3::Zero();
  Vec3 initial_spin_deg_s = Vec3::Zero();
  Vec3 spin_centre = Vec3::Zero();
  std::vector<std::string> initial_velocity_field;
  std::vector<BoundaryConfig> boundaries;
  std::vector<PressureConfig> pressures;
  std::vector<LoadConfig> loads;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(name), Field().required().doc("name of the body"));
    visit(FORMING_SIM_FIELD(blank), Field().doc("a body that is meshed here. Give blank, mesh or formed"));
    visit(FORMING_SIM_FIELD(mesh), Field().doc("a body from a volume mesh; its physical groups become sets: by their names, group_TAG without one, and NAME_curve, NAME_surface and so on where groups of several dimensions have one name"));
    visit(FORMING_SIM_FIELD(formed), Field().doc("a part as an earlier run has left it: its shape, its stresses and what has flowed, at rest; its material and pressure_average are those of then, its sets are kept"));
    visit(FORMING_SIM_FIELD(trim), Field().doc("what is cut away before the run: the cells whose middle lies in one of these regions; the edge follows the mesh"));
    visit(FORMING_SIM_FIELD(imperfection), Field().unit("m").doc("how far the nodes stand from where the mesh puts them, free of stress: what a sheet or column buckles by, which never does so while it is perfect. A formula for each coordinate (two in a scene of dimension 2), of the place x, y, z in m that the mesh gives and pi, in the language of muParser. Sets and trims are chosen before; probes, velocities and thickness count from the shape with it. Not of a formed part"));
    visit(FORMING_SIM_FIELD(pressure_average), Field().choices({"cell", "node", "element"}).doc("over what the pressure is averaged: cell: one per quadrilateral or hexahedron, and in free triangles and tetrahedra as node; node: one per node, everything else once an edge; element: no average (locks in plastic flow)"));
    visit(FORMING_SIM_FIELD(material), Field().required().doc("what the body is made of"));
    visit(FORMING_SIM_FIELD(self_contact), Field().doc("true: the body meets itself where it folds; contact of bodies with each other is always on"));
    visit(FORMING_SIM_FIELD(sets), Field().doc("named sets of nodes, beside those of the mesh"));
    visit(FORMING_SIM_FIELD(initial_velocity), Field().unit("m/s").doc("uniform initial velocity"));
    visit(FORMING_SIM_FIELD(initial_spin_deg_s), Field().unit("deg/s").doc("initial angular velocity, added to the uniform velocity"));
    visit(FORMING_SIM_FIELD(spin_centre), Field().unit("m").doc("point about which the body spins"));
    visit(FORMING_SIM_FIELD(initial_velocity_field), Field().unit("m/s").doc("initial velocity that differs from place to place, added to the uniform velocity and the spin: a formula for each coordinate (two in a scene of dimension 2), of the initial position x, y, z in m and pi, in the language of muParser"));
    visit(FORMING_SIM_FIELD(boundaries), Field().doc("what holds or drives sets of nodes"));
    visit(FORMING_SIM_FIELD(pressures), Field().doc("pressures on its surface"));
    visit(FORMING_SIM_FIELD(loads), Field().doc("tractions and forces that keep their direction"));
  }
};

struct Scene {
  std::string name;
  int dimension = 0;
  bool axisymmetric = false;
  std::vector<BodyConfig> bodies;
  std::vector<ToolConfig> tools;
  Vec3 gravity = Vec3::Zero();
  ContactConfig contact;
  TimeStepConfig time_step;
  std::vector<StageConfig> stages;
  OutputConfig output;

  /// Directory that relative file names refer to; set by whoever read the
  /// scene, not by the user.
  std::string base_directory = ".";
  /// The text the scene was read from, kept in result.h5.
  std::string text;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(name), Field().required().doc("name of the scene"));
    visit(FORMING_SIM_FIELD(dimension), Field().at_least(2).at_most(3).required().doc("2: a section in x-y, in plane strain (forces per metre of width) unless axisymmetric; 3: solid"));
    visit(FORMING_SIM_FIELD(axisymmetric), Field().doc("true, in dimension 2: the section at x >= 0 is turned about the axis y; x is the radius, forces, masses and energies are those of the whole circle, N, kg, J"));
    visit(FORMING_SIM_FIELD(bodies), Field().required().doc("deformable bodies"));
    visit(FORMING_SIM_FIELD(tools), Field().doc("rigid tools"));
    visit(FORMING_SIM_FIELD(gravity), Field().unit("m/s2").doc("acceleration of gravity"));
    visit(FORMING_SIM_FIELD(contact), Field().doc("parameters of the mild contact; they are chosen from the mesh and the material"));
    visit(FORMING_SIM_FIELD(time_step), Field().doc("time step, viscosity, damping, mass scaling"));
    visit(FORMING_SIM_FIELD(stages), Field().required().doc("what happens, one stage after the other; times of motions and loads count from the start of the run, or of the stage that their since names"));
    visit(FORMING_SIM_FIELD(output), Field().doc("what is written"));
  }
};

}  // namespace forming_sim
