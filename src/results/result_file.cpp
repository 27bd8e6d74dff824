#include "forming_sim/results/result_file.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "forming_sim/config/fault.h"
#include "forming_sim/results/disk.h"
#include "forming_sim/results/result_reader.h"
#include "result_header.h"

namespace forming_sim {
namespace {

std::string frame_name(std::size_t number) {
  char name[32];
  std::snprintf(name, sizeof name, "%06zu", number);
  return name;
}

/// What is another in the file than in the run; empty where nothing is.
std::string difference(const ResultHeader& file, const ResultHeader& run) {
  if (file.version != run.version) return "it was written by version " + file.version + ", this is version " + run.version;
  if (file.scene_name != run.scene_name) return "it is of the scene " + file.scene_name + ", this is " + run.scene_name;
  if (file.scene_hash != run.scene_hash) return "its scene " + file.scene_name + " has other values";
  if (file.dimension != run.dimension || file.elements != run.elements || file.initial_positions != run.initial_positions) return "its bodies have another mesh";
  if (file.tools.size() != run.tools.size()) return "it has " + std::to_string(file.tools.size()) + " tools, this run " + std::to_string(run.tools.size());
  return "";
}

void write_fields(Hdf5Group& group, const Frame& frame) {
  const std::uint64_t nodes = frame.positions.size(), elements = frame.stress.size();
  // All digits of places, speeds and stresses are in use: to pack them saves little, and takes a quarter of the time that output takes.
  group.write("positions", coordinates(frame.positions).data(), {nodes, 3}, "m", Storage::plain);
  group.write("velocities", coordinates(frame.velocities).data(), {nodes, 3}, "m/s", Storage::plain);
  group.write("contact_pressure", frame.contact_pressure.data(), {frame.contact_pressure.size()}, "Pa");
  if (!frame.contact_gap.empty()) group.write("contact_gap", frame.contact_gap.data(), {nodes}, "m");
  if (!frame.contact_slip.empty()) group.write("contact_slip", frame.contact_slip.data(), {nodes}, "m");
  group.write("plastic_strain", frame.plastic_strain.data(), {frame.plastic_strain.size()}, "1");
  group.write("stress", elements ? frame.stress[0].data() : nullptr, {elements, 6}, "Pa", Storage::plain);
  std::vector<float> mises(frame.stress.size());
  for (std::size_t e = 0; e < mises.size(); ++e) mises[e] = mises_stress(frame.stress[e]);
  group.write("mises", mises.data(), {elements}, "Pa", Storage::plain);
  group.write("volume_ratio", frame.volume_ratio.data(), {frame.volume_ratio.size()}, "1");
  if (!frame.damage.empty()) group.write("damage", frame.damage.data(), {elements}, frame.damage_unit);
  group.write("surface_strain", frame.surface_strain.data(), {frame.surface_strain.size()}, "1");
  group.write("surface_strain_minor", frame.surface_strain_minor.data(), {frame.surface_strain_minor.size()}, "1");
  if (!frame.limit_ratio.empty()) {
    group.write("membrane_strain", frame.membrane_strain.data(), {frame.membrane_strain.size()}, "1");
    group.write("membrane_strain_minor", frame.membrane_strain_minor.data(), {frame.membrane_strain_minor.size()}, "1");
    group.write("limit_ratio", frame.limit_ratio.data(), {nodes}, "1");
  }
  if (frame.thickness.empty()) return;
  group.write("thickness", frame.thickness.data(), {nodes}, "m");
  group.write("thinning", frame.thinning.data(), {nodes}, "1");
}

/// At most what a frame takes in the file: its values as they are, and 4 KiB a data set and group for what describes them.
std::uint64_t most_bytes(const Frame& frame, const ResultHeader& header) {
  std::uint64_t bytes = 25 * 4096;
  bytes += frame.positions.size() * (6 * sizeof(double) + 6 * sizeof(float)) + frame.stress.size() * 10 * sizeof(float) +
           4 * frame.surface_strain.size() * sizeof(float);
  for (const ToolShape& tool : header.tools) bytes += 6 * 4096 + tool.points.size() * 3 * sizeof(double);
  return bytes;
}

}  // namespace

float mises_stress(const std::array<float, 6>& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  const double shear = double(s[3]) * s[3] + double(s[4]) * s[4] + double(s[5]) * s[5];
  return static_cast<float>(std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * shear));
}

