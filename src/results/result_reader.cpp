#include "forming_sim/results/result_reader.h"

#include <algorithm>

#include "forming_sim/config/fault.h"
#include "files/read_apart.h"

namespace forming_sim {
namespace {

/// What the file says is looked at before it is used: who wrote it last may not have been this package.
void need(bool good, const std::string& what) {
  if (!good) throw Error(Code::output_error, "the result file is damaged: " + what);
}

template <class Range> void need_indices(const Range& indices, std::size_t count, const std::string& name) {
  for (int i : indices)
    if (i < 0 || static_cast<std::size_t>(i) >= count) need(false, name + " name " + std::to_string(i) + ", and there are " + std::to_string(count));
}

template <std::size_t N>
std::vector<std::array<int, N>> rows(const std::vector<std::int32_t>& flat, std::size_t columns) {
  need(flat.size() % columns == 0, std::to_string(flat.size()) + " indices are no rows of " + std::to_string(columns));
  std::vector<std::array<int, N>> rows(flat.size() / columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].fill(-1);
    std::copy_n(&flat[i * columns], columns, rows[i].begin());
  }
  return rows;
}

NodeField nodes(const std::vector<double>& flat) {
  need(flat.size() % 3 == 0, std::to_string(flat.size()) + " coordinates are no rows of 3");
  NodeField nodes(flat.size() / 3);
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = Node(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2], 0);
  return nodes;
}

template <class T> std::vector<T> values(const Hdf5Group& group, const std::string& name, std::size_t count) {
  std::vector<T> found = group.read<T>(name);
  need(found.size() == count, name + " has " + std::to_string(found.size()) + " values, " + std::to_string(count) + " are needed");
  return found;
}

Vec3 vector(const Hdf5Group& group, const std::string& name) {
  return Eigen::Map<const Vec3>(values<double>(group, name, 3).data());
}

/// Members "0", "1", ... in numeric order.
std::size_t member_count(const Hdf5Group& group) { return group.names().size(); }

ToolShape read_tool(const Hdf5Group& tool, int dimension) {
  ToolShape shape;
  shape.name = tool.text("name");
  if (!tool.has("points")) {
    shape.plane_point = vector(tool, "plane_point");
    shape.plane_normal = vector(tool, "plane_normal");
    return shape;
  }
  for (const Node& node : nodes(tool.read<double>("points"))) shape.points.push_back(vec3(node));
  const std::vector<std::int32_t> facets = tool.read<std::int32_t>("facets");
  need_indices(facets, shape.points.size(), "facets of tool " + shape.name);
  shape.facets = rows<3>(facets, dimension);
  return shape;
}

}  // namespace

ResultHeader read_header(const Hdf5Group& root) {
  ResultHeader header;
  if (!root.has("topology") || !root.has("frames")) throw Error(Code::output_error, "the file holds no result; give the result.h5 of a run");
  header.version = root.text("version");
  header.scene_name = root.text("scene");
  header.scene_text = root.read_text("scene_text");
  header.scene_hash = root.integer("scene_hash");
  header.dimension = static_cast<int>(root.integer("dimension"));
  header.axisymmetric = root.integer("axisymmetric") != 0;
  need(header.dimension == 2 || header.dimension == 3, "its dimension is " + std::to_string(header.dimension));
  const Hdf5Group topology = root.group("topology");
  header.initial_positions = nodes(topology.read<double>("initial_positions"));
  const std::size_t count = header.initial_positions.size();
  const std::vector<std::int32_t> corners = topology.read<std::int32_t>("elements"), facets = topology.read<std::int32_t>("surface");
  need_indices(corners, count, "elements");
  need_indices(facets, count, "facets of the surface");
  header.elements = rows<4>(corners, header.dimension + 1);
  header.element_body = topology.read<std::int32_t>("body");
  need(header.element_body.size() == header.elements.size(), "not every element has a body");
  const std::vector<std::int32_t> owners = topology.read<std::int32_t>("surface_element");
  need_indices(owners, header.elements.size(), "facets of the surface");
  const auto surface = rows<3>(facets, header.dimension);
  need(owners.size() == surface.size(), "not every facet has an element");
  for (const auto& facet : surface) header.surface.push_back({facet, owners[header.surface.size()]});
  const Hdf5Group bodies = root.group("bodies");
  for (std::size_t i = 0; i < member_count(bodies); ++i) {
    const Hdf5Group body = bodies.group(std::to_string(i));
    header.bodies.push_back(body.text("name"));
    const Hdf5Group sets = body.group("sets");
    for (const std::string& name : sets.names())
      header.sets[header.bodies.back() + "/" + sets.group(name).text("name")] =
          sets.group(name).read<std::int32_t>("nodes");
  }
  need_indices(header.element_body, header.bodies.size(), "elements");
  for (const auto& [name, set] : header.sets) need_indices(set, count, "nodes of set " + name);
  const Hdf5Group tools = root.group("tools");
  for (std::size_t i = 0; i < member_count(tools); ++i)
    header.tools.push_back(read_tool(tools.group(std::to_string(i)), header.dimension));
  return header;
}

