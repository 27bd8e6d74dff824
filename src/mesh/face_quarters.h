#pragma once
// How whole faces of a generated sheet are divided.

namespace forming_sim {

/// By so many quarter turns about the third direction the corners of a cell of a sheet are numbered on: 0, 1, 2, 3 in the quarters of its face, one after the other. A face that
/// stays whole is divided as the tetrahedra of hex6 are, from its first corner on, and diagonals that all run one way let what is symmetric drift in contact: these mirror about both middles of the sheet.
inline int quarter_of(bool right, bool behind) { return behind ? (right ? 2 : 3) : (right ? 1 : 0); }

}  // namespace forming_sim
