#include "forming_sim/results/xdmf.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace forming_sim {
namespace {

/// Bytes that are not UTF-8, and control characters, which XML knows no way to write, replaced.
std::string readable(const std::string& text) {
  using nlohmann::json;
  std::string result = json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
  std::replace_if(result.begin(), result.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return result;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (char c : readable(text)) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += c;
    }
  }
  return result;
}

/// Writes frames one below the other.
class Writer {
 public:
  Writer(const ResultHeader& header, const std::string& h5_name, Xdmf::Shows shows) : header_(header), h5_(escaped(h5_name)), shows_(shows) {
    out_.precision(17);
  }
  std::string text() const { return out_.str(); }

  void write(const FrameEntry& frame) {
    out_ << "<Grid Name=\"" << frame.name << "\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
         << "<Time Value=\"" << frame.time << "\"/>\n";
    const std::string path = "/frames/" + frame.name + "/";
    if (shows_ == Xdmf::Shows::bodies) bodies(frame, path);
    else surface(frame, path);
    for (std::size_t i = 0; i < header_.tools.size(); ++i)
      if (frame.tools_present.at(i) && !header_.tools[i].points.empty()) tool(i, path);
    out_ << "</Grid>\n";
  }

 private:
  void bodies(const FrameEntry& frame, const std::string& path) {
    const std::size_t elements = header_.elements.size();
    out_ << "<Grid Name=\"" << (header_.bodies.size() == 1 ? escaped(header_.bodies[0]) : "bodies") << "\" GridType=\"Uniform\">\n";
    topology(header_.dimension == 2 ? "Triangle" : "Tetrahedron", header_.dimension + 1, elements, "/topology/elements");
    nodes(frame, path);
    attribute("plastic_strain", "Scalar", "Cell", elements, 1, 4, path + "plastic_strain");
    attribute("stress", "Matrix", "Cell", elements, 6, 4, path + "stress");
    attribute("mises", "Scalar", "Cell", elements, 1, 4, path + "mises");
    attribute("volume_ratio", "Scalar", "Cell", elements, 1, 4, path + "volume_ratio");
    if (frame.damage) attribute("damage", "Scalar", "Cell", elements, 1, 4, path + "damage");
    number("body", elements, "/topology/body");
    out_ << "</Grid>\n";
  }

  void surface(const FrameEntry& frame, const std::string& path) {
    const std::size_t facets = header_.surface.size();
    out_ << "<Grid Name=\"surface\" GridType=\"Uniform\">\n";
    topology(header_.dimension == 2 ? "Polyline" : "Triangle", header_.dimension, facets, "/topology/surface");
    nodes(frame, path);
    for (const char* strain : {"surface_strain", "surface_strain_minor"}) attribute(strain, "Scalar", "Cell", facets, 1, 4, path + strain);
    if (frame.limit)
      for (const char* strain : {"membrane_strain", "membrane_strain_minor"}) attribute(strain, "Scalar", "Cell", facets, 1, 4, path + strain);
    number("element", facets, "/topology/surface_element");
    number("body", facets, "/topology/surface_body");
    out_ << "</Grid>\n";
  }

  /// Where they are, and what lives on them.
  void nodes(const FrameEntry& frame, const std::string& path) {
    const std::size_t nodes = header_.initial_positions.size();
    geometry(nodes, path + "positions");
    attribute("velocities", "Vector", "Node", nodes, 3, 8, path + "velocities");
    attribute("contact_pressure", "Scalar", "Node", nodes, 1, 4, path + "contact_pressure");
    if (frame.gap) attribute("contact_gap", "Scalar", "Node", nodes, 1, 4, path + "contact_gap");
    if (frame.slip) attribute("contact_slip", "Scalar", "Node", nodes, 1, 4, path + "contact_slip");
    if (frame.sheet) {
      attribute("thickness", "Scalar", "Node", nodes, 1, 4, path + "thickness");
      attribute("thinning", "Scalar", "Node", nodes, 1, 4, path + "thinning");
    }
    if (frame.limit) attribute("limit_ratio", "Scalar", "Node", nodes, 1, 4, path + "limit_ratio");
  }

  /// Of each cell.
  void number(const char* name, std::size_t count, const std::string& path) {
    out_ << "<Attribute Name=\"" << name << "\" AttributeType=\"Scalar\" Center=\"Cell\">\n";
    item(count, 1, "Int", 4, path);
    out_ << "</Attribute>\n";
  }

  void tool(std::size_t index, const std::string& frame_path) {
    const ToolShape& shape = header_.tools[index];
    const std::string index_text = std::to_string(index);
    out_ << "<Grid Name=\"tool " << escaped(shape.name) << "\" GridType=\"Uniform\">\n";
    topology(header_.dimension == 2 ? "Polyline" : "Triangle", header_.dimension, shape.facets.size(),
             "/tools/" + index_text + "/facets");
    geometry(shape.points.size(), frame_path + "tools/" + index_text + "/points");
    number("body", shape.facets.size(), "/tools/" + index_text + "/body");
    out_ << "</Grid>\n";
  }

  void topology(const char* type, int corners, std::size_t count, const std::string& path) {
    out_ << "<Topology TopologyType=\"" << type << "\" NodesPerElement=\"" << corners << "\" NumberOfElements=\""
         << count << "\">\n";
    item(count, corners, "Int", 4, path);
    out_ << "</Topology>\n";
  }

  void geometry(std::size_t nodes, const std::string& path) {
    out_ << "<Geometry GeometryType=\"XYZ\">\n";
    item(nodes, 3, "Float", 8, path);
    out_ << "</Geometry>\n";
  }

  void attribute(const char* name, const char* type, const char* centre, std::size_t count, int columns, int precision,
                 const std::string& path) {
    out_ << "<Attribute Name=\"" << name << "\" AttributeType=\"" << type << "\" Center=\"" << centre << "\">\n";
    item(count, columns, "Float", precision, path);
    out_ << "</Attribute>\n";
  }

  void item(std::size_t rows, int columns, const char* type, int precision, const std::string& path) {
    out_ << "<DataItem Dimensions=\"" << rows;
    if (columns > 1) out_ << ' ' << columns;
    out_ << "\" NumberType=\"" << type << "\" Precision=\"" << precision << "\" Format=\"HDF\">" << h5_ << ':' << path
         << "</DataItem>\n";
  }

  const ResultHeader& header_;
  std::string h5_;
  Xdmf::Shows shows_;
  std::ostringstream out_;
};

}  // namespace

std::string Xdmf::text(const std::vector<FrameEntry>& frames) {
  Writer writer(header_, h5_name_, shows_);
  for (; written_ < frames.size(); ++written_) writer.write(frames[written_]);
  grids_ += writer.text();
  return "<?xml version=\"1.0\"?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf Version=\"2.0\">\n<Domain>\n<Grid Name=\"" + escaped(header_.scene_name) +
         "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n" + grids_ + "</Grid>\n</Domain>\n</Xdmf>\n";
}

}  // namespace forming_sim
