#include "geometry.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "forming_sim/config/formula_field.h"
#include "forming_sim/config/words.h"
#include "forming_sim/element/sheet_sides.h"
#include "forming_sim/loads/motion.h"
#include "forming_sim/loads/rotation.h"
#include "forming_sim/mesh/axis.h"
#include "forming_sim/mesh/generate.h"
#include "forming_sim/mesh/import.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/mesh/profile.h"
#include "forming_sim/mesh/seams.h"
#include "forming_sim/mesh/sets.h"
#include "forming_sim/mesh/sweep.h"
#include "forming_sim/mesh/trim.h"
#include "forming_sim/parallel/interrupt.h"
#include "approach.h"
#include "formed_body.h"
#include "rules.h"

namespace forming_sim {

namespace {

constexpr double kSamePlane = 1e-9;  ///< of a body's size
constexpr double kRound = 3e-3;  ///< longest segment of an arc of what turns freely, of its radius: half of it is the lever at which what lies on a corner turns it

bool has_faults(const std::vector<Fault>& known, const std::string& path) {
  return std::any_of(known.begin(), known.end(), [&](const Fault& fault) { return fault.field.compare(0, path.size(), path) == 0; });
}

/// What the user gave where a mesh cannot be made: the url, or that it is inline or generated.
std::string origin_of(const std::optional<MeshConfig>& mesh, const char* otherwise) {
  return !mesh ? otherwise : mesh->url.empty() ? "an inline mesh" : given_text(mesh->url);
}

/// Runs `make`; what it throws becomes a fault of `path`.
template <class Make> bool attempt(const std::string& path, const std::string& given, std::vector<Fault>& faults, Make&& make) {
  try {
    make();
    return true;
  } catch (const SceneError& error) {  // of fields beside the one of the path
    for (const Fault& fault : error.faults()) faults.push_back({fault.code, path.substr(0, path.rfind('.') + 1) + fault.field, fault.given, fault.remedy});
  } catch (const Error& error) {
    if (error.code() == Code::cancelled) throw;
    faults.push_back({error.code(), path, given, error.what()});
  } catch (const std::bad_alloc&) {
    faults.push_back({Code::mesh_error, path, given, "there is not memory enough for this mesh; give fewer cells"});
  }
  return false;
}

std::vector<std::string> set_names(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const auto& [name, nodes] : mesh.sets) names.push_back(name);
  return names;
}

/// Adds the sets that the scene declares to those of the mesh.
void add_sets(const BodyConfig& body, const std::string& path, Mesh& mesh, std::vector<Fault>& faults) {
  for (std::size_t k = 0; k < body.sets.size(); ++k) {
    const SetConfig& set = body.sets[k];
    const std::string here = join_path(path + ".sets", k);
    if (mesh.sets.count(set.name) > 0) {
      faults.push_back({Code::invalid_scene, here + ".name", given_text(set.name), "give another name: the mesh has the sets " + one_of(set_names(mesh), ", ") + " already"});
      continue;
    }
    std::vector<int> nodes;
    const std::string round = " of radius " + number_text(set.radius) + " m about " + given_text(set.point);
    const std::string chosen = set.choose == "plane"      ? "the plane through " + given_text(set.point) + " with normal " + given_text(set.normal)
                               : set.choose == "cylinder" ? "the cylinder" + round + (mesh.dimension == 2 || set.axis.isZero(0) ? "" : " along " + given_text(set.axis))
                               : set.choose == "sphere"   ? "the sphere" + round
                                                          : "the box from " + given_text(set.min) + " to " + given_text(set.max);
    if (!attempt(here, chosen, faults, [&] { nodes = choose_nodes(mesh, set); })) continue;
    if (nodes.empty()) {
      const auto box = bounds(mesh);
      faults.push_back({Code::invalid_scene, here, chosen, "choose at least one node: no node of body " + body.name + " is there, which extends from " + given_text(Vec3(box.min())) + " to " + given_text(Vec3(box.max())) + " m"});
    }
    mesh.sets[set.name] = std::move(nodes);
  }
}

/// A surface face all of whose nodes are in the set.
bool covers_a_face(const Mesh& mesh, const std::vector<int>& set) {
  return std::any_of(mesh.surface.begin(), mesh.surface.end(), [&](const Facet& facet) {
    return std::all_of(facet.nodes.begin(), facet.nodes.end(), [&](int n) { return n < 0 || std::binary_search(set.begin(), set.end(), n); });
  });
}

void check_used_sets(const BodyConfig& body, const std::string& path, const Mesh& mesh, std::vector<Fault>& faults) {
  FaultList list(faults);
  const auto exists = [&](const std::string& set, const std::string& here) {
    if (set.empty() || mesh.sets.count(set) > 0) return !set.empty();
    add_missing_set(set, body.name, set_names(mesh), here + ".set", list);
    return false;
  };
  for (std::size_t k = 0; k < body.boundaries.size(); ++k) exists(body.boundaries[k].set, join_path(path + ".boundaries", k));
  const auto covers = [&](const std::string& set, const std::string& here, const std::string& what) {
    if (!exists(set, here) || mesh.sets.at(set).empty() || covers_a_face(mesh, mesh.sets.at(set))) return;
    list.add(here + ".set", given_text(set), "give a set that holds all nodes of at least one surface face: on none of this one can a " + what + " act");
  };
  for (std::size_t k = 0; k < body.pressures.size(); ++k) covers(body.pressures[k].set, join_path(path + ".pressures", k), "pressure");
  for (std::size_t k = 0; k < body.loads.size(); ++k) {
    const std::string here = join_path(path + ".loads", k);
    if (body.loads[k].kind == "traction") covers(body.loads[k].set, here, "traction");
    else exists(body.loads[k].set, here);
  }
}

void check_velocity_field(const BodyConfig& body, const std::string& path, const Mesh& mesh, std::vector<Fault>& faults) {
  attempt(path, one_of(body.initial_velocity_field, ", "), faults, [&] {
    const FormulaField field(body.initial_velocity_field);
    for (const Vec3& X : mesh.nodes) field.at(X);
  });
}

/// Moves the nodes by the body's imperfection.
void make_imperfect(const Scene& scene, std::size_t i, Mesh& mesh, std::vector<Fault>& faults) {
  const std::vector<std::string>& formulas = scene.bodies[i].imperfection;
  const std::string path = body_path(i) + ".imperfection";
  if (formulas.empty() || mesh.nodes.empty()) return;
  attempt(path, one_of(formulas, ", "), faults, [&] {
    const FormulaField field(formulas);
    Mesh moved = mesh;
    for (Vec3& X : moved.nodes) {
      const Vec3 x = X + field.at(X);
      if (scene.axisymmetric && (X.x() == 0 ? x.x() != 0 : !(x.x() > 0)))
        throw Error(Code::invalid_scene, "give formulas that leave what is on the axis y there, and the rest beside it: the node at " + place(X) + " goes to x = " + number_text(x.x()) + " m");
      X = x;
    }
    const double in_plane = kSamePlane * size_of(mesh);
    for (const BoundaryConfig& boundary : scene.bodies[i].boundaries) {
      const auto set = mesh.sets.find(boundary.set);
      if (boundary.kind != "symmetric" || set == mesh.sets.end() || boundary.normal.isZero(0)) continue;
      const Vec3 normal = boundary.normal.stableNormalized();
      for (int n : set->second)
        if (const double across = normal.dot(moved.nodes[n] - mesh.nodes[n]); std::abs(across) > in_plane)
          throw Error(Code::invalid_scene, "give formulas that leave the nodes of the set " + boundary.set + " in their plane of symmetry: the one at " + place(mesh.nodes[n]) + " goes " + three_digits(across) + " m across it");
    }
    try {
      check_volumes(moved);
    } catch (const Error& error) {
      throw Error(Code::invalid_scene, "give smaller ones: they turn cells over or make them flat. " + std::string(error.what()));
    }
    mesh = std::move(moved);
  });
}

/// What is left of a body.
bool trim_body(const BodyConfig& body, const std::string& path, Mesh& mesh, std::optional<FormedMemory>& formed, std::vector<Fault>& faults) {
  if (body.trim.empty()) return true;
  return attempt(path + ".trim", std::to_string(body.trim.size()) + (body.trim.size() == 1 ? " region" : " regions"), faults, [&] {
    const Remainder left = find_remainder(mesh, body.trim);
    mesh = remaining(mesh, left);
    if (formed) formed = remaining(*formed, left);
  });
}

bool make_body(const Scene& scene, std::size_t i, const std::vector<Fault>& known, Mesh& mesh, std::optional<FormedMemory>& formed, Geometry& geometry) {
  std::vector<Fault>& faults = geometry.faults;
  const BodyConfig& body = scene.bodies[i];
  const std::string path = body_path(i);
  const bool one_source = int(body.blank.has_value()) + int(body.mesh.has_value()) + int(body.formed.has_value()) == 1;
  if (!one_source) return false;
  for (const char* part : {".blank", ".mesh", ".formed", ".trim"})
    if (has_faults(known, path + part)) return false;
  if (body.formed && has_faults(known, path + ".material")) return false;  // with which that of then is compared
  const std::string source = path + (body.blank ? ".blank" : body.formed ? ".formed.url" : body.mesh->url.empty() ? ".mesh" : ".mesh.url");
  const std::string origin = body.formed ? given_text(body.formed->url) : origin_of(body.mesh, "this blank");
  const std::size_t before = faults.size();
  check_interrupt();
  const bool made = attempt(source, origin, faults, [&] {
    if (body.formed) {
      FormedBody part = load_formed_body(scene, body, path, faults, geometry.model.notes);
      mesh = std::move(part.mesh);
      formed = std::move(part.memory);
    } else {
      mesh = body.blank ? generate_blank(*body.blank) : load_body_mesh(*body.mesh, scene.base_directory, geometry.model.notes);
    }
    check_interrupt();
    if (faults.size() > before) return;
    if (!formed) return check_volumes(mesh);
    Mesh free_of_stress = mesh;  // where it stands now its run has come to, with cells that no fresh mesh should have
    free_of_stress.nodes = formed->reference;
    check_volumes(free_of_stress);
  });
  if (!made || faults.size() > before) return false;
  if (!trim_body(body, path, mesh, formed, faults)) return false;
  if (scene.axisymmetric && mesh.dimension == 2 && !attempt(source, origin, faults, [&] { close_at_axis(mesh); })) return false;
  if (mesh.dimension != scene.dimension && (scene.dimension == 2 || scene.dimension == 3)) {
    faults.push_back({Code::invalid_scene, source, origin + ", whose cells have dimension " + std::to_string(mesh.dimension),
                      scene.dimension == 2 ? "give a mesh of triangles or quadrilaterals, or set dimension to 3" : "give a mesh of tetrahedra, hexahedra or wedges (bodies are solids: a surface is to be extruded through the thickness), or set dimension to 2"});
    return false;
  }
  return true;
}

/// The turned section of a tool lies at x >= 0 where it is put at the start.
void check_beside_axis(const ToolConfig& tool, const Mesh& mesh) {
  const double near = 1e-9 * size_of(mesh);
  const Mat3 rotation = rotation_matrix(kRadiansPerDegree * tool.rotation_deg);
  for (const Vec3& point : mesh.nodes) {
    const Vec3 x = rotation * point + tool.position;
    if (x.x() < -near)
      throw Error(Code::mesh_error, "its point at " + place(x) + " lies beyond the axis; give the section at x >= 0: it is turned about the axis y");
  }
}

/// Mean edge of the surface of the body that has the smallest, m; in dimension 3 of squares as large as two facets are in the mean.
double finest_edge(const std::vector<Mesh>& bodies) {
  double finest = std::numeric_limits<double>::infinity();
  for (const Mesh& mesh : bodies) {
    if (mesh.surface.empty()) continue;
    double sum = 0;
    for (const Facet& side : mesh.surface) sum += area_vector(mesh, side).norm();
    const double mean = sum / static_cast<double>(mesh.surface.size());
    finest = std::min(finest, mesh.dimension == 2 ? mean : std::sqrt(2 * mean));
  }
  return finest;
}

ToolModel tool_model(const ToolConfig& config, Mesh mesh) {
  ToolModel tool;
  tool.name = config.name;
  tool.mesh = std::move(mesh);
  tool.point = config.point;
  if (!config.normal.isZero(0)) tool.normal = config.normal.stableNormalized();
  tool.position = config.position;
  tool.rotation_deg = config.rotation_deg;
  tool.motion = config.motion;
  tool.friction = config.friction;
  tool.friction_limit = config.friction_limit;
  return tool;
}

/// longest: of the segments that stand for an arc of a profile, m.
bool make_tool(const Scene& scene, std::size_t i, const std::vector<Fault>& known, double longest, Mesh& mesh, Geometry& geometry) {
  std::vector<Fault>& faults = geometry.faults;
  const ToolConfig& tool = scene.tools[i];
  const std::string path = tool_path(i);
  const int sources = int(tool.mesh.has_value()) + int(tool.profile.has_value()) + int(!tool.normal.isZero(0));
  if (sources != 1 || has_faults(known, path + ".mesh") || has_faults(known, path + ".profile")) return false;
  if (tool.profile)
    return attempt(path + ".profile", "this profile", faults, [&] {
      const auto make = [&](double most) { return scene.dimension == 3 ? sweep_profile(*tool.profile, most) : mesh_profile(*tool.profile, most); };
      mesh = make(longest);
      const bool turns_freely = tool.motion && tool.motion->turns_freely();
      if (turns_freely && tool.profile->sweep != "turned") mesh = make(std::min(longest, kRound * reach_from_axle(tool_model(tool, mesh))));
      if (scene.axisymmetric) check_beside_axis(tool, mesh);
    });
  if (!tool.mesh) return true;  // a plane
  return attempt(path + (tool.mesh->url.empty() ? ".mesh" : ".mesh.url"), origin_of(tool.mesh, ""), faults,
                 [&] {
                   std::vector<std::string> notes;
                   mesh = load_tool_surface(*tool.mesh, scene.base_directory, notes);
                   for (const std::string& note : notes) geometry.model.notes.push_back("tool " + tool.name + ": " + note);
                 });
}

/// A probe that is meant to be on the body.
void note_far_probe(const ProbeConfig& probe, const std::string& body, const Mesh& mesh, std::vector<std::string>& notes) {
  constexpr double kFar = 0.05;  // of the body's size
  const auto box = bounds(mesh);
  Vec3 point = probe.point;
  if (mesh.dimension == 2) point.z() = 0;
  const double away = box.exteriorDistance(point);
  if (away > kFar * box.sizes().maxCoeff())
    notes.push_back("probe " + probe.name + " is put " + three_digits(away) + " m outside body " + body + ", which extends from " + given_text(Vec3(box.min())) + " to " +
                    given_text(Vec3(box.max())) + " m: the node nearest to it is followed; give a point on the body, in metres");
}

/// Two probes on one node make no line.
void check_springback_nodes(const Scene& scene, const std::vector<Mesh>& bodies, const std::vector<Fault>& known, std::vector<Fault>& faults) {
  if (!scene.output.springback || has_faults(known, "output")) return;
  const auto check = [&](const std::string& from, const std::string& to, const std::string& field) {
    const auto of = [&](const std::string& name) { return std::find_if(scene.output.probes.begin(), scene.output.probes.end(), [&](const ProbeConfig& p) { return p.name == name; }); };
    const auto first = of(from), second = of(to), end = scene.output.probes.end();
    if (first == end || second == end || !first->set.empty() || !second->set.empty()) return;
    const int body = body_of(*first, scene);
    if (body < 0 || body != body_of(*second, scene) || bodies[body].nodes.empty()) return;
    const Mesh& mesh = bodies[body];
    if (const int n = nearest_node(mesh, first->point); n == nearest_node(mesh, second->point))
      faults.push_back({Code::invalid_scene, "output.springback." + field, given_text(to), "node " + std::to_string(n) + " at " + place(mesh.nodes[n]) + " is the nearest to this probe and to " + from + ": a line needs two nodes, so put the probes apart"});
  };
  check(scene.output.springback->from, scene.output.springback->to, "to");
  check(scene.output.springback->reference_from, scene.output.springback->reference_to, "reference_to");
}

/// A forming limit is one of a sheet, and asks for both of its sides.
void check_sides(const BodyConfig& config, const BodyModel& body, const std::string& path, bool axisymmetric, std::vector<Fault>& faults) {
  if (!config.material.forming_limit || body.mesh.nodes.empty()) return;
  const auto [bottom, top] = sides_of_sheet(body, axisymmetric);
  if (top.empty() || facets_within(body.mesh, bottom).empty() || facets_within(body.mesh, top).empty())
    faults.push_back({Code::invalid_scene, path + ".material.forming_limit", "the limit of a body without two sides",
                      "name the faces of its two sides as sets bottom and top, of a tube inside and outside (its sets are " + one_of(set_names(body.mesh), ", ") + "): the strains of the middle between them are compared with the curve"});
}

void add_body(const BodyConfig& config, Mesh mesh, std::optional<FormedMemory> formed, Model& model) {
  BodyModel body;
  body.name = config.name;
  body.first_node = model.node_count();
  body.first_element = model.element_count();
  body.node_count = static_cast<int>(mesh.nodes.size());
  body.element_count = mesh.simplex_count();
  body.material = config.material;
  body.pressure_average = config.pressure_average;
  body.self_contact = config.self_contact;
  body.mesh = std::move(mesh);
  body.formed = std::move(formed);
  tell_odd_body(config, body, model);
  model.bodies.push_back(std::move(body));
}

}  // namespace

