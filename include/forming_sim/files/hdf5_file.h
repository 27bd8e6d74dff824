#pragma once
// HDF5 files: handles that close themselves, errors as sentences.
// Every function throws Error(output_error) with file, object and reason;
// nothing is printed by the HDF5 library itself.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace forming_sim {

/// An HDF5 identifier that is closed with its owner.
class Hdf5Handle {
 public:
  using Close = int (*)(std::int64_t);
  Hdf5Handle() = default;
  Hdf5Handle(std::int64_t id, Close close) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept { swap(other); }
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept { swap(other); return *this; }
  ~Hdf5Handle() { close(); }
  /// False where what was still to be written then could not be.
  bool close() {
    const std::int64_t id = std::exchange(id_, -1);
    return id < 0 || !close_ || close_(id) >= 0;
  }
  std::int64_t id() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  void swap(Hdf5Handle& other) { std::swap(id_, other.id_); std::swap(close_, other.close_); }
  std::int64_t id_ = -1;
  Close close_ = nullptr;
};

/// How a dataset lies in the file.
enum class Storage {
  plain,    ///< as it is
  packed    ///< bytes shuffled, deflated at level 1, where there are many
};

/// A group of a file, and what it holds. T: double, float, int32_t, uint8_t.
class Hdf5Group {
 public:
  /// row-major array of one axis or more; `unit` becomes the attribute "unit" of the dataset.
  template <class T>
  void write(const std::string& name, const T* data, const std::vector<std::uint64_t>& shape, const std::string& unit,
             Storage storage = Storage::packed);
  /// One string; it may be longer than the 64 KiB of an attribute.
  void write_text(const std::string& name, const std::string& text);
  /// Bytes beside their hash, which is verified on reading; what describes them lies in headers with checksums.
  void write_checked(const std::string& name, const std::string& bytes);
  template <class T>
  std::vector<T> read(const std::string& name) const;
  std::string read_text(const std::string& name) const;
  std::string read_checked(const std::string& name) const;

  /// An attribute that is not there yet.
  void set(const std::string& attribute, const std::string& value);
  void set(const std::string& attribute, const char* value) { set(attribute, std::string(value)); }
  void set(const std::string& attribute, double value);
  void set(const std::string& attribute, std::int64_t value);
  std::string text(const std::string& attribute) const;
  double number(const std::string& attribute) const;
  std::int64_t integer(const std::string& attribute) const;

  bool has(const std::string& name) const;
  std::vector<std::string> names() const;      ///< of its members, in order of name
  Hdf5Group group(const std::string& name) const;
  /// links: how many it will hold, as far as is known.
  Hdf5Group create(const std::string& name, std::size_t links = 16);
  /// A group that no other group holds yet: it is in the file once it is linked.
  Hdf5Group create_unlinked(const std::string& label) const;
  /// Makes `object` (of this file) a member under this name.
  void link(const Hdf5Group& object, const std::string& name);
  /// Makes the member `source_name` of `source` a member here too (a hard link).
  void link(const Hdf5Group& source, const std::string& source_name, const std::string& name);
  void remove(const std::string& name);

 private:
  friend class Hdf5File;
  Hdf5Group(Hdf5Handle handle, std::string label) : handle_(std::move(handle)), label_(std::move(label)) {}
  [[noreturn]] void fail(const std::string& action, const std::string& name) const;
  Hdf5Handle handle_;
  std::string label_;  ///< "result.h5:/frames"
};

class Hdf5File {
 public:
  enum class Mode { create, read, append };
  Hdf5File(const std::string& path, Mode mode);
  ~Hdf5File();
  Hdf5File(Hdf5File&&) noexcept = default;
  Hdf5File& operator=(Hdf5File&&) noexcept = default;
  Hdf5Group root() const;
  /// All that was written is in the file when it returns.
  void flush();
  /// A flush goes through all metadata in memory: what the last one has put into the file need not stay there.
  void forget();
  /// Flushes and closes; groups must have been released. The destructor closes silently.
  void close();

 private:
  std::string path_;
  Hdf5Handle handle_;
};

/// A file that is the old or the new one, whole, wherever the program is stopped: what `fill` writes goes to a temporary name, which is renamed.
void write_whole_file(const std::string& path, const std::function<void(Hdf5Group& root)>& fill);

}  // namespace forming_sim
