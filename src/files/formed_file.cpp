#include "forming_sim/files/formed_file.h"

#include "config/archive.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/files/hdf5_file.h"

namespace forming_sim {

namespace {

constexpr std::int64_t kLayout = 2;  ///< counts up with every change of what is kept, that of the elements' memories too

template <class Archive> void exchange(Archive& a, FormedPart& part) {
  a.text(part.name);
  a.text(part.material);
  a.text(part.pressure_average);
  a.number(part.axisymmetric);
  for (std::vector<std::string>* names : {&part.pressed_by, &part.held_sets}) a.each(*names, [&](std::string& name) { a.text(name); });
  Mesh& mesh = part.mesh;
  a.number(mesh.dimension);
  a.list(mesh.nodes);
  a.each(mesh.cells, [&](Cells& cells) {
    a.number(cells.kind);
    a.list(cells.nodes);
  });
  a.list(mesh.surface);
  a.lists(mesh.sets);
  FormedMemory& memory = part.memory;
  a.list(memory.reference);
  a.each(memory.cells, [&](FormedCells& cells) {
    for (int* size : {&cells.points, &cells.items, &cells.hourglass_items}) a.number(*size);
    for (std::vector<double>* values : {&cells.memory, &cells.hourglass, &cells.ratio, &cells.damage}) a.list(*values);
  });
  a.number(memory.edges.items);
  a.list(memory.edges.ends);
  a.list(memory.edges.memory);
  a.list(memory.edges.edges);
  a.list(memory.edges.volume_ratio);
  a.list(memory.nodal_ratio);
}

std::string number_of(std::size_t part) { return std::to_string(part); }

[[noreturn]] void refuse(const std::string& path, const std::string& why) { throw Error(Code::mesh_error, "file \"" + path + "\" " + why); }

/// Calls read(/parts) of the file.
template <class Read> auto with_parts(const std::string& path, Read&& read) {
  try {
    const Hdf5File file(path, Hdf5File::Mode::read);
    const Hdf5Group root = file.root();
    if (!root.has("parts")) refuse(path, "holds no formed parts; give the formed.h5 of a run with output.formed");
    const Hdf5Group parts = root.group("parts");
    if (parts.integer("layout") != kLayout) refuse(path, "was written by a version that keeps other things; form its parts anew with this one");
    return read(parts);
  } catch (const Error& error) {
    if (error.code() == Code::mesh_error) throw;
    refuse(path, std::string("is damaged or no formed.h5 of a run: ") + error.what());
  }
}

}  // namespace

void save_formed(const std::string& path, const std::vector<FormedPart>& parts) {
  write_whole_file(path, [&](Hdf5Group& root) {
    Hdf5Group group = root.create("parts");
    group.set("layout", kLayout);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      FormedPart part = parts[k];
      Writer out;
      exchange(out, part);
      const std::vector<char> bytes = out.take();
      group.write_checked(number_of(k), std::string(bytes.begin(), bytes.end()));
      group.set("name " + number_of(k), part.name);
    }
    group.set("count", static_cast<std::int64_t>(parts.size()));
  });
}

std::vector<std::string> formed_names(const std::string& path) {
  return with_parts(path, [](const Hdf5Group& parts) {
    std::vector<std::string> names;
    for (std::int64_t k = 0; k < parts.integer("count"); ++k) names.push_back(parts.text("name " + number_of(static_cast<std::size_t>(k))));
    return names;
  });
}

FormedPart load_formed(const std::string& path, std::size_t which) {
  return with_parts(path, [&](const Hdf5Group& parts) {
    const std::string text = parts.read_checked(number_of(which));
    const std::vector<char> bytes(text.begin(), text.end());
    Reader in(bytes);
    FormedPart part;
    exchange(in, part);
    return part;
  });
}

}  // namespace forming_sim
