// Meshes of bodies that are taken, and told because they do not do what their author expects of them.
#include <algorithm>
#include <cmath>

#include "forming_sim/config/words.h"
#include "forming_sim/element/sheet_sides.h"
#include "forming_sim/loads/boundary.h"
#include "forming_sim/mesh/generate.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/mesh/seams.h"
#include "geometry.h"

namespace forming_sim {

namespace {

/// A strip of crossed triangles whose own bending is too soft (docs/elements.md): of cells higher than long, and about the axis of a ring.
/// The own bending of n cells through a sheet is 1/n^2 of the whole.
void note_soft_strip(const BodyConfig& config, const Mesh& mesh, Model& model) {
  constexpr double kHigh = 1.2;      // times as high as long
  constexpr double kSheet = 4;       // times as long as thick
  constexpr double kToBeTold = 0.06; // of the stiffness
  if (!config.blank || config.blank->shape != "strip" || config.blank->pattern != "fine") return;
  const BlankConfig& blank = *config.blank;
  if (!(blank.length > kSheet * blank.thickness)) return;
  const double n = blank.cells_through, high = blank.thickness / n * blank.cells_along / blank.length;
  const bool at_axis = model.axisymmetric && bounds(mesh).min().x() < blank.thickness;
  const double lost = (at_axis ? 0.9 : high > kHigh ? 0.5 : 0) / (n * n);
  if (lost < kToBeTold) return;
  model.notes.push_back("body " + config.name + " has " + number_text(n) + " cells of crossed triangles through its thickness" +
                        (at_axis ? " and reaches the axis" : ", " + three_digits(high) + " times as high as they are long") + ": it lacks some " + number_text(std::round(100 * lost)) +
                        " % of its stiffness in bending (docs/elements.md); set its pattern to one_point, or give more cells through" + (at_axis ? "" : " or fewer along"));
}

/// A sheet of two triangles a cell: `forming_bench speed-error bending`.
void note_stiff_strip(const BodyConfig& config, Model& model) {
  constexpr double kSheet = 4;  // times as long as thick
  if (!config.blank || config.blank->shape != "strip" || config.blank->pattern != "coarse" || !(config.blank->length > kSheet * config.blank->thickness)) return;
  model.notes.push_back("body " + config.name + " is a sheet of two triangles a cell, which lock in bending: moments are a fifth too large with two cells through the thickness, 6 % with four, and several "
                        "times as wrong where cells are longer than high (docs/elements.md); set its pattern to fine or one_point");
}

/// A bar whose section, a polygon with its corners on the circle, has less area by what counts.
void note_polygonal_bar(const BodyConfig& config, const Mesh& mesh, Model& model) {
  constexpr double kToBeTold = 0.01;
  if (!config.blank || config.blank->shape != "bar" || !config.trim.empty()) return;
  const BlankConfig& bar = *config.blank;
  const double part = 0.25 * quarters_of(bar.portion), lost = 1 - volume(mesh) / (part * M_PI * bar.radius * bar.radius * bar.length);
  if (lost > kToBeTold)
    model.notes.push_back("the section of body " + config.name + " is a polygon with its corners on the circle and has " + three_digits(100 * lost) +
                          " % less area, so that forces are as much too small: give more cells_radius, or a larger radius");
}

/// A sheet of free tetrahedra with hardly more than one of them through its thickness.
void note_coarse_sheet(const BodyConfig& config, const Mesh& mesh, Model& model) {
  constexpr double kCoarse = 0.8;  // edges over the thickness
  constexpr int kFew = 100;        // elements, which are no mesh of a sheet
  const double edge = edge_of_tetrahedra(mesh);
  if (edge == 0 || mesh.simplex_count() < kFew) return;
  const double thickness = thickness_of(mesh, false, cut_facets(mesh, symmetry_planes(config.boundaries, false)));
  if (!(edge > kCoarse * thickness) || !is_sheet(mesh, thickness)) return;
  model.notes.push_back("the tetrahedra of body " + config.name + " have edges " + three_digits(edge / thickness) + " times as long as the body is thick: with one of them through its thickness a sheet bends a fourth too stiffly, "
                        "with two by 4 % (docs/elements.md); give shorter edges, or hexahedra with pattern one_point");
}

/// The classical law keeps its pressure in the simplices, and where these are no parts of cells nothing takes the mean.
void note_classical_simplices(const BodyConfig& config, const Mesh& mesh, Model& model) {
  const auto free = [](const Cells& cells) { return cells.kind == CellKind::triangle || cells.kind == CellKind::tetrahedron; };
  if (config.material.law != "classical" || config.pressure_average == "element" || std::none_of(mesh.cells.begin(), mesh.cells.end(), free)) return;
  model.notes.push_back("the law of body " + config.name + " is classical, which keeps a pressure in every one of its free " + (mesh.dimension == 2 ? "triangles" : "tetrahedra") +
                        ": they lock in plastic flow and bend too stiffly, with forces up to twice as large; give quadrilaterals or hexahedra, or the law green_elastic");
}

/// Lengths in millimetres where the thickness is in metres, say.
void note_long_cells(const BodyConfig& config, Model& model) {
  constexpr double kLong = 50;  // times as long as high
  if (!config.blank || config.blank->shape != "strip") return;
  const BlankConfig& blank = *config.blank;
  const double ratio = blank.length / blank.cells_along / (blank.thickness / blank.cells_through);
  if (ratio > kLong)
    model.notes.push_back("the cells of body " + config.name + " are " + three_digits(ratio) + " times as long as they are high: its length is " + number_text(blank.length) + " m and its thickness " +
                          number_text(blank.thickness) + " m; give both in metres, or more cells_along");
}

/// The wall of a tube, say.
void note_standing_strip(const BodyConfig& config, const BodyModel& body, Model& model) {
  if (!config.blank || config.blank->shape != "strip" || sides_of_sheet(body, model.axisymmetric).first != "left") return;
  model.notes.push_back("body " + config.name + " is a strip " + three_digits(config.blank->thickness / config.blank->length) +
                        " times as thick as it is long: thickness and thinning of the results are those of its wall, between its sets left and right");
}

}  // namespace

void tell_odd_body(const BodyConfig& config, const BodyModel& body, Model& model) {
  const Mesh& mesh = body.mesh;
  if (const int parts = config.self_contact ? 1 : count_parts(mesh); parts > 1)
    model.notes.push_back("body " + config.name + " consists of " + std::to_string(parts) +
                          " parts that share no node, and they pass through each other: set its self_contact to true, or give them as bodies of their own");
  note_soft_strip(config, mesh, model);
  note_stiff_strip(config, model);
  note_polygonal_bar(config, mesh, model);
  note_coarse_sheet(config, mesh, model);
  note_classical_simplices(config, mesh, model);
  constexpr double kFlat = 1.5;
  if (const double flat = flatness(mesh); flat > kFlat)
    model.notes.push_back("the cells of body " + config.name + " are " + three_digits(flat) +
                          " times as long and as wide as they are thick: split into tetrahedra they bend far too stiffly (docs/elements.md); take hexahedra with pattern one_point, or give cells about as thick as long");
  note_long_cells(config, model);
  note_standing_strip(config, body, model);
}

}  // namespace forming_sim
