#pragma once
// forming_bench contact exact: problems of contact whose answer is known, by mesh, layer and friction.
#include "report.h"

namespace forming_sim::bench {

std::vector<Row> contact_exact(const Request& request);

// The problems. One line each here and in contact_exact.cpp.
void bounce_problem(Report&);         ///< a mass on a mild layer, by time step
void bars_problem(Report&);           ///< bars in uniaxial strain: on a plane, on each other
void hertz_line_problem(Report&);     ///< a cylinder on a plane and on another one
void hertz_sphere_problem(Report&);   ///< a sphere strikes a plane
void patch_problem(Report&);          ///< two blocks pressed, meshes that match or not
void capstan_problem(Report&);        ///< a strip on a drum
void incline_problem(Report&);        ///< a block that sticks or slides

}  // namespace forming_sim::bench