std::vector<FrameEntry> read_entries(const Hdf5Group& root) {
  std::vector<FrameEntry> entries;
  const Hdf5Group frames = root.group("frames");
  for (const std::string& name : frames.names()) {
    const Hdf5Group frame = frames.group(name), tools = frame.group("tools");
    FrameEntry entry{name, frame.number("time"), frame.integer("step"), frame.integer("interrupted") != 0, {}, frame.has("contact_gap"), frame.has("contact_slip"), frame.has("thickness"), frame.has("damage"), frame.has("limit_ratio")};
    for (std::size_t i = 0; i < member_count(tools); ++i)
      entry.tools_present.push_back(tools.group(std::to_string(i)).integer("present") != 0);
    entries.push_back(std::move(entry));
  }
  return entries;
}

void require_sound(const std::string& path) {
  try {
    bytes_read_apart("result file " + path, path, [&] {
      const Hdf5File file(path, Hdf5File::Mode::read);
      read_header(file.root());
      for (const FrameEntry& entry : read_entries(file.root())) file.root().group("frames").group(entry.name).text("stage");
      return std::vector<char>();
    });
  } catch (const Error& error) {
    throw Error(error.code() == Code::mesh_error ? Code::output_error : error.code(), error.what());
  }
}

ResultReader::ResultReader(const std::string& path)
    : file_((require_sound(path), path), Hdf5File::Mode::read), header_(read_header(file_.root())), frames_(read_entries(file_.root())) {}

Frame ResultReader::frame(std::size_t index) const {
  const FrameEntry& entry = frames_.at(index);
  const Hdf5Group group = file_.root().group("frames").group(entry.name);
  Frame frame;
  frame.time = group.number("time");
  frame.step = group.integer("step");
  frame.stage = group.text("stage");
  frame.interrupted = group.integer("interrupted") != 0;
  const std::size_t count = header_.initial_positions.size(), elements = header_.elements.size(), facets = header_.surface.size();
  frame.positions = nodes(values<double>(group, "positions", 3 * count));
  frame.velocities = nodes(values<double>(group, "velocities", 3 * count));
  frame.plastic_strain = values<float>(group, "plastic_strain", elements);
  const std::vector<float> stress = values<float>(group, "stress", 6 * elements);
  frame.stress.resize(elements);
  for (std::size_t e = 0; e < frame.stress.size(); ++e) std::copy_n(&stress[6 * e], 6, frame.stress[e].begin());
  frame.volume_ratio = values<float>(group, "volume_ratio", elements);
  if (entry.damage) frame.damage = values<float>(group, "damage", elements);
  if (entry.limit) {
    frame.membrane_strain = values<float>(group, "membrane_strain", facets);
    frame.membrane_strain_minor = values<float>(group, "membrane_strain_minor", facets);
    frame.limit_ratio = values<float>(group, "limit_ratio", count);
  }
  frame.contact_pressure = values<float>(group, "contact_pressure", count);
  if (entry.gap) frame.contact_gap = values<float>(group, "contact_gap", count);
  if (entry.slip) frame.contact_slip = values<float>(group, "contact_slip", count);
  frame.surface_strain = values<float>(group, "surface_strain", facets);
  frame.surface_strain_minor = values<float>(group, "surface_strain_minor", facets);
  if (entry.sheet) {
    frame.thickness = values<float>(group, "thickness", count);
    frame.thinning = values<float>(group, "thinning", count);
  }
  const Hdf5Group tools = group.group("tools");
  need(member_count(tools) == header_.tools.size(), "frame " + entry.name + " has " + std::to_string(member_count(tools)) + " tools, the scene " + std::to_string(header_.tools.size()));
  for (std::size_t i = 0; i < header_.tools.size(); ++i) {
    const Hdf5Group tool = tools.group(std::to_string(i));
    FrameTool pose;
    pose.position = vector(tool, "position");
    pose.rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values<double>(tool, "rotation", 9).data());
    pose.force = vector(tool, "force");
    pose.moment = tool.has("moment") ? vector(tool, "moment") : Vec3(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));  // files of before it was kept
    pose.present = tool.integer("present") != 0;
    frame.tools.push_back(pose);
  }
  return frame;
}

}  // namespace forming_sim
