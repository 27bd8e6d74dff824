// The messages of a scene say of every field what its declaration says.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

#include "forming_sim/SceneSpec.h"
#include "forming_sim/scene/schema.h"

namespace forming_sim {
namespace {

/// A field of a message, and what the comment above it says, in one line.
struct MessageField {
  std::string type, name, comment;
};

/// The messages that a SceneSpec is made of, by their names, as the .msg files define them.
std::map<std::string, std::vector<MessageField>> messages_of_a_scene() {
  std::map<std::string, std::vector<MessageField>> messages;
  std::istringstream text(ros::message_traits::Definition<SceneSpec>::value());
  std::string line, message = "SceneSpec", comment;
  while (std::getline(text, line)) {
    if (line.rfind("MSG: ", 0) == 0) {  // and its package
      message = line.substr(line.find('/') + 1);
      comment.clear();
    } else if (line.rfind("# ", 0) == 0) {
      comment += (comment.empty() ? "" : " ") + line.substr(2);
    } else if (std::istringstream words(line); line.empty() || line[0] == '=') {
      comment.clear();
    } else if (MessageField field; words >> field.type >> field.name) {
      field.comment = std::exchange(comment, "");
      messages[message].push_back(field);
    }
  }
  return messages;
}

/// What stands above a field. A message holds 0, "" or [] where nothing is given, so defaults that say no more are left out.
std::string comment_of(const FieldText& field) {
  std::string text = (field.unit.empty() ? "" : "[" + field.unit + "] ") + field.doc;
  if (!field.range.empty()) text += (field.type == "text" ? "; one of " : "; ") + field.range;
  if (!field.when.empty()) text += "; " + field.when;
  if (field.required) return text + "; required" + (field.name == "from" ? ". In Python its name is from_, since from is a word of the language" : "");
  for (const char* nothing : {"none", "[]", "[0, 0, 0]", "0", "false"})
    if (field.standard == nothing) return text;
  return text + "; default: " + field.standard;
}

/// The message of a group is the type of the field that holds it: "bodies[].material" is found from SceneSpec by bodies and material.
std::string message_of(const std::string& path, const std::map<std::string, std::vector<MessageField>>& messages) {
  std::string message = "SceneSpec", name;
  for (std::istringstream names(path); std::getline(names, name, '.');) {
    name = name.substr(0, name.find('['));
    const auto& fields = messages.at(message);
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const MessageField& field) { return field.name == name; });
    if (found == fields.end()) return "";
    message = found->type.substr(0, found->type.find('['));
  }
  return message;
}

TEST(RosMessages, SayWhatTheSchemaSays) {
  const auto messages = messages_of_a_scene();
  std::size_t fields = 0;
  for (const GroupText& group : schema()) {
    const std::string message = message_of(group.paths.front(), messages);
    ASSERT_EQ(messages.count(message), 1u) << group.paths.front();
    for (const FieldText& field : group.fields) {
      const auto& of = messages.at(message);
      const auto found = std::find_if(of.begin(), of.end(), [&](const MessageField& f) { return f.name == field.name; });
      ASSERT_NE(found, of.end()) << message << " has no " << field.name;
      EXPECT_EQ(found->comment, comment_of(field)) << "msg/" << message << ".msg, above " << field.name << ":\n# " << comment_of(field) << "\nnot\n# " << found->comment;
      ++fields;
    }
    const std::size_t others = message == "MeshSpec" ? 1 : 0;  // shape, the ROS spelling of an inline mesh
    EXPECT_EQ(messages.at(message).size(), group.fields.size() + others) << "msg/" << message << ".msg has fields that the schema has not";
  }
  EXPECT_GT(fields, 150u);
}

}  // namespace
}  // namespace forming_sim
