#pragma once
// What result.h5 holds, as plain data: what stays (ResultHeader) and one
// output time (Frame). Written by ResultFile, read by ResultReader.
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "forming_sim/mesh/mesh.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// A tool's surface in its own frame. A rigid plane has no points; its normal
/// and a point of it are given, in its own frame.
struct ToolShape {
  std::string name;
  std::vector<Vec3> points;                 ///< m
  std::vector<std::array<int, 3>> facets;   ///< segments (third node -1) or triangles
  Vec3 plane_point = Vec3::Zero(), plane_normal = Vec3::Zero();
};

struct ResultHeader {
  std::string version, scene_name, scene_text;
  std::int64_t scene_hash = 0;               ///< of what the scene means: a remark changes nothing
  int dimension = 3;
  bool axisymmetric = false;                 ///< dimension 2: the section is turned about the y axis
  std::vector<std::array<int, 4>> elements;  ///< simplices of all bodies, dimension + 1 nodes each
  std::vector<int> element_body;             ///< index of the body, per element
  std::vector<std::string> bodies;
  std::vector<std::string> sheet_sides;      ///< per body the sets that its thickness is between, "bottom top"; "" of what is no sheet
  std::vector<std::vector<std::array<double, 2>>> forming_limits;  ///< per body the points of its curve, minor and major strain; empty of what has none
  NodeField initial_positions;               ///< m
  std::vector<Facet> surface;
  std::map<std::string, std::vector<int>> sets;  ///< "body/set": nodes
  std::vector<ToolShape> tools;
};

/// Where a tool stands: x = position + rotation X.
struct FrameTool {
  Vec3 position = Vec3::Zero();        ///< m
  Mat3 rotation = Mat3::Identity();
  Vec3 force = Vec3::Zero();           ///< on the tool; N (N/m in plane strain)
  Vec3 moment = Vec3::Zero();          ///< about `position`, N m (N in plane strain)
  bool present = true;                 ///< false once withdrawn
};

/// Node fields are kept in double, element and facet fields in single precision.
struct Frame {
  double time = 0;                     ///< s
  long step = 0;
  std::string stage;
  bool interrupted = false;            ///< written because the run was cancelled here; a resumed run drops it
  NodeField positions, velocities;     ///< m, m/s
  std::vector<float> plastic_strain;   ///< equivalent, per element
  std::vector<std::array<float, 6>> stress;  ///< Cauchy, Pa, per element: xx yy zz xy yz zx
  std::vector<float> volume_ratio;     ///< V/V0, per element
  std::vector<float> damage;           ///< material/damage.h, per element; NaN of bodies without, empty where none has it
  std::string damage_unit;
  std::vector<float> surface_strain, surface_strain_minor;  ///< principal log strains in the surface, the larger and the smaller, per surface facet
  std::vector<float> membrane_strain, membrane_strain_minor;  ///< the same of the middle of sheets with a forming limit (results/forming_limits.h), per surface facet; NaN elsewhere, empty where no body has one
  std::vector<float> limit_ratio;      ///< of the forming limit, per node; likewise
  std::vector<float> thickness, thinning;  ///< of sheets, m and 1, per node; NaN elsewhere, empty where no body is a sheet (results/thickness.h)
  std::vector<float> contact_pressure; ///< normal, Pa, per node; 0 inside, below 0 where a tie pulls
  std::vector<float> contact_gap;      ///< to the nearest other surface, m, per node; empty where nothing can meet
  std::vector<float> contact_slip;     ///< slid so far, m, per node; empty where nothing rubs
  std::vector<FrameTool> tools;         ///< in the order of ResultHeader::tools
};

/// von Mises stress of xx yy zz xy yz zx.
float mises_stress(const std::array<float, 6>& stress);

/// One frame's place in the file.
struct FrameEntry {
  std::string name;                    ///< "000012"
  double time = 0;
  long step = 0;
  bool interrupted = false;
  std::vector<bool> tools_present;
  bool gap = false, slip = false, sheet = false, damage = false, limit = false;  ///< has contact_gap, contact_slip, thickness and thinning, damage, limit_ratio
};

}  // namespace forming_sim
