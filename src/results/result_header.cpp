#include "result_header.h"

namespace forming_sim {
namespace {

void write_ints(Hdf5Group& group, const std::string& name, const std::vector<std::int32_t>& values,
                std::uint64_t columns = 0) {
  std::vector<std::uint64_t> shape{values.size()};
  if (columns) shape = {values.size() / columns, columns};
  group.write(name, values.data(), shape, "1");
}

void write_vector(Hdf5Group& group, const std::string& name, const Vec3& value, const std::string& unit) {
  group.write(name, value.data(), {3}, unit, Storage::plain);
}

void write_bodies(Hdf5Group bodies, const ResultHeader& header) {
  for (std::size_t i = 0; i < header.bodies.size(); ++i) {
    Hdf5Group body = bodies.create(std::to_string(i));
    body.set("name", header.bodies[i]);
    if (i < header.sheet_sides.size()) body.set("thickness_between", header.sheet_sides[i]);
    if (i < header.forming_limits.size() && !header.forming_limits[i].empty())
      body.write("forming_limit", header.forming_limits[i][0].data(), {header.forming_limits[i].size(), 2}, "1", Storage::plain);
    Hdf5Group sets = body.create("sets");
    const std::string prefix = header.bodies[i] + "/";
    int index = 0;
    for (const auto& [name, nodes] : header.sets) {
      if (name.compare(0, prefix.size(), prefix) != 0) continue;
      Hdf5Group set = sets.create(std::to_string(index++));
      set.set("name", name.substr(prefix.size()));
      write_ints(set, "nodes", nodes);
    }
  }
}

void write_tools(Hdf5Group tools, const ResultHeader& header) {
  for (std::size_t i = 0; i < header.tools.size(); ++i) {
    const ToolShape& shape = header.tools[i];
    Hdf5Group tool = tools.create(std::to_string(i));
    tool.set("name", shape.name);
    if (shape.points.empty()) {
      write_vector(tool, "plane_point", shape.plane_point, "m");
      write_vector(tool, "plane_normal", shape.plane_normal, "1");
      continue;
    }
    tool.write("points", shape.points[0].data(), {shape.points.size(), 3}, "m");
    write_ints(tool, "facets", flatten(shape.facets, header.dimension), header.dimension);
    write_ints(tool, "body", std::vector<std::int32_t>(shape.facets.size(), -1 - static_cast<int>(i)));
  }
}

}  // namespace

void write_header(Hdf5Group root, const ResultHeader& header, std::size_t frames) {
  root.set("version", header.version);
  root.set("scene", header.scene_name);
  root.set("scene_hash", header.scene_hash);
  root.set("dimension", std::int64_t{header.dimension});
  root.set("axisymmetric", std::int64_t{header.axisymmetric});
  root.write_text("scene_text", header.scene_text);

  Hdf5Group topology = root.create("topology");
  write_ints(topology, "elements", flatten(header.elements, header.dimension + 1), header.dimension + 1);
  write_ints(topology, "body", header.element_body);
  std::vector<std::array<int, 3>> facets;
  std::vector<std::int32_t> owners, bodies;
  for (const Facet& facet : header.surface) {
    facets.push_back(facet.nodes);
    owners.push_back(facet.element);
    bodies.push_back(header.element_body[facet.element]);
  }
  write_ints(topology, "surface", flatten(facets, header.dimension), header.dimension);
  write_ints(topology, "surface_element", owners);
  write_ints(topology, "surface_body", bodies);
  topology.write("initial_positions", coordinates(header.initial_positions).data(),
                 {header.initial_positions.size(), 3}, "m");
  write_bodies(root.create("bodies"), header);
  write_tools(root.create("tools"), header);
  root.create("frames", frames);
}

}  // namespace forming_sim
