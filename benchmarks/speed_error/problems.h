#pragma once
#include "report.h"

namespace forming_sim::bench {

// The problems of forming_bench speed-error. One line each here and in speed_error.cpp.
void bending_problem(Report&);   ///< a sheet bent evenly and let go: hardening and perfectly plastic
void cook_problem(Report&);      ///< Cook's membrane, elastic-plastic
void taylor_problem(Report&);    ///< the Taylor bar of copper, 3D and axisymmetric
void cube_problem(Report&);      ///< the swinging cube: linear, exact
void sphere_problem(Report&);    ///< a thick sphere yields from inside
void torsion_problem(Report&);   ///< a round bar yields in torsion and is let go
void impact_problem(Report&);    ///< a bar in uniaxial strain hits a plane, and another bar
void flange_problem(Report&);    ///< scenes/flange.yaml against its own finest mesh
void flange_time_problem(Report&);  ///< the same: mass scaling, tool speed, time step
void slivers_problem(Report&);   ///< a few thin cells in a pulled sheet: the limits of the step, mass for the few
void layers_problem(Report&);    ///< one to ten layers of plasticity in a bent sheet
void release_problem(Report&);   ///< a bent sheet is let go at once, and slowly

}  // namespace forming_sim::bench
