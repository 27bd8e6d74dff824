// A .msh file by way of libgmsh, in a process of its own: gmsh has one state for the whole process, and breaks over some files.
// A library of its own, which mesh/gmsh_reader.cpp loads with the first .msh.
#include <gmsh.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <unordered_map>

#include "forming_sim/config/fault.h"
#include "forming_sim/config/words.h"
#include "forming_sim/mesh/cell_order.h"
#include "files/read_apart.h"
#include "mesh/gmsh_reader.h"

namespace forming_sim {
namespace {

using Groups = std::vector<std::pair<int, int>>;  // dimension and tag

void open_mesh(const std::string& path) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  // Errors go to the log: not all that are thrown say what is wrong.
  gmsh::option::setNumber("General.AbortOnError", 0);
  gmsh::clear();
  gmsh::logger::start();
  gmsh::open(path);
  std::vector<std::string> log;
  gmsh::logger::get(log);
  for (const std::string& line : log)
    if (line.compare(0, 7, "Error: ") == 0) throw line.substr(7);
}

std::string name_of(const std::pair<int, int>& group) {
  std::string name;
  gmsh::model::getPhysicalName(group.first, group.second, name);
  return name.empty() ? "group_" + std::to_string(group.second) : name;
}

/// Names and tags are one for each dimension alone: a curve and a surface may have the same, and are told apart.
std::vector<std::string> set_names_of(const Groups& groups) {
  constexpr const char* kDimensions[] = {"point", "curve", "surface", "volume"};
  std::vector<std::string> names;
  std::map<std::string, std::set<int>> dimensions;
  for (const auto& group : groups) dimensions[names.emplace_back(name_of(group))].insert(group.first);
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (dimensions[names[g]].size() > 1) names[g] += std::string("_") + kDimensions[groups[g].first];
  return names;
}

/// The group that is wanted is no body.
struct WrongGroup {
  std::string why;
};

struct MeshReader {
  std::string source;
  std::unordered_map<std::size_t, int> index;  // of a node's tag
  RawMesh raw;

  [[noreturn]] void refuse(const std::string& what) const { throw Error(Code::mesh_error, source + ": " + what); }

  /// By the dimension of an element and the number of its corners.
  RawKind kind_of(int dimension, int corners, const std::string& name) const {
    for (RawKind kind : {RawKind::point, RawKind::line, RawKind::triangle, RawKind::quadrilateral, RawKind::tetrahedron, RawKind::pyramid, RawKind::wedge, RawKind::hexahedron})
      if (shape_of(kind).dimension == dimension && shape_of(kind).corners == corners) return kind;
    refuse("holds cells of the kind " + name +
           "; triangles, quadrilaterals, tetrahedra, hexahedra, wedges (prisms) and pyramids can be used, so mesh the body with these");
  }

