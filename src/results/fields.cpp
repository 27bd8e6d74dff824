#include "forming_sim/results/fields.h"

#include "forming_sim/results/snapshot.h"
#include "forming_sim/results/text_file.h"
#include "forming_sim/results/xdmf.h"

namespace forming_sim {

void Fields::on_start(const Simulation& simulation) {
  schedule_.start(simulation.time());
  const std::string path = in_directory(directory_, "result.h5");
  ResultHeader header = take_header(simulation, scene_);
  if (resumed_) {
    file_ = ResultFile::resume(path, header, simulation.steps());
    if (file_) {
      if (!file_->frames().empty()) last_step_ = file_->frames().back().step;
      write_xdmf();
      return;
    }
    record_.notes.push_back("result.h5 begins at the checkpoint: the directory held no result of the earlier part");
  }
  file_.emplace(path, std::move(header));
  write(simulation);
}

void Fields::on_step(const Simulation& simulation) {
  if (schedule_.due(simulation.time())) write(simulation);
}

void Fields::on_stage_end(const Simulation& simulation, int) { write(simulation); }

void Fields::on_end(const Simulation& simulation, Code code, const std::string&) {
  if (!file_ || code == Code::output_error) return;
  write(simulation, code == Code::cancelled);
  if (frames_in_xdmf_ != file_->frames().size()) write_xdmf();
}

void Fields::write(const Simulation& simulation, bool interrupted) {
  if (simulation.steps() == last_step_) return;
  last_step_ = simulation.steps();
  Frame frame = take_frame(simulation, gauge_.at(simulation));
  frame.interrupted = interrupted;
  file_->write(frame);
  // With very many frames not after each: the text grows with every one of them.
  const std::size_t frames = file_->frames().size();
  if (frames <= 100 || frames >= frames_in_xdmf_ + frames_in_xdmf_ / 100) write_xdmf();
}

void Fields::write_xdmf() {
  replace_file(in_directory(directory_, "result.xdmf"), xdmf_text(file_->header(), file_->frames(), "result.h5"));
  frames_in_xdmf_ = file_->frames().size();
}

}  // namespace forming_sim
