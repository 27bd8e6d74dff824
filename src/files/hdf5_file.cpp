#include "forming_sim/files/hdf5_file.h"

#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "forming_sim/config/fault.h"
#include "forming_sim/files/hdf5_error.h"

namespace forming_sim {
namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t), "HDF5 1.10 or newer");

/// Metadata reaches the file in flush() only, so that what is there between two
/// flushes is a whole file.
void keep_metadata(H5AC_cache_config_t& cache) {
  cache.evictions_enabled = false;
  cache.set_initial_size = true;
  cache.initial_size = cache.max_size;
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
}

/// file: just flushed.
bool forget_metadata(hid_t file) {
  constexpr std::size_t kStays = 64 << 10;  // bytes, of what was used last
  H5AC_cache_config_t cache;
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  if (H5Fget_mdc_config(file, &cache) < 0) return false;
  cache.evictions_enabled = true;
  cache.set_initial_size = true;
  cache.initial_size = cache.min_size = kStays;
  if (H5Fset_mdc_config(file, &cache) < 0) return false;
  const bool looked = H5Lexists(file, "any", H5P_DEFAULT) >= 0;  // room is made when something is looked at
  keep_metadata(cache);
  return H5Fset_mdc_config(file, &cache) >= 0 && looked;
}

Hdf5Handle access_list() {
  Hdf5Handle list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5AC_cache_config_t cache;
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  H5Pget_mdc_config(list.id(), &cache);
  keep_metadata(cache);
  H5Pset_mdc_config(list.id(), &cache);
  H5Pset_libver_bounds(list.id(), H5F_LIBVER_V18, H5F_LIBVER_LATEST);  // what HDF5 1.8 reads: headers of half the size of those before
  // Blocks for small things to come would be cut off again by every flush, and with them what results/disk.h allots.
  H5Pset_meta_block_size(list.id(), 0);
  H5Pset_small_data_block_size(list.id(), 0);
  // A file that is being written can be looked at meanwhile.
  H5Pset_file_locking(list.id(), false, true);
  return list;
}

}  // namespace

Hdf5File::Hdf5File(const std::string& path, Mode mode) : path_(path) {
  silence_hdf5();
  const Hdf5Handle access = access_list(), root(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(root.id(), false);
  switch (mode) {
    case Mode::create:
      handle_ = Hdf5Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, root.id(), access.id()), H5Fclose);
      break;
    case Mode::read: handle_ = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose); break;
    case Mode::append: handle_ = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id()), H5Fclose); break;
  }
  if (!handle_.valid()) throw_hdf5_error(mode == Mode::create ? "create" : "open", path);
}

Hdf5File::~Hdf5File() = default;

Hdf5Group Hdf5File::root() const {
  Hdf5Handle group(H5Gopen2(handle_.id(), "/", H5P_DEFAULT), H5Gclose);
  if (!group.valid()) throw_hdf5_error("open", path_ + ":/");
  return Hdf5Group(std::move(group), path_ + ":");
}

void Hdf5File::flush() {
  if (H5Fflush(handle_.id(), H5F_SCOPE_LOCAL) < 0) throw_hdf5_error("write", path_);
}

void Hdf5File::forget() {
  if (!forget_metadata(handle_.id())) throw_hdf5_error("write", path_);
}

void Hdf5File::close() {
  flush();
  if (!handle_.close()) throw_hdf5_error("close", path_);
}

void write_whole_file(const std::string& path, const std::function<void(Hdf5Group& root)>& fill) {
  const std::string temporary = path + ".part";
  try {
    Hdf5File file(temporary, Hdf5File::Mode::create);
    {
      Hdf5Group root = file.root();
      fill(root);
    }
    file.close();
    if (std::rename(temporary.c_str(), path.c_str()) != 0) throw Error(Code::output_error, "cannot write " + path + ": " + std::strerror(errno));
  } catch (...) {
    std::remove(temporary.c_str());
    throw;
  }
}

}  // namespace forming_sim