  void read_nodes(double scale) {
    std::vector<std::size_t> tags;
    std::vector<double> x, unused;
    gmsh::model::mesh::getNodes(tags, x, unused, -1, -1, false, false);
    std::vector<std::size_t> order(tags.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
    for (std::size_t i : order) {
      if (!index.emplace(tags[i], static_cast<int>(raw.points.size())).second) continue;
      raw.points.push_back(scale * Vec3(x[3 * i], x[3 * i + 1], x[3 * i + 2]));
      raw.point_tags.push_back(static_cast<long long>(tags[i]));
    }
  }

  void append_cells(int dimension, int entity, std::vector<RawCell>& cells) {
    if (entity < 0) {
      gmsh::vectorpair entities;
      gmsh::model::getEntities(entities, dimension);
      for (const auto& each : entities) append_cells(dimension, each.second, cells);
      return;
    }
    std::vector<int> types, groups;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    gmsh::model::getPhysicalGroupsForEntity(dimension, entity, groups);
    for (std::size_t t = 0; t < types.size(); ++t) {
      if (tags[t].empty()) continue;
      std::string name;
      int of_dimension, order, of_an_element, primary;
      std::vector<double> local;
      gmsh::model::mesh::getElementProperties(types[t], name, of_dimension, order, of_an_element, local, primary);
      const RawKind kind = kind_of(of_dimension, primary, name);
      const int corners = shape_of(kind).corners;
      if (order > 1 && raw.note.empty())
        raw.note = source + " holds cells of order " + std::to_string(order) + " (" + name + "): their corners alone are taken, and edges are straight between these";
      // Format 2.2 writes a cell once for each physical group that it is in.
      std::set<std::vector<std::size_t>> known;
      for (std::size_t c = 0; c < tags[t].size(); ++c) {
        if (groups.size() > 1 && !known.emplace(nodes[t].begin() + c * of_an_element, nodes[t].begin() + (c + 1) * of_an_element).second) continue;
        RawCell cell{kind, static_cast<long long>(tags[t][c]), {}};
        for (int k = 0; k < corners; ++k) {
          const auto found = index.find(nodes[t][c * of_an_element + k]);
          if (found == index.end())
            refuse("cell " + std::to_string(cell.tag) + " names node " + std::to_string(nodes[t][c * of_an_element + k]) +
                   ", which the file does not hold");
          cell.nodes[k] = found->second;
        }
        cells.push_back(cell);
      }
    }
  }

  void append_group(const std::pair<int, int>& group, std::vector<RawCell>& cells) {
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(group.first, group.second, entities);
    for (int entity : entities) append_cells(group.first, entity, cells);
  }

  void choose_body(const Groups& groups, const std::vector<std::string>& set_names, const std::string& wanted) {
    if (wanted.empty()) {
      for (int dimension = 3; dimension >= 2 && raw.cells.empty(); --dimension) {
        append_cells(dimension, -1, raw.cells);
        raw.dimension = dimension;
      }
      if (raw.cells.empty()) refuse("holds no triangles, quadrilaterals, tetrahedra, hexahedra, wedges or pyramids; mesh it first (gmsh -2 or gmsh -3)");
      return;
    }
    std::string names;
    raw.dimension = -1;
    const auto is_wanted = [&](std::size_t g) { return name_of(groups[g]) == wanted || set_names[g] == wanted; };
    for (std::size_t g = 0; g < groups.size(); ++g) {
      names += (names.empty() ? "" : ", ") + set_names[g];
      if (is_wanted(g)) raw.dimension = std::max(raw.dimension, groups[g].first);
    }
    if (raw.dimension < 0)
      throw WrongGroup{source + " has no such physical group; it has " + (names.empty() ? std::string("none") : names)};
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (groups[g].first == raw.dimension && is_wanted(g)) append_group(groups[g], raw.cells);
    if (raw.dimension < 2 || raw.cells.empty())
      throw WrongGroup{"this physical group of " + source + " holds no triangles, quadrilaterals, tetrahedra, hexahedra, wedges or pyramids, so it is no body"};
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (groups[g].first == 3) raw.volumes += (raw.volumes.empty() ? "" : ", ") + set_names[g];
  }

  // Neighbours in the body come near to each other, which the numbers of a mesh generator do not see to.
  void order_cells() {
    std::vector<int> nodes;
    for (const RawCell& cell : raw.cells)
      for (int k = 0; k < 8; ++k) nodes.push_back(cell.nodes[std::min(k, shape_of(cell.kind).corners - 1)]);
    const std::vector<RawCell> given = raw.cells;
    const std::vector<int> order = order_of_cells(raw.points, nodes, 8, ends_of_pieces(static_cast<int>(nodes.size() / 8), 512), 0.8);
    for (std::size_t i = 0; i < order.size(); ++i) raw.cells[i] = given[order[i]];
  }

  // In the order in which the cells come to them. Nodes that the body does not use are dropped: they would have no mass.
  void renumber_nodes() {
    std::vector<int> place(raw.points.size(), -1);
    std::vector<Vec3> points;
    std::vector<long long> tags;
    for (const RawCell& cell : raw.cells)
      for (int k = 0; k < shape_of(cell.kind).corners; ++k) {
        const int p = cell.nodes[k];
        if (place[p] >= 0) continue;
        place[p] = static_cast<int>(points.size());
        points.push_back(raw.points[p]);
        tags.push_back(raw.point_tags[p]);
      }
    raw.points = std::move(points);
    raw.point_tags = std::move(tags);
    const auto renumber = [&](RawCell& cell) {
      bool whole = true;
      for (int k = 0; k < shape_of(cell.kind).corners; ++k) whole = (cell.nodes[k] = place[cell.nodes[k]]) >= 0 && whole;
      return whole;
    };
    for (RawCell& cell : raw.cells) renumber(cell);
    for (auto& [name, cells] : raw.groups)
      cells.erase(std::remove_if(cells.begin(), cells.end(), [&](RawCell& c) { return !renumber(c); }), cells.end());
  }
};

// Whatever does not begin like a mesh, gmsh would run as a script.
void check_beginning(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  std::getline(file, line);
  if (line.compare(0, 3, "\xEF\xBB\xBF") == 0)
    throw Error(Code::mesh_error, "mesh file \"" + path + "\": it begins with a byte order mark, which gmsh does not read; save it without one");
  if (line.compare(0, 11, "$MeshFormat") != 0 && line.compare(0, 9, "$Comments") != 0)
    throw Error(Code::mesh_error, "mesh file \"" + path + "\": " +
                                      (line.empty() ? "the file or its first line is empty" : "its first line is not that of a mesh") +
                                      "; a .msh begins with $MeshFormat");
}

RawMesh read(const std::string& path, const std::string& group, double unit_scale) {
  check_beginning(path);
  open_mesh(path);
  MeshReader reader;
  reader.source = "mesh file \"" + path + "\"";
  reader.raw.source = reader.source;
  reader.read_nodes(unit_scale);
  Groups groups;
  gmsh::model::getPhysicalGroups(groups);
  const std::vector<std::string> set_names = set_names_of(groups);
  reader.choose_body(groups, set_names, group);
  std::map<std::string, int> dimension_of;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto [known, fresh] = dimension_of.emplace(set_names[g], groups[g].first);
    if (!fresh && known->second != groups[g].first)
      reader.refuse("a group is called " + set_names[g] + ", as another is told apart from those of its name; give one of them another name");
    reader.append_group(groups[g], reader.raw.groups[set_names[g]]);
  }
  reader.order_cells();
  reader.renumber_nodes();
  return std::move(reader.raw);
}

RawMesh read_with_reasons(const std::string& path, const std::string& group, double unit_scale) {
  const std::string source = "mesh file \"" + path + "\": ";
  const std::string remedy = "; it may be cut short: write it again with gmsh (format 2.2 or 4.1)";
  try {
    return read(path, group, unit_scale);
  } catch (const WrongGroup& wrong) {
    RawMesh none;
    none.wrong_group = wrong.why;
    return none;
  } catch (const Error&) {
    throw;
  } catch (const std::string& message) {
    throw Error(Code::mesh_error, source + "gmsh cannot read it: " + message + remedy);
  } catch (const std::exception& error) {
    throw Error(Code::mesh_error, source + "gmsh cannot read it: " + error.what() + remedy);
  } catch (...) {
    throw Error(Code::mesh_error, source + "gmsh cannot read it" + remedy);
  }
}

}  // namespace

void forming_sim_read_gmsh(const std::string& path, const std::string& group, double unit_scale, RawMesh& body) {
  body = read_apart<RawMesh>("mesh file \"" + path + "\"", path, [&] { return read_with_reasons(path, group, unit_scale); }, [](auto& archive, auto& mesh) {
    archive.text(mesh.source);
    archive.text(mesh.note);
    archive.text(mesh.wrong_group);
    archive.text(mesh.volumes);
    archive.number(mesh.dimension);
    archive.list(mesh.points);
    archive.list(mesh.point_tags);
    archive.list(mesh.cells);
    archive.lists(mesh.groups);
  });
  body.group = group;
  if (!body.wrong_group.empty()) throw SceneError({{Code::mesh_error, "group", given_text(group), body.wrong_group}});
}

}  // namespace forming_sim
