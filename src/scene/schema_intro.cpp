#include "schema_intro.h"

namespace forming_sim {

std::string schema_intro() {
  return R"(# Writing a scene

This page is printed by `forming_offline --schema markdown`, from the same declarations that check a scene.

A scene is one YAML file that says all there is to a run: the deformable bodies, the rigid tools and how they move,
the stages, and what is to be seen of it. Every key is a field of the tables below; anything else is refused, and all
faults of a scene are told at once, each with its field, its line, what was given and what would be right.

```
forming_offline --validate my_scene.yaml            # all faults; exit code 0 if there is none; notes on what is taken but looks odd
forming_offline --estimate my_scene.yaml            # elements, time step, steps, wall time, memory
forming_offline --plan my_scene.yaml                # what a step does and keeps, and what is not there
forming_offline my_scene.yaml --output my_run       # the run and its files
```

A scene is also the goal of the action `simulate_forming`: the message has the same field names (in Python `springback.from` is `from_`). A message cannot
leave a field out: there 0, "" and [] mean "not given", and the default holds.

## Units, coordinates, dimensions

- SI units throughout: m, s, kg, N, Pa, J. Angles are in degrees where a name ends in `_deg`. Only a mesh file has a
  unit of its own, and `unit_scale` says it: 0.001 for a file in millimetres. A scale that makes a body or tool larger
  than 100 m or smaller than 1e-6 m, or a tool 200 times larger than the bodies or smaller than their elements, is refused.
- Right-handed coordinates x, y, z. Vectors are written `[x, y, z]`; `[x, y]` means z = 0.
- `dimension: 2` is plane strain: everything lies in the x-y plane and nothing strains along z. Forces, masses and
  energies are then per metre of width (N/m, kg/m, J/m). Vectors have z = 0, and things turn about z only.
- `dimension: 2` with `axisymmetric: true` turns that section about the axis y: x is the radius, so that bodies and
  profiles lie at x >= 0. Forces, masses and energies are those of the whole circle (N, kg, J). What lies on the axis
  stays on it without being told; a set of nodes on the axis carries no pressure and no traction. Tools, gravity and a uniform initial velocity
  go along y. Of the force on a tool what goes along the axis is its force; what presses outward holds itself in balance, and is told as its `radial_force`, summed around the circle.
- `dimension: 3` is a solid of hexahedra (each of 24 or 6 tetrahedra, or of one point), of wedges (of 14 tetrahedra), pyramids (of 8) or free tetrahedra, also side by side.
- Relative file names refer to the directory of the scene file; `package://NAME/PATH` and `file://` URLs are understood.
- Names of bodies, tools, stages, probes and sets are of letters, digits, `_`, `-` and `.`; a tool has another name than a body.
- What is said twice can be said once: keys that begin with `x-` at the top of a scene are free, for groups of fields with an
  anchor (`x-steel: &steel {density: 7850, ...}`), which `material: *steel` or `<<: *steel` take; fields beside `<<` win over its.

## Bodies and their sets

A body is a blank that is meshed here, or a volume mesh (`.msh` of gmsh, or points and cells inline). Boundaries,
pressures, loads and probes name sets of its nodes:

| body | sets |
|---|---|
| `strip` (dimension 2) | `left`, `right` (least and greatest x), `bottom`, `top` (least and greatest y) |
| `plate` | `left`, `right` (x), `front`, `back` (y), `bottom`, `top` (z) |
| `bar` | `bottom`, `top` (least and greatest z), `side`; `symmetry_x` (x = 0; half and quarter), `symmetry_y` (y = 0; quarter) |
| `tube` | `start`, `end` (least and greatest z), `inside`, `outside`; `symmetry_x`, `symmetry_y` as a bar |
| `.msh` file | its physical groups by their names |

A rolled sheet yields by the direction: `anisotropy` takes its r values (Hill's yield stress of 1948), the rolling direction and the normal of the sheet,
which turn with the sheet as it is formed. The hardening curve is that of tension along the rolling direction. In a section both directions
lie in the plane or along z.

Metal does not part here, however far it is strained: to blank or to pierce a sheet, cut its cells away between two operations (`trim`). How near to a
crack it has come tells `damage`: the integral of Cockcroft and Latham, as it is or normalized, or that of Rice and Tracey, of each element along its way,
through all operations; with the `critical` value of the metal a run says when and where it was reached. It is asked for from the first operation on: what is not summed there is not known later.

How near a sheet has come to necking tells `forming_limit`: its limit curve as two lists of true strains, `minor_strains` and `major_strains`. The strains of the middle
between the two sides of the sheet are compared with it, from when it was flat, through all operations: bending alone comes to no limit. A run that goes beyond the curve says when and where.
The limit is that of straight paths of strain, as curves are measured; where a sheet is strained in one direction and then in another it may neck before or after. A neck is a
thing of the thickness and of the mesh: what comes after the limit is the forming of a sheet that holds.

A fast flow raises the yield stress with `rate_dependence`: after Cowper and Symonds, Johnson and Cook, or a power of the plastic strain rate. A scene whose tools
move faster than in the press, to take fewer steps, says how many times with `speed_up`.

More sets are chosen by a plane, a box, a cylinder or a sphere under `sets`. In a mesh file, name two sets `bottom` and `top`, or of a tube `inside` and `outside`, to have the
thickness of the sheet and its thinning in the results.

A boundary of kind `velocity` moves a set as a rigid body would: with `velocities`, about a `centre` with `spins_deg_s`, or
both, and only along its `axes`. A bar is twisted by an end with `spins_deg_s: [[0, 0, w], ...]` and `axes: [x, y]`, so
that it may get longer or shorter; a sheet is bent by turning an end section. One of kind `trajectory` goes to places and orientations at given times instead, as the
gripper of a robot does. `until` names the stage with which a boundary
lets go, `since` that with which it takes hold: what was clamped in forming springs back when it is cut free. What boundaries push with is in
`history.csv`, where a probe is on their set.

A pressure follows the surface and stays normal to it. A load (`loads`) keeps its direction: a `traction` acts on the faces of a set, per area that they
had at the start, as the nominal stress of a tensile test does; a `force` is given for the whole set, and may act on an edge or a single node. With
either, what no longer bears its load flies away: a body past its greatest load is better pulled by a `velocity`.

## Tools

A tool is rigid. It is a surface mesh (dimension 3), a profile of lines and arcs (the material of the tool
lies to the left of the way along the profile; arcs become segments, fine enough for the cells of the bodies unless `chord_error` says otherwise), or a plane given by `point` and `normal`, the normal towards the body.
In dimension 3 a profile lies in the x-z plane, looked at along y with z upwards, and is turned about the axis z or goes straight along y:

```yaml
  - name: punch                                      # of radius 20 mm, its edge 4 mm
    position: [0, 0, 0.001]                          # where the origin of the profile is put
    profile:
      sweep: turned
      start: [0, 0, 0]
      pieces:
        - {to: [0.016, 0, 0]}
        - {to: [0.020, 0, 0.004], radius: 0.004}
        - {to: [0.020, 0, 0.030]}
  - name: roll                                       # of radius 50 mm, along y, 200 mm wide
    position: [0.1, 0, 0.051]
    profile:
      sweep: straight
      width: 0.2
      start: [0.05, 0, 0]
      pieces:
        - {to: [-0.05, 0, 0], radius: 0.05}
        - {to: [0.05, 0, 0], radius: 0.05}
```

Tools that stand flush side by side, as the parts of a divided die, are one to what slides over their joint, as long as they stand so. A tool that touches a body at the start is backed off by what the contact layer needs, and the run says by how much; a
body that starts inside a tool is refused. A tool with an `approach` is put where it first touches the bodies (or a `gap` before that) when it comes from
far away along a line, wherever its position is on that: `approach: {along: [0, 0, -1]}` lays a holder or a punch on a sheet, or on a formed part whose height nobody knows, and strokes count from there.
A tool that is needed again when it has been withdrawn is listed twice, the second time under another name, out of the way and with `since` in its motion. The motion of a tool is a trajectory (where it is at given times, from
where it stands at the start), a velocity, or a force, and with an `axle` it turns freely beside that. Without a motion it rests. A press
that stops under its force has a way and a `stop_force`.

A tool of kind `force` is a blank holder: guided along the line of its force (or a `guide`), it goes where the force and the bodies push it,
and yields as a flange thickens. Its force is all that acts on it: gravity does not. How fast it goes is found together with the forces of
contact, so that it may be light, down to a thousandth of the mass of the bodies (what is lighter is refused);
a light one follows at once, a heavy one takes time to start and to stop, and on a sheet that slides it may begin to swing (the run tells it, and the `damping` that ends it). Let the force rise smoothly, and lay the holder on the blank:
what falls on it rattles. It goes on where the sheet has left it, and strikes what is in its way: a holder of a cup that is drawn through stands on spacers,
`stop_ahead` of its motion, a little less below its place than the sheet is thick. A set that is held rigidly does not stop it, but ends the run: keep it off what is clamped.
With an `initial_velocity` and its own `mass` it is a hammer: what it has lost when it flies back went into the bodies, as `work`. Its weight is one of its forces.
Its place is in `history.csv`. A `withdraw` stage takes it away like any other tool, from rest where it has come to.
On a spring (`stiffness`) it pushes the more the farther it is pushed back, as a gas spring does: `{kind: force, times: [0], forces: [[0, 0, 2e3]], stiffness: 5e4}` is 2 kN
at the start and 50 N more a millimetre. `positions` or `velocities` along the guide take the other end of the spring along: a tool that is driven, but yields.
A robot that presses a roll on an edge and drives it along is one too: its `forces` go along one line, and its `positions` and `rotations_deg`, or `velocities` and
`spins_deg_s`, take it across that:

```yaml
  - name: roll                                       # pressed down with 800 N, driven along x with .5 m/s, idle about its axle
    profile: {sweep: straight, width: 0.01, start: [0.015, 0, 0], pieces: [{to: [-0.015, 0, 0], radius: 0.015}, {to: [0.015, 0, 0], radius: 0.015}]}
    position: [0, 0, 0.016]
    motion: {kind: force, times: [0, 0.002, 0.1], forces: [[0, 0, 0], [0, 0, -800], [0, 0, -800]], mass: 0.2, damping: 2000,
             velocities: [[0, 0, 0], [0.5, 0, 0], [0.5, 0, 0]], centre: [0, 0, 0.016], axle: [0, 1, 0], inertia: 1e-5}
```

A tool with an `axle` is an idle roll: it turns about that as friction and its `torques` make it, and goes where the rest of its motion
takes it, axle and all, round curves and leaning too, also while it is withdrawn; what of that is about the axle itself does not turn it. Its `spin_damping` brakes it, `damping` the tool along its guide. In a `settle` stage it comes to rest with what it presses on, as a holder does. A roll of a mill turns at `spins_deg_s` instead, pressed on by a force if its `kind` is `force`. How far an idle roll has
turned is in `history.csv`, the torque on a driven one there as its moment. A heavy one takes long to settle: friction releases it slowly (`kinetic_fraction`):

```yaml
tools:
  - name: idler                                      # in the plane x, z of a strip that runs along x
    profile: {sweep: straight, width: 0.2, start: [0.02, 0, 0], pieces: [{to: [-0.02, 0, 0], radius: 0.02}, {to: [0.02, 0, 0], radius: 0.02}]}
    position: [0.1, 0, 0.021]
    friction: 0.1
    motion: {kind: velocity, times: [0], centre: [0.1, 0, 0.021], axle: [0, 1, 0], inertia: 1e-3}
```

## Stages

A run is a list of stages. Motions, boundaries, pressures and loads begin with the run, and their times count from its start; with `since: STAGE` they begin with that
stage, whenever that is, and their times count from there. Until then a tool stands still, a boundary holds nothing, and a pressure or a load is none.

- `form` runs for `duration`, or until a tool has stopped (`until_stopped`).
- `withdraw` moves tools away from where they stand by `displacement`, smoothly, in `duration`; then they are gone.
  Without a displacement they are gone at once; they let go of what they squeezed the bodies by, and what then holds these fades in `release_time`, as does what a boundary
  with `until` held: what lets go of a sheet in one step (`release: sudden`) makes it flow anew as it springs back.
- `settle` takes motion out of the bodies until the kinetic energy of each stays below `kinetic_fraction` of its elastic one:
  springback. Tools that forces drive and that press on them rest with them, and it does not end while a motion, a pressure or a load is between two of its
  times (in the last stage also where these are still to come). It ends at `limit` at the latest, and the result then says so. Forces come to rest as the root of it: with
  the default of 1e-5 to some .3 %, of a sheet that sags by its own weight .1 %; who reads a static force from the end of a run gives 1e-8 (.004 % of that sheet).
  What comes after it is given with `since`; `ends: limit` makes it as long as its limit.

Slow processes are simulated faster than they are: give the tools speeds of some m/s, or scale the mass, and judge
what it costs by kinetic over internal energy in `summary.json`, which should stay below a few percent.

## Several operations

Operations that follow each other in one tool are stages of one scene. Where a part goes into another tool or is trimmed on the way, a scene with
`output: {formed: true}` leaves its bodies in `formed.h5` when it has come to its end, and the next one takes them from there:

```yaml
bodies:
  - name: blank
    formed: {url: cup/formed.h5}                     # shape, stresses, plastic strain, memory of the blank
    trim:                                            # cells whose middle lies there are cut away
      - {choose: plane, point: [24e-3, 0, 0], normal: [1, 0, 0]}
    material: ...                                    # the one that it was formed of
```

Elements, layers and sets go on as they are, at rest; `turn_deg` and `shift` put the part as it goes into the next tool, with its
stresses. Thickness, thinning and surface strain count from the blank, displacements, energies and plastic work from the start of the scene;
sets, boundaries, probes and cuts are chosen where the part stands. What a cut sets free comes to rest in a `settle` stage: the springback of trimming. A cut
goes along cells, so that a mesh with an edge where the trim line will be cuts cleanest. Let the tools go and the part settle before it is
kept: what still holds it would be gone at once. `trim` cuts blanks and meshes too.

## What a run writes

Into the directory of `--output`:

| file | content |
|---|---|
| `result.h5` | the mesh once, and the fields of every frame, with units as attributes and the text of the scene; readable up to the last complete frame, whatever ends the run |
| `result.xdmf`, `surface.xdmf` | open `result.h5` in ParaView and VTK: bodies and tools; the surface of the bodies with its strains, and tools |
| `history.csv` | a row per `history_interval`: time, energies, for every tool its force, place, moment about its place and, if it has an axle, how far it has turned about that, extremes, and for every probe its position, velocity and mean stress (xx yy zz xy yz zx), where boundaries hold or drive it the force and moment that they push with; the first line names the columns, with units |
| `summary.json` | the result in figures |
| `formed.h5` | with `output.formed`: the bodies as the run leaves them, for a next scene |

A checkpoint is written when a run is cancelled, and every `checkpoint_interval` if that is given;
`forming_offline SCENE --output DIR --resume CHECKPOINT` goes on from there to the same numbers as an unbroken run.

Keys of `summary.json` (in plane strain forces, masses and energies are per metre of width):

| key | meaning |
|---|---|
| `status` | `code`, its `name` and `message`: how the run ended |
| `faults` | of a scene that was refused: all of them, `field`, `given`, `remedy`; `status` has the code of the first |
| `version`, `scene`, `dimension`, `axisymmetric`, `per_metre_of_width`, `nodes`, `cells`, `elements`, `steps` | what was run; elements are the triangles or tetrahedra of `result.h5`, also those that a one-point cell is shown as |
| `sim_time_s`, `wall_time_s`, `output_time_s`, `ns_per_element_step` | simulated time (`resumed_at_s`: where the last part of a resumed run began), time that the solver took, time that measuring and writing took beside it, speed; a one-point cell counts as one element there |
| `time_step_s` | `first`, `min`, `limited_by` |
| `energy_J` | `kinetic` (of a swing as fast as the mesh bears less than half of mass times speed squared: what its steps keep), `elastic`, `plastic`, `contact`, `friction`, `damping`, `work`, `initial` (of a formed part with its elastic energy); `balance_error`: the residual of the ledger over the largest work + initial (and no less than the energy of a strain of 1e-11, far from the origin of what rounding of the places makes), a fraction; where it is above .05 at the end of a stage, `warnings` say so; `kinetic_over_internal_forming`: the largest of kinetic over elastic and plastic energy in the form stages, a guard for mass scaling and tool speed: a few percent are good; a body that moves as a whole counts too, and where nothing resists it for long the ratio says little |
| `options` | what viscosity, damping, settling and mass scaling took or added; `time_step`: the limit and its cost; `raised_step`: mass added by `time_step.raise_to`, in kg, as a fraction, by body, and where most |
| `contact` | `crossings` (must be 0), `halvings`, `min_gap_over_h0`, `h0_m`; `sweeps_per_step`: what finding the forces took, of the steps in which anything is near, and `share_at_max_sweeps`, the fraction of these steps that ended at `contact.max_sweeps`, with forces that still changed (by how much in all: `docs/contact.md`, patch); with `contact.method: explicit` `explicit_stable_dt_s`, the smallest step up to which its layer was stable |
| `plastic_strain` | the largest equivalent plastic strain and where it is |
| `damage` | of each body whose material has it the criterion, its unit, the largest of its elements at the end with its place, and the `critical` value |
| `forming_limit` | of each body whose material has one the largest ratio of the strains of its middle to the curve over the rows of the history, where and when, `at_end`, and the part of the sheet `beyond` it at the end |
| `surface_strain` | the largest principal logarithmic strain on the surface; faces in planes of symmetry are none. Rubber (`law: hyperelastic`) counts only where there is nothing else, here and in the next two |
| `thickness_m` | `initial` and `min`: distance of the nodes of the set `top` from the surface `bottom`, of a tube of `outside` from `inside`, of a strip that is twice as high as long (no bar about the axis) of `right` from `left` |
| `thinning` | the largest 1 - t/t0 of a node of `top` (or of the other outer side, see `thickness_m`), t its thickness, t0 that of the start, of a formed part that of its blank; where and when it is |
| `bodies` | for each body: name, mass (that of the solver, with what `mass_scaling` and `raise_to` add), centre, momentum, angular momentum about the origin, `bounding_box` (`min`, `max`) |
| `tools` | for each tool: name and the vector of its peak force (axisymmetric: along the axis, and `peak_radial_force` outward, summed around the circle), of means over some 50 steps: shorter peaks are in `history.csv`, as means from row to row; their `unit`; `peak_moment` likewise, about the place of the tool at that time (in its `moment_unit`; null in an axisymmetric scene); `turned_deg`, of a tool with an axle, about that; `position` and `orientation_xyzw` (a quaternion) at the end, whether it is `present` then, and `stopped_s`, when it stopped under its `stop_force` |
| `springback` | `angle_deg_formed` (at the end of the last form stage; in a scene without one at the start, as the part comes), `angle_deg_released`, `change_deg`, `probe`, `kinetic_over_internal` |
| `stages` | for each stage that has ended: name, kind, when, and the energies then |
| `warnings` | what was odd in the scene or happened on the way, in sentences |
)";
}

std::string small_example_words() {
  return "A strip of metal is stretched in plane strain to beyond yield. Only what has no default is said.\n";
}

std::string flange_example_words() {
  return "A sheet lies on a die, is held, and is folded over the die's edge by a punch; then the tools are withdrawn and the sheet\n"
         "springs back. The angle of its leg is reported as formed and as released.\n";
}

std::string fields_words() {
  return R"(## All fields

`[]` in a heading marks a list: `bodies[].material` is the group `material` of every entry of `bodies`. A field that
applies only under a condition is a fault elsewhere; what is required is required where it applies.
)";
}

}  // namespace forming_sim
