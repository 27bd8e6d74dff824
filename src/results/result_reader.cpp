#include "forming_sim/results/result_reader.h"

#include <algorithm>

namespace forming_sim {
namespace {

template <std::size_t N>
std::vector<std::array<int, N>> rows(const std::vector<std::int32_t>& flat, std::size_t columns) {
  std::vector<std::array<int, N>> rows(flat.size() / columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].fill(-1);
    std::copy_n(&flat[i * columns], columns, rows[i].begin());
  }
  return rows;
}

NodeField nodes(const std::vector<double>& flat) {
  NodeField nodes(flat.size() / 3);
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = Node(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2], 0);
  return nodes;
}

Vec3 vector(const Hdf5Group& group, const std::string& name) {
  return Eigen::Map<const Vec3>(group.read<double>(name).data());
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
  shape.facets = rows<3>(tool.read<std::int32_t>("facets"), dimension);
  return shape;
}

}  // namespace

ResultHeader read_header(const Hdf5Group& root) {
  ResultHeader header;
  header.version = root.text("version");
  header.scene_name = root.text("scene");
  header.scene_text = root.read_text("scene_text");
  header.dimension = static_cast<int>(root.integer("dimension"));
  header.axisymmetric = root.integer("axisymmetric") != 0;
  const Hdf5Group topology = root.group("topology");
  header.elements = rows<4>(topology.read<std::int32_t>("elements"), header.dimension + 1);
  header.element_body = topology.read<std::int32_t>("body");
  const std::vector<std::int32_t> owners = topology.read<std::int32_t>("surface_element");
  for (const auto& facet : rows<3>(topology.read<std::int32_t>("surface"), header.dimension))
    header.surface.push_back({facet, owners[header.surface.size()]});
  header.initial_positions = nodes(topology.read<double>("initial_positions"));
  const Hdf5Group bodies = root.group("bodies");
  for (std::size_t i = 0; i < member_count(bodies); ++i) {
    const Hdf5Group body = bodies.group(std::to_string(i));
    header.bodies.push_back(body.text("name"));
    const Hdf5Group sets = body.group("sets");
    for (const std::string& name : sets.names())
      header.sets[header.bodies.back() + "/" + sets.group(name).text("name")] =
          sets.group(name).read<std::int32_t>("nodes");
  }
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
    FrameEntry entry{name, frame.number("time"), frame.integer("step"), frame.integer("interrupted") != 0, {}, frame.has("contact_gap"), frame.has("contact_slip"), frame.has("thickness")};
    for (std::size_t i = 0; i < member_count(tools); ++i)
      entry.tools_present.push_back(tools.group(std::to_string(i)).integer("present") != 0);
    entries.push_back(std::move(entry));
  }
  return entries;
}

ResultReader::ResultReader(const std::string& path)
    : file_(path, Hdf5File::Mode::read), header_(read_header(file_.root())), frames_(read_entries(file_.root())) {}

Frame ResultReader::frame(std::size_t index) const {
  const FrameEntry& entry = frames_.at(index);
  const Hdf5Group group = file_.root().group("frames").group(entry.name);
  Frame frame;
  frame.time = group.number("time");
  frame.step = group.integer("step");
  frame.stage = group.text("stage");
  frame.interrupted = group.integer("interrupted") != 0;
  frame.positions = nodes(group.read<double>("positions"));
  frame.velocities = nodes(group.read<double>("velocities"));
  frame.plastic_strain = group.read<float>("plastic_strain");
  const std::vector<float> stress = group.read<float>("stress");
  frame.stress.resize(stress.size() / 6);
  for (std::size_t e = 0; e < frame.stress.size(); ++e) std::copy_n(&stress[6 * e], 6, frame.stress[e].begin());
  frame.volume_ratio = group.read<float>("volume_ratio");
  frame.contact_pressure = group.read<float>("contact_pressure");
  if (entry.gap) frame.contact_gap = group.read<float>("contact_gap");
  if (entry.slip) frame.contact_slip = group.read<float>("contact_slip");
  frame.surface_strain = group.read<float>("surface_strain");
  frame.surface_strain_minor = group.read<float>("surface_strain_minor");
  if (entry.sheet) {
    frame.thickness = group.read<float>("thickness");
    frame.thinning = group.read<float>("thinning");
  }
  const Hdf5Group tools = group.group("tools");
  for (std::size_t i = 0; i < member_count(tools); ++i) {
    const Hdf5Group tool = tools.group(std::to_string(i));
    FrameTool pose;
    pose.position = vector(tool, "position");
    pose.rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(tool.read<double>("rotation").data());
    pose.force = vector(tool, "force");
    pose.present = tool.integer("present") != 0;
    frame.tools.push_back(pose);
  }
  return frame;
}

}  // namespace forming_sim
