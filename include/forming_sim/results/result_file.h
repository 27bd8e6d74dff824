#pragma once
// result.h5, the fields of a run:
//
//   /                       attributes version, scene, scene_hash, dimension, axisymmetric; dataset scene_text
//   /topology/elements      n x 3|4 int32, corner nodes of the simplices
//   /topology/body          n int32, index into the attribute names of /bodies
//   /topology/surface       m x 2|3 int32, boundary facets, normal outwards
//   /topology/surface_element  m int32, the element of each facet
//   /topology/surface_body  m int32, its body
//   /topology/initial_positions  nodes x 3, m (z = 0 in dimension 2)
//   /bodies/<index>         attributes name, thickness_between ("bottom top"); forming_limit, minor and major strains; sets/<index>: attribute name, nodes, int32
//   /tools/<index>          attribute name; points (m), facets and their number body, -1, -2, ... by the tool, or plane_point and plane_normal
//   /frames/NNNNNN          attributes time, step, stage, interrupted; positions, velocities, plastic_strain,
//                           contact_pressure, contact_gap where anything can meet, contact_slip
//                           where anything rubs, stress (xx yy zz xy yz zx), mises, volume_ratio, surface_strain, surface_strain_minor, damage where a body has it,
//                           membrane_strain, membrane_strain_minor and limit_ratio where a body has a forming limit, thickness and thinning where one is a sheet;
//                           tools/<index>: points (m, as they stand), position, rotation, force, moment,
//                           attribute present
//
// Every dataset has the attribute "unit". A frame is listed in /frames only
// after all of it is in the file, so the file is readable up to the last
// complete frame wherever the program is stopped.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/results/frame.h"
#include "forming_sim/files/hdf5_file.h"

namespace forming_sim {

/// Where there is a file at `path`: throws Error(output_error) unless it is of this scene, mesh and version, whole or cut off after a frame.
void require_first_part(const std::string& path, const ResultHeader& header);

/// Writes result.h5. All functions throw Error(output_error) with file, dataset and reason.
class ResultFile {
 public:
  /// A new file; an old one of that name is replaced.
  /// frames: how many there will be, as far as is known.
  ResultFile(const std::string& path, ResultHeader header, std::size_t frames = 64);
  /// Goes on with the file of the run's first part: frames after `step` are dropped. nullopt where there is no file. Throws as require_first_part().
  static std::optional<ResultFile> resume(const std::string& path, ResultHeader header, long step);

  /// Throws Error(output_error); the frames before stay readable, also on a full disk.
  void write(const Frame& frame);
  /// After the last frame: frees room on the disk that was kept for more.
  void finish();
  const std::vector<FrameEntry>& frames() const { return frames_; }
  const ResultHeader& header() const { return header_; }

 private:
  ResultFile(const std::string& path, ResultHeader header, Hdf5File file);
  void write_tool(Hdf5Group& tools, const Frame& frame, std::size_t index);

  std::string path_;
  ResultHeader header_;
  Hdf5File file_;
  std::vector<FrameEntry> frames_;
  std::vector<FrameTool> last_poses_;   ///< of the last frame written here
};

}  // namespace forming_sim