ResultFile::ResultFile(const std::string& path, ResultHeader header, Hdf5File file) : path_(path), header_(std::move(header)), file_(std::move(file)) {}

ResultFile::ResultFile(const std::string& path, ResultHeader header, std::size_t frames)
    : path_(path), header_(std::move(header)), file_(path, Hdf5File::Mode::create) {
  write_header(file_.root(), header_, frames);
  file_.flush();
}

void require_first_part(const std::string& path, const ResultHeader& header) {
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown)) return;
  try {
    require_sound(path);
    const Hdf5File file(path, Hdf5File::Mode::read);
    if (const std::string why = difference(read_header(file.root()), header); !why.empty()) throw Error(Code::output_error, why);
  } catch (const Error& error) {
    throw Error(Code::output_error, "cannot go on with " + path + ": " + error.what() + "; resume into the directory of the run's first part, or into one without a result.h5");
  }
}

std::optional<ResultFile> ResultFile::resume(const std::string& path, ResultHeader header, long step) {
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown)) return std::nullopt;
  require_first_part(path, header);
  Hdf5File file(path, Hdf5File::Mode::append);
  ResultFile result(path, std::move(header), std::move(file));
  Hdf5Group frames = result.file_.root().group("frames");
  for (FrameEntry& entry : read_entries(result.file_.root())) {
    if (entry.step > step || entry.interrupted) frames.remove(entry.name);
    else result.frames_.push_back(std::move(entry));
  }
  result.file_.flush();
  return result;
}

void ResultFile::write(const Frame& frame) {
  allot(path_, most_bytes(frame, header_));
  const std::string name = frame_name(frames_.size());
  Hdf5Group frames = file_.root().group("frames");
  Hdf5Group group = frames.create_unlinked(name);
  group.set("time", frame.time);
  group.set("time_unit", "s");
  group.set("step", std::int64_t{frame.step});
  group.set("stage", frame.stage);
  group.set("interrupted", std::int64_t{frame.interrupted});
  write_fields(group, frame);
  Hdf5Group tools = group.create("tools");
  FrameEntry entry{name, frame.time, frame.step, frame.interrupted, {}, !frame.contact_gap.empty(), !frame.contact_slip.empty(), !frame.thickness.empty(), !frame.damage.empty(), !frame.limit_ratio.empty()};
  for (std::size_t i = 0; i < frame.tools.size(); ++i) {
    write_tool(tools, frame, i);
    entry.tools_present.push_back(frame.tools[i].present);
  }
  file_.flush();             // the frame is in the file,
  frames.link(group, name);  // then it is listed
  file_.flush();
  file_.forget();
  frames_.push_back(std::move(entry));
  last_poses_ = frame.tools;
}

void ResultFile::finish() { give_back(path_); }

void ResultFile::write_tool(Hdf5Group& tools, const Frame& frame, std::size_t index) {
  const FrameTool& pose = frame.tools[index];
  const std::string name = std::to_string(index);
  Hdf5Group tool = tools.create(name);
  tool.set("present", std::int64_t{pose.present});
  tool.write("position", pose.position.data(), {3}, "m", Storage::plain);
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = pose.rotation;
  tool.write("rotation", rotation.data(), {3, 3}, "1", Storage::plain);
  const bool per_width = header_.dimension == 2 && !header_.axisymmetric;
  tool.write("force", pose.force.data(), {3}, per_width ? "N/m" : "N", Storage::plain);
  tool.write("moment", pose.moment.data(), {3}, per_width ? "N" : "N m", Storage::plain);
  const std::vector<Vec3>& shape = header_.tools.at(index).points;
  if (shape.empty()) return;
  const bool rests = index < last_poses_.size() && last_poses_[index].position == pose.position &&
                     last_poses_[index].rotation == pose.rotation;
  if (rests) {
    const Hdf5Group last = file_.root().group("frames").group(frames_.back().name).group("tools").group(name);
    tool.link(last, "points", "points");
    return;
  }
  std::vector<Vec3> points;
  for (const Vec3& x : shape) points.push_back(pose.position + pose.rotation * x);
  tool.write("points", points[0].data(), {points.size(), 3}, "m");
}

}  // namespace forming_sim
