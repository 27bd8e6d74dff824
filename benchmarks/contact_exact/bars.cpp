// Bars in uniaxial strain hit a rigid plane and each other: pressure rho c_p v for the time that a wave takes there and
// back. A front that is carried by cells of second order is (h^2 L)^(1/3) wide, so that duration and restitution come near
// with the cell to the power 2/3; the bar whose end is held instead shows the same without contact. What contact itself
// takes, the energy of the half cell that it stops, falls with the cell.
#include "support/bars.h"

#include "contact_exact/choice.h"
#include "contact_exact/problems.h"

namespace forming_sim::bench {
namespace {

constexpr int kCells[] = {20, 40, 80, 160};
constexpr double kFront = 0.6, kFirst = 0.85;  ///< orders: what 2/3 and 1 are at least between two meshes

}  // namespace

void bars_problem(Report& report) {
  const std::vector<Sought> sought{{"pressure, Pa", kBarPressure, 0.004}, {"duration, s", kBarDuration, 0.03}, {"restitution", 1, 0.05, kFront}};
  const std::pair<const char*, BarKind> kinds[] = {{"plane strain", BarKind::plane}, {"axisymmetric", BarKind::axisymmetric}, {"3D", BarKind::space}};
  report.begin("bar on plane", "A bar in uniaxial strain hits a plane", sought);
  for (const auto& [name, kind] : kinds)
    for (int cells : kCells) {
      const Impact found = hit_wall(cells, 0.9, {}, kind);
      report.add({name, words("%d along", cells), found.run, {found.pressure, found.duration, found.restitution}, "", double(cells)});
    }
  for (int cells : kCells) {
    const Impact found = hold_end(cells, 0.9);
    report.add({"end held, no contact", words("%d along", cells), found.run, {found.pressure, found.duration, found.restitution}, "", double(cells)});
  }
  report.begin("bar on plane energy", "A bar in uniaxial strain hits a plane: what contact takes", {{"energy / at the start", 0, 0.02, kFirst}});
  for (const auto& [name, kind] : kinds)
    for (int cells : kCells) {
      const Impact found = hit_wall(cells, 0.9, {}, kind);
      report.add({name, words("%d along", cells), found.run, {found.taken}, "", double(cells)});
    }
  report.begin("bar on bar", "Two bars in uniaxial strain meet", sought);
  for (double other : {1., 1.15, 2.})
    for (int cells : kCells) {
      const Meeting found = hit_each_other(cells, static_cast<int>(std::lround(other * cells)));
      report.add({words("cells of the other 1/%g", other), words("%d along", cells), found.run, {found.pressure, found.duration, found.restitution}, "", double(cells)});
    }
  report.begin("bar on plane by layer", "A bar in uniaxial strain hits a plane: layer and its modulus", {{"pressure, Pa", kBarPressure, 0.004}, {"duration, s", kBarDuration, 0.03}, {"restitution", 1, 0.05}});
  const double cell = 4.0 / 40;
  for (double stiffness : {7e9, 7e10, 7e11})
    for (double layer : {1e-1, 1e-2, 1e-3, 1e-4}) {
      ContactConfig contact;
      contact.layer = layer * cell;
      contact.stiffness = stiffness;
      const Impact found = hit_wall(40, 0.9, contact);
      report.add({words("E of the layer %g GPa", stiffness / 1e9), words("h0 %g cell", layer), found.run, {found.pressure, found.duration, found.restitution}});
    }
}

}  // namespace forming_sim::bench
