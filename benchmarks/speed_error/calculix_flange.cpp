// scenes/flange.yaml by CalculiX: static, one layer of bricks for the sheet, bricks with
// prescribed nodes along the tools' profiles, penalty contact of surface with surface. The punch goes its way in
// equal parts; then the contacts are taken away and the sheet springs back.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "forming_sim/loads/motion.h"
#include "forming_sim/mesh/generate.h"
#include "forming_sim/mesh/profile.h"
#include "speed_error/flange.h"
#include "speed_error/peers.h"

namespace forming_sim::bench {
namespace {

constexpr double kToolDepth = 0.45e-3; ///< of the bricks behind a profile, m; less than its least radius
constexpr double kChordError = 2e-6;   ///< m; with finer faces than the sheet's it finds no equilibrium past a quarter of the way
constexpr double kPenalty = 1e5;       ///< MPa/mm
constexpr int kSeconds = 1500;         ///< of processor time

/// Bricks along a profile, which is walked with the tool on the left; their face on it is the surface face_NAME.
struct ToolBricks {
  std::vector<int> nodes;
  std::string text;
};
ToolBricks tool_bricks(const ToolConfig& tool, double width, Deck& deck, long& element) {
  ProfileConfig config = *tool.profile;
  config.chord_error = kChordError;
  const Mesh profile = mesh_profile(config);
  const std::size_t segments = profile.surface.size();
  std::vector<Vec3> path{profile.nodes[profile.surface[0].nodes[0]]};
  for (const Facet& f : profile.surface) path.push_back(profile.nodes[f.nodes[1]]);
  ToolBricks bricks;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3 way = (path[std::min(i + 1, segments)] - path[i == 0 ? 0 : i - 1]).normalized(), left(-way.y(), way.x(), 0);
    for (const Vec3& x : {path[i], Vec3(path[i] + kToolDepth * left)})
      for (double z : {-0.5 * width, 1.5 * width}) bricks.nodes.push_back(deck.point(Vec3(x.x(), x.y(), z)));
  }
  std::ostringstream out, faces;
  out << "*ELEMENT, TYPE=C3D8, ELSET=" << tool.name << "\n";
  faces << "*SURFACE, NAME=face_" << tool.name << ", TYPE=ELEMENT\n";
  for (std::size_t i = 0; i < segments; ++i) {
    const int *a = &bricks.nodes[4 * i], *b = a + 4;  // on the path near and far, behind it near and far
    out << ++element;
    for (int n : {a[0], b[0], b[2], a[2], a[1], b[1], b[3], a[3]}) out << ", " << n;
    out << "\n";
    faces << element << ", S3\n";
  }
  bricks.text = out.str() + "*SOLID SECTION, ELSET=" + tool.name + ", MATERIAL=TOOL\n" + faces.str();
  return bricks;
}

/// Force over the way of the punch, both rising; straight lines between.
struct ForceOverWay {
  std::vector<double> way{0}, force{0};
  double at(double w) const {
    const auto next = std::upper_bound(way.begin(), way.end(), w) - way.begin();
    if (next == static_cast<long>(way.size())) return force.back();
    const double s = (w - way[next - 1]) / (way[next] - way[next - 1]);
    return force[next - 1] + s * (force[next] - force[next - 1]);
  }
};

/// Places of the nodes of a table of displacements in a deck, by number, m.
std::map<int, Vec3> places(const Printed& table, const Deck& deck) {
  std::map<int, Vec3> x;
  for (const std::vector<double>& row : table.rows) x[static_cast<int>(row.at(0))] = 1e-3 * (deck.place(static_cast<int>(row[0])) + Vec3(row.at(1), row.at(2), 0));
  return x;
}

}  // namespace