Geometry make_geometry(const Scene& scene, const std::vector<Fault>& known) {
  Geometry geometry;
  geometry.model.dimension = scene.dimension;
  geometry.model.axisymmetric = scene.axisymmetric;
  std::vector<Mesh> bodies(scene.bodies.size()), tools(scene.tools.size());
  std::vector<std::optional<FormedMemory>> formed(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!make_body(scene, i, known, bodies[i], formed[i], geometry)) bodies[i] = Mesh{};
    else if (!has_faults(known, body_path(i) + ".sets")) {
      add_sets(scene.bodies[i], body_path(i), bodies[i], geometry.faults);
      check_used_sets(scene.bodies[i], body_path(i), bodies[i], geometry.faults);
    }
    if (!has_faults(known, body_path(i) + ".imperfection")) make_imperfect(scene, i, bodies[i], geometry.faults);
    const std::string field = body_path(i) + ".initial_velocity_field";
    if (!has_faults(known, field)) check_velocity_field(scene.bodies[i], field, bodies[i], geometry.faults);
  }
  check_interrupt();
  const double longest = 2 * finest_edge(bodies);
  for (std::size_t i = 0; i < tools.size(); ++i) {
    if (!make_tool(scene, i, known, longest, tools[i], geometry)) tools[i] = Mesh{};
  }
  for (std::size_t i = 0; i < scene.output.probes.size(); ++i) {
    const ProbeConfig& probe = scene.output.probes[i];
    const int body = body_of(probe, scene);
    if (body < 0 || bodies[static_cast<std::size_t>(body)].nodes.empty()) continue;
    const Mesh& mesh = bodies[static_cast<std::size_t>(body)];
    if (probe.set.empty()) {
      note_far_probe(probe, scene.bodies[static_cast<std::size_t>(body)].name, mesh, geometry.model.notes);
      continue;
    }
    if (mesh.sets.count(probe.set) > 0) continue;
    FaultList list(geometry.faults);
    add_missing_set(probe.set, scene.bodies[static_cast<std::size_t>(body)].name, set_names(mesh), join_path("output.probes", i) + ".set", list);
  }
  check_interrupt();
  check_springback_nodes(scene, bodies, known, geometry.faults);
  check_sizes(scene, bodies, tools, geometry.faults, geometry.model.notes);
  if (known.empty()) tell_odd_values(scene, geometry.model.notes);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    add_body(scene.bodies[i], std::move(bodies[i]), std::move(formed[i]), geometry.model);
    check_sides(scene.bodies[i], geometry.model.bodies.back(), body_path(i), scene.axisymmetric, geometry.faults);
  }
  for (std::size_t i = 0; i < tools.size(); ++i) geometry.model.tools.push_back(tool_model(scene.tools[i], std::move(tools[i])));
  if (known.empty() && geometry.faults.empty()) approach_tools(scene, geometry.model, geometry.faults);
  return geometry;
}

}  // namespace forming_sim
