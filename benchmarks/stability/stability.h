#pragma once
// forming_bench stability: hard cases, each with what must hold: bounded energy, no
// false inversion, and the right named error where physics ends.
#include <memory>

#include "rows.h"
#include "support/runs.h"

namespace forming_sim::bench {

/// Runs it to its end and gives the rows that every case has: how it ended, and where
/// that is success the error of the energy ledger over the work put in.
std::unique_ptr<Simulation> tried(std::vector<Row>& rows, const std::string& name, const OneBody& run, double ledger, Code right = Code::success);

std::vector<Row> nearly_incompressible(const Request&);  ///< nu .4999, elastic and plastic
std::vector<Row> large_strain(const Request&);           ///< log strains beyond 3, and pressed to nothing
std::vector<Row> bad_shapes(const Request&);             ///< slivers, cells of 50 to 1, one cell through a sheet
std::vector<Row> many_steps(const Request&);             ///< a million steps of a small body
std::vector<Row> ten_million_steps(const Request&);      ///< only where it is asked for
std::vector<Row> spin(const Request&);                   ///< 1000 turns
std::vector<Row> free_swings(const Request&);            ///< of a run with its default time step, elastic and after plastic flow
std::vector<Row> fast_impact(const Request&);            ///< 100 to 1000 m/s and more
std::vector<Row> sudden_loads(const Request&);           ///< full pressure at once; mass scaling by 1e4

}  // namespace forming_sim::bench
