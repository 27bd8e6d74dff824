#include <hdf5.h>

#include <algorithm>
#include <functional>

#include "forming_sim/config/fault.h"
#include "forming_sim/files/hdf5_error.h"
#include "forming_sim/files/hdf5_file.h"

namespace forming_sim {
namespace {

template <class T> hid_t native();
template <> hid_t native<double>() { return H5T_NATIVE_DOUBLE; }
template <> hid_t native<float>() { return H5T_NATIVE_FLOAT; }
template <> hid_t native<std::int32_t>() { return H5T_NATIVE_INT32; }
template <> hid_t native<std::int64_t>() { return H5T_NATIVE_INT64; }
template <> hid_t native<std::uint8_t>() { return H5T_NATIVE_UINT8; }

constexpr std::uint64_t kChunkBytes = 1u << 20;
constexpr std::uint64_t kCompactBytes = 1024;     ///< what is no longer lies in the header of its dataset
constexpr std::uint64_t kPackedBytes = 1u << 16;  ///< of less the index of a chunk is as large as what packing saves, and packing most of the time that writing takes

/// What creates a dataset; like groups it keeps no times, so that the same run gives the same file.
Hdf5Handle dataset_list() {
  Hdf5Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(list.id(), false);
  return list;
}

/// Kept, and closed by the library at its end: to make a list anew takes as long as to write what is small.
Hdf5Handle kept_list(bool compact) {
  const auto of = [](H5D_layout_t layout) {
    const Hdf5Handle list = dataset_list();
    H5Pset_layout(list.id(), layout);
    return H5Pcopy(list.id());
  };
  static const hid_t in_header = of(H5D_COMPACT), plain = of(H5D_CONTIGUOUS);
  return Hdf5Handle(compact ? in_header : plain, nullptr);
}

/// Chunks of whole rows of about a megabyte.
Hdf5Handle packed_list(const std::vector<std::uint64_t>& shape, std::uint64_t row_bytes) {
  Hdf5Handle list = dataset_list();
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  chunk[0] = std::clamp<hsize_t>(kChunkBytes / row_bytes, 1, shape[0]);
  H5Pset_chunk(list.id(), static_cast<int>(chunk.size()), chunk.data());
  H5Pset_shuffle(list.id());
  H5Pset_deflate(list.id(), 1);
  return list;
}

Hdf5Handle creation_list(const std::vector<std::uint64_t>& shape, std::uint64_t size, Storage storage) {
  std::uint64_t row_bytes = size;
  for (std::size_t axis = 1; axis < shape.size(); ++axis) row_bytes *= shape[axis];
  const std::uint64_t bytes = shape[0] * row_bytes;
  if (bytes == 0) return kept_list(false);
  if (bytes <= kCompactBytes) return kept_list(true);
  if (storage == Storage::plain || bytes < kPackedBytes) return kept_list(false);
  return packed_list(shape, row_bytes);
}

/// All links lie in the header of their group, which has room for so many, and not in an index: whoever reads the file meanwhile
/// would find the parts of an index that do not fit each other, and HDF5 does not bear that. A header has a checksum.
Hdf5Handle links_in_header(std::size_t links) {
  constexpr unsigned kMost = 65535, kLength = 12;
  Hdf5Handle list(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(list.id(), false);
  H5Pset_link_phase_change(list.id(), kMost, 0);
  H5Pset_est_link_info(list.id(), static_cast<unsigned>(std::min<std::size_t>(links, kMost)), kLength);
  return list;
}

Hdf5Handle text_type(std::size_t length) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), std::max<std::size_t>(length, 1));
  H5Tset_strpad(type.id(), length == H5T_VARIABLE ? H5T_STR_NULLTERM : H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

std::string without_padding(std::string text) {
  text.resize(text.find_last_not_of('\0') + 1);
  return text;
}

/// False where it could not be written.
bool put_attribute(hid_t object, const std::string& name, hid_t type, const void* value) {
  static const hid_t scalar = H5Screate(H5S_SCALAR);  // the library closes it at its end
  const Hdf5Handle attribute(H5Acreate2(object, name.c_str(), type, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.valid() && H5Awrite(attribute.id(), type, value) >= 0;
}

/// Of variable length: what h5py shows as str.
bool put_attribute(hid_t object, const std::string& name, const std::string& value) {
  static const hid_t type = H5Tcopy(text_type(H5T_VARIABLE).id());
  const char* text = value.c_str();
  return put_attribute(object, name, type, &text);
}

bool get_attribute(hid_t object, const std::string& name, hid_t type, void* value) {
  const Hdf5Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  return attribute.valid() && H5Aread(attribute.id(), type, value) >= 0;
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

}  // namespace

void Hdf5Group::fail(const std::string& action, const std::string& name) const {
  throw_hdf5_error(action, label_ + "/" + name);
}

template <class T>
void Hdf5Group::write(const std::string& name, const T* data, const std::vector<std::uint64_t>& shape,
                      const std::string& unit, Storage storage) {
  const std::vector<hsize_t> size(shape.begin(), shape.end());
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
  const Hdf5Handle list = creation_list(shape, sizeof(T), storage);
  Hdf5Handle set(
      H5Dcreate2(handle_.id(), name.c_str(), native<T>(), space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT), H5Dclose);
  if (!set.valid()) fail("create dataset", name);
  const bool empty = std::find(shape.begin(), shape.end(), 0u) != shape.end();
  if (!empty && H5Dwrite(set.id(), native<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) fail("write dataset", name);
  if (!unit.empty() && !put_attribute(set.id(), "unit", unit)) fail("write the unit of", name);
  if (!set.close()) fail("write dataset", name);  // what is packed reaches the file here
}

template <class T>
std::vector<T> Hdf5Group::read(const std::string& name) const {
  const Hdf5Handle set(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.valid()) fail("open dataset", name);
  const Hdf5Handle space(H5Dget_space(set.id()), H5Sclose);
  std::vector<T> data(static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space.id()), 0)));
  if (!data.empty() && H5Dread(set.id(), native<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) < 0)
    fail("read dataset", name);
  return data;
}

#define FORMING_SIM_HDF5_TYPE(T)                                                                                 \
  template void Hdf5Group::write<T>(const std::string&, const T*, const std::vector<std::uint64_t>&,              \
                                    const std::string&, Storage);                                                \
  template std::vector<T> Hdf5Group::read<T>(const std::string&) const;
FORMING_SIM_HDF5_TYPE(double)
FORMING_SIM_HDF5_TYPE(float)
FORMING_SIM_HDF5_TYPE(std::int32_t)
FORMING_SIM_HDF5_TYPE(std::uint8_t)
#undef FORMING_SIM_HDF5_TYPE

void Hdf5Group::write_text(const std::string& name, const std::string& text) {
  const Hdf5Handle type = text_type(text.size());
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle set(
      H5Dcreate2(handle_.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, dataset_list().id(), H5P_DEFAULT), H5Dclose);
  if (!set.valid()) fail("create dataset", name);
  const std::string value = text.empty() ? std::string(1, '\0') : text;
  if (H5Dwrite(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0) fail("write dataset", name);
}

std::string Hdf5Group::read_text(const std::string& name) const {
  const Hdf5Handle set(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.valid()) fail("open dataset", name);
  const Hdf5Handle type(H5Dget_type(set.id()), H5Tclose);
  std::string value(H5Tget_size(type.id()), '\0');
  if (H5Dread(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0) fail("read dataset", name);
  return without_padding(value);
}

namespace {
std::string hash_of(const std::string& name) { return name + "_hash"; }
std::int64_t hash(const std::string& bytes) { return static_cast<std::int64_t>(std::hash<std::string>()(bytes)); }
}  // namespace

void Hdf5Group::write_checked(const std::string& name, const std::string& bytes) {
  write(name, reinterpret_cast<const std::uint8_t*>(bytes.data()), {bytes.size()}, "", Storage::plain);
  set(hash_of(name), hash(bytes));
}

std::string Hdf5Group::read_checked(const std::string& name) const {
  const std::vector<std::uint8_t> read_bytes = read<std::uint8_t>(name);
  std::string bytes(read_bytes.begin(), read_bytes.end());
  if (integer(hash_of(name)) != hash(bytes)) throw Error(Code::output_error, label_ + "/" + name + " is not what was written: its bytes have another hash");
  return bytes;
}

void Hdf5Group::set(const std::string& attribute, const std::string& value) {
  if (!put_attribute(handle_.id(), attribute, value)) fail("write attribute", attribute);
}
void Hdf5Group::set(const std::string& attribute, double value) {
  if (!put_attribute(handle_.id(), attribute, native<double>(), &value)) fail("write attribute", attribute);
}
void Hdf5Group::set(const std::string& attribute, std::int64_t value) {
  if (!put_attribute(handle_.id(), attribute, native<std::int64_t>(), &value)) fail("write attribute", attribute);
}

std::string Hdf5Group::text(const std::string& attribute) const {
  const Hdf5Handle handle(H5Aopen(handle_.id(), attribute.c_str(), H5P_DEFAULT), H5Aclose);
  if (!handle.valid()) fail("read attribute", attribute);
  const Hdf5Handle type = text_type(H5T_VARIABLE);
  char* value = nullptr;
  if (H5Aread(handle.id(), type.id(), &value) < 0) fail("read attribute", attribute);
  const std::string text = value ? value : "";
  H5free_memory(value);
  return text;
}
double Hdf5Group::number(const std::string& attribute) const {
  double value = 0;
  if (!get_attribute(handle_.id(), attribute, native<double>(), &value)) fail("read attribute", attribute);
  return value;
}
std::int64_t Hdf5Group::integer(const std::string& attribute) const {
  std::int64_t value = 0;
  if (!get_attribute(handle_.id(), attribute, native<std::int64_t>(), &value)) fail("read attribute", attribute);
  return value;
}

bool Hdf5Group::has(const std::string& name) const {
  return H5Lexists(handle_.id(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5Group::names() const {
  std::vector<std::string> names;
  hsize_t position = 0;
  if (H5Literate(handle_.id(), H5_INDEX_NAME, H5_ITER_INC, &position, collect_name, &names) < 0) fail("list", "");
  return names;
}

Hdf5Group Hdf5Group::group(const std::string& name) const {
  Hdf5Handle group(H5Gopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Gclose);
  if (!group.valid()) fail("open group", name);
  return Hdf5Group(std::move(group), label_ + "/" + name);
}

Hdf5Group Hdf5Group::create(const std::string& name, std::size_t links) {
  Hdf5Handle group(H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, links_in_header(links).id(), H5P_DEFAULT), H5Gclose);
  if (!group.valid()) fail("create group", name);
  return Hdf5Group(std::move(group), label_ + "/" + name);
}

Hdf5Group Hdf5Group::create_unlinked(const std::string& label) const {
  Hdf5Handle group(H5Gcreate_anon(handle_.id(), links_in_header(16).id(), H5P_DEFAULT), H5Gclose);
  if (!group.valid()) fail("create group", label);
  return Hdf5Group(std::move(group), label_ + "/" + label);
}

void Hdf5Group::link(const Hdf5Group& object, const std::string& name) {
  if (H5Olink(object.handle_.id(), handle_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0) fail("link", name);
}

void Hdf5Group::link(const Hdf5Group& source, const std::string& source_name, const std::string& name) {
  if (H5Lcreate_hard(source.handle_.id(), source_name.c_str(), handle_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
    fail("link", name);
}

void Hdf5Group::remove(const std::string& name) {
  if (H5Ldelete(handle_.id(), name.c_str(), H5P_DEFAULT) < 0) fail("remove", name);
}

}  // namespace forming_sim
