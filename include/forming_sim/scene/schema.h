#pragma once
// What a scene may say, told from the declarations.
#include <string>
#include <vector>

namespace forming_sim {

/// One declared field, in words.
struct FieldText {
  std::string name, type, unit, range, standard /* default */, when, doc;
  bool required = false;
};

/// The fields of one Config and the places in a scene where it stands.
struct GroupText {
  std::vector<std::string> paths;  ///< "bodies[].material"; "" is the scene itself
  std::string doc;
  std::vector<FieldText> fields;
};

/// All groups, each once, in the order in which a scene has them.
std::vector<GroupText> schema();

/// For a terminal: what `forming_offline --schema` prints.
std::string schema_text();
/// docs/scene.md: `forming_offline --schema markdown > docs/scene.md`.
std::string schema_markdown();

/// Complete scenes that docs/scene.md shows; they need no files.
std::string minimal_example();
std::string flange_example();

}  // namespace forming_sim
