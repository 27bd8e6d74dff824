#pragma once
// What a user says of meshes: generated blanks, meshes from files or inline,
// named sets, and 2D profiles of tools.
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/config/field.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// A blank that the package meshes itself.
struct BlankConfig {
  std::string shape;            ///< strip (2D) | plate (3D) | bar (3D) | tube (3D)
  Vec3 origin = Vec3::Zero();   ///< strip, plate: least corner; bar, tube: centre of the end face
  double length = 0;            ///< along x (strip, plate) or along z (bar, tube)
  double width = 0;             ///< plate: along y
  double thickness = 0;         ///< strip: along y; plate: along z; tube: of its wall
  double radius = 0;            ///< bar, tube: outside
  std::string portion = "full"; ///< bar, tube: full | half (x >= 0) | quarter (x, y >= 0)
  int cells_along = 0, cells_across = 0, cells_through = 0, cells_radius = 0, cells_around = 0;
  std::string pattern = "fine"; ///< fine: 4 crossed triangles | 24 tetrahedra; coarse: 2 triangles | 6 tetrahedra; one_point

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(shape), Field().required().choices({"strip", "plate", "bar", "tube"})
          .doc("strip: rectangle in dimension 2, length along x, thickness along y; plate: box, length along x, width along y, thickness along z; bar: round bar along z from its end face, O-grid; tube: round tube along z from its end face"));
    visit(FORMING_SIM_FIELD(origin), Field().unit("m").doc("least corner of a strip or plate; centre of the lower end face of a bar or tube"));
    visit(FORMING_SIM_FIELD(length), Field().unit("m").above(0).required().doc("length along x (strip, plate) or z (bar, tube)"));
    visit(FORMING_SIM_FIELD(width), Field().unit("m").above(0).required().when("shape", {"plate"}).doc("width along y"));
    visit(FORMING_SIM_FIELD(thickness), Field().unit("m").above(0).required().when("shape", {"strip", "plate", "tube"}).doc("thickness along y (strip) or z (plate), or of the wall (tube)"));
    visit(FORMING_SIM_FIELD(radius), Field().unit("m").above(0).required().when("shape", {"bar", "tube"}).doc("radius of the bar, or of the tube outside"));
    visit(FORMING_SIM_FIELD(portion), Field().choices({"full", "half", "quarter"}).when("shape", {"bar", "tube"}).doc("full bar or tube, half (x >= 0) or quarter (x >= 0, y >= 0); cut faces are the sets symmetry_x and symmetry_y"));
    visit(FORMING_SIM_FIELD(cells_along), Field().at_least(1).at_most(1e6).required().doc("cells along the length"));
    visit(FORMING_SIM_FIELD(cells_across), Field().at_least(1).at_most(1e6).required().when("shape", {"plate"}).doc("cells along the width"));
    visit(FORMING_SIM_FIELD(cells_through), Field().at_least(1).at_most(1e6).required().when("shape", {"strip", "plate", "tube"}).doc("cells through the thickness"));
    visit(FORMING_SIM_FIELD(cells_radius), Field().at_least(2).at_most(1e4).required().when("shape", {"bar"}).doc("cells along a radius; the section is a polygon with its corners on the circle: 2.6 % less area at 4, .6 % at 8, .2 % at 12"));
    visit(FORMING_SIM_FIELD(cells_around), Field().at_least(3).at_most(1e6).required().when("shape", {"tube"}).doc("cells around the whole circle, also of a half (then a multiple of 2) or quarter (of 4); nodes lie on the circles: .6 % less area at 32, .16 % at 64"));
    visit(FORMING_SIM_FIELD(pattern), Field().choices({"fine", "coarse", "one_point"}).doc("how a cell is split: fine: 4 crossed triangles or 24 tetrahedra; coarse: 2 triangles or 6 tetrahedra; the pressure is one per cell; one_point: not at all, one quadrilateral or hexahedron with one point, the cheapest for sheets, also of cells several times longer than thick"));
  }
};

