#include "forming_sim/files/hdf5_error.h"

#include <hdf5.h>

#include "forming_sim/config/fault.h"

namespace forming_sim {
namespace {

herr_t keep_innermost(unsigned, const H5E_error2_t* entry, void* text) {
  if (entry->desc) *static_cast<std::string*>(text) = entry->desc;
  return 0;
}

/// The system's own words where the library quotes them:
/// "... errno = 28, error message = 'No space left on device', buf = ...".
std::string plain_words(const std::string& description) {
  const std::string mark = "error message = '";
  const std::size_t begin = description.find(mark);
  if (begin == std::string::npos) return description;
  const std::size_t end = description.find('\'', begin + mark.size());
  return description.substr(begin + mark.size(), end - begin - mark.size());
}

}  // namespace

void silence_hdf5() {
  static const bool once = [] { H5dont_atexit(); return true; }();
  (void)once;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void throw_hdf5_error(const std::string& action, const std::string& what) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &reason);
  reason = reason.empty() ? "the HDF5 library gives no reason" : plain_words(reason);
  H5Eclear2(H5E_DEFAULT);
  throw Error(Code::output_error, "cannot " + action + " " + what + ": " + reason);
}

}  // namespace forming_sim
