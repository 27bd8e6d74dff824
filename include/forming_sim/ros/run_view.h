#pragma once
// What of a run is drawn and published: taken from a running simulation or from
// a result file, so that both look the same.
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "forming_sim/loads/tool.h"
#include "forming_sim/mesh/mesh.h"
#include "forming_sim/simulation/observer.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// What stays while the run goes on.
struct RunShape {
  std::string scene;
  int dimension = 3;
  NodeField initial_positions;              ///< m
  std::vector<std::array<int, 4>> elements; ///< dimension + 1 corners each
  std::vector<Facet> surface;
  std::vector<std::string> bodies;
  std::vector<int> first_element;           ///< of each body
  std::vector<ToolModel> tools;
};

/// One instant of it.
struct RunFrame {
  double time = 0;                          ///< s
  long step = 0;
  std::string stage;
  NodeField positions;                      ///< m
  std::vector<double> plastic_strain;       ///< per element
  std::vector<double> contact_pressure, contact_gap, contact_slip;  ///< per node, Pa, m, m; empty where not asked for, and where nothing can meet or rub
  std::vector<double> damage;               ///< per element; empty where not asked for and where no material has it (material/damage.h)
  std::vector<double> thinning;             ///< per node; empty where not asked for and where no body is a sheet (results/thickness.h)
  std::vector<double> limit_ratio;          ///< per node; empty where not asked for and where no material has a forming limit (results/forming_limits.h)
  std::vector<ToolStatus> tools;            ///< as RunShape::tools
  /// False where a position or a strain is not a finite number.
  bool is_finite() const;
};

RunShape shape_of(const Simulation& simulation, const std::string& scene);
/// contact: with the fields of contact, which are searched for.
RunFrame frame_of(const Simulation& simulation, bool contact);

/// The box around the nodes; where there is none, the origin.
Eigen::AlignedBox3d box_of(const NodeField& positions);

}  // namespace forming_sim