/// A mesh from a file, or inline as points and cells.
struct MeshConfig {
  std::string url;
  double unit_scale = 0;
  std::string group;            ///< physical group to take; empty: all cells
  std::vector<Vec3> points;     ///< inline
  std::vector<int> cells;       ///< inline: corner indices, cell after cell
  std::string cell_type;        ///< inline: triangle | quadrilateral | tetrahedron | hexahedron | wedge | pyramid
  std::string pattern = "fine"; ///< of a body's quadrilaterals and hexahedra: fine | one_point

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(url), Field().doc("file path (relative to the scene file), file:// or package:// URL: .msh for a body; .stl .obj .ply .dae for a tool. Give url or points, not both"));
    visit(FORMING_SIM_FIELD(unit_scale), Field().unit("m").above(0).at_most(1e3).required().doc("metres per unit of the file: 0.001 for a file in millimetres; inline points too"));
    visit(FORMING_SIM_FIELD(group), Field().doc("physical group of the .msh to take as the body; empty: every cell of the highest dimension"));
    visit(FORMING_SIM_FIELD(points), Field().doc("inline mesh: nodes"));
    visit(FORMING_SIM_FIELD(cells), Field().at_least(0).doc("inline mesh: corner indices from 0, cell after cell"));
    visit(FORMING_SIM_FIELD(cell_type), Field().choices({"", "triangle", "quadrilateral", "tetrahedron", "hexahedron", "wedge", "pyramid"}).doc("inline mesh: kind of its cells, a wedge being three corners and three above them, a pyramid four and one above them; a tool takes triangles"));
    visit(FORMING_SIM_FIELD(pattern), Field().choices({"fine", "one_point"}).doc("what becomes of a body's quadrilaterals and hexahedra: fine: 4 crossed triangles or 24 tetrahedra each; one_point: one element with one point each, the cheapest for sheets. Wedges (prisms) and pyramids become 14 and 8 tetrahedra each, which do not fit beside whole hexahedra; triangles and tetrahedra stay as they are"));
  }
};

/// Where something of a body is: a plane, a box, a cylinder or a sphere.
struct PlaceConfig {
  std::string choose;           ///< plane | box | cylinder | sphere
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();
  Vec3 axis = Vec3::Zero();     ///< of a cylinder; zero: z
  double radius = 0;
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();

  /// What `choose` and `normal` mean is told by whose place it is.
  template <class Visitor> static void declare_place(Visitor& visit, const char* choosing, const char* which_normal) {
    visit(FORMING_SIM_FIELD(choose), Field().required().choices({"plane", "box", "cylinder", "sphere"}).doc(choosing));
    visit(FORMING_SIM_FIELD(point), Field().unit("m").when("choose", {"plane", "cylinder", "sphere"}).doc("a point of the plane or of the cylinder's axis, the sphere's centre"));
    visit(FORMING_SIM_FIELD(normal), Field().when("choose", {"plane"}).required().doc(which_normal));
    visit(FORMING_SIM_FIELD(axis), Field().when("choose", {"cylinder"}).computed("[0, 0, 1]").doc("direction of the cylinder's axis, any length; in dimension 2 it is z"));
    visit(FORMING_SIM_FIELD(radius), Field().unit("m").above(0).required().when("choose", {"cylinder", "sphere"}).doc("radius of the cylinder or sphere"));
    visit(FORMING_SIM_FIELD(min), Field().unit("m").when("choose", {"box"}).doc("least corner of the box"));
    visit(FORMING_SIM_FIELD(max), Field().unit("m").when("choose", {"box"}).doc("greatest corner of the box; in dimension 2 z is ignored"));
  }
};

