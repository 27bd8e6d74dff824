#include "forming_sim/results/fields.h"

#include <algorithm>
#include <exception>

#include "forming_sim/config/fault.h"
#include "forming_sim/config/words.h"
#include "forming_sim/results/snapshot.h"
#include "forming_sim/results/spanned_corner.h"
#include "forming_sim/results/text_file.h"

namespace forming_sim {
void Fields::on_start(const Simulation& simulation) {
  schedule_.start(simulation.time());
  const std::string path = in_directory(directory_, "result.h5");
  ResultHeader header = take_header(simulation, scene_, meaning_);
  if (resumed_) {
    file_ = ResultFile::resume(path, header, simulation.steps());
    if (file_) {
      const FrameEntry* last = file_->frames().empty() ? nullptr : &file_->frames().back();
      if (last) last_step_ = last->step;
      if (!last || schedule_.due_between(last->time, simulation.time()))
        record_.notes.push_back("result.h5 holds no frames between " + (last ? number_text(last->time) : "0") + " s and the checkpoint, " + number_text(simulation.time()) + " s: it is that of a shorter first part");
      open_xdmf();
      write_xdmf();
      return;
    }
    record_.notes.push_back("result.h5 begins at the checkpoint: the directory held no result of the earlier part");
  }
  const double time = longest_time(scene_.stages), frames = std::min(schedule_.times(time), time / simulation.dt());
  file_.emplace(path, std::move(header), static_cast<std::size_t>(std::min(1e5, frames + static_cast<double>(scene_.stages.size()) + 2)));
  open_xdmf();
  write(simulation);
}

void Fields::on_step(const Simulation& simulation) {
  if (schedule_.due(simulation.time())) write(simulation);
}

void Fields::on_stage_end(const Simulation& simulation, int) { write(simulation); }

void Fields::on_end(const Simulation& simulation, Code code, const std::string&) {
  if (!file_) return;
  // Whatever fails: frames that are in the one file are listed in the other, and the room that was kept is free for what is written after these.
  std::exception_ptr failed;
  const auto attempt = [&](auto&& work) {
    try {
      work();
    } catch (const std::exception&) {
      if (!failed) failed = std::current_exception();
    }
  };
  if (code != Code::output_error) attempt([&] { write(simulation, code == Code::cancelled); });
  file_->finish();
  if (frames_in_xdmf_ != file_->frames().size()) attempt([&] { write_xdmf(); });
  if (failed && code != Code::output_error) std::rethrow_exception(failed);
}

void Fields::write(const Simulation& simulation, bool interrupted) {
  if (simulation.steps() == last_step_) return;
  last_step_ = simulation.steps();
  Frame frame = take_frame(simulation, gauge_.at(simulation));
  frame.interrupted = interrupted;
  file_->write(frame);
  if (interrupted) return;  // a run that is resumed takes no such frame, and goes on with what the checkpoint knows of this record
  record_.pressed.rise_to(greatest_pressure(simulation, frame.stress));
  record_.spanned.rise_to(farthest_spanned_corner(simulation, frame.contact_gap));
  record_.pressed_cells.rise_to(number_of_pressed_cells(simulation));
  if (Clock::now() >= xdmf_due_) write_xdmf();
}

void Fields::open_xdmf() {
  xdmf_.emplace(file_->header(), "result.h5", Xdmf::Shows::bodies);
  surface_xdmf_.emplace(file_->header(), "result.h5", Xdmf::Shows::surface);
}

// All of it is written each time. So with the first frame after a second, and for no more than a hundredth of the time of a run.
void Fields::write_xdmf() {
  const Clock::time_point start = Clock::now();
  replace_file(in_directory(directory_, "result.xdmf"), xdmf_->text(file_->frames()));
  replace_file(in_directory(directory_, "surface.xdmf"), surface_xdmf_->text(file_->frames()));
  frames_in_xdmf_ = file_->frames().size();
  const Clock::time_point end = Clock::now();
  xdmf_due_ = end + std::max<Clock::duration>(std::chrono::seconds(1), 100 * (end - start));
}

}  // namespace forming_sim
