#pragma once
// Cells of one body and kind, with the arrays that they own.
#include <string>
#include <vector>

#include "forming_sim/element/elements.h"

namespace forming_sim {

struct Elements::Group : CellGroup {
  std::vector<int> node_storage;
  std::vector<double> plastic, viscous, lowest;
  enum Rest : char { changed, kept, passed_over };  ///< a block's memory by the last evaluation, or none was needed
  std::vector<Rest> rest;  ///< per block; empty where all are evaluated
  CurveTables curves;
  std::vector<Lane> memory_storage, constants_storage, hourglass_storage;
  std::vector<double> share;  ///< [cell][node] kg, with ElementOptions::shares
  int parts = 0;  ///< simplices of a cell, all of them its one point's in a one-point cell
  int first_element = 0;
  long first_record = 0;
  std::string body;
};

}  // namespace forming_sim