/// A named set of a body's nodes, chosen by where they are.
struct SetConfig : PlaceConfig {
  std::string name;
  double tolerance = 0;
  bool surface_only = false;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(name), Field().required().doc("name by which boundaries, loads and probes refer to the set"));
    declare_place(visit, "plane: nodes on a plane; box: nodes inside an axis-parallel box; cylinder, sphere: nodes on one, in dimension 2 on a circle, and centres of faces of hexahedra, wedges and pyramids whose corners are (initial positions)",
                  "normal of the plane, any length but zero");
    visit(FORMING_SIM_FIELD(tolerance), Field().unit("m").at_least(0).computed("1e-6 of the body's size").doc("distance up to which a node counts as on the surface or in the box"));
    visit(FORMING_SIM_FIELD(surface_only), Field().doc("take only nodes on the body's surface"));
  }
};

/// What is cut away from a body: the cells whose middle lies in a region.
struct TrimConfig : PlaceConfig {
  bool outside = false;

  template <class Visitor> static void declare(Visitor&& visit) {
    declare_place(visit, "plane: cut away what lies on the side to which its normal points; box, cylinder (in dimension 2 a circle), sphere: what lies inside",
                  "normal of the plane, any length but zero: towards what is cut away");
    visit(FORMING_SIM_FIELD(outside), Field().when("choose", {"box", "cylinder", "sphere"}).doc("true: cut away what lies outside, and keep what lies inside"));
  }
};

/// A part as an earlier run left it.
struct FormedConfig {
  std::string url;
  std::string body;
  Vec3 turn_deg = Vec3::Zero(), turn_centre = Vec3::Zero(), shift = Vec3::Zero();

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(url), Field().required().doc("file path (relative to the scene file), file:// or package:// URL of the formed.h5 of a run with output.formed"));
    visit(FORMING_SIM_FIELD(body), Field().computed("the body of the same name, or the only one").doc("which of its bodies"));
    visit(FORMING_SIM_FIELD(turn_deg), Field().unit("deg").doc("the part is turned by this rotation vector before anything else, as it is put into the next tool; its stresses turn with it. Not in axisymmetric scenes, where a section stays beside its axis: turn the tools over instead"));
    visit(FORMING_SIM_FIELD(turn_centre), Field().unit("m").doc("the point that this turn leaves where it is"));
    visit(FORMING_SIM_FIELD(shift), Field().unit("m").doc("then the part is shifted by this"));
  }
};

/// One piece of a 2D profile.
struct ProfilePieceConfig {
  Vec3 to = Vec3::Zero();
  double radius = 0;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(to), Field().unit("m").required().may_be_zero().doc("end point of the piece"));
    visit(FORMING_SIM_FIELD(radius), Field().unit("m").doc("0: straight line; otherwise the arc of at most 180 degrees with this radius, positive: turning left (counter-clockwise) on the way, negative: turning right"));
  }
};

/// The section of a tool: lines and arcs, in z = 0; in dimension 3 in y = 0, and swept.
struct ProfileConfig {
  Vec3 start = Vec3::Zero();
  std::vector<ProfilePieceConfig> pieces;
  bool closed = false;
  std::string sweep;            ///< dimension 3: turned | straight
  double width = 0;             ///< straight
  double chord_error = 0;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(start), Field().unit("m").doc("first point"));
    visit(FORMING_SIM_FIELD(pieces), Field().required().doc("lines and arcs, one after the other"));
    visit(FORMING_SIM_FIELD(closed), Field().doc("join the last point to the first by a line"));
    visit(FORMING_SIM_FIELD(sweep), Field().choices({"", "turned", "straight"}).doc("dimension 3: how the section, given in y = 0 as points [x, 0, z], becomes a surface: turned: about the axis z, a punch or a ring; straight: along y, a bar or a roll, with open ends"));
    visit(FORMING_SIM_FIELD(width), Field().unit("m").above(0).required().when("sweep", {"straight"}).doc("extent along y, from -width/2 to width/2; wider than what meets it: its ends are open"));
    visit(FORMING_SIM_FIELD(chord_error), Field().unit("m").at_least(0).computed("1e-3 of the arc's radius, and no segment longer than two edges of the bodies' surfaces, in the mean of the finest body, nor, of a tool with an axle that is not turned, than 3e-3 of its radius").doc("largest distance of an arc, and of the largest circle of a turned section, from the segments that stand for it"));
  }
};

}  // namespace forming_sim