void flange_by_calculix(Report& report, const Flanged& reference) {
  if (!calculix_or_say(report)) return;
  for (const int through : {3}) {
    const Scene scene = flange_scene(through);
    const BodyConfig& sheet = scene.bodies[0];
    BlankConfig blank = *sheet.blank;
    blank.pattern = "coarse";
    const Mesh mesh = generate_blank(blank);
    const double cell = blank.length / blank.cells_along, clamped = sheet.sets[0].max.x();
    Deck deck(mesh, "C3D8I", cell);
    deck.material(sheet.material);
    std::vector<int> held, free_bottom;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
      for (int number : deck.numbers(static_cast<int>(n))) {
        if (mesh.nodes[n].x() <= clamped) held.push_back(number);
        if (mesh.nodes[n].y() <= 0 && mesh.nodes[n].x() > clamped - cell) free_bottom.push_back(number);
      }
    deck.node_set("clamped", held);
    deck.node_set("free_bottom", free_bottom);
    deck.surface("over", "top");
    deck.surface("under", "free_bottom");
    long element = deck.size().cells;
    const double way = -scene.tools[2].motion->positions.back().y();
    std::ostringstream model;
    model.precision(12);
    model << "*MATERIAL, NAME=TOOL\n*ELASTIC\n210000., .3\n";
    for (const ToolConfig& tool : scene.tools) {
      const ToolBricks bricks = tool_bricks(tool, cell, deck, element);
      deck.node_set(tool.name, bricks.nodes);
      model << bricks.text;
    }
    model << "*SURFACE INTERACTION, NAME=touch\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n" << kPenalty << "\n*FRICTION\n"
          << scene.tools[2].friction << ", " << kPenalty / 10 << "\n";
    const std::pair<const char*, const char*> pairs[] = {{"under", "face_die"}, {"over", "face_pad"}, {"over", "face_punch"}};
    for (const auto& [own, other] : pairs) model << "*CONTACT PAIR, INTERACTION=touch, TYPE=SURFACE TO SURFACE\n" << own << ", " << other << "\n";
    const std::string print = "*NODE PRINT, NSET=punch, TOTALS=ONLY\nRF\n*NODE PRINT, NSET=top\nU\n*NODE PRINT, NSET=bottom\nU\n*END STEP\n";
    model << "*BOUNDARY\nclamped, 1, 2\ndie, 1, 2\npad, 1, 2\npunch, 1, 1\n*STEP, NLGEOM, INC=4000\n*STATIC\n0.005, 1., 1e-7, 0.01\n"
          << "*BOUNDARY\npunch, 2, 2, " << -1e3 * way << "\n" << print << "*STEP, NLGEOM, INC=1000\n*STATIC\n0.05, 1., 1e-7, 0.1\n";
    for (const auto& [own, other] : pairs) model << "*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE\n" << own << ", " << other << "\n";
    deck.steps += model.str() + print;

    const std::string choice = "CalculiX C3D8I", name = std::to_string(through) + " through";
    const CalculixRun run(deck, "flange_" + std::to_string(through), report.request(), kSeconds);
    if (run.failed()) {
      report.no_answer(choice + ", " + name, run.failure(), run.wall_time(), false);
      continue;
    }
    Flanged found;
    found.size = deck.size();
    found.size.steps = run.increments();
    found.size.wall_time = run.wall_time();
    ForceOverWay punch;
    std::map<int, Vec3> top, bottom, released = places(run.last("displacements", "TOP"), deck);
    for (const Printed& table : run.printed()) {
      if (table.time > 1 + 1e-9) break;
      if (table.what == "displacements") (table.set == "TOP" ? top : bottom) = places(table, deck);
      if (table.what != "total") continue;
      punch.way.push_back(way * table.time);
      punch.force.push_back(-table.rows.at(0).at(1) / cell);  // of the sheet on the punch, N/m
    }
    // As the scene has it: means over equal parts of the time in which the punch goes from rest to rest.
    constexpr int points = 50;
    const RigidMotion motion(*scene.tools[2].motion, 2);
    for (int k = 0; k < kForceParts; ++k) {
      double sum = 0;
      for (int i = 0; i < points; ++i)
        sum += punch.at(-motion.at(scene.stages[0].duration * (k + (i + 0.5) / points) / kForceParts).translation.y());
      found.force.push_back(sum / points);
    }
    for (const auto* line : {&top, &bottom}) {
      std::vector<std::pair<double, Vec3>> along;  // of one side of the layer, by x at the start
      for (const auto& [number, x] : *line)
        if (number <= static_cast<int>(mesh.nodes.size())) along.emplace_back(1e-3 * deck.place(number).x(), x);
      std::sort(along.begin(), along.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      for (std::size_t i = 0; i + 1 < along.size(); ++i)
        found.strain = std::max(found.strain, std::log((along[i + 1].second - along[i].second).norm() / (along[i + 1].first - along[i].first)));
    }
    const auto slope = [&](const std::map<int, Vec3>& x) {
      const auto at = [&](double X) {
        return std::min_element(x.begin(), x.end(), [&](const auto& a, const auto& b) {
                 return std::abs(1e-3 * deck.place(a.first).x() - X) < std::abs(1e-3 * deck.place(b.first).x() - X);
               })->second;
      };
      const Vec3 way_along = at(scene.output.probes[1].point.x()) - at(scene.output.probes[0].point.x());
      return std::atan2(way_along.y(), way_along.x());
    };
    found.springback = (slope(released) - slope(top)) * 180 / M_PI;
    add_flange(report, choice, name, found, reference);
  }
}

}  // namespace forming_sim::bench
